# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`verdict`: whether RGB is enough for a scene, and if not, the least that is."""

from __future__ import annotations

import argparse

from ...support.shown_text import out, tell

NAME = "verdict"
SUMMARY = "say whether RGB is enough for the scene, or what is"
DESCRIPTION = (
    "Render small pictures of the scene, spectral and in RGB, and say how far RGB is off, and what "
    "the least is that brings 95 % of the picture within the tolerance: another working space, "
    "materials matched to the lights, or how many passes of three bands. Exit status 0 where RGB "
    "is enough as it is, 1 where not. The .blend is not changed."
)
_NOT_ENOUGH = 1


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `verdict`."""
    from ....core.limits import TOLERANCE
    from .spectral import add_light

    parser.add_argument("--scene", metavar="NAME", help="a scene other than the file's active one")
    parser.add_argument(
        "--tolerance",
        type=float,
        default=TOLERANCE,
        metavar="ΔE",
        help=f"ΔE00 within which 95 %% of the picture shall be, {TOLERANCE:g}",
    )
    add_light(parser)
    parser.add_argument("--samples", type=int, metavar="N", help="of the small pictures; 8")
    parser.add_argument(
        "--percentage",
        type=int,
        metavar="N",
        help="of the resolution; what comes to 240 × 135 pixels unless given",
    )


def run(options: argparse.Namespace) -> int:
    """Render, judge and tell; exit status 0 where RGB is enough, else 1."""
    from ... import api
    from ..progress import ProgressLine
    from ..result import add
    from .spectral import scene_of

    with ProgressLine("rendering") as progress:
        found = api.picture_verdict(
            scene_of(options),
            tolerance=options.tolerance,
            samples=options.samples,
            percentage=options.percentage,
            lights=dict(options.light),
            progress=progress,
        )
    if found.untranslated:
        names = ", ".join(found.untranslated)
        tell(f"warning: {names}: stays RGB in part, on {found.touched:.0%} of the picture")
    out(f"{'way':40} {'mean':>6} {'95 %':>6} {'max':>6} {'seconds':>8}")
    for rung in found.rungs:
        numbers = f"{rung.mean:6.2f} {rung.usual:6.2f} {rung.largest:6.2f} {rung.seconds:8.0f}"
        out(f"{rung.words:40} {numbers}")
    out(found.sentence)
    add(
        options,
        enough=found.enough,
        sentence=found.sentence,
        tolerance=found.tolerance,
        chosen=None if found.chosen is None else found.chosen.kind,
        rungs=[
            {
                "kind": rung.kind,
                "renders": rung.renders,
                "mean": rung.mean,
                "usual": rung.usual,
                "largest": rung.largest,
                "seconds": rung.seconds,
            }
            for rung in found.rungs
        ],
        untranslated={name: list(left) for name, left in found.untranslated.items()},
        touched=found.touched,
    )
    return 0 if found.enough else _NOT_ENOUGH
