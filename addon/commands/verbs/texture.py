# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`texture`: an image of readings becomes a texture of albedo, or of color with its material."""

from __future__ import annotations

import argparse
from pathlib import Path

from ...support.shown_text import inform, tell

NAME = "texture"
SUMMARY = "turn a spectral image of a rough surface into a texture"
DESCRIPTION = (
    "Turn what a spectral camera or a scanner read of a rough surface into a texture in the file's "
    "working space: of the facets' albedo, or of the color with which Cycles reads the same."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `texture`."""
    from ....core.models import NAMES, TARGET
    from ....core.reading import INSTRUMENTS
    from ...colorimetry.tristimulus import ILLUMINANTS
    from ...textures.wanted import HOLDS

    parser.add_argument(
        "image",
        type=Path,
        metavar="IMAGE",
        help="spectral OpenEXR, an ENVI cube or its header, or RGB as PNG, TIFF or EXR",
    )
    parser.add_argument(
        "--sigma", type=float, required=True, metavar="DEGREES", help="roughness of the surface"
    )
    parser.add_argument(
        "--instrument",
        choices=INSTRUMENTS,
        default=INSTRUMENTS[0],
        help=f"that the image was taken with; {INSTRUMENTS[0]}",
    )
    parser.add_argument(
        "--illuminant",
        choices=ILLUMINANTS,
        default="D65",
        help="light under which the colors are right; of RGB, the one it was taken for",
    )
    parser.add_argument("--model", choices=NAMES, default=TARGET, help=f"usually {TARGET}")
    parser.add_argument(
        "--scale",
        type=float,
        metavar="NUMBER",
        help="of an ENVI cube, the number that stands for a reflectance of 1",
    )
    parser.add_argument(
        "--holds", choices=HOLDS, help="albedo, or color if there is a material to be made"
    )
    parser.add_argument("--output", type=Path, required=True, metavar="FILE", help="an EXR")
    parser.add_argument(
        "--material", metavar="NAME", help="make this material of it, and save the open file"
    )
    parser.add_argument(
        "--save", type=Path, metavar="FILE", help="save the material here, not over the open file"
    )


def run(options: argparse.Namespace) -> int:
    """Write the texture, and the material if one is asked for; exit status 0."""
    import math

    from ....core.errors import InputError
    from ...blender import blend_file, working_space
    from ...textures import convert, material
    from ...textures.saved import OPTION, make_and_save
    from ...textures.wanted import Wanted
    from ..progress import ProgressLine
    from ..result import add

    holds = options.holds or ("albedo" if options.material is None else "color")
    if options.material is None and options.save is not None:
        raise InputError("There is nothing to save without --material; leave --save out.")
    wanted = Wanted(
        math.radians(options.sigma),
        options.instrument,
        options.illuminant,
        options.model,
        holds,
        options.scale,
    )
    if options.material is not None:  # before the work that could not be saved
        blend_file.destination(options.save, OPTION)
        material.check(options.output, wanted, options.material)
    conversion = convert.Conversion(options.image, options.output, wanted, working_space.current())
    with ProgressLine("lines") as progress:
        if options.material is None:
            made, saved = conversion.finish(progress), None
        else:
            made, saved = make_and_save(conversion, options.material, options.save, progress)
    for note in made.notes:
        tell(f"note: {options.image.name}: {note}")
    told = f"{made.width} × {made.height} pixels of {holds}; wrote {made.path.name}"
    if saved is not None:
        add(options, saved=saved)
        told += f"; material {options.material!r}, saved {saved}"
    add(options, files=[made.path])
    inform(told)
    return 0
