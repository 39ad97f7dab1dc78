# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A word for a roughness, for who does not think in degrees."""

from __future__ import annotations

_UP_TO = ((7.5, "smooth"), (22.5, "fine"), (37.5, "rough"))
"""Degrees, halfway between what the balls are of; presets say 10° of paper and 30° of concrete."""

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
