# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`spectral`: a spectral picture of the scene, and how far the RGB picture is from it."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...support.shown_text import tell

if TYPE_CHECKING:
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
    from ..work_list import share

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
    parser.add_argument(
        "--frames",
        metavar="A-B",
        help="these frames, such as 1-48, 1-48x2 for every second one, or 7,12-20; their numbers "
        "go into the names of the files: room-0007.exr",
    )
    parser.add_argument(
        "--shard",
        type=share,
        default=(1, 1),
        metavar="I/N",
        help="only every N-th of the frames, from the I-th on",
    )
    parser.add_argument(
        "--skip-done",
        action="store_true",
        help="leave out frames whose picture is there; a file that is there is whole",
    )
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
    from ....core.errors import InputError
    from ...picture import files

    scene = scene_of(options)
    files.check(options.output, options.spectral)  # before the work that could not be written
    if options.frames is not None:
        return _frames(options, scene)
    if options.shard != (1, 1) or options.skip_done:
        raise InputError("--shard and --skip-done are for --frames; name the frames.")
    return _one(options, scene)


def _one(options: argparse.Namespace, scene: Any) -> int:
    from ... import api
    from ..progress import ProgressLine, counted

    with ProgressLine("rendering") as progress:
        picture = api.spectral_picture(
            scene,
            tolerance=options.tolerance,
            bands=options.bands,
            observer=options.observer,
            direct=options.direct,
            compare=not options.no_comparison,
            samples=options.samples,
            percentage=options.percentage,
            lights=dict(options.light),
            progress=progress,
        )
    _tell(picture, options, set())
    written = api.write_picture(
        picture, options.output, options.spectral, at_bands=options.at_bands
    )
    tell(
        f"{counted(len(picture.seconds), 'render')} in {sum(picture.seconds):.1f} s; wrote "
        f"{', '.join(path.name for path in written)}"
    )
    return 0


def _frames(options: argparse.Namespace, scene: Any) -> int:
    from ...picture import frames
    from ...picture.render import Wanted
    from ..progress import ProgressLine, counted
    from ..result import add

    index, count = options.shard
    mine = frames.numbers(options.frames)[index - 1 :: count]
    wanted = Wanted(
        options.tolerance,
        options.bands,
        options.observer,
        options.direct,
        not options.no_comparison,
        options.samples,
        options.percentage,
        dict(options.light),
    )
    rest = frames.left(mine, options.output) if options.skip_done else mine
    if len(rest) < len(mine):
        tell(f"{counted(len(mine) - len(rest), 'frame')} done before")
    told: set[str] = set()
    results: list[dict[str, Any]] = []
    progress = ProgressLine("rendering")
    made = frames.each(
        scene, rest, wanted, options.output, options.spectral, progress, at_bands=options.at_bands
    )
    try:
        for frame, picture, written in made:
            progress.close()
            _tell(picture, options, told)
            names = ", ".join(path.name for path in written)
            tell(f"frame {frame}: {sum(picture.seconds):.1f} s; wrote {names}")
            found = picture.comparison
            off = None if found is None else {"mean": found.mean, "usual": found.usual}
            results.append({"frame": frame, "files": written, "delta_e_00": off})
    finally:
        made.close()  # the scene's frame is put back
        progress.close()
    add(options, frames=results, done_before=len(mine) - len(rest))
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
