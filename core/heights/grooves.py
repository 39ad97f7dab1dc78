# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""V-grooves side by side, infinitely long and symmetric, their rims level.

Level rims keep the light of each groove to itself, so their order does not matter, and a slope may
be shared out among several narrow grooves as well as given to a wide one. Slopes are stratified:
each of n equal strips of the macroscopic area gets the slope in the middle of its share of the law.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import DomainError
from ..numerics.arrays import Array
from .field import check_slope

LAWS = ("gaussian", "oren-nayar")
"""Slope laws over macroscopic area: tan θ sec²θ exp(-tan²θ / 2 tan²σ), the slopes of a Gaussian
random surface with Rdq = tan σ; and exp(-θ²/2σ²) sin θ, what Oren and Nayar fitted to."""

_DEEPEST = 2.0
"""Depth of a groove in widths of a strip; a steeper strip is divided among narrower grooves."""

_TABLE = 1 << 16
"""Nodes of the integral of the law "oren-nayar": its quantiles are exact to 1e-8 rad."""


@dataclass(frozen=True, eq=False)
class Grooves:
    """One period of grooves.

    Attributes
    ----------
    slopes
        Of each groove's walls, radians, shape (grooves,).
    widths
        From rim to rim, shape (grooves,); they add up to the period.
    """

    slopes: Array
    widths: Array

    @property
    def period(self) -> float:
        """Length across the grooves after which they repeat."""
        return float(self.widths.sum())

    @property
    def depths(self) -> Array:
        """From the rims down."""
        return np.asarray(self.widths / 2 * np.tan(self.slopes))

    @property
    def rdq(self) -> float:
        """Rdq of profiles, averaged over all azimuths: tan² is halved by a turn of the grooves."""
        return self.sdq / float(np.sqrt(2))

    @property
    def sdq(self) -> float:
        """Sdq, the root mean square of the walls' slope over macroscopic area."""
        share = self.widths / self.widths.sum()
        return float(np.sqrt(np.sum(share * np.tan(self.slopes) ** 2)))


def grooves(
    sigma: float, law: str = "gaussian", *, period: float = 1.0, strips: int = 1024, seed: int = 0
) -> Grooves:
    """Make grooves of a slope law.

    Parameters
    ----------
    sigma
        Width of the law, radians, 0 to below π/2.
    law
        One of `LAWS`.
    period
        Width of all of them, in any unit of length.
    strips
        Strata of equal width.
    seed
        Another order for each number.

    Raises
    ------
    DomainError
        If σ, the law, the period or the number of strips make no surface.

    Examples
    --------
    >>> walls = grooves(np.radians(30), strips=4)
    >>> np.round(np.degrees(np.sort(walls.slopes)), 1).tolist()
    [16.6, 29.2, 39.0, 49.7]
    >>> round(walls.period, 6)
    1.0
    """
    check_slope(sigma)
    if law not in LAWS:
        raise DomainError(f"Slope law {law!r} is not known; choose one of: {', '.join(LAWS)}.")
    if strips < 1 or not (np.isfinite(period) and period > 0):
        raise DomainError(f"{strips} strips over {period:g} are no surface; give more than 0.")
    share = (np.arange(strips) + 0.5) / strips
    slopes = _quantiles(share, sigma, law)
    np.random.default_rng(seed).shuffle(slopes)
    width = period / strips
    parts = np.ceil(np.tan(slopes) / (2 * _DEEPEST)).clip(min=1).astype(int)
    return Grooves(np.repeat(slopes, parts), np.repeat(width / parts, parts))


def _quantiles(share: Array, sigma: float, law: str) -> Array:
    """Slopes below which these shares of the macroscopic area lie."""
    if sigma == 0:
        return np.zeros_like(share)
    if law == "gaussian":
        return np.asarray(np.arctan(np.tan(sigma) * np.sqrt(-2 * np.log1p(-share))))
    slope = np.linspace(0, min(np.pi / 2, 9 * sigma), _TABLE)
    density = np.exp(-0.5 * (slope / sigma) ** 2) * np.sin(slope)
    below = np.concatenate(([0], np.cumsum(density[:-1] + density[1:])))
    return np.asarray(np.interp(share, below / below[-1], slope))
