# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lay all pictures of the shelf on one sheet for the manual, group by group, with their names.

    .venv/bpy-5.2/bin/python -m tools.manual.shelf_sheet [FILE]

The pictures are those that the asset library ships with; none is rendered.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import ROOT, load_extension
from tools.tables import make_shelf

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.assets import shelf
from rough_spectra.addon.preview.drawing import raster, text
from rough_spectra.addon.samples import presets

TARGET = ROOT / "docs" / "images" / "shelf.jpg"
COLUMNS = 10
CELL, BALL, MARGIN = 128, 80, 12
TITLE, NAME = 17, 10.5
HEAD, FOOT = 34, 34
BACKGROUND, INK = (0.97, 0.97, 0.97), (0.15, 0.15, 0.15)


def groups() -> dict[str, list[str]]:
    """Return the names of the everyday presets by the shelf's groups."""
    found: dict[str, list[str]] = {}
    for name in presets.names_of("everyday"):
        title = make_shelf.group(name.partition("/")[2])
        found.setdefault(title, []).append(presets.load(name).name)
    return dict(sorted(found.items()))


def pictures() -> dict[str, Any]:
    """Return each material's preview, bytes of shape (pixels, pixels, 4), the first row on top."""
    with bpy.data.libraries.load(str(shelf.folder() / shelf.BLEND)) as (there, wanted):
        wanted.materials = list(there.materials)
    found = {}
    for material in wanted.materials:
        wide, high = material.preview.image_size
        pixels = np.empty(wide * high * 4, np.float32)
        material.preview.image_pixels_float.foreach_get(pixels)
        found[material.name] = pixels.reshape(high, wide, 4)[::-1]
    return found


def smaller(picture: Any, pixels: int) -> Any:
    """Return a picture of another size: the nearest of its pixels, after a mean of four."""
    soft = (picture + np.roll(picture, 1, 0) + np.roll(picture, 1, 1)) / 3
    at = np.arange(pixels) * len(picture) // pixels
    return soft[at][:, at]


def lines(name: str) -> list[str]:
    """Return a name in as many lines as fit below its picture."""
    found = [""]
    for word in name.split(" "):
        longer = f"{found[-1]} {word}".strip()
        if found[-1] and text.width(longer, NAME) > CELL - 6:
            found.append(word)
        else:
            found[-1] = longer
    return found


def main(arguments: list[str]) -> int:
    """Draw the sheet and say where."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("file", type=Path, nargs="?", default=TARGET)
    file = parser.parse_args(arguments).file
    extension = load_extension()
    extension.register()
    try:
        balls, named = pictures(), groups()
    finally:
        extension.unregister()
    rows = sum(-(-len(names) // COLUMNS) for names in named.values())
    height = MARGIN + len(named) * HEAD + rows * (BALL + FOOT)
    canvas = raster.blank(height, COLUMNS * CELL)
    raster.rectangle(canvas, (0, 0, canvas.shape[1], height), BACKGROUND)
    top = MARGIN
    for title, names in named.items():
        text.draw(canvas, title, 10, top + 20, TITLE, INK)
        top += HEAD
        for place, name in enumerate(names):
            row, column = divmod(place, COLUMNS)
            _put(canvas, balls[name], column * CELL, top + row * (BALL + FOOT))
            middle = column * CELL + CELL / 2
            for number, line in enumerate(lines(name)):
                below = top + row * (BALL + FOOT) + BALL + 12 * (number + 1)
                text.draw(canvas, line, middle, below, NAME, INK, align=0.5)
        top += -(-len(names) // COLUMNS) * (BALL + FOOT)
    _write(file, canvas[..., :3])
    print(f"{sum(map(len, named.values()))} materials in {file}")
    return 0


def _write(file: Path, pixels: Any) -> None:
    bpy.utils.expose_bundled_modules()
    import OpenImageIO

    rows, columns, _ = pixels.shape
    about = OpenImageIO.ImageSpec(columns, rows, 3, OpenImageIO.UINT8)
    about.attribute("compression", "jpeg:88")
    picture = OpenImageIO.ImageBuf(about)
    picture.set_pixels(OpenImageIO.ROI(0, columns, 0, rows), np.ascontiguousarray(pixels))
    if not picture.write(str(file)):
        raise SystemExit(f"{file} cannot be written: {picture.geterror()}")


def _put(canvas: Any, picture: Any, left: int, top: int) -> None:
    left += (CELL - BALL) // 2
    small = smaller(picture, BALL)
    share = small[..., 3:]
    part = canvas[top : top + BALL, left : left + BALL, :3]
    part[:] = np.round(255 * small[..., :3] * share + part * (1 - share))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
