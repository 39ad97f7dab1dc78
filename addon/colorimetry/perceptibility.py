# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a color difference means, in words. docs/reading-delta-e.md gives the sources."""

from __future__ import annotations

import math

SIDE_BY_SIDE = 0.8
"""ΔE00 that half of all observers see between patches that touch: Paravina et al., "Color
difference thresholds in dentistry", J. Esthetic and Restorative Dentistry 27 (2015)."""

VISIBLE = 2.0
"""From here on observers without experience notice, too: Mokrzycki and Tatol, "Colour difference
ΔE: a survey", Machine Graphics and Vision 20 (2011)."""


def words(delta_e: float) -> str:
    """Say whether people see a ΔE00: "not visible", "visible beside the sample" or "visible"."""
    if math.isnan(delta_e):
        return "unknown"
    if delta_e < SIDE_BY_SIDE:
        return "not visible"
    return "visible beside the sample" if delta_e < VISIBLE else "visible"
