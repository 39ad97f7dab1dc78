# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`lab`: measure rough samples as real meshes, in Cycles."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ...support.shown_text import inform

if TYPE_CHECKING:
    from ...samples.sample import Sample

NAME = "lab"
SUMMARY = "measure a rough sample, as a mesh of facets, with the virtual spectrophotometer"
DESCRIPTION = (
    "Make a rough surface of Lambertian facets, render it in Cycles at 45°a:0° with all bounces, "
    "and write what a circular spot of it reads, its spread over places, and the noise."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `lab`."""
    from ...laboratory import experiment, kinds

    parser.add_argument("--kind", choices=tuple(kinds.KINDS), help="of sample; --map has its own")
    parser.add_argument(
        "--map",
        type=Path,
        metavar="FILE",
        help="heights of your own: a 16-bit or float image, or a profilometer's text",
    )
    slope = parser.add_mutually_exclusive_group()
    slope.add_argument("--sigma", type=float, metavar="DEGREES", help="roughness σ")
    slope.add_argument("--rdq", type=float, metavar="RDQ", help="in place of σ: its tangent")
    slope.add_argument("--sdq", type=float, metavar="SDQ", help="in place of σ: √2 times as much")
    parser.add_argument(
        "--length",
        type=float,
        metavar="LENGTH",
        help="correlation length, diameter of grains, width of grooves, or between two heights of "
        "a map, in any unit; usually 1",
    )
    parser.add_argument("--spot", type=float, metavar="DIAMETER", help="in the same unit")
    parser.add_argument(
        "--albedo", type=float, nargs="+", metavar="RHO", help="of the facets, 0 to 1"
    )
    parser.add_argument(
        "--sample", metavar="NAME", help="a preset or library sample that the facets are of"
    )
    parser.add_argument(
        "--file", type=Path, metavar="FILE", help="take the sample from this measurement file"
    )
    parser.add_argument("--seed", type=int, default=0, help="another surface for each number")
    parser.add_argument(
        "--cells", type=int, default=kinds.CELLS, help=f"of the mesh, a side; {kinds.CELLS}"
    )
    parser.add_argument(
        "--seeds",
        type=int,
        default=experiment.SEEDS,
        help=f"renders with random numbers of their own; {experiment.SEEDS}",
    )
    parser.add_argument(
        "--rays",
        type=int,
        default=experiment.SAMPLES,
        help=f"a pixel and render, shared by finer pixels for a small spot; {experiment.SAMPLES}",
    )
    parser.add_argument("--output", type=Path, required=True, metavar="FILE", help="table, CSV")


def run(options: argparse.Namespace) -> int:
    """Measure and write; exit status 0."""
    from ... import api
    from ...laboratory import readings
    from ...support import atomic_files
    from ..progress import ProgressLine, counted
    from ..result import add

    target = atomic_files.check_target(options.output)
    spectrum = _spectrum(options)
    rough = api.rough_sample(
        "map" if options.map else options.kind or "gaussian",
        _sigma(options),
        options.length,
        seed=options.seed,
        cells=options.cells,
        path=options.map,
    )
    albedos = options.albedo if spectrum is None else spectrum.reflectance
    with ProgressLine("measuring") as progress:
        found = api.measure_rough(
            rough,
            albedos,
            options.spot,
            seeds=options.seeds,
            samples=options.rays,
            progress=progress,
        )
    wavelengths = None if spectrum is None else spectrum.wavelengths
    with atomic_files.publication() as files:
        files.write(target, readings.to_csv(rough, found, wavelengths))
    add(options, files=[target])
    inform(
        f"{counted(len(rough.mesh.faces), 'facet')}, Rdq {rough.mesh.rdq:.4f}, "
        f"Sdq {rough.mesh.sdq:.4f}; {counted(found.albedos.size, 'reading')}, noise at most "
        f"{found.noise.max():.2g}, spread at most {found.spread.max():.2g}; wrote {target.name}"
    )
    return 0


def _sigma(options: argparse.Namespace) -> float | None:
    """σ in radians, however it was given."""
    import math

    from ....core import roughness

    if options.sigma is not None:
        return math.radians(options.sigma)
    if options.rdq is not None:
        return float(roughness.sigma_from_rdq(options.rdq))
    if options.sdq is not None:
        return float(roughness.sigma_from_sdq(options.sdq))
    return None


def _spectrum(options: argparse.Namespace) -> Sample | None:
    """Albedos of a sample, if one is named instead of numbers."""
    from ....core.errors import InputError
    from ... import api
    from ...laboratory import readings
    from ...samples import sets

    named = options.sample is not None or options.file is not None
    if named == (options.albedo is not None):
        raise InputError("Give either --albedo, or a spectrum with --sample or --file.")
    if not named:
        return None
    if options.file is None:
        return readings.facets(api.find(options.sample))
    found = api.read(options.file)
    if options.sample is not None:
        known = sets.by_name(found)
        found = [sample for sample in found if sample.name == options.sample]
        found = found or [s for name, s in known.items() if name == options.sample]
    if len(found) != 1:
        msg = f"{options.file} has {len(found)} such samples; name one of its samples by --sample."
        raise InputError(msg)
    return readings.facets(found[0])
