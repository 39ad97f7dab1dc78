# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What readings say of gloss: a sphere with specular light in and out, and gloss meters.

Each of them tells which part of the light a surface sends into a window around the mirror
direction: 0.02 of it, say. Beside it stands the reflectance at the normal, F0, of the smooth
dielectric that would send as much. A surface that is not smooth spreads its gloss beyond the
window, so that its own F0 is larger: what is told is the least that it can be. How far it spreads
follows from several windows of different widths, and from a lobe that is the target renderer's.

- A sphere looks from 8°, where a dielectric reflects within 0.2 % as much as at the normal. Its
  window is the gloss trap. A matte surface has a difference, too, where it sends more or less
  toward the trap than elsewhere: that is below `MATTE`.
- Gloss units are shares of what black glass of the index 1.567 reflects at that angle, in percent
  (ISO 2813). What a matte surface sends into the window is among them: white has 1 unit at 20° and
  2 at 60°.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from .errors import DomainError
from .instruments.gloss import BLACK_GLASS, fresnel

SPHERE_ANGLE = 8.0
"""Degrees from which a sphere's detector looks."""

MATTE = 0.002
"""Difference of SCI and SCE that a surface without gloss may have, and noise."""

UNEVEN = 0.2
"""Largest spread over the bands, as a share of the difference, that is a dielectric's gloss."""

LARGEST_INDEX = 4.0
"""Of a dielectric, silicon's in red light; what reflects more is a metal."""

_NEAR_NORMAL = 20.0  # degrees up to which metals reflect within a few percent as at the normal
_INDICES = 2001


@dataclass(frozen=True)
class Specular:
    """What one reading says of gloss.

    Attributes
    ----------
    reflectance
        Share of the light that goes into the instrument's window around the mirror direction.
    angle
        Degrees of the window from the normal.
    f0
        Reflectance at the normal of the smooth surface that sends as much: the least that a rough
        one can have. NaN where there is none.
    index
        Its refractive index; NaN where no dielectric reflects so much.
    """

    reflectance: float
    angle: float
    f0: float
    index: float


@dataclass(frozen=True)
class SphereGloss(Specular):
    """The same from SCI and SCE; `reflectance` is the mean of their difference.

    Attributes
    ----------
    lowest, highest
        Of the difference over the bands.
    doubt
        Why it may be no gloss, the end of a sentence; empty where nothing speaks against it.
    """

    lowest: float
    highest: float
    doubt: str


@dataclass(frozen=True)
class GlossReadings:
    """All that is known of one surface's gloss, for whoever seeks the lobe that explains it.

    Attributes
    ----------
    sphere
        From SCI and SCE, or None.
    units
        Gloss units by angle in degrees.
    """

    sphere: SphereGloss | None = None
    units: Mapping[float, float] = field(default_factory=dict)

    @property
    def told(self) -> tuple[Specular, ...]:
        """What each reading says by itself: the sphere's, then by angle."""
        meters = tuple(of_units(units, angle) for angle, units in sorted(self.units.items()))
        return meters if self.sphere is None else (self.sphere, *meters)

    @property
    def least_f0(self) -> float:
        """The largest F0 of all readings, each of which is the least; NaN where none has one."""
        known = [each.f0 for each in self.told if math.isfinite(each.f0)]
        return max(known, default=math.nan)


def of_sphere(sci: npt.ArrayLike, sce: npt.ArrayLike) -> SphereGloss:
    """Give the gloss from readings with specular light included and excluded.

    Parameters
    ----------
    sci, sce
        Fractions at the same wavelengths, shape ``(bands,)``.

    Raises
    ------
    DomainError
        If they are not of the same shape, or a value is no number.

    Examples
    --------
    >>> found = of_sphere([0.34, 0.44, 0.54], [0.30, 0.40, 0.50])
    >>> round(found.reflectance, 4), round(found.f0, 4), round(found.index, 2), found.doubt
    (0.04, 0.04, 1.5, '')
    """
    included, excluded = (np.asarray(values, np.float64) for values in (sci, sce))
    if included.ndim != 1 or included.shape != excluded.shape or included.size == 0:
        msg = f"SCI has {included.size} bands and SCE {excluded.size}; give both the same."
        raise DomainError(msg)
    difference = included - excluded
    if not np.isfinite(difference).all():
        msg = "SCI or SCE has a band that is no number; leave it out of both."
        raise DomainError(msg)
    mean, lowest, highest = (float(f(difference)) for f in (np.mean, np.min, np.max))
    return SphereGloss(
        mean,
        SPHERE_ANGLE,
        *_of_smooth(mean, SPHERE_ANGLE),
        lowest,
        highest,
        _doubt(mean, difference),
    )


def of_units(units: float, angle: float) -> Specular:
    """Give what gloss units say.

    Parameters
    ----------
    units
        0 or more; black glass of the index 1.567 has 100 at each angle.
    angle
        Degrees, above 0 and below 90.

    Raises
    ------
    DomainError
        If one of them cannot be.

    Examples
    --------
    >>> black = of_units(100, 60)
    >>> round(black.reflectance, 4), round(black.f0, 4), round(black.index, 3)
    (0.1001, 0.0488, 1.567)
    """
    if not (math.isfinite(units) and units >= 0 and 0 < angle < 90):
        msg = f"{units:g} gloss units at {angle:g}° cannot be; give 0 or more, below 90°."
        raise DomainError(msg)
    reflectance = units / 100.0 * _reflected(BLACK_GLASS, angle)
    return Specular(reflectance, float(angle), *_of_smooth(reflectance, angle))


def _doubt(mean: float, difference: npt.NDArray[np.float64]) -> str:
    if mean < -MATTE:
        return "SCE reads more than SCI: they were taken for each other, or at two places"
    if mean < MATTE:
        return "so little may come from a matte surface, or from noise"
    if float(np.ptp(difference)) > max(UNEVEN * mean, MATTE):
        return "it differs by wavelength, as gloss of metals does, and that of no dielectric"
    return ""


def _of_smooth(reflectance: float, angle: float) -> tuple[float, float]:
    """Return F0 and index of the smooth dielectric that reflects so much at an angle."""
    if reflectance <= 0.0:
        return 0.0, 1.0
    # By the square root of F0, which what is reflected nearly follows.
    root = np.linspace(0.0, (LARGEST_INDEX - 1) / (LARGEST_INDEX + 1), _INDICES)
    reflected = np.sqrt(fresnel(math.radians(angle), (1 + root) / (1 - root)))
    # At grazing angles there is an index from which more of it reflects less.
    falls = np.flatnonzero(np.diff(reflected) < 0)
    rising = int(falls[0]) + 1 if falls.size else _INDICES
    wanted = math.sqrt(reflectance)
    if wanted > reflected[rising - 1]:
        # Of metals, too, nearly as much is reflected near the normal as at it.
        return (reflectance if angle <= _NEAR_NORMAL else math.nan), math.nan
    found = float(np.interp(wanted, reflected[:rising], root[:rising]))
    return found**2, (1 + found) / (1 - found)


def _reflected(index: float, angle: float) -> float:
    return float(fresnel(math.radians(angle), index))
