# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`gloss`: what to set in a Principled BSDF for a gloss that was read."""

from __future__ import annotations

import argparse
import math

from ...support.shown_text import inform, tell

NAME = "gloss"
SUMMARY = "find specular level and roughness from readings of gloss"
DESCRIPTION = (
    "Find Specular IOR Level and Roughness of a Principled BSDF from a sphere's readings with "
    "specular included and excluded, from gloss units, or from both, and print them."
)
_FITS = 0.05
"""Relative misfit up to which a lobe is said to fit."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `gloss`."""
    parser.add_argument(
        "--sci",
        type=float,
        required=True,
        metavar="Y",
        help="luminance factor with specular included (di:8), 0 to 1",
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
    read = gloss_estimate.GlossReadings(options.sci, options.sce, dict(options.units))
    found = gloss_estimate.estimate(read, options.level, Gloss(ior=options.ior))
    how = "found" if found.level_is_known else "given"
    add(
        options,
        level=round(found.gloss.level, 6),
        roughness=round(found.gloss.roughness, 6),
        ior=options.ior,
        misfit=round(found.misfit, 6),
    )
    inform(
        f"Specular IOR Level {found.gloss.level:.3f} ({how}), Roughness "
        f"{found.gloss.roughness:.3f}, IOR {options.ior:g}; it reads within "
        f"{100 * found.misfit:.1f} % of what was given"
    )
    if found.misfit > _FITS:
        tell("warning: no gloss of one lobe reads all of it; take the one that matters more to you")
    return 0


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
