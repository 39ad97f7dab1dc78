# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lambert's law: the diffuse lobe of glTF, UsdPreviewSurface, pbrt-4 and others."""

from __future__ import annotations

import numpy as np

from ..numerics.arrays import Array
from .lobe import Lobe, Terms, flat


def terms(roughness: Array, theta_i: Array, theta_r: Array, delta_phi: Array) -> Terms:
    """Give 1, 0 and 0, whatever the directions.

    Examples
    --------
    >>> terms(*np.zeros(4)[:, np.newaxis])[0].tolist()
    [[1.0]]
    """
    nothing = flat(np.broadcast_arrays(roughness, theta_i, theta_r, delta_phi)[0])
    return nothing + 1, nothing, nothing


LOBE = Lobe("lambert", "Lambert's law", "r = c", 0.0, terms)
