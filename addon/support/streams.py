# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Order between what Blender prints and what we say."""

from __future__ import annotations

import contextlib
import sys


def flush_blender() -> None:
    """Let out what Blender itself printed, which its C library keeps back in pipes and files.

    Else a log would end in Blender's first line instead of in our last one.
    """
    import ctypes

    with contextlib.suppress(OSError, AttributeError):
        library = ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None)
        library.fflush(None)
