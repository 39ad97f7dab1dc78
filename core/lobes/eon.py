# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""EON: the energy-preserving Oren-Nayar of OpenPBR, and of MaterialX with energy compensation.

J. Portsmouth, P. Kutz, S. Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14
(2025). Single scattering is Fujii's, as in Cycles, whose directional albedos it shares; the light
that bounces on is (1 - E(θi)) (1 - E(θr)) / (1 - Ē) times c² Ē / (1 - c (1 - Ē)), where Cycles
has c³. The energy E is exact here, as in MaterialX, and not the fit of the paper.
"""

from __future__ import annotations

from .. import cycles
from ..numerics.arrays import Array
from .lobe import Lobe, Terms


def terms(roughness: Array, theta_i: Array, theta_r: Array, delta_phi: Array) -> Terms:
    """Give A, B and D, which are those of Cycles: only the power of the color differs.

    Examples
    --------
    >>> import numpy as np
    >>> single, multiple, ratio = terms(np.array(1.0), np.array(0.8), *np.zeros((2, 1)))
    >>> round(float(single[0, 0]), 4)
    0.7765
    """
    return cycles.lobe(roughness, *cycles.directions(theta_i, theta_r, delta_phi))


LOBE = Lobe("eon", "EON", "Portsmouth, Kutz and Hill, JCGT 14 (2025)", 1.0, terms)
