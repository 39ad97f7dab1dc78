# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Oren and Nayar's qualitative model, r = c (A + B max(0, cos Δφ) sin α tan β), of LuxCore.

M. Oren and S. K. Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994, with 0.33:
what is left of the functional model without interreflection. Roughness is the model's own σ.
"""

from __future__ import annotations

import numpy as np

from ..numerics.arrays import Array
from ..oren_nayar import first_bounce_at_normal
from .lobe import Lobe, Terms, flat


def terms(roughness: Array, theta_i: Array, theta_r: Array, delta_phi: Array) -> Terms:
    """Give A, and nothing that bounces on; the roughness is σ in radians.

    Examples
    --------
    >>> single, *_ = terms(np.array(0.5), np.array(0.8), np.array(0.4), np.array(0.0))
    >>> round(float(single[0]), 4)
    0.8848
    """
    s2 = roughness * roughness
    alpha, beta = np.maximum(theta_i, theta_r), np.minimum(theta_i, theta_r)
    toward = np.maximum(0, np.cos(delta_phi)) * np.sin(alpha) * np.tan(beta)
    single = first_bounce_at_normal(s2) + 0.45 * s2 / (s2 + 0.09) * toward
    nothing = flat(single)
    return np.asarray(single)[..., np.newaxis], nothing, nothing


LOBE = Lobe("qualitative", "Oren-Nayar, qualitative", "SIGGRAPH 1994", np.pi / 2, terms)
