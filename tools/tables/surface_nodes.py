# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the traced surfaces are tabulated."""

from __future__ import annotations

import numpy as np

from core.numerics.arrays import Array

SIGMA = (2.5, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65)
"""Degrees; tan σ is the field's Rdq."""
POLAR = (0, 10, 20, 30, 40, 49, 57, 64, 70, 75, 79, 82.5, 85.5, 88)
RATIO = (0, 0.2, 0.4, 0.6, 0.76, 0.88, 0.95, 1)
"""Nodes of the larger polar angle, degrees, and of the smaller one over it."""
ORDERS = 96
"""Bounces kept apart; the last stands for all later ones."""


def polar_angles() -> Array:
    """α and the β = α · ratio that belong to it, radians: shape (alphas, 1 + ratios)."""
    larger = np.radians(POLAR)[:, np.newaxis]
    return np.concatenate((larger, larger * np.array(RATIO)), axis=1)
