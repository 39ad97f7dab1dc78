# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Cycles makes of a color and a diffuse roughness, and the two that meet a target.

lobe             the Diffuse BSDF, and the Principled BSDF without gloss
gloss_lobe       what the gloss of a Principled BSDF adds to that, and what it takes
gloss_facets     the facets of one of its lobes: what they mirror, shadow and send to each other
gloss_sphere     the same where light comes from a hemisphere
gloss_reading    what instruments read of it, and how much of it a reading allows
gloss_estimate   level and roughness from what instruments read
derivatives      its slopes over color and roughness
matching         color and roughness for a reading and other directions
least_mean_fit   the same where several lights and directions contradict each other
"""

from .lobe import (
    ALBEDO_SPAN,
    MEAN_SPAN,
    Lobe,
    albedo_shape,
    check_roughness,
    directions,
    lobe,
    reflectance,
    reflected,
)
from .matching import (
    color_for_reading,
    match,
)

__all__ = [
    "ALBEDO_SPAN",
    "MEAN_SPAN",
    "Lobe",
    "albedo_shape",
    "check_roughness",
    "color_for_reading",
    "directions",
    "lobe",
    "match",
    "reflectance",
    "reflected",
]
