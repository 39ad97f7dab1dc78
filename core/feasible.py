# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which albedos a reading leaves open while nobody says how rough the surface is.

No facet reflects more than it receives, so the brightest band bounds σ: white facets have to reach
it. Every σ within the bound gives an albedo in every band; here is the range that they span. With
the published model it is [r, ρ(r; σmax)] in each band, from the level surface to the roughest one.
With all bounces the ends need not be those: a rough white surface may read more than 1 along one
direction.

Source: S. Zuffi and I. Gagliardi's report of 2007, section 1.2.1, which asks this of 45a:0.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import models, reading
from .numerics.arrays import Array, spectrum
from .numerics.blocks import ELEMENTS

_NODES = 361
"""Roughnesses, 0.25° apart or less, at which white facets are held against the peak."""
_EVERY = 4
"""One node in so many is inverted: an extreme between two of them is missed by less than 1e-4."""
_HALVINGS = 30
"""Of the step between two nodes, to where white facets just reach the peak."""


@dataclass(frozen=True, eq=False)
class AlbedoRange:
    """Albedos that give a reading at some roughness.

    Attributes
    ----------
    lowest, highest
        Per band, shape (..., bands); NaN where no roughness fits, and in bands that are NaN.
    sigma_min, sigma_max
        Smallest and largest roughness that fits, radians, shape (...); NaN where none does.
    """

    lowest: Array
    highest: Array
    sigma_min: Array
    sigma_max: Array


def albedo_range(
    values: npt.ArrayLike, model: str = models.TARGET, instrument: str = "45a:0"
) -> AlbedoRange:
    """Find the lowest and the highest albedo that may be behind each band of a reading.

    Parameters
    ----------
    values
        r(λ), shape (..., bands).
    model, instrument
        One of `core.models.NAMES` and of `core.reading.INSTRUMENTS`.

    Returns
    -------
    Albedos in the precision of `values`, and the roughnesses that fit. A reading that exceeds what
    white facets give at every roughness fits none: all is NaN then.

    Raises
    ------
    DomainError
        If model or instrument is unknown, or `values` has no band axis.

    Examples
    --------
    >>> found = albedo_range([0.2, 0.8], "two-bounce")
    >>> np.round(found.lowest, 3).tolist(), np.round(found.highest, 3).tolist()
    ([0.2, 0.8], [0.287, 1.0])
    >>> round(float(np.degrees(found.sigma_max)), 1)
    48.9
    """
    r = spectrum(values, "the reading")
    # One that has no number at all has no peak.
    peak = np.fmax.reduce(r, axis=-1, initial=-np.inf).astype(np.float64)
    nodes = np.linspace(0, np.radians(models.find(model).largest_sigma), _NODES)
    white = reading.white_reading(nodes, model, instrument)
    fits = (white >= peak[..., np.newaxis]) & np.isfinite(peak)[..., np.newaxis]
    some = fits.any(axis=-1)
    first, last = fits.argmax(axis=-1), _NODES - 1 - fits[..., ::-1].argmax(axis=-1)
    sigma_min = _edge(nodes, first, np.maximum(first - 1, 0), peak, model, instrument)
    sigma_max = _edge(nodes, last, np.minimum(last + 1, _NODES - 1), peak, model, instrument)

    lowest, highest = np.full_like(r, np.inf), np.full_like(r, -np.inf)
    ends = [(sigma[..., np.newaxis], some[..., np.newaxis]) for sigma in (sigma_min, sigma_max)]
    for sigma, at in (*ends, *_between(nodes[::_EVERY], fits[..., ::_EVERY], r.size)):
        rho = reading.to_albedo(r[..., np.newaxis, :], sigma, model, instrument)
        which = at[..., np.newaxis]
        np.minimum(lowest, rho.min(axis=-2, where=which, initial=np.inf), out=lowest)
        np.maximum(highest, rho.max(axis=-2, where=which, initial=-np.inf), out=highest)
    lowest[~some], highest[~some] = np.nan, np.nan
    no_number = np.where(some, 0, np.nan)
    return AlbedoRange(lowest, highest, sigma_min + no_number, sigma_max + no_number)


def _between(nodes: Array, fits: Array, size: int) -> Iterator[tuple[Array, Array]]:
    """Give as many roughnesses at once as a block holds of readings with `size` elements."""
    step = max(1, ELEMENTS // max(1, size))
    for start in range(0, len(nodes), step):
        which = slice(start, start + step)
        yield nodes[which], fits[..., which]


def _edge(
    nodes: Array, inside: Array, outside: Array, peak: Array, model: str, instrument: str
) -> Array:
    """Halve the step from a node that fits to the next that does not; ends stay as they are."""
    fitting, beyond = nodes[inside], nodes[outside]
    if np.array_equal(inside, outside):
        return np.asarray(fitting)
    for _ in range(_HALVINGS):
        middle = (fitting + beyond) / 2
        fits = reading.white_reading(middle, model, instrument) >= peak
        fitting, beyond = np.where(fits, middle, fitting), np.where(fits, beyond, middle)
    return np.asarray(fitting)
