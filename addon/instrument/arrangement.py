# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the virtual instruments put lights and views: directions of real renders.

What is a beam without width in `core.instruments` is one direction here, and a ring or a cone are
as many as a quadrature needs. A sphere is no set of lights but a glowing hemisphere: whatever sends
light from there to the view is seen, a mirror too, but for what a gloss trap swallows.

Rings of light stand at eight azimuths, and views all around at four, so that samples with a grain
read as on the real instrument. A view beside the plane of its axis, as in the cone around 8°, is
taken by turning light and trap instead: a sample with a grain is then turned by those few degrees.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ...core.instruments import HEMISPHERE, Beam, Instrument, find

_LIGHTS_AROUND = 8
_QUARTERS = 4
_GAUSS = (0.5 - math.sqrt(1 / 12), 0.5 + math.sqrt(1 / 12))
"""Two nodes between 0 and 1, of equal weight: exact for cubics."""
_TURNS = 8
"""Directions around the axis of a cone, for each of the two radii."""

Direction = tuple[float, float]
"""Polar angle and azimuth, radians."""


@dataclass(frozen=True)
class Window:
    """A part of the hemisphere that alone glows, or that does not.

    Parameters
    ----------
    middle
        Its axis.
    along, across
        Half its width, radians: in the plane of axis and normal, and at right angles to it. Of a
        cone both are its half-angle.
    is_cone
        Whether it is round, or a rectangle.
    """

    middle: Direction
    along: float
    across: float
    is_cone: bool


@dataclass(frozen=True)
class Glow:
    """A hemisphere that glows evenly.

    Parameters
    ----------
    strength
        Its radiance.
    trap
        Where it is dark.
    window
        Where alone it glows; None for everywhere.
    """

    strength: float = 1.0
    trap: Window | None = None
    window: Window | None = None


@dataclass(frozen=True)
class Shot:
    """One render, or several with the same lights and view.

    Parameters
    ----------
    light
        Where a sun without width stands, or what glows.
    view
        Polar angle of the view, radians below π/2.
    quarter
        Azimuth of the view in quarters of a turn; the sample stays as it is.
    weight
        Of this render in the mean.
    """

    light: Direction | Glow
    view: float = 0.0
    quarter: int = 0
    weight: float = 1.0


@dataclass(frozen=True)
class Arrangement:
    """All renders of one measurement.

    Parameters
    ----------
    shots
        Their weighted mean is what is read.
    members
        Places of the materials to measure; None for all.
    """

    shots: tuple[Shot, ...]
    members: tuple[int, ...] | None = field(default=None)


def of(name: str) -> Arrangement:
    """Give the renders of an instrument.

    Parameters
    ----------
    name
        One of `core.instruments.REGISTRY`.

    Raises
    ------
    DomainError
        If there is none of this name.
    """
    instrument = find(name)
    if instrument.light == HEMISPHERE:
        return Arrangement(_sphere(instrument))
    light, view = instrument.light, instrument.view
    # Light from one side comes from the azimuth between the two; the view is at 0.
    side = math.radians(instrument.azimuth)
    return Arrangement(
        tuple(
            Shot((theta, phi + side - beside), seen, quarter)
            for seen, quarter, beside in _views(view)
            for theta, phi in _lights(light)
        )
    )


def _lights(beam: Beam) -> list[Direction]:
    """Directions of a source, the azimuth of its axis being 0."""
    if beam.all_around:
        turns = [2 * math.pi * k / _LIGHTS_AROUND for k in range(_LIGHTS_AROUND)]
        return [(theta, turn) for theta in _tilts(beam) for turn in turns]
    return _cone(beam)


def _views(beam: Beam) -> list[tuple[float, int, float]]:
    """Give a detector's views: polar angle, quarter of a turn, and the azimuth's rest."""
    if beam.all_around:
        return [(theta, quarter, 0.0) for theta in _tilts(beam) for quarter in range(_QUARTERS)]
    found = []
    for theta, phi in _cone(beam, _QUARTERS if beam.tilt == 0 else _TURNS):
        quarter = round(phi / (math.pi / 2))
        found.append((theta, quarter % _QUARTERS, phi - quarter * (math.pi / 2)))
    return found


def _tilts(beam: Beam) -> list[float]:
    """Polar angles of a ring; area is even in sin² θ."""
    if beam.half_angle == 0:
        return [math.radians(beam.tilt)]
    low, high = (
        math.sin(math.radians(beam.tilt + side * beam.half_angle)) ** 2 for side in (-1, 1)
    )
    return [math.asin(math.sqrt(low + share * (high - low))) for share in _GAUSS]


def _cone(beam: Beam, turns: int = _TURNS) -> list[Direction]:
    """Directions of a cone, evenly in projected solid angle, as `core.instruments.quadrature`."""
    tilt, half = math.radians(beam.tilt), math.radians(beam.half_angle)
    if half == 0:
        return [(tilt, 0.0)]
    found = []
    for share in _GAUSS:
        for k in range(turns):
            radius, turn = math.sqrt(share), 2 * math.pi * k / turns
            x = math.sin(tilt) * math.cos(half)
            x += math.sin(half) * math.cos(tilt) * radius * math.cos(turn)
            y = math.sin(half) * radius * math.sin(turn)
            found.append((math.asin(math.hypot(x, y)), math.atan2(y, x)))
    return found


def _sphere(instrument: Instrument) -> tuple[Shot, ...]:
    """Let a hemisphere glow, seen from all over the detector.

    Behind the trap no light comes from the white either, which is why the rest is the brighter.
    """
    trap, tilt = math.radians(instrument.trap), math.radians(instrument.view.tilt)
    strength = 1 / (1 - math.sin(trap) ** 2 * math.cos(tilt))
    return tuple(
        Shot(
            Glow(strength, _cone_window((tilt, math.pi - beside), trap) if trap else None),
            seen,
            quarter,
        )
        for seen, quarter, beside in _views(instrument.view)
    )


def _cone_window(middle: Direction, half_angle: float) -> Window:
    return Window(middle, half_angle, half_angle, is_cone=True)


def told(arrangement: Arrangement, count: int) -> dict[str, object]:
    """Write an arrangement for the second Blender, which knows nothing of the extension.

    `count` is the number of materials.
    """
    members = arrangement.members
    return {
        "shots": [_shot(shot) for shot in arrangement.shots],
        "members": list(range(count) if members is None else members),
    }


def _shot(shot: Shot) -> dict[str, object]:
    found: dict[str, object] = {
        "view": shot.view,
        "quarter": shot.quarter,
        "weight": shot.weight,
    }
    if not isinstance(shot.light, Glow):
        return found | {"sun": list(shot.light)}
    glow = shot.light
    return found | {
        "glow": {
            "strength": glow.strength,
            "trap": None if glow.trap is None else _window(glow.trap),
            "window": None if glow.window is None else _window(glow.window),
        }
    }


def _window(window: Window) -> dict[str, object]:
    """Give axis and both directions across as vectors, and how far it reaches."""
    theta, phi = window.middle
    sin, cos = np.sin(theta), np.cos(theta)
    toward = np.array([sin * np.cos(phi), sin * np.sin(phi), cos])
    along = np.array([cos * np.cos(phi), cos * np.sin(phi), -sin])
    across = np.cross(toward, along)
    return {
        "axes": [[float(x) for x in axis] for axis in (toward, along, across)],
        "cosine": math.cos(window.along) if window.is_cone else None,
        "tangents": [math.tan(window.along), math.tan(window.across)],
    }
