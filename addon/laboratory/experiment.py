# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure a rough sample in Cycles: reading, spread over places of a spot, and noise.

One period of the surface is rendered, as often as there are seeds. Because the surface goes on, so
does the picture: a circular spot may lie anywhere, and the mean over *all* its places is the mean
of the picture. What readings at different places differ by is the surface's own; what pictures with
different random numbers differ by is noise. The first is found free of the second, from products
of pictures that share no random numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ...core.errors import DomainError
from ...core.heights import Mesh
from ...core.numerics.arrays import Array
from ..blender.background_job import Job, waited
from ..instrument.measure import Geometry

AZIMUTHS = 64
"""Lights in a ring. Seeds turn it, so grooves are lit from `AZIMUTHS` times `SEEDS` azimuths."""

SEEDS = 4
"""Renders with random numbers of their own."""

SAMPLES = 256
"""Rays a pixel and render. Cycles shares 256 sequences among all pixels: few rays in many pixels
that see alike, as they do of even grooves, would repeat one error, and the noise not show it."""

PIXELS = 64
"""Width of the picture; more where the spot would be less than `SPOT_PIXELS` wide."""

FEWEST_SAMPLES = 16
"""Rays a pixel that a finer picture keeps; otherwise it shares those of one `PIXELS` wide."""

SPOT_PIXELS = 8
LARGEST_PICTURE = 1024

GROUP = 3
"""Albedos a render: red, green and blue."""

RING_45_0 = Geometry(
    tuple((math.pi / 4, 2 * math.pi * number / AZIMUTHS) for number in range(AZIMUTHS)), 0.0
)
"""45°a:0°, with more lights than a flat sample needs."""


@dataclass(frozen=True, eq=False)
class Measured:
    """What the laboratory found of one sample.

    Attributes
    ----------
    albedos
        Of the facets, shape (n,).
    reflectance
        Reflectance factor, the mean over all places of the spot, shape (n,).
    noise
        Standard error of `reflectance`, shape (n,).
    spread
        Standard deviation of readings over the places of the spot, noise taken out, shape (n,); 0
        where it is below the noise.
    spot_noise
        Standard error of a reading at one place, shape (n,).
    spot
        Diameter, in the sample's unit.
    """

    albedos: Array
    reflectance: Array
    noise: Array
    spread: Array
    spot_noise: Array
    spot: float


class Experiment(Job):
    """A rough sample being measured in a second Blender.

    Parameters
    ----------
    mesh
        One period of the sample.
    albedos
        Of the facets, 0 to 1, shape (n,).
    spot
        Diameter of what the instrument sees, in the mesh's unit, up to the shorter period; half of
        that if not given.
    geometry
        Lights and view.
    seeds, samples
        Renders with random numbers of their own, two or more, and rays a pixel in each; a picture
        that is finer for the sake of a small spot shares as many, see `FEWEST_SAMPLES`.

    Raises
    ------
    DomainError
        If a number is out of its range.
    OutputError
        If the temporary folder cannot be written or the second Blender not be started.
    """

    doing = "measures the rough sample"
    interrupted = "Measuring was interrupted; nothing was written."
    smaller = "ask for fewer cells"

    def __init__(
        self,
        mesh: Mesh,
        albedos: npt.ArrayLike,
        spot: float | None = None,
        *,
        geometry: Geometry = RING_45_0,
        seeds: int = SEEDS,
        samples: int = SAMPLES,
    ) -> None:
        self._albedos = _checked(albedos)
        self._mesh = mesh
        self._spot = _checked_spot(mesh, spot)
        if seeds < 2:
            raise DomainError(f"{seeds} renders tell no noise; give 2 seeds or more.")
        if samples < 1:
            raise DomainError(f"There are {samples} rays a pixel; give 1 or more.")
        self._levels, self._level_of = np.unique(self._albedos, return_inverse=True)
        groups = _groups(self._levels)

        pixels = _pixels(mesh, self._spot)
        shared = max(FEWEST_SAMPLES, round(samples * (PIXELS / pixels) ** 2))

        def prepare(folder: Path) -> dict[str, Any]:
            np.savez(folder / "mesh.npz", vertices=mesh.vertices, faces=mesh.faces)
            return {
                "period": mesh.period,
                "rings": mesh.rings,
                "albedos": groups.tolist(),
                "lights": geometry.lights,
                "view": geometry.view,
                "pixels": pixels,
                "samples": min(samples, shared),
                "seeds": seeds,
            }

        super().__init__(Path(__file__).with_name("worker.py"), prepare)

    def result(self) -> Measured:
        """Give what was measured, once `poll` says that it has ended.

        Raises
        ------
        OutputError
            If the second Blender failed.
        """
        pictures = np.load(self.output("pictures.npy")).astype(np.float64)
        count = self._levels.size
        # (groups, seeds, rows, columns, 3) to (albedos, seeds, rows, columns)
        each = np.moveaxis(pictures, -1, 1).reshape(-1, *pictures.shape[1:-1])[:count]
        found = [_judged(of_one, self._mesh.period, self._spot) for of_one in each]
        reading, noise, spread, spot_noise = np.array(found)[self._level_of.ravel()].T
        return Measured(self._albedos, reading, noise, spread, spot_noise, self._spot)


