# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the chart's methods are held against: the V-cavity solved, and traced height fields.

The first is a model, whose closed form is "closure". The second are paths over rough surfaces, from
fields that "surface" was not made from, but by the same authors' tracer.
"""

from __future__ import annotations

import numpy as np

from core import vcavity
from core.numerics import direction_grid
from core.vcavity import bounce_series
from tools.chart.chart_work import GEOMETRIES, RING, SIGMAS, Array, Truth, Work, colorchecker
from tools.tables import traces

TRACED = {
    "gaussian": (15, 30, 45),
    "multi-scale": (15, 30, 45),
    "grains": (30,),
}
"""Kinds of surfaces and the σ, degrees, at which they were traced."""

DOUBLE = vcavity.Resolution(slopes=12, azimuths=12, panels=128, table=256)


def ring() -> Array:
    """45°/0° as an array of one geometry, shape (3, 1)."""
    return np.array(RING)[:, np.newaxis]


def solve(
    albedo: Array, angles: Array, sigmas: Array, nodes: vcavity.Resolution = vcavity.STANDARD
) -> Array:
    """Solve the V-cavity at every roughness, shape (sigmas, geometries, patches, bands)."""
    light, view, azimuth = angles
    rows = vcavity.series(light, view, azimuth, sigmas[:, np.newaxis], resolution=nodes)
    return np.stack([bounce_series.evaluate(rows, rho) for rho in albedo], axis=2)


def cavity(
    albedo: Array, angles: Array, sigmas: Array, nodes: vcavity.Resolution = vcavity.STANDARD
) -> Truth:
    """Solve the V-cavity in these directions and at 45°/0°."""
    return Truth(
        sigmas,
        angles,
        solve(albedo, angles, sigmas, nodes),
        solve(albedo, ring(), sigmas, nodes)[:, 0],
    )


def traced(albedo: Array, kind: str, raised: float = 0.0) -> Truth:
    """Give the traces of one kind of surface, raised by so many of their own standard errors."""
    known = [traces.load(kind, degrees) for degrees in TRACED[kind]]
    found = []
    for of_sigma in known:
        moved = traces.Traces(
            of_sigma.directions, of_sigma.reflectance + raised * of_sigma.error, of_sigma.error
        )
        found.append(np.stack([moved.of(rho) for rho in albedo], axis=1))
    factor = np.stack(found)
    sigmas = np.radians(np.array(TRACED[kind], np.float64))
    # The first direction of the traces is 45°/0°.
    return Truth(sigmas, known[0].directions[:, 1:], factor[:, 1:], factor[:, 0])


def make_work() -> Work:
    """Solve and read what every peer is asked for."""
    albedo = colorchecker()
    angles = np.stack(direction_grid.hemisphere(GEOMETRIES))
    return Work(albedo, cavity(albedo, angles, SIGMAS), traced(albedo, "gaussian"))
