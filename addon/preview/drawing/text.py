# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Text on a canvas, in the font of Blender's own interface.

The outlines come along (`glyphs`), because nothing that Blender offers serves everywhere: its
OpenImageIO is built without fonts, and what `blf` draws into memory cannot be read back before
Blender 5. Outlines are crisp at any size and need no window.
"""

from __future__ import annotations

import base64
import zlib

import numpy as np

from ....core.numerics.arrays import Array
from ....core.numerics.memoized import memoized
from . import glyphs, raster

_UNKNOWN = "?"


def draw(
    canvas: Array,
    text: str,
    x: float,
    y: float,
    size: float,
    color: raster.Color,
    align: float = 0,
    alpha: float = 1,
) -> None:
    """Write one line of text.

    Parameters
    ----------
    x, y
        Place of the baseline, pixels.
    size
        Pixels an em.
    align
        Share of the text that lies left of `x`: 0, 0.5 or 1.
    """
    coverage, above = _coverage(text, size)
    # Whole pixels: a baseline between two rows would blur every letter.
    left = round(x - align * width(text, size)) - 1
    raster.paint(canvas, coverage, left, round(y) - above, color, alpha)


def width(text: str, size: float) -> float:
    """Length of the text, pixels."""
    return sum(_outline(c)[0] for c in text) * size / glyphs.EM


def height(size: float) -> float:
    """Height of capitals and digits, pixels."""
    return glyphs.CAP_HEIGHT * size / glyphs.EM


@memoized(maxsize=512)
def _coverage(text: str, size: float) -> tuple[Array, int]:
    """Coverage of a text that starts in its second column, and rows above the baseline."""
    scale = size / glyphs.EM
    above, below = int(np.ceil(1.05 * size)), int(np.ceil(0.3 * size))
    starts, ends, pen = [], [], 1.0
    for character in text:
        advance, start, end = _outline(character)
        offset = np.array((pen, above))
        starts.append(start * (scale, -scale) + offset)
        ends.append(end * (scale, -scale) + offset)
        pen += advance * scale
    shape = (above + below, int(np.ceil(pen)) + 2)
    if not text:
        return np.zeros(shape, np.float32), above
    found = raster.area(np.concatenate(starts), np.concatenate(ends), shape)
    found.setflags(write=False)
    return found, above


def _outline(character: str) -> tuple[int, Array, Array]:
    """Advance and edges of a character; a question mark for one that the table lacks."""
    table = _table()
    return table.get(character, table[_UNKNOWN])


@memoized(maxsize=1)
def _table() -> dict[str, tuple[int, Array, Array]]:
    advances, counts, sizes = map(_unpack, (glyphs.ADVANCES, glyphs.CONTOURS, glyphs.POINTS))
    steps = _unpack(glyphs.STEPS).reshape(2, -1).T
    contours = iter(np.split(steps, np.cumsum(sizes)[:-1]))
    table = {}
    for character, advance, count in zip(
        glyphs.CHARACTERS, advances.tolist(), counts.tolist(), strict=True
    ):
        points = [np.cumsum(next(contours), axis=0) for _ in range(count)]
        ends = [np.roll(contour, -1, axis=0) for contour in points]
        nothing = np.zeros((0, 2))
        table[character] = (
            advance,
            np.concatenate([nothing, *points]),
            np.concatenate([nothing, *ends]),
        )
    return table


def _unpack(text: str) -> Array:
    """Read what tools/tables/make_glyphs.py packed: 16-bit integers, low bytes first."""
    planes = np.frombuffer(zlib.decompress(base64.b85decode(text)), np.uint8).reshape(2, -1)
    return np.asarray(planes.T.copy().view("<i2").ravel(), np.int64)
