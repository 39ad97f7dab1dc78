# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The RGB spaces that renderers with three channels take their colors in."""

from __future__ import annotations

import numpy as np

from ...core.color import color_difference
from ..colorimetry import srgb, tristimulus
from ..colorimetry.rgb_space import WorkingSpace

SPECTRA = "spectra"
"""What a target with spectra says in place of a space."""
REC709, ACESCG = "lin_rec709", "acescg"
"""Names of MaterialX and of the ACES."""

_ACES_WHITE = (0.32168, 0.33767)
_AP1 = np.array(
    (
        (1.6410233797, -0.3248032942, -0.2364246952),
        (-0.6636628587, 1.6153315917, 0.0167563477),
        (0.0117218943, -0.0082844420, 0.9883948585),
    )
)
"""ACEScg from XYZ under the white of the ACES, by S-2014-004."""


def find(name: str) -> WorkingSpace:
    """Give the space of that name, which is `REC709` or `ACESCG`."""
    white = tristimulus.white("D65")
    if name == REC709:
        return WorkingSpace("Linear Rec.709", srgb.from_xyz(white))
    x, y = _ACES_WHITE
    adapt = color_difference.adaptation(white, np.array((x / y, 1.0, (1 - x - y) / y)))
    matrix = _AP1 @ adapt
    # The digits of the two whites differ in the last places; a white is (1, 1, 1).
    return WorkingSpace("ACEScg", matrix / (matrix @ white)[:, np.newaxis])
