# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings to estimate σ from: of which material, on which surface, how repeatable."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .. import instruments, limits
from ..errors import DomainError
from ..numerics.arrays import Array

RELATIVE = limits.REPEATABILITY
"""Repeatability of a reading unless it is stated, as a share of it."""

ABSOLUTE = 0.0001
"""What is added to it, in quadrature: files print four decimals, and black is never quiet."""

_BEYOND_NOISE = 5
"""Standard deviations from 0 or from white that are no noise."""

_SAME_NM = 0.01
"""Wavelengths so near to each other, nm, are the same."""

_PLATEAU = 3
"""Bands in a row, exactly as large as the largest, that make a detector look saturated."""

Directions = tuple[float, float, float]
"""θi, θr and Δφ, radians."""


@dataclass(frozen=True, eq=False)
class Reading:
    """One reading of one surface.

    Attributes
    ----------
    values
        Reflectance factors as measured, shape (bands,); NaN where there is none.
    rough
        Whether the surface is rough; a smooth one reads its albedo at every instrument.
    instrument
        One of `core.instruments.REGISTRY`; or θi, θr and Δφ, radians, of a goniometer.
    material
        Readings with the same material share their albedo.
    deviation
        Standard deviation of repeated readings, a number or shape (bands,); None takes that of
        `repeatability`.
    wavelengths
        Nanometers, shape (bands,), to be compared with those of the other readings; or None.
    name
        What messages call the reading.
    """

    values: npt.ArrayLike
    rough: bool = True
    instrument: str | Directions = "45a:0"
    material: str = ""
    deviation: npt.ArrayLike | None = None
    wavelengths: npt.ArrayLike | None = None
    name: str = ""


@dataclass(frozen=True, eq=False)
class Measured:
    """Readings that can be computed with.

    Attributes
    ----------
    values
        Shape (readings, bands); 0 where `weights` is.
    weights
        1 over the variance, same shape; 0 in bands that are left out.
    rough
        Shape (readings,).
    instruments
        One a reading.
    materials
        Each material's rows of `values`.
    notes
        Sentences on what was left out.
    """

    values: Array
    weights: Array
    rough: Array
    instruments: tuple[str | Directions, ...]
    materials: dict[str, list[int]]
    notes: tuple[str, ...]


def repeatability(
    values: npt.ArrayLike, relative: float = RELATIVE, absolute: float = ABSOLUTE
) -> Array:
    """Give the standard deviation of repeated readings, √((relative · r)² + absolute²).

    Examples
    --------
    >>> np.round(repeatability([0.0, 0.5, 1.0]), 6).tolist()
    [0.0001, 0.00051, 0.001005]
    """
    return np.hypot(relative * np.asarray(values, np.float64), absolute)


def prepare(readings: Sequence[Reading]) -> Measured:
    """Check readings, and leave out bands that say nothing of a surface.

    Raises
    ------
    DomainError
        If there is no rough one, if bands or wavelengths differ, if an instrument is not known or
        a deviation is not above 0.

    Examples
    --------
    >>> smooth, rough = Reading([0.5, 0.6], rough=False), Reading([0.4, np.nan])
    >>> found = prepare([smooth, rough])
    >>> found.weights[1].round().tolist(), found.notes
    ([5882353.0, 0.0], ('reading 2: 1 of 2 bands was left out, no number.',))
    """
    given = list(readings)
    names = [reading.name or f"reading {number}" for number, reading in enumerate(given, 1)]
    if not any(reading.rough for reading in given):
        msg = "None of the readings is of a rough surface; say which are."
        raise DomainError(msg)
    _check_bands(given, names)
    values, weights, notes, materials = [], [], [], dict[str, list[int]]()
    for row, (reading, name) in enumerate(zip(given, names, strict=True)):
        if isinstance(reading.instrument, str):
            instruments.find(reading.instrument)
        found = np.asarray(reading.values, np.float64)
        deviation = _deviation(reading, found, name)
        reasons = _unusable(found, deviation, reading.rough)
        left_out = np.any(list(reasons.values()), axis=0)
        values.append(np.where(left_out, 0, found))
        weights.append(np.where(left_out, 0, 1 / deviation**2))
        materials.setdefault(reading.material, []).append(row)
        if left_out.any():
            notes.append(_note(name, left_out, reasons))
    return Measured(
        np.array(values),
        np.array(weights),
        np.array([reading.rough for reading in given]),
        tuple(reading.instrument for reading in given),
        materials,
        tuple(notes),
    )


