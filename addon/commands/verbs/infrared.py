# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`infrared`: what a camera for the infrared sees of the scene by the light of its lamps."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...support.shown_text import inform, tell

if TYPE_CHECKING:
    from ...blender.background_job import Progress
    from ...picture.infrared import InfraredPicture

NAME = "infrared"
SUMMARY = "what an infrared camera sees by the light of lamps"
DESCRIPTION = (
    "Render the scene in a band of the infrared, by lamps whose spectrum is known there, and write "
    "its radiance in gray or false color. Materials and lamps of which nothing is known there are "
    "named. The .blend is not changed."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `infrared`."""
    from ...picture import infrared_wanted
    from .. import picture_frames
    from .spectral import add_light
    from .thermal import add_material, band

    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="an EXR")
    through = parser.add_mutually_exclusive_group()
    through.add_argument(
        "--band",
        type=band,
        default=infrared_wanted.BAND,
        metavar="FIRST-LAST",
        help="wavelengths of the camera in nm; 700-1000",
    )
    through.add_argument(
        "--response",
        type=Path,
        metavar="FILE",
        help="what the camera or its filter lets through: a table of wavelength and response",
    )
    parser.add_argument(
        "--parts", type=int, default=3, metavar="N", help="of the band, three a render; 3"
    )
    parser.add_argument(
        "--false-color",
        action="store_true",
        help="red, green and blue are the thirds of the band, red the longest wavelengths",
    )
    add_light(
        parser,
        "a lamp, world or emitting material, and what it is: a blackbody, such as Lamp=2856K, or "
        "the file of a spectrum that reaches there; repeatable",
    )
    add_material(parser, "its reflectance, such as Leaf=0.5")
    picture_frames.add_arguments(parser)
    parser.add_argument("--scene", metavar="NAME", help="a scene other than the file's active one")
    parser.add_argument("--samples", type=int, metavar="N", help="instead of the scene's")
    parser.add_argument(
        "--percentage", type=int, metavar="N", help="of the resolution, instead of the scene's"
    )


def run(options: argparse.Namespace) -> int:
    """Render, write and tell; exit status 0."""
    from ...picture import files, infrared, infrared_file, infrared_wanted
    from ...samples import filter_response
    from .. import picture_frames
    from ..result import add
    from .spectral import scene_of
    from .thermal import known

    scene = scene_of(options)
    files.check(options.output)  # before the work that could not be written
    wanted = infrared_wanted.Wanted(
        options.band if options.response is None else filter_response.read(options.response),
        options.parts,
        dict(options.light),
        {name: known(what) for name, what in options.material},
        options.samples,
        options.percentage,
    )

    def make(progress: Progress) -> InfraredPicture:
        return infrared.render(scene, wanted, progress)

    def write(picture: InfraredPicture, path_of: picture_frames.PathOf) -> list[Path]:
        path = path_of(options.output)
        infrared_file.write(picture, path, false_color=options.false_color)
        return [path]

    told: set[str] = set()
    results: list[dict[str, Any]] = []
    for made in picture_frames.pictures(options, scene, make, write):
        found = made.picture
        for sentence in _warnings(found):
            if sentence not in told:
                tell(sentence)
        for name, rule in found.told.items():
            if f"{name}: {rule}" not in told:
                inform(f"{name}: {rule}")
        told |= {*_warnings(found), *(f"{name}: {rule}" for name, rule in found.told.items())}
        mean, (first, last) = float(found.gray.mean()), found.ends
        tell(f"{made.words}{first:g} to {last:g} nm: mean {mean:.4g}; wrote {made.names}")
        facts = {
            "mean": mean,
            "parts": found.parts.mean(axis=(0, 1)).tolist(),
            "assumed": dict(found.assumed),
            "dark": dict(found.dark),
            "told": dict(found.told),
            "file": made.files[0],
        }
        results.append({"frame": made.frame, **facts})
    add(options, **(results[0] if options.frames is None else {"frames": results}))
    return 0


def _warnings(found: InfraredPicture) -> list[str]:
    return [
        *(
            f"warning: {name} has no infrared data ({why}); it is as bright as to the eye"
            for name, why in found.assumed.items()
        ),
        *(f"warning: {name} is dark in the infrared: {why}" for name, why in found.dark.items()),
    ]
