# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The models as rungs of a ladder, cheapest first: as much of it as a scene needs.

`choose_model` finds the cheapest rung that is good enough for a material, `choose_shader` the
cheaper of Blender's two materials. Both err on the accurate side: what the yardstick itself may
miss is added to every predicted error.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from . import models
from .choice import SHADERS, Choice, cheapest, choose_shader
from .color.color_difference import delta_e, xyz_to_lab
from .errors import DomainError
from .limits import TOLERANCE
from .models.surface_colors import Surface
from .numerics.arrays import Array, spectrum
from .vcavity import tabulated

__all__ = [
    "SHADERS",
    "Choice",
    "choose_model",
    "choose_shader",
    "reflectance",
]

_APPROXIMATE = models.NAMES[:-1]

_CHUNK = 1 << 16
"""Values of spectra (materials · geometries · bands) held at once: 0.5 MB an array."""


def reflectance(
    model: str,
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Reflectance factor r(λ) by the model of one rung.

    Parameters
    ----------
    model
        One of `core.models.NAMES`.
    albedo
        ρ(λ), shape (..., bands).
    theta_i, theta_r
        Polar angles of light and view, radians in [0, π/2].
    delta_phi
        Azimuth between light and view, radians.
    sigma
        Roughness, radians in [0, π/2]. The four broadcast against the leading axes of `albedo`.

    Returns
    -------
    Array of shape (..., bands), in the precision of `albedo`.

    Raises
    ------
    DomainError
        If the model is unknown, an angle lies outside its range or `albedo` has no band axis.

    Examples
    --------
    >>> np.round(reflectance("lambert", [0.2, 0.6], 0.8, 0.1, 0.0, 0.5), 3).tolist()
    [0.2, 0.6]
    >>> np.round(reflectance("two-bounce", [0.2, 0.6], 0.8, 0.1, 0.0, 0.5), 3).tolist()
    [0.166, 0.525]
    """
    return models.find(model).formulas.reflectance(albedo, theta_i, theta_r, delta_phi, sigma)


def choose_model(
    albedos: npt.ArrayLike,
    sigma: npt.ArrayLike,
    geometries: Sequence[npt.ArrayLike],
    lights: Sequence[npt.ArrayLike],
    tolerance: npt.ArrayLike = TOLERANCE,
) -> list[Choice]:
    """Choose for each material the cheapest rung that is good enough in its scene.

    The yardstick is `core.vcavity.tabulated`, the tabulated reference. A rung's predicted error is
    its color difference from it, plus the one that the error of the table itself may amount to, in
    the worst of all directions and lights.

    Parameters
    ----------
    albedos
        ρ(λ), shape (materials, bands).
    sigma
        Roughness, radians in [0, π/2], shape (materials,) or a scalar.
    geometries
        θi, θr and Δφ that occur, radians, each of shape (geometries,), or
        (materials, geometries) where every material has a scene of its own; scenes with fewer
        directions are filled up with NaN.
    lights
        Matrices (bands, 3) that turn reflectance into XYZ; column sums are the white point.
    tolerance
        Largest ΔE00 (CIEDE2000) allowed, shape (materials,) or a scalar.

    Returns
    -------
    One `Choice` a material. A call for many costs a fraction of many calls.

    Raises
    ------
    DomainError
        If an angle lies outside its range, or there is no light or no direction.

    Examples
    --------
    >>> light = np.linspace(0.01, 0.06, 93).reshape(31, 3)
    >>> directions = np.radians([[45.0, 30.0], [0.0, 10.0], [0.0, 90.0]])
    >>> albedos = np.full((2, 31), 0.7)
    >>> [choice.model for choice in choose_model(albedos, [0.0, 0.5], directions, [light])]
    ['lambert', 'closure']
    """
    rho = np.atleast_2d(spectrum(albedos, "the albedo")).astype(np.float64, copy=False)
    count, bands = rho.shape
    spread, allowed = (np.full(count, values, np.float64) for values in (sigma, tolerance))
    angles = [np.asarray(angle, np.float64) for angle in geometries]
    if len({angle.shape for angle in angles}) > 1:
        angles = list(np.broadcast_arrays(*angles))
    light, view, azimuth = angles
    # A sum is finite where all its parts are.
    occurs = np.broadcast_to(np.isfinite(light + view + azimuth), (count, light.shape[-1]))
    directions = occurs.sum(axis=-1)
    if not lights or not directions.all():
        msg = "A choice needs at least one light, and one direction for every material."
        raise DomainError(msg)
    matrices = [np.asarray(matrix, np.float64) for matrix in lights]

    errors = np.empty((len(_APPROXIMATE), count))
    step = max(1, _CHUNK // (light.shape[-1] * bands))
    for start in range(0, count, step):
        part = slice(start, start + step)
        own = [angle[part] if angle.ndim > 1 else angle for angle in angles]
        found = _predict(rho[part], spread[part], own, matrices)
        # What cannot be compared is not taken for equal.
        found = np.where(np.isfinite(found), found, np.inf)
        errors[:, part] = np.where(occurs[part], found, 0).max(axis=-1)
    errors[:, spread == 0] = 0
    return [
        cheapest(
            dict(zip(models.NAMES, (*errors[:, i].tolist(), 0.0), strict=True)),
            float(allowed[i]),
            int(directions[i]),
            len(matrices),
        )
        for i in range(count)
    ]


def _predict(
    rho: Array,
    sigma: Array,
    geometries: Sequence[Array],
    lights: Sequence[Array],
) -> Array:
    """Largest error over the lights, shape (rungs, materials, geometries), NaN where unknown."""
    light, view, azimuth = geometries
    spread = sigma[:, np.newaxis]
    missed = tabulated.bound(light, view, azimuth, spread)
    # Beyond its last node nothing is known and the bound is infinite; F1 there may be, too.
    light, view = (np.minimum(angle, tabulated.LARGEST_ANGLE) for angle in (light, view))
    truth = tabulated.reflectance(rho, light, view, azimuth, sigma)
    weights = np.concatenate(lights, axis=1)
    surface = Surface(rho, light, view, azimuth, spread, weights)
    wanted = truth @ weights
    margin = np.where(np.isfinite(missed), missed, 0)[..., np.newaxis]
    seen = np.empty((len(_APPROXIMATE) + 1, *wanted.shape))
    for row, model in enumerate(_APPROXIMATE):
        seen[row] = _colors(model, surface)
    seen[-1] = wanted * (1 + margin)
    # (rungs, materials, geometries, lights)
    whites = weights.sum(axis=0).reshape(-1, 3)
    seen, wanted = (xyz.reshape(*xyz.shape[:-1], *whites.shape) for xyz in (seen, wanted))
    found = delta_e(xyz_to_lab(seen, whites), xyz_to_lab(wanted, whites))
    worst = (found[:-1] + found[-1]).max(axis=-1)
    return np.where(np.isfinite(missed), worst, np.inf)


def _colors(model: str, surface: Surface) -> Array:
    """XYZ by a model, which broadcasts to (materials, geometries, 3 · lights)."""
    formulas = models.find(model).formulas
    quick = getattr(formulas, "colors", None)
    if quick is not None:
        return np.asarray(quick(surface))
    angles = surface.theta_i, surface.theta_r, surface.delta_phi
    seen = formulas.reflectance(surface.albedo[:, np.newaxis], *angles, surface.sigma)
    return np.asarray(seen @ surface.weights)
