# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Emissivity of a rough surface, by Kirchhoff's law: what it does not reflect.

    ε(λ, θ) = 1 - ρ_dh(λ, θ)

with ρ_dh the part of the light from θ that the surface sends back, wherever to. Facets of one
temperature are meant, and light that facets emit onto each other is counted: roughness raises
emissivity, as every hit is another chance to be absorbed.

Source: G. Kirchhoff, "Ueber das Verhältniss zwischen dem Emissionsvermögen und dem
Absorptionsvermögen der Körper für Wärme und Licht" (Annalen der Physik 185, 1860).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Protocol, cast

import numpy as np
import numpy.typing as npt

from .. import models
from ..errors import DomainError
from ..numerics.arrays import Array, spectrum
from ..vcavity import slope_law
from . import random_surface, v_grooves


class _Surface(Protocol):
    """What a model has to tell."""

    def of_direction(self, theta: npt.ArrayLike, sigma: npt.ArrayLike, slopes: str) -> Array:
        """Give numbers (..., n) whose mean over directions is that of light from all of them."""

    def emissivity(self, found: Array, rho: Array) -> Array:
        """Give ε of them at albedos (..., bands)."""

    def albedo(self, found: Array, epsilon: Array) -> Array:
        """Invert `emissivity`."""

    def of_reading(
        self, reading: Array, sigma: npt.ArrayLike, instrument: str, slopes: str
    ) -> Array:
        """Give the albedo behind an instrument's reading."""


MODELS: Mapping[str, _Surface] = MappingProxyType(
    {
        "reference": cast("_Surface", v_grooves),
        "surface": cast("_Surface", random_surface),
    }
)
"""Models that lose no light, so that what they don't reflect is emitted."""

MODEL = "reference"
"""The one that is meant where none is named."""

_WHY_NOT = {
    "lambert": "it knows no roughness, and the emissivity of a smooth surface is 1 - ρ",
    "first-order": "it leaves out the light between facets, and 1 - ρ_dh would count it as emitted",
    "two-bounce": (
        "it loses the light of all bounces after the second, which 1 - ρ_dh would count as "
        "emitted, up to 0.2 at σ = 45°, and it makes light at grazing"
    ),
    "closure": (
        "it is a table of single directions and misses the integral over all by up to 0.001, where "
        "the reference costs no more"
    ),
}

_POLAR_NODES = 24
"""Gauss nodes over cos² θ for the hemisphere; 48 change less than 1e-6."""


def directional(
    albedo: npt.ArrayLike,
    theta: npt.ArrayLike,
    sigma: npt.ArrayLike,
    *,
    model: str = MODEL,
    slopes: str = slope_law.DEFAULT,
) -> Array:
    """Emissivity of a rough surface in a direction.

    Parameters
    ----------
    albedo
        ρ(λ), what a facet reflects of light from anywhere, shape (..., bands); its own emissivity
        is 1 - ρ. Outside 0..1 see `core.vcavity.bounce_series`: nothing is clipped.
    theta
        Polar angle of the view, radians in [0, π/2].
    sigma
        Roughness, radians in [0, π/2]. Both broadcast against the leading axes of `albedo`.
    model
        One of `MODELS`.
    slopes
        Of the reference, the slope law: a name in `core.vcavity.slope_law.LAWS`. The other models
        have Gaussian slopes.

    Returns
    -------
    ε(λ, θ), shape (..., bands), in the precision of `albedo`; at σ = 0 it is 1 - ρ, at ρ = 1 it is
    0 to the last digits. Absolute error: `core.vcavity.hemisphere.ERROR_BOUND`.

    Raises
    ------
    DomainError
        If an angle lies outside its range, `albedo` has no band axis, or the model is none of
        them; of a known model, the message says why it cannot serve here.

    Examples
    --------
    >>> np.round(directional([0.5, 0.9], 0.0, np.radians(30), slopes="oren-nayar"), 3).tolist()
    [0.573, 0.142]
    >>> directional([0.25, 0.5], 1.2, 0.0).tolist()
    [0.75, 0.5]
    """
    surface = _of(model)
    rho = spectrum(albedo, "the albedo")
    return _in_double(surface.emissivity, surface.of_direction(theta, sigma, slopes), rho)


