# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A random rough surface in three dimensions, all bounces: what materials are matched to.

Gaussian height fields of Lambertian facets were traced over directions and roughness
(`tools/tables/trace_surfaces.py`), σ being the angle of their rms slope along a profile: a
profilometer's Rdq is tan σ. The closed form of `core.closure` describes what they reflect, within
0.1 % at 40° and 0.4 % at 50° in the median over all directions and albedos, and its three numbers
are tabulated: see `core.closure.table`. So this costs what the closed form of V-grooves does, has
the same closed inverse, and holds where light and view are steep and opposite, where V-grooves of
any law are off.

The surface's spectrum hardly matters, its slopes do: a surface of many scales with the same Rdq
reads the same within a few thousandths. Packed grains, whose slopes are not Gaussian, do not.
"""

from __future__ import annotations

import numpy.typing as npt

from ..closure import table
from ..closure.formula import forward, over_blocks
from ..numerics.arrays import Array, spectrum
from . import data

__all__ = ["TABLE", "factors", "reflectance"]

TABLE = table.Table(
    "surface",
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
        Polar angles of light and view, radians in [0, π/2]; beyond 88° taken as 88°.
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
    """Reflectance factor r(λ) of a random rough surface whose facets have the given albedo.

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
