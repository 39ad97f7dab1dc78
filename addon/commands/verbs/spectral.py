# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`spectral`: a spectral picture of the scene, and how far the RGB picture is from it."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...support.shown_text import tell

if TYPE_CHECKING:
    from ...blender.background_job import Progress
    from ...picture.picture import SpectralPicture

NAME = "spectral"
SUMMARY = "render a spectral picture of the scene"
DESCRIPTION = (
    "Render the scene in as many bands as its colors need, three in each ordinary render, put them "
    "together into a picture in the file's working space, and say how far the RGB picture is off. "
    "A map of ΔE00 is written beside it. The .blend is not changed."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `spectral`."""
    from ....core.limits import TOLERANCE
    from ...colorimetry.tristimulus import OBSERVERS
    from .. import picture_frames

    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="an EXR")
    parser.add_argument(
        "--spectral",
        type=Path,
        metavar="FILE",
        help="a spectral image besides, FILE.spectral.exr: radiance every 10 nm",
    )
    parser.add_argument(
        "--at-bands", action="store_true", help="the bands themselves in that, as rendered"
    )
    picture_frames.add_arguments(parser)
    parser.add_argument("--scene", metavar="NAME", help="a scene other than the file's active one")
    amount = parser.add_mutually_exclusive_group()
    amount.add_argument(
        "--tolerance",
        type=float,
        default=TOLERANCE,
        metavar="ΔE",
        help=f"ΔE00 within which 95 %% of the picture shall be, {TOLERANCE:g}; decides the bands",
    )
    amount.add_argument(
        "--bands", type=int, metavar="N", help="as many bands instead, a multiple of 3"
    )
    parser.add_argument("--observer", type=int, choices=OBSERVERS, default=2, help="in degrees; 2")
    parser.add_argument(
        "--direct",
        action=argparse.BooleanOptionalAction,
        help="render direct light apart, in one more render for each spectrum of light: it is "
        "exact then. Chosen by what needs fewer renders if left out",
    )
    parser.add_argument(
        "--no-comparison",
        action="store_true",
        help="leave out the RGB picture and the map",
    )
    add_light(parser)
    parser.add_argument("--samples", type=int, metavar="N", help="instead of the scene's")
    parser.add_argument(
        "--percentage", type=int, metavar="N", help="of the resolution, instead of the scene's"
    )


def add_light(
    parser: argparse.ArgumentParser,
    words: str = "a lamp, world or emitting material, and the spectrum that it has: a CIE "
    "illuminant, such as Lamp=F11, or a file, such as Lamp=sodium.spdx, or a table; repeatable",
) -> None:
    """Declare --light."""
    parser.add_argument(
        "--light",
        type=_light,
        action="append",
        default=[],
        metavar="NAME=LIGHT",
        help=words,
    )


def scene_of(options: argparse.Namespace) -> Any:
    """Give the scene that --scene names, or the active one.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    import bpy

    from ....core.errors import InputError

    if options.scene is None:
        return bpy.context.scene
    scene = bpy.data.scenes.get(options.scene)
    if scene is None:
        msg = f"There is no scene {options.scene!r} in the file; check the name."
        raise InputError(msg)
    return scene


def run(options: argparse.Namespace) -> int:
    """Render, write and tell; exit status 0."""
    from ...picture import files
    from ...picture.render import Wanted, render
    from .. import picture_frames
    from ..progress import counted
    from ..result import add

    scene = scene_of(options)
    files.check(options.output, options.spectral)  # before the work that could not be written
    wanted = Wanted(
        options.tolerance,
        options.bands,
        options.observer,
        options.direct,
        not options.no_comparison,
        options.samples,
        options.percentage,
        dict(options.light),
        spectra=options.spectral is not None,
    )

    def make(progress: Progress) -> SpectralPicture:
        return render(scene, wanted, progress)

    def write(picture: SpectralPicture, path_of: picture_frames.PathOf) -> list[Path]:
        beside = None if options.spectral is None else path_of(options.spectral)
        return files.write(picture, path_of(options.output), beside, at_bands=options.at_bands)

    told: set[str] = set()
    results: list[dict[str, Any]] = []
    for made in picture_frames.pictures(options, scene, make, write):
        picture = made.picture
        _tell(picture, options, told)
        renders = counted(len(picture.seconds), "render")
        tell(f"{made.words}{renders} in {sum(picture.seconds):.1f} s; wrote {made.names}")
        found = picture.comparison
        off = None if found is None else {"mean": found.mean, "usual": found.usual}
        results.append({"frame": made.frame, "files": made.files, "delta_e_00": off})
    add(options, **(results[0] if options.frames is None else {"frames": results}))
    return 0


def _tell(picture: SpectralPicture, options: argparse.Namespace, told: set[str]) -> None:
    """Say what was rendered, unless it was told of another frame."""
    from ...picture import files

    sentences = [
        f"warning: {name}: {', '.join(left)} stays RGB"
        for name, left in picture.untranslated.items()
    ]
    sentences += [f"{name}: {'; '.join(rules)}" for name, rules in picture.rules.items()]
    sentences += files.told(picture)
    if not picture.enough and options.bands is None:
        sentences.append(f"warning: no number of bands is within ΔE00 {options.tolerance:g}")
    for sentence in sentences:
        if sentence not in told:
            told.add(sentence)
            tell(sentence)


def _light(text: str) -> tuple[str, str]:
    name, _, light = text.partition("=")
    if not (name and light):
        msg = f"{text!r} is no lamp and its light; write Lamp=F11"
        raise argparse.ArgumentTypeError(msg)
    return name, light
