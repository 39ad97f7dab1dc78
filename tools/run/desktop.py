# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Start a desktop Blender, with a new and empty user folder, for a module to act in its window."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence

from tools.run.run_command_line import ROOT

SECONDS = 600


def run(blender: str, module: str, size: tuple[int, int], words: Sequence[object]) -> int:
    """Call `start` of a module in a window and give Blender's exit status.

    Parameters
    ----------
    blender
        The executable; a screen (or a virtual one) has to be there.
    module
        Of tools/; its `start` installs the extension and ends Blender in the end.
    size
        Width and height of the window in pixels.
    words
        The module's arguments.
    """
    start = (
        f"import importlib, sys; sys.path.insert(0, {str(ROOT)!r}); "
        f"importlib.import_module({module!r}).start()"
    )
    with tempfile.TemporaryDirectory(prefix="rough-spectra-user-") as user:
        command = [
            *(blender, "--gpu-backend", "opengl", "--enable-event-simulate"),
            *("--window-geometry", "0", "0", *map(str, size)),
            *("--python-exit-code", "1", "--python-expr", start, "--", *map(str, words)),
        ]
        try:
            done = subprocess.run(
                command,
                env=os.environ | {"BLENDER_USER_RESOURCES": user},
                timeout=SECONDS,
                check=False,
            )
        except subprocess.TimeoutExpired:
            print(f"Blender did not end within {SECONDS} s.", file=sys.stderr)
            return 1
    return done.returncode
