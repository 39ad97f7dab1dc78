# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`thermal`: what a thermal camera sees of the scene, as radiance and apparent temperature."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...support.shown_text import tell

if TYPE_CHECKING:
    from ...blender.background_job import Progress
    from ...picture.thermal import ThermalPicture
    from ...samples.sample import Sample

NAME = "thermal"
SUMMARY = "what a thermal camera sees of the scene"
DESCRIPTION = (
    "Render what surfaces emit in a band of the infrared and what they reflect of each other, and "
    "write radiance and apparent temperature. An object's temperature is its custom property "
    "rough_spectra_temperature, in kelvin, or an attribute of this name of its vertices. The "
    ".blend is not changed."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `thermal`."""
    from ...picture import thermal
    from .. import picture_frames

    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE", help="an EXR of two channels"
    )
    parser.add_argument(
        "--band",
        type=band,
        default=thermal.BAND,
        metavar="FIRST-LAST",
        help="wavelengths of the camera in nm; 8000-14000",
    )
    parser.add_argument(
        "--parts", type=int, default=3, metavar="N", help="of the band, three a render; 3"
    )
    parser.add_argument(
        "--ambient",
        type=float,
        default=thermal.AMBIENT,
        metavar="K",
        help="temperature of objects that have none of their own; 293.15",
    )
    parser.add_argument(
        "--sky", type=float, metavar="K", help="temperature where nothing is; that of --ambient"
    )
    parser.add_argument(
        "--emissivity",
        type=float,
        default=thermal.EMISSIVITY,
        metavar="E",
        help="of materials without infrared data, which are named; 0.95",
    )
    add_material(parser, "its emissivity, such as Foil=0.05")
    picture_frames.add_arguments(parser)
    parser.add_argument("--scene", metavar="NAME", help="a scene other than the file's active one")
    parser.add_argument("--samples", type=int, metavar="N", help="instead of the scene's")
    parser.add_argument(
        "--percentage", type=int, metavar="N", help="of the resolution, instead of the scene's"
    )


def add_material(parser: argparse.ArgumentParser, number: str) -> None:
    """Declare --material, where a number is what it is called."""
    parser.add_argument(
        "--material",
        type=_material,
        action="append",
        default=[],
        metavar="NAME=WHAT",
        help=f"a material and {number}, a preset or a file of one sample; repeatable",
    )


def run(options: argparse.Namespace) -> int:
    """Render, write and tell; exit status 0."""
    from ...picture import files, thermal, thermal_file
    from .. import picture_frames
    from ..result import add
    from .spectral import scene_of

    scene = scene_of(options)
    files.check(options.output)  # before the work that could not be written
    wanted = thermal.Wanted(
        options.band,
        options.parts,
        options.ambient,
        options.sky,
        options.emissivity,
        {name: known(what) for name, what in options.material},
        options.samples,
        options.percentage,
    )

    def make(progress: Progress) -> ThermalPicture:
        return thermal.render(scene, wanted, progress)

    def write(picture: ThermalPicture, path_of: picture_frames.PathOf) -> list[Path]:
        thermal_file.write(picture, path_of(options.output))
        return [path_of(options.output)]

    named: set[str] = set()
    results: list[dict[str, Any]] = []
    for made in picture_frames.pictures(options, scene, make, write):
        found, kelvin = made.picture, made.picture.kelvin
        for name in found.assumed:
            if name not in named:
                tell(
                    f"warning: material {name!r} has no infrared data; its emissivity is taken as "
                    f"{options.emissivity:g}"
                )
        named |= set(found.assumed)
        for name, own in found.temperatures.items():
            tell(f"{made.words}Object {name!r}: {own:g} K")
        low, mean, high = float(kelvin.min()), float(kelvin.mean()), float(kelvin.max())
        first, last = found.band
        tell(
            f"{made.words}{first:g} to {last:g} nm: {low:.2f} to {high:.2f} K, mean {mean:.2f} K; "
            f"wrote {made.names}"
        )
        facts = {
            "kelvin": {"least": low, "mean": mean, "largest": high},
            "assumed": list(found.assumed),
            "temperatures": dict(found.temperatures),
            "file": made.files[0],
        }
        results.append({"frame": made.frame, **facts})
    add(options, **(results[0] if options.frames is None else {"frames": results}))
    return 0


def known(what: str) -> Sample | float:
    """Give what stands for a material: a number, a sample of presets or library, or a file's."""
    from ....core.errors import InputError
    from ... import api

    try:
        return float(what)
    except ValueError:
        pass
    if not Path(what).exists():
        return api.find(what)
    samples = api.read(what)
    if len(samples) != 1:
        msg = f"{what} holds {len(samples)} samples; give a file of one, or a preset."
        raise InputError(msg)
    return samples[0]


def band(text: str) -> tuple[float, float]:
    """Read first and last wavelength."""
    try:
        first, last = (float(part) for part in text.split("-"))
    except ValueError:
        msg = f"{text!r} is no band; write 8000-14000"
        raise argparse.ArgumentTypeError(msg) from None
    return first, last


def _material(text: str) -> tuple[str, str]:
    name, _, what = text.partition("=")
    if not (name and what):
        msg = f"{text!r} is no material and what it is; write Foil=0.05"
        raise argparse.ArgumentTypeError(msg)
    return name, what
