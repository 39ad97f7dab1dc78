# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Instruments: from where they light a surface and from where they look at it.

geometries   one record an instrument; needs no numpy
quadrature   directions and weights of each
curves       what each model says of an instrument, over σ
"""

from .geometries import (
    APERTURE,
    DEFAULT,
    HEMISPHERE,
    NORMAL,
    REGISTRY,
    TRAP,
    Beam,
    Instrument,
    find,
    has_apertures,
    spoken,
)

__all__ = [
    "APERTURE",
    "DEFAULT",
    "HEMISPHERE",
    "NORMAL",
    "REGISTRY",
    "TRAP",
    "Beam",
    "Instrument",
    "find",
    "has_apertures",
    "spoken",
]