def measure(
    mesh: Mesh,
    albedos: npt.ArrayLike,
    spot: float | None = None,
    *,
    geometry: Geometry = RING_45_0,
    seeds: int = SEEDS,
    samples: int = SAMPLES,
    progress: Callable[[int, int], None] | None = None,
) -> Measured:
    """Measure a rough sample and wait for the result.

    Parameters
    ----------
    mesh, albedos, spot, geometry, seeds, samples
        As of `Experiment`.
    progress
        Called with renders done and renders in all; may raise to stop.

    Raises
    ------
    DomainError
        If a number is out of its range.
    OutputError
        If the second Blender failed.
    CancelledError
        On an interrupt from the keyboard.
    """
    with waited(
        Experiment(mesh, albedos, spot, geometry=geometry, seeds=seeds, samples=samples), progress
    ) as experiment:
        return experiment.result()


def spot_readings(picture: Array, period: Sequence[float], spot: float) -> Array:
    """Mean over a circular spot around each pixel of a picture that goes on at its edges.

    Parameters
    ----------
    picture
        Shape (..., rows, columns), one period.
    period
        Along x and y.
    spot
        Diameter.

    Returns
    -------
    The shape of `picture`.
    """
    rows, columns = picture.shape[-2:]
    x = period[0] * np.fft.fftfreq(columns)
    y = period[1] * np.fft.fftfreq(rows)[:, np.newaxis]
    inside = (x**2 + y**2 <= (spot / 2) ** 2).astype(np.float64)
    around = np.fft.rfft2(inside / inside.sum())
    return np.asarray(np.fft.irfft2(np.fft.rfft2(picture) * around, s=(rows, columns)))


def _judged(pictures: Array, period: Sequence[float], spot: float) -> tuple[float, ...]:
    """Give reading, noise, spread and noise of a spot, from pictures (seeds, rows, columns)."""
    seeds = len(pictures)
    means = pictures.mean(axis=(1, 2))
    places = spot_readings(pictures, period, spot)
    varied = places - means[:, np.newaxis, np.newaxis]
    products = varied.sum(axis=0) ** 2 - np.sum(varied**2, axis=0)
    variance = max(float(products.mean()) / (seeds * (seeds - 1)), 0.0)
    spot_variance = float(places.var(axis=0, ddof=1).mean()) / seeds
    noise = float(means.std(ddof=1)) / math.sqrt(seeds)
    return float(means.mean()), noise, math.sqrt(variance), math.sqrt(spot_variance)


def _checked(albedos: npt.ArrayLike) -> Array:
    array = np.atleast_1d(np.asarray(albedos, np.float64)).ravel()
    if array.size == 0:
        raise DomainError("There is no albedo to measure; give one or more.")
    outside = array[~((array >= 0) & (array <= 1))]
    if outside.size:
        raise DomainError(f"An albedo is {outside[0]:g}; give 0 to 1.")
    return array


def _checked_spot(mesh: Mesh, spot: float | None) -> float:
    shorter = min(mesh.period)
    if spot is None:
        return shorter / 2
    smallest = SPOT_PIXELS * mesh.period[0] / LARGEST_PICTURE
    if not smallest <= spot <= shorter:
        msg = (
            f"The spot is {spot:g} wide, and the sample repeats after {shorter:g}; give a spot of "
            f"{smallest:.3g} to {shorter:g}, or another length to make the sample with."
        )
        raise DomainError(msg)
    return spot


def _pixels(mesh: Mesh, spot: float) -> int:
    return max(PIXELS, math.ceil(SPOT_PIXELS * mesh.period[0] / spot))


def _groups(levels: Array) -> Array:
    """Albedos in rows of three, the last repeated; like ones together, for rays to end alike."""
    padded = np.pad(levels, (0, -levels.size % GROUP), mode="edge")
    return np.asarray(padded.reshape(-1, GROUP))
