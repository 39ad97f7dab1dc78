# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From meshes that were measured in grays to all that a page shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from ....core import estimate
from ...samples import presets
from ...samples.sample import Sample
from . import figures, judge, meshes
from .meshes import Grays
from .page import Found

_EVERY = 2
"""Of the presets' bands: every 10 nm."""

_NOTE = (
    "Samples are meshes of Lambertian facets, rendered by Cycles at 45°/0° with all bounces; their "
    "facets have the colors of a ColorChecker. Level meshes read their albedo, so that these are "
    "the smooth readings."
)


def chart() -> list[Sample]:
    """Give the albedos of the facets: 24 patches, every 10 nm."""
    return [
        replace(of, wavelengths=of.wavelengths[::_EVERY], values=of.values[::_EVERY])
        for of in presets.load_all("colorchecker")
    ]


def found(
    grays: Sequence[Grays],
    relative: float = estimate.RELATIVE,
    progress: Callable[[int, int], None] | None = None,
) -> Found:
    """Judge what was measured of meshes.

    Parameters
    ----------
    grays
        As `meshes.measure` gave them.
    relative, progress
        As of `judge.judge`.
    """
    reads, inferred = judge.judge(meshes.surfaces(grays, chart()), relative, progress)
    return Found(reads, inferred, figures.panels_of_grays(grays), grays, (_NOTE,))
