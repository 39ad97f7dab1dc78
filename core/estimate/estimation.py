# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""σ of a rough surface from readings, what they leave open, and why σ can't be told.

Three kinds of readings tell σ: a smooth and a rough one of the same material, several angles of one
surface, and several materials with the same roughness. All are one thing here: readings share their
albedo where they share the material, and the rough ones share σ.

Two kinds of doubt are kept apart. Noise is what the readings' repeatability leaves open: the
interval. The rest is the model's: σ by other models, and a misfit where the residuals are larger
than noise. Whether σ can be told at all is decided by both: not, where even the model that is used
could shift σ by `TOO_OPEN` if it missed the readings by `MODEL_ERROR`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import models
from ..errors import DomainError
from ..numerics.arrays import Array
from . import likelihood
from .readings import Measured, Reading, prepare
from .search import QUANTILE, Found, search

MODEL = "closure"
"""Model that σ is estimated in unless another is named, and that decides whether σ can be told: it
has to keep the energy of white facets, or it would see roughness in white."""

SPREAD = tuple(name for name in models.NAMES if name not in ("lambert", "first-order"))
"""Models whose σ is given beside it: all that know light between facets."""

CONFIDENCE = 0.95
"""Share of cases in which the interval holds σ."""

MODEL_ERROR = 0.003
"""What the best models miss of a traced random surface at 45°/0°, as a share of the reading. It is
taken for every instrument, once for dark facets and once for bright ones."""

LARGEST = np.radians(60.0)
"""Largest σ that is thought of: beyond it no model is held against a surface."""

TOO_OPEN = np.radians(20.0)
"""An interval as wide as this says no more than the eye does."""

_NODES = np.radians(np.arange(0.0, 61.0, 2.0))
"""Roughnesses where the search begins; χ² has no valley narrower than that, but deeper ones."""

_FINE = np.radians(np.arange(0.0, 60.5, 0.5))
"""Roughnesses at which it is asked what the model's error leaves open."""

_UNLIKELY = 5.0
"""Standard deviations of χ² from which residuals are more than noise."""

_TOO_BRIGHT = 3.0
"""Model errors beyond a smooth surface from which no roughness explains a reading."""

_TOO_FAR = 10.0
"""Model errors of residuals, over all bands, from which the readings are not of one material."""

_ANY_ERROR = 1e3
"""A model error that explains whatever is the same in all bands."""


@dataclass(frozen=True, eq=False)
class Estimate:
    """What readings say of a roughness; angles are radians.

    Attributes
    ----------
    sigma
        The best; NaN where σ can't be told.
    interval
        What noise leaves open, 95 %: lower and upper end. It begins at 0 where the surface may be
        smooth. Where σ can't be told it is what noise and the model leave open together.
    is_told
        Whether the readings tell σ.
    reason
        Why they don't; or, where they do, what limits it; a sentence.
    standard_error
        1 over the root of the Fisher information about σ, from noise alone; infinite where there is
        none, as at σ = 0, where a reading does not change with σ.
    model, by_model
        The model that was used; and σ by each of the others, NaN where it has no answer.
    albedo
        By material, each of shape (bands,); NaN in bands that no reading has.
    residuals
        Reading less prediction, shape (readings, bands); NaN in bands that were left out.
    chi_square, freedom
        Sum of the squares of the residuals over their deviations, and how large it should be.
    notes
        Sentences: bands that were left out, and what to doubt.
    """

    sigma: float
    interval: tuple[float, float]
    is_told: bool
    reason: str
    standard_error: float
    model: str
    by_model: Mapping[str, float]
    albedo: Mapping[str, Array]
    residuals: Array
    chi_square: float
    freedom: int
    notes: tuple[str, ...]

    @property
    def spread(self) -> tuple[float, float]:
        """Smallest and largest σ of all models: what they leave open."""
        known = [sigma for sigma in self.by_model.values() if np.isfinite(sigma)]
        return (min(known), max(known)) if known else (np.nan, np.nan)


