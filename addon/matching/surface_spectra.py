# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From the measured spectra of requests to the surface's readings and its facets' albedos."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from ...core import feasible, instruments, models, reading
from ...core.errors import DomainError
from ...core.numerics.arrays import Array
from ...core.numerics.memoized import memoized
from ..samples.sample import Sample
from .request import Request


def readings_and_albedos(requests: list[Request]) -> tuple[Array, Array]:
    """Give readings and albedos, each (materials, bands), of requests that `alike` put together.

    An albedo is above 1 where the reading is more than white facets give. Those of a single request
    are read-only.
    """
    if len(requests) == 1:
        return _of_one(requests[0])
    return _of_all(requests)


@memoized(maxsize=16)
def _of_one(request: Request) -> tuple[Array, Array]:
    """Compute one material once: while a slider is dragged, its pictures need the same again."""
    found = _of_all([request])
    for values in found:
        values.setflags(write=False)
    return found


def _of_all(requests: list[Request]) -> tuple[Array, Array]:
    model = requests[0].model
    rho = albedos(requests, model)
    if model == "lambert":
        return rho, rho
    sigma = np.array([request.sigma for request in requests])
    seen = [i for i, request in enumerate(requests) if _as_printed(request)]
    read_at = requests[0].read_at
    predicted = rho.copy()
    if len(seen) < len(requests):
        predicted = _from_albedo(rho, sigma, model, read_at)
    for i in seen:
        predicted[i] = requests[i].sample.reflectance
    return predicted, rho


def sigma_max(request: Request) -> float | None:
    """Largest σ, degrees, at which white facets read no less than the sample; None without one."""
    sample, model = request.sample, request.model
    if sample.kind == "albedo" or model == "lambert":
        return None
    degrees, white = _white(_quick(model), sample.instrument)
    peak = float(sample.reflectance.max())
    too_dark = np.flatnonzero(white < peak)
    if not too_dark.size:
        return None
    first = int(too_dark[0])
    if first == 0:
        return 0.0
    above, below = white[first - 1], white[first]
    share = (above - peak) / (above - below)
    return float(degrees[first - 1] + share * (degrees[first] - degrees[first - 1]))


def open_albedos(request: Request) -> tuple[Array, Array] | None:
    """Lowest and highest albedo, each (bands,), that may be behind a reading while σ is unknown.

    None of an albedo, which is known, and of what reads more than white facets at every σ.
    """
    sample = request.sample
    if sample.kind == "albedo":
        return None
    return _open_albedos(sample, _quick(request.model))


@memoized(maxsize=32)
def _open_albedos(sample: Sample, model: str) -> tuple[Array, Array] | None:
    """Search once: while σ is dragged, the pictures show the same at every step."""
    found = feasible.albedo_range(sample.reflectance, model, sample.instrument)
    if np.isnan(found.sigma_max):
        return None
    for values in (found.lowest, found.highest):
        values.setflags(write=False)
    return found.lowest, found.highest


def _quick(model: str) -> str:
    """Give the closure for the reference: that takes seconds at first, and they differ by 1 %."""
    return "closure" if model == "reference" else model


def _as_printed(request: Request) -> bool:
    """Whether the measured values themselves are what the virtual instrument has to read."""
    return request.sample.kind == "reading" and request.sample.instrument == request.read_at


def albedos(requests: list[Request], model: str) -> Array:
    """Albedos (materials, bands) by a model, of requests with the same bands and instrument."""
    instrument = instruments.find(requests[0].sample.instrument).name
    values = np.stack([request.sample.reflectance for request in requests])
    is_albedo = np.array([request.sample.kind == "albedo" for request in requests])
    if model == "lambert" or is_albedo.all():
        return values
    sigma = np.array([request.sigma for request in requests])
    behind = _to_albedo(values, sigma, model, instrument)
    return np.where(is_albedo[:, np.newaxis], values, behind)


def _to_albedo(values: Array, sigma: Array, model: str, instrument: str) -> Array:
    """Give the albedo behind readings; above 1 in proportion where white facets give less.

    Only fluorescence or gloss reads more than white facets, which no model of them describes.
    """
    white = reading.white_reading(sigma, model, instrument)[:, np.newaxis]
    rho = reading.to_albedo(np.minimum(values, white), sigma, model, instrument)
    return np.asarray(rho * np.maximum(values / white, 1))


def _from_albedo(rho: Array, sigma: Array, model: str, read_at: str) -> Array:
    """Predict the virtual instrument's readings; beyond 1 in proportion, as `_to_albedo`."""
    seen = reading.from_albedo(np.minimum(rho, 1), sigma, model, read_at)
    return np.asarray(seen * np.maximum(rho, 1))


def alike(requests: Sequence[Request]) -> list[list[int]]:
    """Group requests that share wavelengths, light, model and instruments: their matrices."""
    groups: dict[tuple[object, ...], list[int]] = {}
    for i, request in enumerate(requests):
        sample, light = request.sample, request.scene or request.illuminant
        bands, read_at = sample.wavelengths.tobytes(), request.read_at
        key = (bands, light, request.model, sample.instrument, read_at)
        groups.setdefault(key, []).append(i)
    return list(groups.values())


@contextmanager
def naming(sample: Sample) -> Iterator[None]:
    """Name the sample in what the core says of its wavelengths."""
    try:
        yield
    except DomainError as error:
        msg = f"{sample.source or 'Sample'}, {sample.name!r}: {error}"
        raise DomainError(msg) from error


@memoized(maxsize=64)
def _white(model: str, instrument: str) -> tuple[Array, Array]:
    degrees = np.linspace(0, models.find(model).largest_sigma, 361)
    return degrees, reading.white_reading(np.radians(degrees), model, instrument)
