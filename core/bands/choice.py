# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The fewest bands that show a scene's colors within a tolerance, and how far they are off."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..color import color_difference
from ..cycles.least_mean_fit import whitener
from ..errors import DomainError
from ..limits import TOLERANCE
from ..numerics.arrays import Array
from ..numerics.wavelength_grid import check_wavelengths
from . import fitting, paths
from .paths import Paths
from .wavelengths import Selection

Metric = Literal["delta-e", "relative"]

IN_A_PASS = 3
"""Bands that one picture holds, as red, green and blue."""
MOST = 36
"""Bands beyond which none are added, unless told otherwise."""
MOST_RAISED = 0.2
"""Share by which weights may raise noise, unless told otherwise."""

_FITTED, _JUDGED = 256, 1024
"""Pixels that bands are fitted to, and those that judge them."""
_SEEDS = 1994, 2007
"""Of the ways of light to the former and to the latter."""
_ELSE = 17
"""Waves that stand for anything else that a scene might hold."""
_WEIGHT_ELSE = 1e-5
"""What each counts, as a part of all pixels."""
_BESIDE_A_LINE = 0.15
"""Part of a lamp's largest value by which others may be below 0: a cubic through four nodes, which
tells where between them a line is, has an eighth."""
_UNSEEN = 1e-6
"""Part of Y that a channel of XYZ counts as in which nothing is seen of the lamps."""
_USUAL = 0.95
"""Part of the pixels that has to be within the tolerance."""


@dataclass(frozen=True)
class Error:
    """How far colors are off, over the pixels of a picture.

    Parameters
    ----------
    mean, usual, largest
        Mean, 95th percentile and maximum: ΔE00, or percent of white for the metric "relative".
    """

    mean: float
    usual: float
    largest: float


@dataclass(frozen=True, eq=False)
class Bands:
    """Some wavelengths, and what becomes of them.

    Parameters
    ----------
    wavelengths
        Nanometers, increasing, shape (bands,): what surfaces reflect there is their color.
    weights
        From a picture's bands to the observer's values, shape (bands, channels).
    lights
        What each lamp sends in the bands, shape (lamps, bands).
    error
        What is predicted.
    raised
        By what share noise may be greater than with weights that are never negative.
    direct
        Whether light that met one surface alone is to come from a picture of its own, and is
        exact: the bands then show the rest.
    enough
        Whether it is within the tolerance.
    """

    wavelengths: Array
    weights: Array
    lights: Array
    error: Error
    raised: float
    direct: bool
    enough: bool


@dataclass(frozen=True, eq=False)
class _Scene:
    """What `choose` and `rgb` are told, checked.

    Parameters
    ----------
    nm, albedos, lights
        Shapes (n,), (surfaces, n) and (lamps, n).
    to_observer
        From what lamps send to the observer's values, shape (n, channels).
    whites
        Those of the lamps, shape (lamps, channels).
    white
        Of all lamps together, shape (channels,).
    metric, shares, enclosed
        As in `choose`.
    """

    nm: Array
    albedos: Array
    lights: Array
    to_observer: Array
    whites: Array
    white: Array
    metric: Metric
    shares: Array
    enclosed: float

    def paths(self, pixels: int, seed: int) -> Paths:
        surfaces, lamps = len(self.albedos), len(self.lights)
        return paths.draw(pixels, surfaces, lamps, seed, self.shares, self.enclosed)

    def observed(self, transport: Array) -> Array:
        """Observer's values of each lamp's light, (lamps, pixels, channels)."""
        return np.asarray((transport * self.lights[:, np.newaxis]) @ self.to_observer)

    def metric_at(self, values: Array) -> Array:
        """Matrices after which small differences from values (pixels, channels) are distances."""
        if self.metric == "relative":
            whole = np.diag(100 / self.white)
            return np.broadcast_to(whole, (len(values), *whole.shape))
        roots, slope = color_difference.roots(values / self.white)
        lab = color_difference.roots_to_lab(roots)
        scale = slope[:, np.newaxis] / self.white
        return np.asarray(whitener(lab) @ color_difference.LAB_FROM_ROOTS * scale)

    def apart(self, shown: Array, truth: Array) -> Array:
        """Errors of pixels, shape (pixels,)."""
        if self.metric == "relative":
            return np.asarray(100 * np.abs((shown - truth) / self.white).max(axis=-1))
        labs = (color_difference.xyz_to_lab(each, self.white) for each in (shown, truth))
        return color_difference.delta_e(*labs)