def sigma(
    readings: Sequence[Reading], model: str = MODEL, others: Sequence[str] = SPREAD
) -> Estimate:
    """Estimate the roughness that the rough ones of some readings share.

    Parameters
    ----------
    readings
        With the same bands; at least one of a rough surface.
    model
        One of `core.models.NAMES` that knows roughness.
    others
        Models whose σ is given beside it.

    Raises
    ------
    DomainError
        If the readings cannot be used together, or a model does not know roughness.

    Examples
    --------
    >>> from .. import reading
    >>> albedo = np.array([0.2, 0.4, 0.6])
    >>> read = reading.from_albedo(albedo, np.radians(30), MODEL)
    >>> found = sigma([Reading(albedo, rough=False), Reading(read)])
    >>> round(float(np.degrees(found.sigma)), 2), found.is_told
    (30.0, True)
    >>> np.round(np.degrees(found.interval), 1).tolist()
    [29.8, 30.2]
    >>> sigma([Reading(read)]).reason.partition(":")[0]
    "σ can't be told from one reading"
    """
    measured = prepare(readings)
    for name in (model, *others):
        models.find(name)
        if name == "lambert":
            msg = "The model 'lambert' does not know roughness; choose another one."
            raise DomainError(msg)
    found = _best(measured, model)
    by_model = {name: found if name == model else _best(measured, name) for name in others}
    fitted = likelihood.fit(
        measured, model, measured.values, np.asarray(found.sigma[0]), found.albedo[0]
    )
    open_range = max(
        (_left_open(measured, name, fitted.albedo, found.sigma[0]) for name in (model, MODEL)),
        key=lambda ends: ends[1] - ends[0],
    )
    freedom = _freedom(measured)
    reason = _why_not(measured, found, fitted, open_range)
    is_told = not reason
    best, (low, high) = float(found.sigma[0]), found.interval[0].tolist()
    doubts = _doubts(float(fitted.chi_square), freedom)
    if best == 0 and doubts:
        # Readings beyond what a smooth surface gives leave noise less than nothing.
        high = max(high, open_range[1])
    chosen = {name: float(of.sigma[0]) if is_told else np.nan for name, of in by_model.items()}
    used = measured.weights > 0
    return Estimate(
        sigma=best if is_told else np.nan,
        interval=(low, high) if is_told else open_range,
        is_told=is_told,
        reason=reason or _limits(low, high),
        standard_error=_standard_error(measured, model, fitted, best),
        model=model,
        by_model=chosen,
        albedo={
            name: np.where(used[rows].any(axis=0), fitted.albedo[number], np.nan)
            for number, (name, rows) in enumerate(measured.materials.items())
        },
        residuals=np.where(used, measured.values - fitted.predicted, np.nan),
        chi_square=float(fitted.chi_square),
        freedom=freedom,
        notes=measured.notes + doubts,
    )


def of_draws(readings: Sequence[Reading], draws: Array, model: str = MODEL) -> tuple[Array, Array]:
    """Estimate σ of many draws of the same readings at once.

    Parameters
    ----------
    readings
        As in `sigma`: which is of what, and how repeatable.
    draws
        Values in place of theirs, shape (draws, readings, bands).

    Returns
    -------
    σ, shape (draws,), and the ends of its interval, shape (draws, 2); radians.

    Raises
    ------
    DomainError
        As in `sigma`.

    Examples
    --------
    >>> pair = [Reading([0.5], rough=False), Reading([0.4])]
    >>> best, interval = of_draws(pair, np.array([[[0.5], [0.4]], [[0.5], [0.5]]]), "two-bounce")
    >>> np.round(np.degrees(best), 1).tolist(), np.round(np.degrees(interval[1]), 1).tolist()
    ([34.6, 0.0], [0.0, 3.1])
    """
    measured = prepare(readings)
    found = search(measured, model, np.where(measured.weights > 0, draws, 0), _NODES)
    return found.sigma, found.interval


def _best(measured: Measured, model: str) -> Found:
    return search(measured, model, measured.values[np.newaxis], _NODES)


def _left_open(measured: Measured, model: str, albedo: Array, best: Array) -> tuple[float, float]:
    """Give the σ that noise and the model's error leave open together.

    It is asked of readings as the model predicts them and not of the measured ones: this is the
    Fisher information at a distance. Where a reading hardly depends on σ, one draw of noise may
    suit a far σ by chance, which says nothing.
    """
    predicted = likelihood.predict(measured, model, albedo, np.asarray(best))
    expected = replace(measured, values=predicted)
    fitted = likelihood.fit(expected, model, predicted, _FINE)
    likely = likelihood.allowing(expected, fitted, MODEL_ERROR) <= QUANTILE**2
    return float(_FINE[likely].min(initial=LARGEST)), float(_FINE[likely].max(initial=0))


