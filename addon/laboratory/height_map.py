# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A user's own surface: an image of heights, or what a profilometer exports as text.

Which of the texts a file is follows from its content:

- ISO 25178-71 SDF, ASCII: a header with NumPoints, NumProfiles, Xscale, Yscale, Zscale.
- Three columns x, y, z, a point a line, on a regular grid in any order.
- A matrix of heights, a profile a line. An ESRI header (ncols, nrows, cellsize) gives its spacing,
  otherwise the caller has to.

The plane of the sample is taken out, as an instrument looks along its normal, whatever the table
of the profilometer was like; nothing else is: not a wave, not a scratch. For the surface to go on
at its edges it is mirrored there.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ...core.errors import InputError
from ...core.heights import HeightField
from ...core.numerics.arrays import Array
from ..support.openimageio import openimageio

LARGEST = 2048
"""Heights a side: mirrored, 4096 × 4096 cells would be the most that a render can hold."""

IMAGES = (".exr", ".png", ".tif", ".tiff", ".hdr")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_MISSING = {"nan", "bad", "na", "null", "***", "---"}
_LARGEST_BYTES = 500_000_000


def read(path: Path, spacing: float | None = None) -> HeightField:
    """Read a surface, level it and mirror it at its edges.

    Parameters
    ----------
    path
        Of the file.
    spacing
        Between two heights, in the unit of the heights; needed where the file does not say it. In
        images it is in units of the whole range from black to white of 8 or 16 bits, or of the
        values of a float image.

    Raises
    ------
    InputError
        If the file cannot be read as heights, has holes, or does not say its spacing and none is
        given.
    """
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise _fault(path, "is larger than 500 MB; export a smaller part of the surface")
        is_image = path.suffix.lower() in IMAGES
        values, own = _image(path) if is_image else _text(path, path.read_text("utf-8", "replace"))
    except OSError as error:
        raise _fault(path, f"cannot be read ({error.strerror}); check the path") from error
    rows, columns = values.shape
    if min(rows, columns) < 4:
        raise _fault(path, f"has {columns} × {rows} heights; a surface needs 4 × 4 or more")
    if max(rows, columns) > LARGEST:
        raise _fault(
            path,
            f"has {columns} × {rows} heights; export a part of at most {LARGEST} × {LARGEST}",
        )
    missing = int(np.count_nonzero(~np.isfinite(values)))
    if missing:
        raise _fault(
            path,
            f"has {missing} heights missing of {values.size}; fill the holes in the program of the "
            "profilometer, and export it again",
        )
    if own is None and spacing is None:
        raise _fault(
            path, "does not say how far apart its heights are; give the length between two of them"
        )
    steps = own if own is not None else (float(spacing or 0), float(spacing or 0))
    return HeightField(mirrored(level(values)), steps)


def level(heights: Array) -> Array:
    """Take out the plane that is nearest to the heights by least squares."""
    rows, columns = heights.shape
    x = np.linspace(-1, 1, columns)
    y = np.linspace(-1, 1, rows)[:, np.newaxis]
    centered = heights - heights.mean()
    along_x = np.sum(centered * x) / (rows * np.sum(x**2))
    along_y = np.sum(centered * y) / (columns * np.sum(y**2))
    return np.asarray(centered - along_x * x - along_y * y)


def mirrored(heights: Array) -> Array:
    """Let a surface meet itself at its edges, without a step."""
    across = np.concatenate((heights, heights[:, ::-1]), axis=1)
    return np.concatenate((across, across[::-1]), axis=0)


def _image(path: Path) -> tuple[Array, None]:
    oiio = openimageio()
    image = oiio.ImageInput.open(str(path))
    if image is None:
        oiio.geterror()
        raise _fault(path, "cannot be read as an image; check the file")
    try:
        spec = image.spec()
        if max(spec.width, spec.height) > LARGEST:
            size = f"{spec.width} × {spec.height}"
            raise _fault(path, f"has {size} pixels; crop it to at most {LARGEST} × {LARGEST}")
        if spec.format.basetype == oiio.UINT8:
            raise _fault(
                path,
                "has 8 bits a pixel, steps that a light at 45° sees as terraces; save heights with "
                "16 bits or as floating point",
            )
        pixels = image.read_image(0, 0, 0, 1, oiio.FLOAT)
    finally:
        image.close()
    if pixels is None:
        raise _fault(path, "is damaged; save the image again")
    values = np.asarray(pixels, np.float64).reshape(spec.height, spec.width)
    return values[::-1], None  # images begin at the top


