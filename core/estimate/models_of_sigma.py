# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The models that σ can be estimated in: those of `core.models`, and the V-cavity's slope laws.

What "σ" is of a V-cavity depends on its slope law, so the law is a part of what models leave open.
"reference" has one law; the V-cavity with each other law is a model here, called after both.
"""

from __future__ import annotations

from .. import ladder, models, reading
from ..errors import DomainError
from ..instruments import curves
from ..numerics.arrays import Array
from ..vcavity import bounce_series, reflectance, slope_law
from .readings import Directions

OTHER_LAWS = {f"reference, {law}": law for law in slope_law.LAWS if law != slope_law.DEFAULT}
"""Slope laws of the V-cavity besides that of "reference", by the name of the model here."""

SPREAD = (
    *(name for name in models.NAMES if name not in ("lambert", "first-order")),
    *OTHER_LAWS,
)
"""All that know light between facets."""


def check(model: str) -> None:
    """Refuse a model that there is not, or that knows no roughness.

    Raises
    ------
    DomainError
        Naming what to choose.

    Examples
    --------
    >>> check("two-bounce")
    >>> check("lambert")
    Traceback (most recent call last):
    core.errors.DomainError: The model 'lambert' does not know roughness; choose another one.
    """
    if model not in OTHER_LAWS:
        models.find(model)
    if model == "lambert":
        msg = "The model 'lambert' does not know roughness; choose another one."
        raise DomainError(msg)


def predict(albedo: Array, sigma: Array, model: str, instrument: str | Directions) -> Array:
    """Predict the reading of an instrument, or in a direction: shape (..., bands).

    Examples
    --------
    >>> albedo, sigma = np.array([0.2, 0.6]), np.array(0.5)
    >>> np.round(predict(albedo, sigma, "two-bounce", "45a:0"), 3).tolist()
    [0.161, 0.511]
    """
    if model in OTHER_LAWS:
        law = OTHER_LAWS[model]
        if not isinstance(instrument, str):
            return reflectance(albedo, *instrument, sigma, slopes=law)
        return bounce_series.evaluate(curves.series(instrument, law).rows(sigma), albedo)
    if not isinstance(instrument, str):
        return ladder.reflectance(model, albedo, *instrument, sigma)
    return reading.from_albedo(albedo, sigma, model, instrument)


def invert(values: Array, sigma: Array, model: str, instrument: str) -> Array:
    """Give the albedo behind a reading of an instrument: shape (..., bands).

    Examples
    --------
    >>> read = predict(np.array([0.2, 0.6]), np.array(0.5), "two-bounce", "45a:0")
    >>> np.round(invert(read, np.array(0.5), "two-bounce", "45a:0"), 9).tolist()
    [0.2, 0.6]
    """
    if model in OTHER_LAWS:
        rows = curves.series(instrument, OTHER_LAWS[model]).rows(sigma)
        return bounce_series.invert(rows, values)
    return reading.to_albedo(values, sigma, model, instrument)
