# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The virtual gloss meter: 20°, 60° and 85°, of ISO 2813, as renders.

Light goes the other way round: the *receptor's* window glows, and the view is from all over the
image of the *source*. By Helmholtz's reciprocity that is the same, and far quieter: the window is
wider than the source's image, so a mirror shows it from each view, where the other way few views
would meet the source. What Cycles lays over each other, as the Principled BSDF's gloss over its
base, is weakened by the view's angle alone, but both ways have one angle here.
`tests/addon/test_gloss_meter.py` measures both.

A mirror's number is exact to 0.1 unit. A rough surface's is estimated, to some 2 % of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ...core.instruments import gloss
from ...core.numerics.arrays import Array
from ..colorimetry.rgb_space import WorkingSpace
from . import measure
from .arrangement import Arrangement, Glow, Shot, Window

ANGLES = tuple(gloss.METERS)
"""Degrees, of all gloss meters."""

RAYS = 16384
"""Rays a pixel, over all views."""


def arrangement(angle: float) -> Arrangement:
    """Give the renders of a gloss meter; they read the share of light that meets the window.

    Raises
    ------
    DomainError
        If there is none of this angle.
    """
    return of_meter(gloss.find(angle))


def of_meter(meter: gloss.GlossMeter) -> Arrangement:
    """Give the renders of a gloss meter, of one that no standard has, too."""
    along, across = (math.radians(width) / 2 for width in meter.receptor)
    tilt = math.radians(meter.angle)
    return Arrangement(
        tuple(
            Shot(
                # The sample is turned instead of a view beside the plane.
                Glow(window=Window((tilt, math.pi - phi), along, across, is_cone=False)),
                theta,
                weight=weight,
            )
            for theta, phi, weight in zip(
                *(values.tolist() for values in gloss.source_directions(meter)), strict=True
            )
        )
    )


def units(rgb: Array, angle: float, space: WorkingSpace) -> Array:
    """Turn what `arrangement` read, scene-linear RGB (..., 3), into gloss units (...).

    Gloss meters see as the eye does, so it is the luminance.
    """
    # Of equal channels, as of any gray surface, the luminance is their value whatever the light.
    luminance = space.to_xyz(rgb, "D65")[..., 1]
    return np.asarray(100 * luminance / gloss.black_glass(gloss.find(angle)))


def told(units: Array) -> tuple[float, ...]:
    """Give gloss units as a reading has them."""
    return tuple(round(value, 2) + 0.0 for value in units.tolist())


def measured(
    materials: Sequence[Any],
    space: WorkingSpace,
    angles: Sequence[float] = ANGLES,
    progress: Callable[[int, int], None] | None = None,
    rays: int = RAYS,
) -> Array:
    """Measure the gloss of materials and wait for the result.

    Parameters
    ----------
    materials
        `bpy.types.Material`.
    space
        The working space.
    angles
        Degrees, of `ANGLES`.
    progress
        Called with renders done and renders in all; may raise to stop.
    rays
        Rays a pixel, over all views.

    Returns
    -------
    Gloss units, shape (materials, angles): 100 is a polished black glass.

    Raises
    ------
    DomainError
        If there is no gloss meter of an angle.
    OutputError, CancelledError
        As in `measure.measure`.
    """
    work = [arrangement(angle) for angle in angles]
    values = measure.measure(materials, work, progress, rays=rays)
    found = [units(rgb, angle, space) for rgb, angle in zip(values[:, :, 0], angles, strict=True)]
    return np.stack(found, axis=-1) if found else np.empty((len(materials), 0))
