# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""V-grooves of Gaussian slopes in closed form: all bounces in one square root.

    r = ρ (b + a / (1 + √(1 - g ρ)))

b, a and g are those that miss the solver least over all albedos; what they say of r/ρ at ρ → 0, at
one albedo between and at ρ = 1 is tabulated: see `core.closure.table`. tan σ is a profilometer's
Rdq. `tools/tables/make_vcavity_table.py` makes the table and prints the errors stated here.

Worst over ρ, at polar angles below 80° it misses the solver by 0.02 % in the median and 0.3 % at
worst for σ of 10° to 30°, by 0.14 % and 0.9 % for 30° to 50°, by 0.5 % and 2.5 % to 65°, where it
ends: steeper grooves return their light too late for one square root. The worst is where light and
view are steep and opposite. The table adds but a tenth of a percent to what the form itself misses.
"""

from __future__ import annotations

import numpy.typing as npt

from ..closure import table
from ..closure.formula import forward, over_blocks
from ..numerics.arrays import Array, spectrum
from . import closed_data as data

__all__ = ["ERROR", "RING_ERROR", "TABLE", "factors", "reflectance"]

ERROR = 0.01
"""Largest relative error against the solver below 80°, σ ≤ 50°, 0 < ρ ≤ 1."""

RING_ERROR = 0.001
"""The same of a 45a:0 reading; at σ = 60° it is 0.004."""

TABLE = table.Table(
    "closure",
    data.SIGMA,
    data.POLAR,
    data.RATIO,
    data.AZIMUTH,
    data.MEETING,
    data.PACKED,
    data.STEPS,
)


def factors(
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> tuple[Array, Array, Array]:
    """Coefficients b, a and g for any geometry.

    Parameters
    ----------
    theta_i, theta_r
        Polar angles of light and view, radians in [0, π/2]; taken as at most `TABLE.largest_angle`.
    delta_phi
        Azimuth between light and view, radians.
    sigma
        Roughness, radians in [0, `TABLE.largest_sigma`]. All four broadcast against each other.

    Returns
    -------
    b, a, g
        Arrays of the broadcast shape; float32 if every array given is float32, else float64.

    Raises
    ------
    DomainError
        If an angle lies outside its range. NaN passes and stays where it was.

    Examples
    --------
    >>> b, a, g = factors(0.8, [0.0, 0.5], 0.0, 0.5)
    >>> np.round(b + a / (1 + np.sqrt(1 - g)), 1).tolist()
    [1.0, 1.1]
    """
    return table.factors(TABLE, theta_i, theta_r, delta_phi, sigma)


def reflectance(
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Reflectance factor r(λ) of V-grooves whose facets have the given albedo.

    Parameters
    ----------
    albedo
        ρ(λ), shape (..., bands).
    theta_i, theta_r, delta_phi, sigma
        As in `factors`; they broadcast against the leading axes of `albedo`.

    Returns
    -------
    Array of shape (..., bands), in the precision of `albedo`.

    Raises
    ------
    DomainError
        If an angle lies outside its range or `albedo` has no band axis.

    Examples
    --------
    >>> np.round(reflectance([0.2, 0.6], np.pi / 4, 0.0, 0.0, np.radians(30)), 2).tolist()
    [0.17, 0.55]
    """
    rho = spectrum(albedo, "the albedo")
    return over_blocks(forward, factors(theta_i, theta_r, delta_phi, sigma), rho)
