# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The gloss of a Principled BSDF, as an artist sets it.

What it does to a reading is in `core.cycles.gloss_lobe`. Blender reads this at its start: nothing
here may import numpy.
"""

from __future__ import annotations

import math
from typing import NamedTuple

Tint = tuple[float, float, float]

WHITE: Tint = (1.0, 1.0, 1.0)

IMPOSSIBLE = "cannot have this gloss"
"""In the sentence that says so of a sample, by which it is known again."""


class Gloss(NamedTuple):
    """The sockets of a Principled BSDF that decide its gloss, named as Blender names them.

    Parameters
    ----------
    level
        Specular IOR Level; 0.5 leaves the IOR's own reflection.
    roughness
        Roughness of the lobe, 0 to 1. Neither σ nor the diffuse roughness.
    ior, tint
        IOR and Specular Tint, the latter in scene-linear RGB.
    coat, coat_roughness, coat_ior, coat_tint
        Of the coat; a weight of 0 is none.
    multiscatter
        Whether the node's distribution is Multiscatter GGX, as it is unless it was changed.
    """

    level: float = 0.5
    roughness: float = 0.5
    ior: float = 1.5
    tint: Tint = WHITE
    coat: float = 0.0
    coat_roughness: float = 0.03
    coat_ior: float = 1.5
    coat_tint: Tint = WHITE
    multiscatter: bool = True

    def numbers(self) -> tuple[float, ...]:
        """All of it in one row, as stamps store it; `from_numbers` reads it.

        Examples
        --------
        >>> from_numbers(Gloss(level=0.25).numbers()) == Gloss(level=0.25)
        True
        """
        return (
            *(self.level, self.roughness, self.ior, *self.tint),
            *(self.coat, self.coat_roughness, self.coat_ior, *self.coat_tint),
            float(self.multiscatter),
        )


def from_numbers(row: tuple[float, ...]) -> Gloss:
    """Read what `Gloss.numbers` gave.

    Raises
    ------
    ValueError
        If these are not the numbers of a gloss.

    Examples
    --------
    >>> from_numbers(Gloss(coat=1.0).numbers()).coat
    1.0
    """
    if len(row) != len(Gloss().numbers()) or not all(map(math.isfinite, row)):
        raise ValueError("no gloss")
    level, roughness, ior, red, green, blue, *of_coat, multiscatter = row
    coat, coat_roughness, coat_ior, coat_red, coat_green, coat_blue = of_coat
    return Gloss(
        *(level, roughness, ior, (red, green, blue)),
        *(coat, coat_roughness, coat_ior, (coat_red, coat_green, coat_blue)),
        bool(multiscatter),
    )
