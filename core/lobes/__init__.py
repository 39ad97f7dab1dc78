# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Diffuse lobes of other renderers, and the color and roughness with which each meets a target.

lobe          what they have in common: one form, one inverse, and what an instrument reads
lambert       glTF, UsdPreviewSurface, pbrt-4
eon           OpenPBR, MaterialX with energy compensation
disney        Mitsuba's principled
qualitative   LuxCore's roughmatte
matching      color and roughness for a reading and other directions

Cycles' own is `core.cycles`: its color has the third power, and an inverse of its own.
"""

from . import disney, eon, lambert, qualitative
from .lobe import Lobe, color_for, reflected
from .matching import match

DISNEY, EON, LAMBERT, QUALITATIVE = disney.LOBE, eon.LOBE, lambert.LOBE, qualitative.LOBE

ALL = (LAMBERT, EON, DISNEY, QUALITATIVE)

__all__ = [
    "ALL",
    "DISNEY",
    "EON",
    "LAMBERT",
    "QUALITATIVE",
    "Lobe",
    "color_for",
    "match",
    "reflected",
]
