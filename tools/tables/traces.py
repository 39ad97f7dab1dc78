# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that no table was made from, traced by tools/tables/trace_held_out.py.

What judges the models: the tests and the chart read it here.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from core.numerics.arrays import Array

FOLDER = Path(__file__).parents[2] / "tests" / "fixtures" / "traces"
ALBEDOS = np.array([0.2, 0.35, 0.5, 0.65, 0.8, 0.95])


@dataclass(frozen=True, eq=False)
class Traces:
    """What one surface was found to reflect.

    Attributes
    ----------
    directions
        θi, θr and Δφ, radians, shape (3, 65); the first is 45°/0°.
    reflectance, error
        Reflectance factor at `ALBEDOS` and its standard error, shape (65, 6).
    """

    directions: Array
    reflectance: Array
    error: Array

    def of(self, albedo: Array) -> Array:
        """Reflectance factors at other albedos (bands,), shape (65, bands): r/ρ is smooth in ρ."""
        powers = np.vander(ALBEDOS, increasing=True)
        ratios = np.linalg.solve(powers, (self.reflectance / ALBEDOS).T)
        albedo = np.asarray(albedo)
        return np.asarray((np.vander(albedo, len(ALBEDOS), increasing=True) @ ratios).T * albedo)


def path(kind: str, degrees: float) -> Path:
    """Where the traces of one surface are, or go; σ in degrees."""
    return FOLDER / f"{kind}-{degrees:g}.csv"


def load(kind: str, degrees: float) -> Traces:
    """Read the traces of one surface; σ in degrees.

    Raises
    ------
    OSError
        If there are none.
    """
    table = np.loadtxt(path(kind, degrees), delimiter=",", skiprows=1)
    return Traces(np.radians(table[:, :3].T), table[:, 3:9], table[:, 9:])
