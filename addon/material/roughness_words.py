# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A word for a roughness, for who does not think in degrees."""

from __future__ import annotations

_UP_TO = ((7.5, "smooth"), (22.5, "fine"), (37.5, "rough"))
"""Degrees, halfway between a smooth wall, fine plaster at 15°, brick at 30° and gravel at 45°."""

STEPS = (0.0, 15.0, 30.0, 45.0)
"""Degrees of the surfaces that the words are of."""


def word(degrees: float) -> str:
    """Say what a surface of this σ is like.

    Examples
    --------
    >>> [word(step) for step in STEPS]
    ['smooth', 'fine', 'rough', 'coarse']
    """
    return next((word for limit, word in _UP_TO if degrees < limit), "coarse")
