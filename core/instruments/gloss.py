# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gloss meters: how much of a lamp's light a surface sends into a window in the mirror direction.

The unit is a polished black glass with the refractive index 1.567, which reads 100 at each angle:
it reflects 4.9 % at 20°, 10.0 % at 60° and 61.9 % at 85°. So gloss units of different angles are
not parts of one thing, and at the smaller angles metals and diamonds read far above 100.

Where the numbers come from: ISO 2813:2014 (ASTM D523 has the same), the image of the source and the
receptor's window in and across the plane of measurement. The standards allow from ±0.05° at the
receptor of 20° to ±0.3° at that of 85°, and ±0.25° and ±0.5° for the source.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from ..errors import DomainError
from ..numerics.arrays import Array

BLACK_GLASS = 1.567
"""Refractive index of the glass that reads 100."""

_GAUSS = 0.5 / np.sqrt(3)
"""Two nodes from the middle, of a width of 1; exact for cubics."""


@dataclass(frozen=True)
class GlossMeter:
    """One angle of a gloss meter. Degrees.

    Attributes
    ----------
    angle
        Of the light's axis from the normal, and of the receptor's on the other side.
    source, receptor
        Whole widths of the source's image and of the receptor's window, in the plane of measurement
        and across.
    """

    angle: float
    source: tuple[float, float]
    receptor: tuple[float, float]


_SOURCE = (0.75, 2.5)

METERS: Mapping[int, GlossMeter] = MappingProxyType(
    {
        20: GlossMeter(20.0, _SOURCE, (1.8, 3.6)),
        60: GlossMeter(60.0, _SOURCE, (4.4, 11.7)),
        85: GlossMeter(85.0, _SOURCE, (4.0, 6.0)),
    }
)
"""Every gloss meter by its angle."""


def find(angle: float) -> GlossMeter:
    """Give the gloss meter of an angle.

    Raises
    ------
    DomainError
        If there is none; the message lists the angles.

    Examples
    --------
    >>> find(60).receptor
    (4.4, 11.7)
    """
    if angle not in METERS:
        known = ", ".join(f"{each}°" for each in METERS)
        msg = f"A gloss meter of {angle:g}° is not known; choose one of: {known}."
        raise DomainError(msg)
    return METERS[int(angle)]


def fresnel(theta: npt.ArrayLike, index: npt.ArrayLike) -> Array:
    """Reflectance of a smooth dielectric for unpolarized light, by Fresnel.

    Parameters
    ----------
    theta
        Angle of incidence, radians, any shape.
    index
        Refractive index, at least 1; of a shape that broadcasts with that of `theta`.

    Returns
    -------
    Array of the shape of both.

    Examples
    --------
    >>> np.round(fresnel(np.radians([0, 20, 60, 85]), BLACK_GLASS), 4).tolist()
    [0.0488, 0.0491, 0.1001, 0.6191]
    """
    cos = np.cos(np.asarray(theta, float))
    square = np.asarray(index, float) ** 2
    inside = np.sqrt(square - 1 + cos * cos)  # index times the cosine within
    across = (cos - inside) / (cos + inside)
    along = (square * cos - inside) / (square * cos + inside)
    return np.asarray((across**2 + along**2) / 2)


def source_directions(meter: GlossMeter) -> tuple[Array, Array, Array]:
    """Spread the image of the source over few directions.

    Returns
    -------
    theta, phi, weights
        Polar angle, azimuth from that of the axis, radians, and share of the projected solid angle;
        each of shape (directions,).

    Examples
    --------
    >>> theta, _, weights = source_directions(find(60))
    >>> round(float(np.degrees(theta @ weights)), 1), round(float(weights.sum()), 12)
    (60.0, 1.0)
    """
    tilt = np.radians(meter.angle)
    along, across = (_GAUSS * np.array([-1, 1]) * np.radians(width) for width in meter.source)
    a, b = (np.tan(x).ravel() for x in np.meshgrid(along, across, indexing="ij"))
    # On the plane that touches the sphere of directions at the axis.
    ahead, up = np.sin(tilt) + a * np.cos(tilt), np.cos(tilt) - a * np.sin(tilt)
    long = np.sqrt(1 + a * a + b * b)
    theta, phi = np.arccos(up / long), np.arctan2(b, ahead)
    weights = np.cos(theta) / long**3
    return theta, phi, weights / weights.sum()


def black_glass(meter: GlossMeter) -> float:
    """Reflectance of the glass that reads 100, over the image of the source.

    Examples
    --------
    >>> round(black_glass(find(60)), 4)
    0.1001
    """
    theta, _, weights = source_directions(meter)
    return float(fresnel(theta, BLACK_GLASS) @ weights)