def _check_bands(readings: Sequence[Reading], names: Sequence[str]) -> None:
    """Refuse readings that don't stand at the same wavelengths."""
    first = np.asarray(readings[0].values)
    wavelengths, owner = None, ""
    for reading, name in zip(readings, names, strict=True):
        shape = np.shape(reading.values)
        if len(shape) != 1 or not shape[0]:
            msg = f"{name} has values of shape {shape}; give one value a band."
            raise DomainError(msg)
        if shape != first.shape:
            msg = (
                f"{names[0]} has {first.size} bands and {name} {shape[0]}; export both with the "
                "same wavelengths."
            )
            raise DomainError(msg)
        if reading.wavelengths is None:
            continue
        nm = np.asarray(reading.wavelengths, np.float64)
        if nm.shape != shape:
            msg = f"{name} has {nm.size} wavelengths and {shape[0]} values; give one value each."
            raise DomainError(msg)
        if wavelengths is None:
            wavelengths, owner = nm, name
        elif not np.allclose(nm, wavelengths, rtol=0, atol=_SAME_NM):
            band = int(np.argmax(np.abs(nm - wavelengths) > _SAME_NM))
            msg = (
                f"Band {band + 1} is {wavelengths[band]:g} nm in {owner} and {nm[band]:g} nm in "
                f"{name}; export both with the same wavelengths."
            )
            raise DomainError(msg)


def _deviation(reading: Reading, values: Array, name: str) -> Array:
    if reading.deviation is None:
        # Of bands that are no number the deviation is not used.
        return repeatability(np.nan_to_num(values, posinf=0, neginf=0))
    deviation = np.asarray(reading.deviation, np.float64)
    if deviation.shape not in ((), values.shape):
        msg = (
            f"{name} has {deviation.size} standard deviations and {values.size} values; give one "
            "for all, or one each."
        )
        raise DomainError(msg)
    if not (np.isfinite(deviation) & (deviation > 0)).all():
        msg = f"The repeatability of {name} holds a number that is not above 0; correct it."
        raise DomainError(msg)
    return np.broadcast_to(deviation, values.shape)


def _unusable(values: Array, deviation: Array, rough: bool) -> dict[str, Array]:
    """Give which bands are left out for each reason."""
    noise = _BEYOND_NOISE * deviation
    finite = np.isfinite(values)
    shown = np.where(finite, values, 0)
    return {
        "no number": ~finite,
        "below 0 by more than noise": shown < -noise,
        # Without roughness nothing diffuse is brighter than white; a rough surface may be.
        "above white": (shown > 1 + noise) & (not rough),
        "saturated": _plateau(shown),
    }


def _plateau(values: Array) -> Array:
    """Find bands where a bright reading stays at exactly its largest value, as if cut off."""
    top = values.max()
    level = values == top
    if top < 1 or level.all():  # all alike is a white by definition
        return np.zeros(values.shape, bool)
    edges = np.flatnonzero(np.diff(np.concatenate(([0], level.view(np.int8), [0]))))
    cut = np.zeros(values.shape, bool)
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        cut[begin:end] = end - begin >= _PLATEAU
    return cut


def _note(name: str, left_out: Array, reasons: dict[str, Array]) -> str:
    what = ", ".join(reason for reason, bands in reasons.items() if bands.any())
    count = int(left_out.sum())
    were = "was" if count == 1 else "were"
    return f"{name}: {count} of {left_out.size} bands {were} left out, {what}."