def choose(
    wavelengths: npt.ArrayLike,
    albedos: npt.ArrayLike,
    lights: npt.ArrayLike,
    observer: npt.ArrayLike,
    tolerance: float = TOLERANCE,
    *,
    most: int = MOST,
    direct: bool = False,
    shares: npt.ArrayLike | None = None,
    enclosed: float = 1.0,
    most_raised: float = MOST_RAISED,
    metric: Metric = "delta-e",
) -> Bands:
    """Choose the fewest bands with which 95 % of a picture are within a tolerance.

    Parameters
    ----------
    wavelengths
        Nanometers, shape (n,), increasing; any range.
    albedos
        Of the scene's surfaces, 0 to 1, shape (surfaces, n).
    lights
        What its lamps send, shape (lamps, n), each as much as it contributes to the scene's light.
        A line between two wavelengths may be told by a cubic through four, of which two are a
        little below 0.
    observer
        Sensitivities, such as color matching functions, shape (n, channels).
    tolerance
        Largest error at 95 % of the pixels.
    most
        Bands beyond which none are added; the best so far are given then, a multiple of 3.
    direct
        Whether light that met one surface alone will be exact, by a picture of its own.
    shares
        How much of what is seen each surface takes; all alike if left out. Shape (surfaces,).
    enclosed
        Part of the light leaving a surface that meets another: 1 in a closed room.
    most_raised
        Share by which negative weights may raise noise; see `Bands`.
    metric
        "delta-e", ΔE00 of XYZ, where three channels are such; or "relative", the largest of the
        channels' errors in percent of white, as for infrared.

    Returns
    -------
    The bands. White surfaces are exactly as white as the lamps, with any number of bands.

    Raises
    ------
    DomainError
        If shapes don't fit, an albedo is outside 0 to 1, or nothing is seen.

    Examples
    --------
    >>> nm = np.arange(400.0, 701.0, 10.0)
    >>> red, green = 1 / (1 + np.exp((600 - nm) / 20)), np.exp(-(((nm - 530) / 40) ** 2))
    >>> eye = np.exp(-(((nm[:, np.newaxis] - [600, 550, 450]) / [50, 45, 25]) ** 2))
    >>> found = choose(nm, [0.8 * red, 0.7 * green], np.ones((1, nm.size)), eye, 1.0)
    >>> found.enough, len(found.wavelengths) % 3, found.error.usual <= 1.0
    (True, 0, True)
    """
    scene = _checked(wavelengths, albedos, lights, observer, shares, enclosed, metric)
    ways = scene.paths(_FITTED, _SEEDS[0])
    parts = np.stack(ways.transport(scene.albedos))
    banded = parts[1] if direct else parts.sum(axis=0)
    targets = scene.observed(banded)
    metric_at = scene.metric_at(scene.observed(parts.sum(axis=0)).sum(axis=0))
    selection = _selection(scene, banded.mean(axis=0), metric_at)
    judge = _Judge.of(scene)
    last = min(max(most // IN_A_PASS, 1) * IN_A_PASS, scene.nm.size // IN_A_PASS * IN_A_PASS)
    for _ in range(last // IN_A_PASS):
        selection.add(IN_A_PASS)
        taken = sorted(selection.found)
        start = _start(scene, taken)
        weights, sent = fitting.fit(
            banded[..., taken], targets, metric_at, start, scene.whites, most_raised
        )
        error = judge.error(scene.albedos[:, taken], sent, weights, direct)
        if error.usual <= tolerance:
            break
    return Bands(
        scene.nm[taken],
        weights,
        sent,
        error,
        fitting.raised(weights, sent),
        direct,
        error.usual <= tolerance,
    )


def at(
    wavelengths: npt.ArrayLike,
    bands: npt.ArrayLike,
    albedos: npt.ArrayLike,
    lights: npt.ArrayLike,
    observer: npt.ArrayLike,
    *,
    most_raised: float = MOST_RAISED,
    metric: Metric = "delta-e",
) -> Bands:
    """Fit weights for bands that are given, as when what they show is to be seen in other light.

    Parameters
    ----------
    bands
        Some of the wavelengths, shape (bands,).

    Other parameters and errors as in `choose`.

    Raises
    ------
    DomainError
        If a band is none of the wavelengths.

    Examples
    --------
    >>> nm = np.arange(400.0, 701.0, 10.0)
    >>> red = 1 / (1 + np.exp((600 - nm) / 20))
    >>> eye = np.exp(-(((nm[:, np.newaxis] - [600, 550, 450]) / [50, 45, 25]) ** 2))
    >>> found = at(nm, nm[2::4], [0.8 * red], np.ones((1, nm.size)), eye)
    >>> len(found.wavelengths), found.error.usual < 1
    (8, True)
    """
    scene = _checked(wavelengths, albedos, lights, observer, None, 1.0, metric)
    wanted = np.asarray(bands, np.float64)
    taken = np.searchsorted(scene.nm, wanted).clip(0, scene.nm.size - 1).tolist()
    if not (scene.nm[taken] == wanted).all():
        msg = "The bands are not all among the wavelengths; give some of these."
        raise DomainError(msg)
    ways = scene.paths(_FITTED, _SEEDS[0])
    parts = np.stack(ways.transport(scene.albedos)).sum(axis=0)
    targets = scene.observed(parts)
    metric_at = scene.metric_at(targets.sum(axis=0))
    weights, sent = fitting.fit(
        parts[..., taken], targets, metric_at, _start(scene, taken), scene.whites, most_raised
    )
    error = _Judge.of(scene).error(scene.albedos[:, taken], sent, weights, False)
    raised = fitting.raised(weights, sent)
    return Bands(scene.nm[taken], weights, sent, error, raised, False, False)


def rgb(
    wavelengths: npt.ArrayLike,
    albedos: npt.ArrayLike,
    lights: npt.ArrayLike,
    observer: npt.ArrayLike,
    colors: npt.ArrayLike,
    to_xyz: npt.ArrayLike,
    *,
    shares: npt.ArrayLike | None = None,
    enclosed: float = 1.0,
) -> Error:
    """Predict how far an ordinary picture in red, green and blue is off.

    Parameters
    ----------
    colors
        What the surfaces are rendered with, scene-linear RGB, shape (surfaces, 3).
    to_xyz
        Matrix from scene-linear RGB to XYZ: `rgb @ to_xyz.T`. Lamps have the color of their
        spectrum, as far as the space has it.

    Other parameters and errors as in `choose`.

    Examples
    --------
    >>> nm = np.arange(400.0, 701.0, 10.0)
    >>> eye = np.exp(-(((nm[:, np.newaxis] - [600, 550, 450]) / [50, 45, 25]) ** 2))
    >>> gray = np.full((1, nm.size), 0.5)
    >>> error = rgb(nm, gray, np.ones((1, nm.size)), eye, [[0.5] * 3], np.eye(3))
    >>> round(error.largest, 6)
    0.0
    """
    scene = _checked(wavelengths, albedos, lights, observer, shares, enclosed, "delta-e")
    matrix = np.asarray(to_xyz, np.float64)
    sent = np.maximum(scene.whites @ np.linalg.inv(matrix).T, 0)
    return _Judge.of(scene).error(np.asarray(colors, np.float64), sent, matrix.T, False)


@dataclass(frozen=True, eq=False)
class _Judge:
    """Pixels of a picture that no band was fitted to."""

    scene: _Scene
    ways: Paths
    direct: Array
    whole: Array

    @classmethod
    def of(cls, scene: _Scene) -> _Judge:
        ways = scene.paths(_JUDGED, _SEEDS[1])
        direct, indirect = (scene.observed(part) for part in ways.transport(scene.albedos))
        return cls(scene, ways, direct.sum(axis=0), (direct + indirect).sum(axis=0))

    def error(self, albedos: Array, lights: Array, weights: Array, exact: bool) -> Error:
        """Tell how far a picture is off with these albedos, lamps and weights."""
        direct, indirect = self.ways.transport(albedos)
        seen = indirect if exact else direct + indirect
        shown = np.einsum("lpk,lk->pk", seen, lights) @ weights
        apart = self.scene.apart(shown + self.direct if exact else shown, self.whole)
        return Error(float(apart.mean()), float(np.quantile(apart, _USUAL)), float(apart.max()))


def _selection(scene: _Scene, transport: Array, metric_at: Array) -> Selection:
    """Look for wavelengths that tell what is to be shown, white, and a little of anything else.

    What is to be shown may be told by fewer wavelengths than there will be: the others then go
    where any spectrum would need them.
    """
    lamps, channels = scene.whites.shape
    importance = (metric_at**2).sum(axis=1).T
    usual = importance.mean(axis=1, keepdims=True)
    turns = np.linspace(0, np.pi, scene.nm.size) * np.arange(_ELSE)[:, np.newaxis]
    waves = (1 + np.cos(turns)) / 2  # the first is white
    rows = np.concatenate((transport, waves))
    counts = np.full(_ELSE, _WEIGHT_ELSE * len(transport))
    counts[0] = len(transport) / len(scene.albedos)
    seen = [(rows * light) @ scene.to_observer for light in scene.lights]
    return Selection(
        rows,
        np.stack(seen).transpose(0, 2, 1).reshape(lamps * channels, -1),
        np.tile(np.concatenate((importance, usual * counts), axis=1), (lamps, 1)),
    )


def _start(scene: _Scene, taken: list[int]) -> tuple[Array, Array]:
    """Weights and lamps as if spectra were straight lines between the bands."""
    parts = fitting.hats(scene.nm, scene.nm[taken])
    sensitivity = np.abs(scene.to_observer).sum(axis=1)
    shining = np.maximum(scene.lights, 0)
    if len(shining) == 1:
        weights = parts.T @ (shining[0][:, np.newaxis] * scene.to_observer)
        return weights * (scene.whites[0] / weights.sum(axis=0)), np.ones((1, len(taken)))
    # A lamp of several sends what it sends around the band, as it is seen there.
    seen = np.maximum(sensitivity @ parts, np.finfo(float).tiny)
    lights = (shining * sensitivity) @ parts / seen
    together = np.einsum("n,nk,nc->kc", shining.sum(axis=0), parts, scene.to_observer)
    total = lights.sum(axis=0)[:, np.newaxis]
    return together / np.where(total > 0, total, 1), lights


def _checked(
    wavelengths: npt.ArrayLike,
    albedos: npt.ArrayLike,
    lights: npt.ArrayLike,
    observer: npt.ArrayLike,
    shares: npt.ArrayLike | None,
    enclosed: float,
    metric: Metric,
) -> _Scene:
    nm = check_wavelengths(wavelengths)
    surfaces, lamps, eye = (np.asarray(each, np.float64) for each in (albedos, lights, observer))
    if nm.size < IN_A_PASS:
        msg = f"There are {nm.size} wavelengths; give at least {IN_A_PASS}."
        raise DomainError(msg)
    for what, array, wanted in (
        ("albedos", surfaces, f"(surfaces, {nm.size})"),
        ("lights", lamps, f"(lamps, {nm.size})"),
        ("observer", eye.T, f"({nm.size}, channels), transposed"),
    ):
        if array.ndim != 2 or array.shape[-1] != nm.size or not len(array):
            msg = f"The {what} have the shape {array.shape}; it has to be {wanted}."
            raise DomainError(msg)
        if not np.isfinite(array).all():
            msg = f"The {what} hold what is no number; leave such spectra out."
            raise DomainError(msg)
    if (surfaces < 0).any() or (surfaces > 1).any():
        worst = surfaces.flat[np.argmax(np.abs(surfaces - 0.5))]
        msg = f"An albedo is {worst:g}; give 0 to 1, and leave out what glows or fluoresces."
        raise DomainError(msg)
    if (lamps < -_BESIDE_A_LINE * lamps.max(axis=1, keepdims=True)).any():
        msg = f"A lamp sends {lamps.min():g}; light is 0 or more."
        raise DomainError(msg)
    if metric == "delta-e" and eye.shape[1] != 3:
        msg = f"ΔE00 needs X, Y and Z, not {eye.shape[1]} channels; choose 'relative'."
        raise DomainError(msg)
    if metric not in ("delta-e", "relative"):
        msg = f"The metric {metric!r} is not known; choose 'delta-e' or 'relative'."
        raise DomainError(msg)
    if not 0 <= enclosed <= 1:
        msg = f"The enclosed part of the light is {enclosed:g}; give 0 to 1."
        raise DomainError(msg)
    to_observer = eye * np.gradient(nm)[:, np.newaxis]
    whites = lamps @ to_observer
    dark = ~(whites.sum(axis=0) > 0)
    if metric == "delta-e" and dark.any() and not dark[1]:
        # Of a sodium line Z is 0 to the 10° observer, and no color is defined against such a white.
        to_observer[:, dark] = _UNSEEN * to_observer[:, 1:2]
        whites = lamps @ to_observer
        dark[:] = False
    if dark.any():
        msg = "Nothing is seen of the lamps in a channel; choose a range in which they shine."
        raise DomainError(msg)
    given = np.ones(len(surfaces)) if shares is None else np.asarray(shares, np.float64)
    if given.shape != (len(surfaces),) or not (given >= 0).all() or not given.sum() > 0:
        msg = "The surfaces' shares must be one number a surface, none below 0 and one above."
        raise DomainError(msg)
    return _Scene(
        nm,
        surfaces,
        lamps,
        to_observer,
        whites,
        whites.sum(axis=0),
        metric,
        given / given.sum(),
        enclosed,
    )
