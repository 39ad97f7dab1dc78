# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One subject, one place: constants and formulas that may stand in one file only."""

from __future__ import annotations

import io
import re
import tokenize
from functools import lru_cache
from pathlib import Path

import pytest

from tests.architecture import house

SUBJECTS = {
    "the curve of sRGB": (r"0\.0031308|0\.04045|12\.92", "addon/colorimetry/srgb.py"),
    "sRGB from XYZ": (r"3\.2406|0\.2126", "addon/colorimetry/srgb.py"),
    "Bradford's adaptation": (r"0\.8951", "core/color/color_difference.py"),
    "CIEDE2000": (r"radians\(275\)", "core/color/color_difference.py"),
    "the end of σ": (
        r"1\.5707|\bSIGMA\w* = (90|math|np)|degrees <= 90|max=(math\.|np\.)?pi / 2",
        None,
    ),
    "the largest σ": (r"LARGEST_SIGMA_DEGREES = |LARGEST_SIGMA = ", "core/limits.py"),
    "the usual tolerance": (r"\bTOLERANCE = |tolerance[^=\n]*= 1\.0", "core/limits.py"),
    "ranges of wavelengths": (
        r"\((360|380)\.0, 780\.0\)|\(400\.0, 700\.0\)|arange\(3[68]0(\.0)?, 78[01]",
        "core/limits.py",
    ),
    "the published weights": (r"\b0\.17 \* |s2 \+ 0\.13\b", "core/oren_nayar.py"),
    "the lobe of Cycles": (r"\b5\.6\b", "core/cycles/lobe.py"),
}
"""Patterns of code, and the file in which they may stand; None where they may not at all."""

ALSO = {"the published weights": {"core/reading.py"}}
"""`core.reading` quotes the fit in the textbook's geometric series and in the bound on σ."""


@lru_cache(maxsize=1024)
def code(text: str) -> str:
    """Give a module's text without comments, strings and docstrings."""
    kept = []
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type in (tokenize.NL, tokenize.NEWLINE):
            kept.append("\n")
        elif token.type not in (tokenize.COMMENT, tokenize.STRING):
            kept.append((" " if token.line[: token.start[1]].endswith(" ") else "") + token.string)
    return "".join(kept)


def places(root: Path, pattern: str) -> set[str]:
    """Files whose code holds a pattern."""
    texts = {path: (root / path).read_text(encoding="utf-8") for path in house.files(root).values()}
    return {path for path, text in texts.items() if re.search(pattern, code(text))}


@pytest.mark.parametrize("subject", SUBJECTS)
def test_each_subject_has_one_place(subject):
    pattern, place = SUBJECTS[subject]
    allowed = ALSO.get(subject, set()) | ({place} if place else set())
    assert places(house.ROOT, pattern) - allowed == set()
    if place:
        assert place in places(house.ROOT, pattern)


def test_a_second_place_is_found(broken):
    root = broken("addon/scene/world.py", "_DARK = 0.0031308  # again")
    pattern, place = SUBJECTS["the curve of sRGB"]
    assert places(root, pattern) == {place, "addon/scene/world.py"}
