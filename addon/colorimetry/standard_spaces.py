# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colors in the scene-linear spaces that pipelines exchange, whatever the open file works in.

Primaries and whites are those of ITU-R BT.709, ITU-R BT.2020 and, for ACEScg, of AP1 (SMPTE ST
2065-1 and S-2014-004). All three are kept as spaces of D65, adapted with Bradford, so that neutral
is neutral in each of them.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ...core.color import color_difference
from ...core.numerics.arrays import Array
from .rgb_space import WorkingSpace

Triple = tuple[float, float, float]

_D65 = (0.3127, 0.3290)
_PRIMARIES = {
    "Linear Rec.709": ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06), _D65),
    "Linear Rec.2020": ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046), _D65),
    "ACEScg": ((0.713, 0.293), (0.165, 0.830), (0.128, 0.044), (0.32168, 0.33767)),
}
"""Chromaticities of red, green, blue and white, by Blender's name of the space."""

NAMES = tuple(_PRIMARIES)

DIGITS = 6


def of_rgb(rgb: npt.ArrayLike, space: WorkingSpace) -> dict[str, Triple]:
    """Give scene-linear RGB (3,) of a space in all of `NAMES`; not clipped to any gamut.

    In the space's own name it is as given: Blender's matrices have fewer digits than ours.
    """
    own = np.asarray(rgb, np.float64)
    xyz = color_difference.adaptation(space.white, _WHITE) @ np.linalg.solve(space.from_xyz, own)
    found: dict[str, Triple] = {}
    for name, other in SPACES.items():
        there = own if name == space.name else other.from_xyz @ xyz
        red, green, blue = there.round(DIGITS).tolist()
        found[name] = (red + 0.0, green + 0.0, blue + 0.0)  # no -0.0
    return found


def _xyz(chromaticity: tuple[float, float]) -> Array:
    """XYZ with Y = 1 of x and y."""
    x, y = chromaticity
    return np.array([x / y, 1.0, (1 - x - y) / y])


_WHITE = _xyz(_D65)


def _space(name: str) -> WorkingSpace:
    *primaries, own_white = map(_xyz, _PRIMARIES[name])
    columns = np.stack(primaries, axis=1)
    to_xyz = columns * np.linalg.solve(columns, own_white)
    matrix = np.linalg.solve(to_xyz, color_difference.adaptation(_WHITE, own_white))
    matrix.setflags(write=False)
    return WorkingSpace(name, matrix)


SPACES = {name: _space(name) for name in NAMES}
"""The spaces by their names; all of them have the white of D65."""
