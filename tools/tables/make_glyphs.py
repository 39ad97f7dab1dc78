# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write addon/preview/drawing/glyphs.py: outlines of the letters in the panel's pictures.

The font is Inter (SIL Open Font License 1.1, no reserved name), which Blender's own interface is
set in. Needs fontTools and brotli, which the extension does not. Equal fonts give equal bytes:

    python -m tools.tables.make_glyphs …/datafiles/fonts/Inter.woff2
"""

from __future__ import annotations

import argparse
import base64
import itertools
import os
import sys
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from tools.run.run_command_line import ROOT

Array = npt.NDArray[np.int64]

MODULE = ROOT / "addon" / "preview" / "drawing" / "glyphs.py"
CHARACTERS = "".join(map(chr, range(32, 127))) + "°²±µ·×Δθλπρσ–…−≤≥"
EM = 1024
"""Units an em in the table."""
TOLERANCE = 1.5
"""How far a chord may leave its curve, in those units: 0.1 pixels in letters 68 pixels high."""
WIDTH = 92
"""Characters a line of the table."""

HEADER = '''# SPDX-FileCopyrightText: 2016 The Inter Project Authors (https://github.com/rsms/inter)
# SPDX-License-Identifier: OFL-1.1
"""Outlines of Inter {version}, written by tools/tables/make_glyphs.py; not by hand.

This Font Software is licensed under the SIL Open Font License, Version 1.1: see OFL-1.1.txt.
`preview.drawing.text` reads it.
"""

# Units an em; heights above the baseline.
EM = {em}
CAP_HEIGHT = {cap}
X_HEIGHT = {x}

CHARACTERS = (
    {characters}
)

# 16-bit integers, deflated, in base 85: advance and number of contours of each character, number of
# points of each contour, and the steps from point to point, along x and then along y.
ADVANCES = {advances}
CONTOURS = {contours}
POINTS = {points}
STEPS = {steps}
'''


def main() -> None:
    """Write the module."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("font", type=Path, help="Inter, as Blender ships it")
    text = module(parser.parse_args().font)
    part = MODULE.with_name(f".{MODULE.name}.part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, MODULE)
    print(f"{MODULE}: {len(CHARACTERS)} characters, {len(text.encode())} bytes")


def module(path: Path) -> str:
    """Return the module's text."""
    from fontTools.ttLib import TTFont

    font = TTFont(path)
    names, glyphs = font.getBestCmap(), font.getGlyphSet()
    missing = [c for c in CHARACTERS if ord(c) not in names]
    if missing:
        sys.exit(f"{path} has no {' '.join(missing)}; take Inter as Blender 4.5 or newer ships it.")
    scale = EM / font["head"].unitsPerEm
    outlines = [contours(glyphs[names[ord(c)]], glyphs, scale) for c in CHARACTERS]
    flat = [contour for outline in outlines for contour in outline]
    steps = np.concatenate([np.diff(c, axis=0, prepend=np.zeros((1, 2), int)) for c in flat])
    advances = [round(glyphs[names[ord(c)]].width * scale) for c in CHARACTERS]
    os2 = font["OS/2"]
    return HEADER.format(
        version=font["name"].getDebugName(5).removeprefix("Version "),
        em=EM,
        cap=round(os2.sCapHeight * scale),
        x=round(os2.sxHeight * scale),
        characters=quoted(CHARACTERS),
        advances=packed(np.array(advances)),
        contours=packed(np.array([len(outline) for outline in outlines])),
        points=packed(np.array([len(c) for c in flat])),
        steps=packed(steps.T),
    )


def contours(glyph: Any, glyphs: Any, scale: float) -> list[Array]:
    """Polygons of one glyph in table units, each of shape (points, 2)."""
    from fontTools.pens.recordingPen import DecomposingRecordingPen

    pen = DecomposingRecordingPen(glyphs)
    glyph.draw(pen)
    found: list[list[tuple[float, float]]] = []
    for verb, points in pen.value:
        at = [(x * scale, y * scale) for x, y in points]
        if verb == "moveTo":
            found.append(at)
        elif verb == "lineTo":
            found[-1] += at
        elif verb == "qCurveTo":
            for control, end in quadratics(at):
                found[-1] += chords(found[-1][-1], control, end)
        elif verb != "closePath":
            sys.exit(f"The font draws with {verb}, which its kind of outline has no use for.")
    rounded = [np.rint(np.array(contour)).astype(int) for contour in found]
    return [contour[np.any(contour != np.roll(contour, 1, axis=0), axis=1)] for contour in rounded]


def quadratics(
    points: list[tuple[float, float]],
) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Split TrueType's run of controls into curves; between two controls lies a point of it."""
    *controls, last = points
    ends = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in itertools.pairwise(controls)]
    return list(zip(controls, [*ends, last], strict=True))


def chords(
    start: tuple[float, float], control: tuple[float, float], end: tuple[float, float]
) -> list[tuple[float, float]]:
    """Points along a quadratic curve, its start left out."""
    a, b, c = np.array(start), np.array(control), np.array(end)
    # A chord over 1/n of the curve leaves it by |a - 2b + c| / 4n².
    count = max(1, int(np.ceil(np.sqrt(np.hypot(*(a - 2 * b + c)) / (4 * TOLERANCE)))))
    t = np.linspace(0, 1, count + 1)[1:, np.newaxis]
    return [(x, y) for x, y in ((1 - t) ** 2 * a + 2 * t * (1 - t) * b + t**2 * c).tolist()]


def packed(integers: Array) -> str:
    """Write 16-bit integers as a literal; high bytes apart, since they are mostly alike."""
    planes = integers.astype("<i2").ravel().view(np.uint8).reshape(-1, 2).T
    text = base64.b85encode(zlib.compress(planes.tobytes(), 9)).decode("ascii")
    if len(text) <= WIDTH:
        return f'"{text}"'
    lines = [f'    "{text[start : start + WIDTH]}"' for start in range(0, len(text), WIDTH)]
    return "\n".join(["(", *lines, ")"])


def quoted(text: str) -> str:
    """Write a string literal as the formatter would."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped[:WIDTH]}"\n    "{escaped[WIDTH:]}"'


if __name__ == "__main__":
    main()
