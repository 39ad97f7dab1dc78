# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the names of files end with that can be read, told without importing what reads them.

Blender wants to know when it starts which files may be dropped, and every format imports numpy.
So the line `ENDINGS = (…)` of each format's file is looked up in its text.
"""

from __future__ import annotations

import re
from pathlib import Path

_FORMATS = Path(__file__).parent / "readers" / "formats"
_LINE = re.compile(rb"\nENDINGS = \(([^)]*)\)\n")
_WORD = re.compile(rb'"(\w+)"')


def endings() -> list[str]:
    """Give the endings of all formats, without a period, in the order of the alphabet.

    They are a hint: whether a file can be read follows from its content.
    """
    found: set[str] = set()
    for path in _FORMATS.glob("*.py"):
        for line in _LINE.finditer(path.read_bytes()):
            found.update(word.decode() for word in _WORD.findall(line[1]))
    return sorted(found)
