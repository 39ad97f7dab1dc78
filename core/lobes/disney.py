# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The diffuse lobe of Disney's BSDF, in Mitsuba's principled: retro-reflection by roughness.

B. Burley, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering", SIGGRAPH
courses (2015), equation 4: (1 - Fi/2) (1 - Fr/2) and R (Fi + Fr + Fi Fr (R - 1)) beside it, with
R = 2 s cos² θd and F = (1 - cos θ)⁵.
"""

from __future__ import annotations

import numpy as np

from ..numerics.arrays import Array
from .lobe import Lobe, Terms, flat


def terms(roughness: Array, theta_i: Array, theta_r: Array, delta_phi: Array) -> Terms:
    """Give A, and nothing that bounces on.

    Examples
    --------
    >>> single, *_ = terms(np.array(0.5), np.array(0.0), np.array(0.0), np.array(0.0))
    >>> single.tolist()
    [1.0]
    """
    light, view = np.cos(theta_i), np.cos(theta_r)
    between = light * view + np.sin(theta_i) * np.sin(theta_r) * np.cos(delta_phi)
    # θd is half the angle between light and view.
    retro = roughness * (1 + between)
    at_light, at_view = (1 - light) ** 5, (1 - view) ** 5
    single = (1 - at_light / 2) * (1 - at_view / 2)
    single = single + retro * (at_light + at_view + at_light * at_view * (retro - 1))
    nothing = flat(single)
    return np.asarray(single)[..., np.newaxis], nothing, nothing


LOBE = Lobe("disney", "Disney's diffuse", "Burley, SIGGRAPH courses (2015)", 1.0, terms)
