# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`emissivity`: what rough samples emit, into tables and pictures."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING

from ....core.errors import InputError
from ...support.shown_text import inform, tell
from ..arguments import add_sigma

if TYPE_CHECKING:
    from ...matching.emission import Named
    from ...samples.sample import Sample

NAME = "emissivity"
SUMMARY = "what rough samples emit, by wavelength, direction and band, into files"
DESCRIPTION = (
    "Compute the emissivity of rough surfaces from measured spectra of any wavelengths, by "
    "Kirchhoff's law, and what temperature a thermal camera tells of them. No .blend is needed."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `emissivity`."""
    from ....core.emissivity import MODEL, MODELS

    parser.add_argument(
        "samples",
        nargs="+",
        metavar="SAMPLE",
        help="measurement files of any format, presets, or samples of the library",
    )
    parser.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="BASE",
        help="folder and base name: BASE.csv, BASE.bands.csv, BASE.png",
    )
    add_sigma(parser)
    parser.add_argument(
        "--angles",
        type=float,
        nargs="+",
        metavar="DEGREES",
        help="directions from the normal; 0 30 60 80 without it",
    )
    parser.add_argument(
        "--temperature", type=float, default=300.0, metavar="K", help="of the surface; 300"
    )
    parser.add_argument(
        "--background",
        type=float,
        default=0.0,
        metavar="K",
        help="temperature of what surrounds it and is reflected; 0, nothing",
    )
    parser.add_argument(
        "--band",
        action="append",
        default=[],
        metavar="FROM-TO",
        help="in nanometers, as 8000-14000, repeatable; without it and --response, 3000-5000 and "
        "8000-14000 where they are covered",
    )
    parser.add_argument(
        "--response",
        action="append",
        default=[],
        type=Path,
        metavar="FILE",
        help="a radiometer's response, a table of wavelength and response, repeatable",
    )
    parser.add_argument("--model", choices=tuple(MODELS), default=MODEL, help="of the roughness")


def run(options: argparse.Namespace) -> int:
    """Compute and write; exit status 0."""
    from ...matching import emission
    from ...preview import emission_files
    from ...samples.stated_sigma import Names, StatedSigma
    from ...support import atomic_files
    from ..progress import counted
    from ..result import add

    atomic_files.check_base(options.output)
    stated = StatedSigma(options.sigma, options.rdq, options.sdq)
    if fault := stated.fault(Names("--sigma", "--rdq", "--sdq"))[1]:
        raise InputError(f"{fault[0].upper()}{fault[1:]}.")
    sigma = stated.settled
    degrees = options.angles or [math.degrees(angle) for angle in emission.ANGLES]
    outside = [angle for angle in degrees if not 0 <= angle <= 90]
    if outside:
        msg = f"--angles holds {outside[0]:g}; give degrees from 0, along the normal, to 90."
        raise InputError(msg)
    bands = _bands(options)
    found = [
        emission.compute(
            sample,
            math.radians(sample.sigma_degrees or 0 if sigma is None else sigma),
            angles=[math.radians(angle) for angle in degrees],
            temperature=options.temperature,
            background=options.background,
            bands=bands,
            model=options.model,
        )
        for name in options.samples
        for sample in _samples(name)
    ]
    for each in found:
        for sentence in each.warnings:
            tell(f"warning: {each.source or each.sample}: {sentence}")
    written = emission_files.write(found, options.output)
    add(options, files=written)
    inform(f"{counted(len(found), 'sample')}; wrote {', '.join(path.name for path in written)}")
    return 0


def _samples(name: str) -> list[Sample]:
    """Give the samples of a file, or the one of presets and library that is called so."""
    from ...material import preferences
    from ...samples import endings, library, readers

    is_file = Path(name).suffix.lower().lstrip(".") in endings.endings()
    if is_file or Path(name).exists():
        return readers.read(name)
    return [library.load(name, preferences.user_folder())]


def _bands(options: argparse.Namespace) -> list[Named] | None:
    from ...samples import filter_response

    bands: list[Named] = []
    for text in options.band:
        try:
            first, last = (float(end) for end in text.split("-"))
        except ValueError:
            msg = f"--band is {text!r}; give first and last wavelength in nm, as 8000-14000."
            raise InputError(msg) from None
        bands.append((f"{first:g}-{last:g} nm", (first, last)))
    bands += [(path.name, filter_response.read(path)) for path in options.response]
    return bands or None
