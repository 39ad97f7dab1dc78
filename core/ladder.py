# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""As much as a scene needs: reflectance by any of the models, and the cheaper of two shaders."""

from __future__ import annotations

import numpy.typing as npt

from . import models
from .choice import SHADERS, Choice, choose_shader
from .numerics.arrays import Array

__all__ = ["SHADERS", "Choice", "choose_shader", "reflectance"]


def reflectance(
    model: str,
    albedo: npt.ArrayLike,
    theta_i: npt.ArrayLike,
    theta_r: npt.ArrayLike,
    delta_phi: npt.ArrayLike,
    sigma: npt.ArrayLike,
) -> Array:
    """Reflectance factor r(λ) by a model of that name.

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
