# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The work that every method of the chart gets, and how its answers are judged.

Needs numpy alone, so that peers in other environments read the same work from one file.
"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from tools.run.run_command_line import ROOT

Array = npt.NDArray[Any]

PRESETS = ROOT / "presets" / "colorchecker"

SIGMAS = np.radians([10.0, 20.0, 30.0, 40.0, 50.0])
BANDS: Array = np.arange(400.0, 701.0, 10.0)
"""31 bands: what most spectrophotometers print."""
GEOMETRIES = 200
TIMED_GEOMETRIES = 1 << 16
TIMED_SIGMA = 2
"""Index of the roughness that is timed; no method's cost depends on it."""
TIMED_PATCH = 13
"""Green, the patch of the published experiments."""

COST_NOISE = 0.25
"""Costs that differ by less are not told apart: RGB(ρ)² and RGB(ρ²) take the same operations a
geometry, and were seen to differ by 6 to 19 % from run to run."""

PANELS = {"angles": "angles", "traced": "angles", "reading": "reading"}
"""What errors are of, and which cost belongs to them: all angles below 80° of the V-cavity and of
traced surfaces, and one reading of the V-cavity at 45°/0°."""

PEER_TRUTHS = {"cavity": "angles", "traced": "traced"}
"""What the programs of others are asked for, and the panel it belongs to."""

RING = (np.pi / 4, 0.0, 0.0)
"""45°/0°: θi, θr, Δφ."""


@dataclass(frozen=True, eq=False)
class Truth:
    """What surfaces of several roughnesses reflect, whoever found it.

    Attributes
    ----------
    sigmas
        Radians, shape (sigmas,).
    angles
        θi, θr and Δφ below 80°, cosine-weighted, shape (3, geometries), radians.
    factor
        Reflectance factor there, shape (sigmas, geometries, patches, bands).
    reading
        The same at 45°/0°, shape (sigmas, patches, bands).
    """

    sigmas: Array
    angles: Array
    factor: Array
    reading: Array


@dataclass(frozen=True, eq=False)
class Work:
    """Spectra, and what is true of surfaces that have them as albedos.

    Attributes
    ----------
    albedo
        ρ of the ColorChecker patches, shape (patches, bands).
    cavity
        By the V-cavity's solver.
    traced
        By paths on Gaussian height fields.
    """

    albedo: Array
    cavity: Truth
    traced: Truth

    def save(self, path: Path) -> None:
        """Write everything into one npz file."""
        parts = {
            f"{name}.{part}": values
            for name in PEER_TRUTHS
            for part, values in vars(getattr(self, name)).items()
        }
        np.savez(path, albedo=self.albedo, **parts)

    @classmethod
    def load(cls, path: Path) -> Work:
        """Read what `save` wrote."""
        with np.load(path) as stored:
            truths = {
                name: Truth(
                    *(stored[f"{name}.{field.name}"] for field in dataclasses.fields(Truth))
                )
                for name in PEER_TRUTHS
            }
            return cls(stored["albedo"], **truths)


def colorchecker() -> Array:
    """Albedos of the 24 patches at `BANDS`, shape (24, 31); the presets have them every 5 nm."""
    rows = []
    for path in sorted(PRESETS.glob("*.json")):
        preset = json.loads(path.read_text(encoding="utf-8"))
        known = dict(zip(preset["wavelengths"], preset["values"], strict=True))
        rows.append([known[int(band)] for band in BANDS])
    return np.array(rows)


def timed_angles() -> Array:
    """Many geometries below 80°, float32, shape (3, `TIMED_GEOMETRIES`)."""
    rng = np.random.default_rng(0)
    steepest = np.sin(np.radians(80))
    theta = np.arcsin(np.sqrt(rng.random((2, TIMED_GEOMETRIES))) * steepest)
    return np.stack((*theta, np.pi * rng.random(TIMED_GEOMETRIES))).astype(np.float32)


def summary(values: Array) -> list[float]:
    """Mean, 95th percentile and maximum."""
    return [float(values.mean()), float(np.percentile(values, 95)), float(values.max())]


def relative_error(predicted: Array, reference: Array) -> list[float]:
    """Summary of |r - reference| / reference over all bands, as fractions."""
    return summary(np.abs(predicted / reference - 1))


def pareto_front(points: Sequence[tuple[float, float]], noise: float = 0.0) -> list[int]:
    """Find the points that no other beats, cheapest first.

    Parameters
    ----------
    points
        Cost and error of each.
    noise
        Share by which two costs may differ and still count as equal.

    Returns
    -------
    Indices. A point is beaten by one with less error that costs at most `noise` more, by a cheaper
    one with the same error, and by an equal one before it.
    """
    front = []
    for index, (cost, error) in enumerate(points):
        beaten = any(
            (other[1] < error and other[0] <= cost * (1 + noise))
            or (other[1] == error and (other[0], place) < (cost, index))
            for place, other in enumerate(points)
        )
        if not beaten:
            front.append(index)
    return sorted(front, key=lambda i: points[i][0])


def write_json(path: Path, value: Any) -> None:
    """Write what was measured."""
    path.write_text(json.dumps(value, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def read_json(path: Path) -> Any:
    """Read what `write_json` wrote."""
    return json.loads(path.read_text(encoding="utf-8"))
