# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All bounces in closed form: r = ρ (b + a / (1 + √(1 - g ρ))).

formula        the form and its inverse
table          b, a and g of a surface, in any direction
packing        how a table's numbers ship
"""

from .formula import forward, inverse, over_blocks

__all__ = ["forward", "inverse", "over_blocks"]