def _freedom(measured: Measured) -> int:
    """Give how many readings are left to judge σ by: all, less one a known albedo, less σ."""
    used = measured.weights > 0
    albedos = sum(int(used[rows].any(axis=0).sum()) for rows in measured.materials.values())
    return max(int(used.sum()) - albedos - 1, 0)


def _standard_error(
    measured: Measured, model: str, fitted: likelihood.Fitted, best: float
) -> float:
    free = likelihood.sensitivity(measured, model, fitted, np.asarray(best * best))
    information = float(np.sum(measured.weights * free * free)) * (2 * best) ** 2
    return float(1 / np.sqrt(information)) if information > 0 else np.inf


def _why_not(
    measured: Measured, found: Found, fitted: likelihood.Fitted, open_range: tuple[float, float]
) -> str:
    """Say why σ can't be told; empty where it can."""
    used = measured.weights > 0
    shared = [rows for rows in measured.materials.values() if (used[rows].sum(axis=0) > 1).any()]
    if not any(measured.rough[rows].any() for rows in shared):
        alone = "readings that share no material and band"
        alone = "one reading" if len(measured.values) == 1 else alone
        return (
            f"σ can't be told from {alone}: any σ explains it with some albedo; add one of the "
            "smooth material, or one at another angle."
        )
    if found.sigma[0] == 0 and _is_brighter(measured, fitted):
        return (
            "σ can't be told: the rough surface reads brighter than the smooth one, which no "
            "roughness does; look for gloss, another white, or another material."
        )
    if open_range[1] - open_range[0] >= TOO_OPEN:
        low, high = np.degrees(open_range)
        return (
            f"σ can't be told: {_cause(measured, found)}; anything from {low:.0f}° to {high:.0f}° "
            f"explains them, if the model misses them by {100 * MODEL_ERROR:g} %."
        )
    miss = _miss(measured, fitted)
    if miss > _TOO_FAR * MODEL_ERROR:
        return (
            f"σ can't be told: the best one still misses the readings by {100 * miss:.0f} % (rms), "
            "more than a diffuse surface of one material; look for gloss or for the wrong sample."
        )
    return ""


def _is_brighter(measured: Measured, fitted: likelihood.Fitted) -> bool:
    """Whether readings are beyond a smooth surface by more than noise and a model's error."""
    free, bound = (
        likelihood.allowing(measured, fitted, error) for error in (_ANY_ERROR, MODEL_ERROR)
    )
    return bool(bound - free > _TOO_BRIGHT**2)


def _miss(measured: Measured, fitted: likelihood.Fitted) -> float:
    """Give the residuals' size as a share of the readings', over all bands."""
    used = measured.weights > 0
    size = float(np.sum(measured.values[used] ** 2))
    left = float(np.sum((measured.values - fitted.predicted)[used] ** 2))
    return float(np.sqrt(left / size)) if size > 0 else 0.0


def _cause(measured: Measured, found: Found) -> str:
    """Say what makes readings insensitive to σ."""
    white = np.max(found.albedo[0], axis=-1, where=_known(measured), initial=0).min()
    if np.min(found.albedo[0], axis=-1, where=_known(measured), initial=2).min() > 0.97:
        return "white reads the same at any roughness, because its facets lose no light"
    if white < 0.01:
        return "black reads the same at any roughness within its noise"
    if measured.rough.all():
        return "these angles see the same change with σ, which an albedo explains as well"
    return "the readings hardly change with σ against their noise"


def _known(measured: Measured) -> Array:
    used = measured.weights > 0
    return np.stack([used[rows].any(axis=0) for rows in measured.materials.values()])


def _limits(low: float, high: float) -> str:
    """Say what the interval is like, where σ can be told."""
    if low == 0:
        return (
            "σ = 0 within noise: the readings fit a smooth surface, and roughness up to "
            f"{np.degrees(high):.1f}°."
        )
    if high >= LARGEST:
        return (
            f"σ is at the end of what is thought of, {np.degrees(LARGEST):.0f}°; it may be larger."
        )
    return "Noise leaves the interval open, and the models the spread."


def _doubts(chi_square: float, freedom: int) -> tuple[str, ...]:
    """Say where the residuals are more than noise."""
    if freedom == 0 or chi_square <= freedom + _UNLIKELY * np.sqrt(2 * freedom):
        return ()
    times = np.sqrt(chi_square / freedom)
    return (
        f"The readings are {times:.1f} times as far from the model as their repeatability "
        "explains; the interval does not count that.",
    )
