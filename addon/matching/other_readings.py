# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a material is from the other readings of its sample's set."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...core import instruments
from ...core.color import color_difference
from ...core.cycles import gloss_reading, instrument_lobe
from ..samples import sets

if TYPE_CHECKING:
    from ..colorimetry.rgb_space import WorkingSpace
    from .request import Request
    from .solution import Solution

MISSED = 0.3
"""ΔE00 from which on a reading is said to be missed."""


def missed(request: Request, solution: Solution, space: WorkingSpace) -> str:
    """Say which readings a material misses, by how much; an empty sentence if none.

    Of those that an instrument of ours has, of the rough surface. It takes a millisecond, and two
    more for each sphere while gloss is dragged: what is missed has to be told then, too.
    """
    if request.scene is not None or request.sample.kind != "reading":
        return ""
    color, told, own = np.clip(solution.color, 0, 1), [], False
    for other in request.sample.readings:
        at = other.instrument
        if at == request.read_at or not sets.is_exact(other) or sets.is_smooth(other):
            continue
        matte = instrument_lobe.reflectance(color, solution.roughness, at)
        seen = gloss_reading.reading(matte, request.gloss, at)
        weights = space.rgb_weights(other.wavelengths, request.illuminant)
        labs = (
            space.to_lab(rgb, request.illuminant) for rgb in (seen, other.reflectance @ weights)
        )
        apart = float(color_difference.delta_e(*labs))
        if apart > MISSED:
            told.append((apart, sets.label(other)))
            own |= at == request.sample.instrument
    if not told:
        return ""
    listed = ", ".join(f"ΔE00 {apart:.2f} at {where}" for apart, where in sorted(told)[::-1])
    if own:
        # Gloss shows at each instrument by as much as it does there, which no matte model tells.
        at = instruments.spoken(request.sample.instrument)
        return f"Of the set's readings it misses {listed}; let it be read at {at} to meet that one."
    return (
        f"Of the set's other readings it misses {listed}: no one color, roughness and gloss has "
        "all of them."
    )
