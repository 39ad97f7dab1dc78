# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Start a desktop Blender, with a new and empty user folder, for a script to act in its window."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

SECONDS = 600


def run(blender: str, script: Path, size: tuple[int, int], words: Sequence[object]) -> int:
    """Run a script in a window and give Blender's exit status.

    Parameters
    ----------
    blender
        The executable; a screen (or a virtual one) has to be there.
    script
        Installs the extension and ends Blender.
    size
        Width and height of the window in pixels.
    words
        The script's arguments.
    """
    with tempfile.TemporaryDirectory(prefix="rough-spectra-user-") as user:
        command = [
            *(blender, "--gpu-backend", "opengl", "--enable-event-simulate"),
            *("--window-geometry", "0", "0", *map(str, size)),
            *("--python-exit-code", "1", "--python", str(script), "--", *map(str, words)),
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
