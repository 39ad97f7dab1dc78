# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All bounces in closed form: r = ρ (b + a / (1 + √(1 - g ρ))).

formula        the model and its inverse
fitted         its numbers
"""

from .formula import (
    LARGEST_ANGLE,
    RING_ERROR,
    coefficients,
    combine,
    factors,
    forward,
    from_albedo,
    inverse,
    monomials,
    over_blocks,
    reflectance,
    roughness_variable,
    to_albedo,
)

__all__ = [
    "LARGEST_ANGLE",
    "RING_ERROR",
    "coefficients",
    "combine",
    "factors",
    "forward",
    "from_albedo",
    "inverse",
    "monomials",
    "over_blocks",
    "reflectance",
    "roughness_variable",
    "to_albedo",
]
