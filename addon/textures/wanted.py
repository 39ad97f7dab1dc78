# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What to make of an image, and what was made of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from ...core import limits
from ...core.errors import DomainError
from ...core.instruments import DEFAULT
from ...core.models import TARGET
from ..samples.sample import Sample

HOLDS = ("albedo", "color")
"""What a texture may hold: the facets' albedo, or the color that Cycles' Diffuse needs."""


@dataclass(frozen=True)
class Wanted:
    """What to make of an image.

    Parameters
    ----------
    sigma
        Roughness σ of the surface, radians.
    instrument
        That the image was taken with, one of `core.reading.INSTRUMENTS`.
    illuminant
        The light under which the texture is right; of an image in RGB, the one it was taken for.
    model
        One of `core.models.NAMES`.
    holds
        One of `HOLDS`.
    scale
        Of an ENVI cube, the number that stands for a reflectance of 1; None takes the header's.

    Raises
    ------
    DomainError
        If σ is none that materials have, or `holds` is neither.
    """

    sigma: float
    instrument: str = DEFAULT
    illuminant: str = "D65"
    model: str = TARGET
    holds: str = "albedo"
    scale: float | None = None

    def __post_init__(self) -> None:
        """Refuse what no image could be read with."""
        if fault := limits.sigma_fault(math.degrees(self.sigma)):
            raise DomainError(fault)
        if self.holds not in HOLDS:
            msg = f"A texture holds {' or '.join(HOLDS)}, not {self.holds!r}."
            raise DomainError(msg)


@dataclass(frozen=True, eq=False)
class Made:
    """A texture that was written.

    Parameters
    ----------
    path
        Of the texture.
    wanted
        What was asked for.
    width, height
        In pixels.
    roughness
        With which a Diffuse BSDF shows it: Cycles' diffuse roughness.
    mean
        The mean reading over all pixels as a sample; None of an image in RGB.
    infeasible
        Share of pixels of which a band reads more than white facets; their albedo is above 1.
    outside
        Share of pixels with a channel below 0 or above 1.
    notes
        Sentences.
    """

    path: Path
    wanted: Wanted
    width: int
    height: int
    roughness: float
    mean: Sample | None
    infeasible: float
    outside: float
    notes: tuple[str, ...]