def _text(path: Path, text: str) -> tuple[Array, tuple[float, float] | None]:
    lines = [line.strip() for line in text.splitlines()]
    if lines and re.match(r"[ab][A-Z]+-\d", lines[0]):
        return _sdf(path, lines)
    header: dict[str, float] = {}
    rows: list[list[float]] = []
    width = None
    for number, line in enumerate(lines, 1):
        words = re.split(r"[\s;]+|,\s*", line.strip(";, \t"))
        if not line or line[0] in "#%*":
            continue
        if not rows and len(words) == 2 and re.fullmatch(r"[A-Za-z_]+", words[0]):
            header[words[0].lower()] = _value(path, number, words[1])
            continue
        if not rows and not _NUMBER.fullmatch(words[0]) and words[0].lower() not in _MISSING:
            continue  # names of columns
        row = [_value(path, number, word) for word in words]
        width = len(row) if width is None else width
        if len(row) != width:
            raise _fault(
                path, f"line {number} has {len(row)} numbers and not {width}, as the first"
            )
        rows.append(row)
    if not rows:
        raise _fault(path, "has no heights: neither an image nor a table of numbers")
    table = np.array(rows)
    if width == 3 and len(rows) > 3:
        return _points(path, table)
    if "nodata_value" in header:
        table[table == header["nodata_value"]] = np.nan
    own = header.get("cellsize")
    # An ESRI grid begins with its northern row; what is no grid of a map begins where it begins.
    return (table[::-1] if own else table), ((own, own) if own else None)


def _value(path: Path, number: int, word: str) -> float:
    if word.lower() in _MISSING:
        return float("nan")
    try:
        return float(word)
    except ValueError:
        raise _fault(path, f"line {number}: {word[:20]!r} is no number") from None


def _points(path: Path, table: Array) -> tuple[Array, tuple[float, float]]:
    """Put points into their grid."""
    (x, column), (y, row) = (_places(table[:, axis]) for axis in (0, 1))
    if len(x) * len(y) > 4 * len(table) or min(len(x), len(y)) < 2:
        raise _fault(path, "has points that lie on no regular grid; export it as a grid")
    steps = []
    for name, at in (("x", x), ("y", y)):
        apart = np.diff(at)
        if apart.max() > 1.01 * apart.min() + 1e-12:
            raise _fault(path, f"has points unevenly spaced along {name}; export an even grid")
        steps.append(float(apart.mean()))
    values = np.full((len(y), len(x)), np.nan)
    values[row, column] = table[:, 2]
    return values, (steps[0], steps[1])


def _places(coordinates: Array) -> tuple[Array, Array]:
    """Coordinates of a grid's lines, told apart where they differ by more than rounding."""
    order = np.argsort(coordinates, kind="stable")
    ordered = coordinates[order]
    rounding = 1e-6 * (ordered[-1] - ordered[0])
    line = np.concatenate(([0], np.cumsum(np.diff(ordered) > rounding)))
    which = np.empty(len(coordinates), int)
    which[order] = line
    lines = np.bincount(line, ordered) / np.bincount(line)
    return lines, which


def _sdf(path: Path, lines: list[str]) -> tuple[Array, tuple[float, float]]:
    """Read ISO 25178-71: a header up to a star, data up to a star."""
    if lines[0].startswith("b"):
        raise _fault(path, "is a binary SDF file; export the ASCII one")
    header, start = {}, len(lines)
    for number, line in enumerate(lines[1:], 1):
        if line.startswith("*"):
            start = number + 1
            break
        name, _, value = line.partition("=")
        header[name.strip().lower()] = value.strip()
    try:
        columns, rows = (int(header[name]) for name in ("numpoints", "numprofiles"))
        scale_x, scale_y, scale_z = (float(header[f"{axis}scale"]) for axis in "xyz")
    except (KeyError, ValueError) as error:
        raise _fault(path, f"has a header without a readable {error}; export it again") from error
    words: list[str] = []
    for line in lines[start:]:
        if line.startswith("*"):
            break
        words += line.split()
    if len(words) != columns * rows:
        raise _fault(path, f"has {len(words)} heights and not {columns} × {rows}; export it again")
    values = np.array([_value(path, start, word) for word in words]).reshape(rows, columns)
    return values * scale_z, (scale_x, scale_y)


def _fault(path: Path, said: str) -> InputError:
    return InputError(f"{path} {said}.")
