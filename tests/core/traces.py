# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that no table was made from, traced by tools/tables/trace_held_out.py."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parents[1] / "fixtures" / "traces"
ALBEDOS = np.array([0.2, 0.35, 0.5, 0.65, 0.8, 0.95])


@dataclass(frozen=True, eq=False)
class Traces:
    """Directions (3, 65), radians, and reflectance factors at `ALBEDOS` with standard errors."""

    directions: np.ndarray
    reflectance: np.ndarray
    error: np.ndarray

    def of(self, albedo):
        """Reflectance factors (65, bands) at other albedos: r/ρ is smooth in ρ."""
        powers = np.vander(ALBEDOS, increasing=True)
        ratios = np.linalg.solve(powers, (self.reflectance / ALBEDOS).T)
        albedo = np.asarray(albedo)
        return (np.vander(albedo, len(ALBEDOS), increasing=True) @ ratios).T * albedo


def load(kind, degrees):
    """Read the traces of one surface."""
    table = np.loadtxt(FOLDER / f"{kind}-{degrees}.csv", delimiter=",", skiprows=1)
    return Traces(np.radians(table[:, :3].T), table[:, 3:9], table[:, 9:])
