# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`relight`: other lamps in a picture whose lights were rendered once, each apart."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ...support.shown_text import out, tell

if TYPE_CHECKING:
    from ...picture.relight import Desk, Lights

NAME = "relight"
SUMMARY = "change lamps of a picture without rendering it again"
DESCRIPTION = (
    "Render the light of each lamp of the scene apart, in bands, keep it, and put it together with "
    "the spectrum and the intensity that each lamp is to have. With --kept, what was rendered once "
    "is read, and nothing is rendered. The .blend is not changed."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `relight`."""
    from ...colorimetry.tristimulus import OBSERVERS
    from .spectral import add_light

    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE", help="an EXR")
    parser.add_argument(
        "--kept",
        type=Path,
        metavar="FILE",
        help="where the lights are kept, an .npz: read where it is, else rendered and written",
    )
    add_light(parser)
    parser.add_argument(
        "--intensity",
        type=_intensity,
        action="append",
        default=[],
        metavar="NAME=TIMES",
        help="how many times as bright a lamp is, such as Lamp=0.5; repeatable",
    )
    parser.add_argument("--observer", type=int, choices=OBSERVERS, default=2, help="in degrees; 2")
    parser.add_argument(
        "--pixel",
        type=_pixel,
        action="append",
        default=[],
        metavar="COLUMN,ROW",
        help="a place from the bottom left; of two, ΔE00 is told under each --illuminant",
    )
    parser.add_argument(
        "--illuminant",
        action="append",
        default=[],
        metavar="LIGHT",
        help="what all lamps are in turn for --pixel; D65, A, F11 and LED-B3 unless given",
    )
    parser.add_argument("--scene", metavar="NAME", help="a scene other than the file's active one")
    parser.add_argument("--bands", type=int, metavar="N", help="a multiple of 3; as many as needed")
    parser.add_argument("--samples", type=int, metavar="N", help="instead of the scene's")
    parser.add_argument(
        "--percentage", type=int, metavar="N", help="of the resolution, instead of the scene's"
    )


def run(options: argparse.Namespace) -> int:
    """Render or read, set the lamps, write and tell; exit status 0."""
    from ....core.errors import InputError
    from ... import api
    from ...picture import files, relight
    from ..result import add

    if len(options.pixel) not in (0, 2):
        raise InputError("--pixel is given twice, for two places, or not at all.")
    files.check(options.output)  # before the work that could not be written
    if options.kept is not None and options.kept.exists():
        lights = relight.read(options.kept)
    else:
        lights = _rendered(options)
    desk = relight.Desk(lights, options.observer)
    relight.set_all(desk, dict(options.light), dict(options.intensity))
    apart = _metamerism(desk, options)
    written = api.write_picture(desk.picture(), options.output)
    tell(f"lights: {', '.join(lights.names)}; wrote {written[0].name}")
    add(options, lights=list(lights.names), delta_e_00=apart, written=written)
    return 0


def _rendered(options: argparse.Namespace) -> Lights:
    from ... import api
    from ...picture import relight
    from ...support import atomic_files
    from ..progress import ProgressLine
    from .spectral import scene_of

    if options.kept is not None:
        atomic_files.check_target(options.kept)
    with ProgressLine("rendering") as progress:
        lights = api.picture_lights(
            scene_of(options),
            bands=options.bands,
            samples=options.samples,
            percentage=options.percentage,
            progress=progress,
        )
    if options.kept is not None:
        relight.write(lights, options.kept)
    return lights


def _metamerism(desk: Desk, options: argparse.Namespace) -> dict[str, float]:
    from ...picture import relight

    if not options.pixel:
        return {}
    first, second = options.pixel
    named = options.illuminant or relight.ILLUMINANTS
    found = relight.metamerism(desk, first, second, named)
    for name, delta_e in found.items():
        out(f"{name:12} ΔE00 {delta_e:6.2f}")
    return found


def _intensity(text: str) -> tuple[str, float]:
    name, _, times = text.rpartition("=")
    try:
        return name, float(times)
    except ValueError:
        msg = f"{text!r} is no lamp and its intensity; write Lamp=0.5"
        raise argparse.ArgumentTypeError(msg) from None


def _pixel(text: str) -> tuple[int, int]:
    try:
        column, row = (int(part) for part in text.split(","))
    except ValueError:
        msg = f"{text!r} is no column and row; write 120,80"
        raise argparse.ArgumentTypeError(msg) from None
    return column, row
