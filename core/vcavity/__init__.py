# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The V-cavity itself, all bounces: what the formulas approximate.

solver          series of bounces in any directions
groove          light inside one groove
surface         grooves of all slopes and azimuths
slope_law       how slopes are distributed
bounce_series   evaluate and invert Σ a_k ρ^k
sigma_tables    the series of one instrument over σ
"""

from .solver import (
    BOUNCES,
    ERROR_BOUND,
    STANDARD,
    Resolution,
    albedo_from_reading,
    bounce_coefficients,
    reading_from_albedo,
    reflectance,
    ring_coefficients,
    series,
)

__all__ = [
    "BOUNCES",
    "ERROR_BOUND",
    "STANDARD",
    "Resolution",
    "albedo_from_reading",
    "bounce_coefficients",
    "reading_from_albedo",
    "reflectance",
    "ring_coefficients",
    "series",
]
