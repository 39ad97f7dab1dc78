# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is asked of an infrared camera. No Blender data here."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ...core.emissivity import Filter
from ...core.emissivity.band import Band
from ...core.errors import DomainError
from ..samples.sample import Sample
from . import cameras

BAND = cameras.NEAR
IN_A_RENDER = 3
LEAST, MOST = 300.0, 20_000.0
"""Nanometers between which a band may lie."""


@dataclass(frozen=True)
class Wanted:
    """What is asked for.

    Parameters
    ----------
    band
        First and last wavelength of the camera, nanometers; or what it lets through.
    parts
        Of the band, a multiple of 3.
    lights
        By the names of lamps, worlds and materials that emit, what they are, see
        `infrared_light.find`.
    materials
        By name, the sample or the reflectance that a material has.
    samples, percentage
        Of the renders, instead of the scene's; or None.

    Raises
    ------
    DomainError
        If any of it cannot be.
    """

    band: Band = BAND
    parts: int = 3
    lights: Mapping[str, str] = field(default_factory=dict)
    materials: Mapping[str, Sample | float] = field(default_factory=dict)
    samples: int | None = None
    percentage: int | None = None

    def __post_init__(self) -> None:
        """Refuse what cannot be."""
        first, last = self.ends
        if not LEAST <= first < last <= MOST:
            msg = (
                f"The band is {first:g} to {last:g} nm; give its ends in nm, {LEAST:g} to {MOST:g}."
            )
            raise DomainError(msg)
        if self.parts % IN_A_RENDER or not 3 <= self.parts <= 36:
            msg = f"The band has {self.parts} parts; give 3, 6, 9 … 36."
            raise DomainError(msg)
        for name, value in self.materials.items():
            if isinstance(value, Sample):
                if not covers(value.wavelengths, self.ends):
                    nm = value.wavelengths
                    msg = (
                        f"{value.name!r} covers {nm[0]:g} to {nm[-1]:g} nm, not the band of "
                        f"{first:g} to {last:g}; choose another sample for {name!r}."
                    )
                    raise DomainError(msg)
            elif not 0 <= value <= 1:
                msg = f"A reflectance is {value:g}; give 0 to 1."
                raise DomainError(msg)

    @property
    def ends(self) -> tuple[float, float]:
        """First and last wavelength, nanometers."""
        nm = np.asarray(self.band.wavelengths if isinstance(self.band, Filter) else self.band)
        return float(nm[0]), float(nm[-1])


def covers(nm: Any, ends: tuple[float, float]) -> bool:
    """Whether wavelengths reach over a band."""
    return bool(nm[0] <= ends[0] and ends[1] <= nm[-1])