def hemispherical(
    albedo: npt.ArrayLike,
    sigma: npt.ArrayLike,
    *,
    model: str = MODEL,
    slopes: str = slope_law.DEFAULT,
) -> Array:
    """Emissivity into the whole hemisphere: what the surface loses by radiation over a black one.

    ε(λ) = ∫ ε(λ, θ) 2 cos θ sin θ dθ, by Gauss's rule over cos² θ. Arguments and errors as in
    `directional`.

    Returns
    -------
    Shape (..., bands), in the precision of `albedo`.

    Examples
    --------
    >>> np.round(hemispherical([0.5, 0.9], 0.0), 12).tolist()
    [0.5, 0.1]
    """
    surface = _of(model)
    rho = spectrum(albedo, "the albedo")
    points, weights = np.polynomial.legendre.leggauss(_POLAR_NODES)
    theta = np.arccos(np.sqrt((points + 1) / 2))
    found = surface.of_direction(theta, np.asarray(sigma)[..., np.newaxis], slopes)
    # Weights add up to 1 but for the last digit, and a mean of equals is to be their equal.
    one = found[..., :1, :]
    mean = one[..., 0, :] + np.einsum("t,...tk->...k", weights / 2, found - one)
    return _in_double(surface.emissivity, mean, rho)


def albedo_from_directional(
    emissivity: npt.ArrayLike,
    theta: npt.ArrayLike,
    sigma: npt.ArrayLike,
    *,
    model: str = MODEL,
    slopes: str = slope_law.DEFAULT,
) -> Array:
    """Find the albedo of facets behind an emissivity: the inverse of `directional`.

    An emissivity above 1 gives an albedo below 0, one below 0 an albedo above 1; nothing is
    clipped. Arguments and errors as in `directional`.

    Returns
    -------
    ρ(λ), shape (..., bands), in the precision of `emissivity`.

    Examples
    --------
    >>> seen = directional([0.2, 0.6], 0.0, 0.5)
    >>> np.round(albedo_from_directional(seen, 0.0, 0.5), 9).tolist()
    [0.2, 0.6]
    """
    surface = _of(model)
    epsilon = spectrum(emissivity, "the emissivity")
    return _in_double(surface.albedo, surface.of_direction(theta, sigma, slopes), epsilon)


def albedo_from_reading(
    reading: npt.ArrayLike,
    sigma: npt.ArrayLike,
    instrument: str = "45a:0",
    *,
    model: str = MODEL,
    slopes: str = slope_law.DEFAULT,
) -> Array:
    """Find the albedo of facets behind an instrument's reading, by the same model as all else here.

    Parameters
    ----------
    reading
        r(λ), shape (..., bands).
    sigma
        Roughness, radians; broadcasts against the leading axes of `reading`.
    instrument
        One of `core.reading.INSTRUMENTS`.
    model, slopes
        As in `directional`.

    Returns
    -------
    ρ(λ), shape (..., bands), in the precision of `reading`; above 1 where a reading is more than
    white facets give.

    Raises
    ------
    DomainError
        As in `directional`, or the instrument is not known.

    Examples
    --------
    >>> np.round(albedo_from_reading([0.2, 0.6], 0.0), 12).tolist()
    [0.2, 0.6]
    """
    surface = _of(model)
    r = spectrum(reading, "the reading")
    return np.asarray(surface.of_reading(r, sigma, instrument, slopes))


def check_model(model: str) -> None:
    """Refuse a model that loses light, with the reason, and an unknown one.

    Raises
    ------
    DomainError
        If `model` is none of `MODELS`.

    Examples
    --------
    >>> check_model("reference")
    """
    if model in MODELS:
        return
    models.find(model)
    reason = _WHY_NOT.get(model, "nobody has shown that it loses no light")
    msg = f"Model {model!r} tells no emissivity, because {reason}; take {MODEL!r}."
    raise DomainError(msg)


def _of(model: str) -> _Surface:
    check_model(model)
    return MODELS[model]


def _in_double(formula: Callable[[Array, Array], Array], found: Array, values: Array) -> Array:
    """Compute in double precision, where a small difference of large numbers keeps its digits."""
    return np.asarray(formula(found, values.astype(np.float64)).astype(values.dtype, copy=False))
