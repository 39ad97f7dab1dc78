# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw the panel's pictures for the manual into docs/images, with the extension's own code.

    python -m tools.manual.preview_figures

Needs the bpy module, no matplotlib. Equal numbers give equal bytes.
"""

from __future__ import annotations

import os
import sys
from dataclasses import replace

from tools.run.run_command_line import ROOT, load_extension

IMAGES = ROOT / "docs" / "images"
PRESETS = ROOT / "presets" / "colorchecker"
THEMES = {"dark": ((0.239,) * 3, (0.902,) * 3), "light": ((0.8,) * 3, (0.102,) * 3)}
SCALE = 2
SHEET, PAIR, GAP = 300, 110, 10


def main():
    extension = load_extension()
    extension.register()
    import numpy as np

    sheets = [sheet("14-green", 35, *THEMES[name]) for name in THEMES]
    save("preview-sheet", np.concatenate(sheets, axis=1))
    pairs = [
        pair("14-green", 35, "closure", None),
        pair("14-green", 35, "closure", 0.0),
        pair("18-cyan", 20, "closure", None),
    ]
    save("preview-swatches", np.concatenate(pairs, axis=1))
    extension.unregister()


def numbers(name, degrees, model, green=None):
    """What the figures of a preset show; with `green` the node's second channel set by hand."""
    import numpy as np
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.matching import solve
    from rough_spectra.addon.preview.figures import data
    from rough_spectra.addon.samples import readers

    [sample] = readers.read(PRESETS / f"{name}.json")
    request = solve.Request(replace(sample, kind="reading"), float(np.radians(degrees)), model)
    space = working_space.current()
    [solution] = solve.solve([request], space)
    color = solution.color.copy()
    if green is not None:
        color[1] = color[1] * 0.8 + green
    return data.of_request(request, color, solution.roughness, space)


def sheet(name, degrees, background, ink):
    from rough_spectra.addon.preview.drawing import looks
    from rough_spectra.addon.preview.figures import compose

    look = looks.look(background, ink, float(SCALE))
    found = numbers(name, degrees, "closure")
    return on(background, compose.picture("sheet", found, SHEET * SCALE, look))


def pair(name, degrees, model, green):
    from rough_spectra.addon.preview.drawing import looks
    from rough_spectra.addon.preview.figures import compose

    background, ink = THEMES["dark"]
    look = looks.look(background, ink, float(SCALE))
    found = numbers(name, degrees, model, green)
    return on(background, compose.picture("swatches", found, PAIR * SCALE, look))


def on(background, canvas):
    """Lay a picture on the color of the panel, with room around it."""
    import numpy as np

    gap = GAP * SCALE
    padded = np.pad(canvas, ((gap, gap), (gap, gap), (0, 0))) / np.float32(255)
    return padded[..., :3] + (1 - padded[..., 3:]) * np.float32(background)


def save(name, picture):
    import numpy as np
    from rough_spectra.addon.support.openimageio import openimageio

    oiio = openimageio()
    pixels = np.ascontiguousarray(np.rint(np.clip(picture, 0, 1) * 255).astype(np.uint8))
    height, width = pixels.shape[:2]
    image = oiio.ImageBuf(oiio.ImageSpec(width, height, 3, "uint8"))
    image.set_pixels(oiio.ROI(), pixels)
    part = IMAGES / f".{name}.part.png"
    if not image.write(str(part)):
        sys.exit(f"{part}: {image.geterror()}")
    os.replace(part, IMAGES / f"{name}.png")
    print(IMAGES / f"{name}.png")


if __name__ == "__main__":
    main()
