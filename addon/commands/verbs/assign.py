# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`assign`: give materials of the file measured spectra."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from ...support.shown_text import inform, tell
from ..arguments import add_sigma

NAME = "assign"
SUMMARY = "give materials of the file measured spectra"
DESCRIPTION = (
    "Give materials measured spectra, from a mapping file, from a preset, or from measurement "
    "files by equal names, and save the file."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `assign`."""
    from ....core.instruments import REGISTRY
    from ....core.models import NAMES
    from ...colorimetry.tristimulus import ILLUMINANTS, OBSERVERS
    from ...matching import shaders

    instruments = tuple(REGISTRY)
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument(
        "--mapping",
        type=Path,
        metavar="FILE",
        help="CSV or JSON with a row a material, in whose name * and ? may stand: material, "
        "sample, and optionally file, sigma_deg (or rdq, or sdq), kind, instrument, scale, white, "
        "white_factor, read_at, illuminant, observer, model, shader; a sample without a file is a "
        "preset or of the library; what an option says counts for all rows",
    )
    source.add_argument(
        "--by-name",
        type=Path,
        nargs="+",
        metavar="FILE",
        help="measurement files; materials get the sample of the same name",
    )
    source.add_argument(
        "--preset", metavar="NAME", help="a preset or library sample for --material"
    )
    parser.add_argument(
        "--material",
        action="append",
        default=[],
        metavar="NAME",
        help="a material, repeatable: of --preset, or the only ones of --by-name",
    )
    add_sigma(parser)
    parser.add_argument("--kind", choices=("reading", "albedo"), help="what the spectra are")
    add_white_arguments(parser)
    parser.add_argument(
        "--illuminant",
        choices=ILLUMINANTS,
        help="under which the color is right; without it what the mapping says, or D65",
    )
    parser.add_argument(
        "--observer",
        type=int,
        choices=OBSERVERS,
        help="of the colorimetry in reports; without it what the mapping says, or 2",
    )
    parser.add_argument(
        "--read-at",
        choices=instruments,
        metavar="INSTRUMENT",
        help="virtual instrument that the materials read right at, and are measured with: "
        f"{', '.join(instruments)}; without it what the mapping says, or {instruments[0]}",
    )
    parser.add_argument(
        "--model",
        choices=("auto", *NAMES),
        help="how light between facets is counted; without it what the mapping says, or auto, "
        "which is the surface model",
    )
    parser.add_argument(
        "--shader",
        choices=[name.lower() for name in (shaders.AUTO, *shaders.NAMES)],
        help="the node to set; without it what the mapping says, or auto, the one that is there",
    )
    parser.add_argument(
        "--gloss",
        choices=("keep", "none", "read"),
        default="keep",
        help="whether a Principled BSDF keeps its gloss, under which the color is then solved, "
        "loses it, or gets that which a sample's SCI and SCE or gloss units tell",
    )
    parser.add_argument(
        "--create", action="store_true", help="make the materials that are not there"
    )
    parser.add_argument("--output", type=Path, metavar="FILE", help="save here, not over the file")


def add_white_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare which white the spectra are relative to."""
    from ....core import white_scale

    parser.add_argument(
        "--white",
        choices=tuple(white_scale.REGISTRY),
        help="what the spectra are relative to: the perfect diffuser, or the certificate of the "
        "instrument's white plaque at this geometry; without it what the files say, or perfect",
    )
    parser.add_argument(
        "--white-factor",
        metavar="FACTOR",
        help="the plaque's true factor at the instrument's geometry over its certificate's value, "
        f"or {white_scale.PTFE} for sintered PTFE",
    )


def run(options: argparse.Namespace) -> int:
    """Assign and save; exit status 0."""
    from ....core.instruments import spoken
    from ...blender.blend_file import destination, save
    from ...samples import stated_white
    from .. import mapping, reader_notes
    from ..progress import counted
    from ..result import add

    destination(options.output)  # before the work that could not be saved
    assignments = mapping.pair(mapping.rows(options), options)
    solutions = mapping.assign(assignments, options.gloss)
    reader_notes.tell_notes(each.request.sample for each in assignments)
    for each, solution in zip(assignments, solutions, strict=True):
        if remark := stated_white.remark(each.request.sample):
            inform(f"note: material {each.material.name!r}: {remark}")
        for warning in solution.warnings:
            tell(f"warning: material {each.material.name!r}: {warning}")
    path = save(options.output)
    worst = max(solution.delta_e_instrument for solution in solutions)
    at = ", ".join(dict.fromkeys(spoken(each.request.read_at) for each in assignments))
    add(
        options,
        saved=path,
        largest_delta_e_00=worst,
        materials=[
            {
                "material": each.material.name,
                "sample": each.request.sample.name,
                "sigma_degrees": round(math.degrees(each.request.sigma), 5),
                "color": solution.color.tolist(),
                "roughness": solution.roughness,
                "model": solution.model,
                "delta_e_instrument": solution.delta_e_instrument,
                "delta_e_mean": solution.delta_e_mean,
                "warnings": list(solution.warnings),
            }
            for each, solution in zip(assignments, solutions, strict=True)
        ],
    )
    inform(
        f"assigned {counted(len(assignments), 'material')}, largest predicted ΔE00 at {at} "
        f"{worst:.4f}; saved {path}"
    )
    return 0
