# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`gloss`: what to set in a Principled BSDF for a gloss that was read."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from ...support.shown_text import inform, tell

if TYPE_CHECKING:
    from ....core.cycles.gloss_estimate import GlossEstimate
    from ....core.gloss import Gloss

NAME = "gloss"
SUMMARY = "find specular level and roughness from readings of gloss"
DESCRIPTION = (
    "Find Specular IOR Level and Roughness of a Principled BSDF from a sphere's readings with "
    "specular included and excluded, from gloss units, or from both, and print them. Samples may "
    "hold the readings, or they are given as numbers. Nothing is written."
)
_FITS = 0.05
"""Relative misfit up to which a lobe is said to fit."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `gloss`."""
    from .. import named_samples

    parser.add_argument(
        "samples",
        nargs="*",
        metavar="SAMPLE",
        help=f"{named_samples.HELP}; each with SCI and SCE, or gloss units beside a reading",
    )
    parser.add_argument(
        "--sci",
        type=float,
        metavar="Y",
        help="luminance factor with specular included (di:8), 0 to 1, instead of samples",
    )
    parser.add_argument(
        "--sce", type=float, metavar="Y", help="the same with specular excluded (de:8)"
    )
    parser.add_argument(
        "--units",
        type=_units,
        action="append",
        default=[],
        metavar="ANGLE:GU",
        help="gloss units of ISO 2813 at 20, 60 or 85 degrees, such as 60:35.2; repeatable",
    )
    parser.add_argument(
        "--level",
        type=float,
        metavar="LEVEL",
        help="Specular IOR Level, if it is known; without it what the readings say, or 0.5 where "
        "they are one alone",
    )
    parser.add_argument("--ior", type=float, default=1.5, metavar="N", help="IOR (1.5)")


def run(options: argparse.Namespace) -> int:
    """Find the gloss and say it; exit status 0."""
    from ....core.cycles import gloss_estimate
    from ....core.errors import DomainError
    from ....core.gloss import Gloss
    from ..result import add

    given = {"--sci": options.sci, "--sce": options.sce, "--level": options.level}
    for name, value in given.items():
        if value is not None and not 0 <= value <= 1:
            raise DomainError(f"{name} is {value:g}; give 0 to 1.")
    if not (math.isfinite(options.ior) and options.ior > 1):
        raise DomainError(f"--ior is {options.ior:g}; give a refractive index above 1.")
    gloss = Gloss(ior=options.ior)
    if options.samples:
        if options.sci is not None or options.sce is not None or options.units:
            msg = "Samples say what was read of them; leave --sci, --sce and --units out."
            raise DomainError(msg)
        _of_samples(options, gloss)
        return 0
    if options.sci is None:
        raise DomainError("Name samples with SCI and SCE or gloss units, or give --sci.")
    read = gloss_estimate.GlossReadings(options.sci, options.sce, dict(options.units))
    found = gloss_estimate.estimate(read, options.level, gloss)
    add(options, **_facts(found))
    _say("", found)
    return 0


def _facts(found: GlossEstimate) -> dict[str, float]:
    return {
        "level": round(found.gloss.level, 6),
        "roughness": round(found.gloss.roughness, 6),
        "ior": found.gloss.ior,
        "misfit": round(found.misfit, 6),
    }


def _of_samples(options: argparse.Namespace, gloss: Gloss) -> None:
    """Say it of each sample; of a file's that say nothing, why, unless none says anything."""
    from ....core.errors import DomainError
    from ... import api
    from .. import named_samples
    from ..result import add

    found, silent = [], []
    for sample in (sample for name in options.samples for sample in named_samples.some(name)):
        try:
            found.append((sample.name, api.estimate_gloss(sample, options.level, gloss)))
        except DomainError as error:
            silent.append(error)
    if not found:
        raise silent[0]
    add(options, samples=[{"name": name, **_facts(estimate)} for name, estimate in found])
    for name, estimate in found:
        _say(f"{name}: ", estimate)
    for sentence in map(str, silent):
        tell(f"warning: {sentence}")


def _say(name: str, found: GlossEstimate) -> None:
    how = "found" if found.level_is_known else "given"
    inform(
        f"{name}Specular IOR Level {found.gloss.level:.3f} ({how}), Roughness "
        f"{found.gloss.roughness:.3f}, IOR {found.gloss.ior:g}; it reads within "
        f"{100 * found.misfit:.1f} % of what was given"
    )
    if found.misfit > _FITS:
        tell(
            f"warning: {name}no gloss of one lobe reads all of it; take the one that matters more "
            "to you"
        )


def _units(text: str) -> tuple[int, float]:
    angle, _, units = text.partition(":")
    try:
        pair = int(angle), float(units)
    except ValueError:
        pair = 0, math.nan
    if not (math.isfinite(pair[1]) and pair[1] >= 0):
        msg = f"{text!r} is no angle and gloss units; write 60:35.2"
        raise argparse.ArgumentTypeError(msg)
    return pair
