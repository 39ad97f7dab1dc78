# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Put a rough sample into a scene, with lights and camera of the instrument if wanted."""

from __future__ import annotations

import math
from typing import Any

import bpy
import numpy as np

from ..instrument.measure import RING_45_0
from .kinds import RoughSample
from .worker import facets

_FARTHEST = 4.0
"""Distance of the camera in widths of the sample."""


def put(rough: RoughSample, collection: Any, size: float, place: Any = (0.0, 0.0, 0.0)) -> Any:
    """Put one period of a sample into a collection.

    Parameters
    ----------
    rough
        The sample.
    collection
        A `bpy.types.Collection`.
    size
        Width along x, in Blender's units.
    place
        Of its middle.

    Returns
    -------
    The object, `bpy.types.Object`, without a material.
    """
    scale = size / rough.mesh.period[0]
    half = rough.mesh.period[1] / 2
    vertices = rough.mesh.vertices.copy()
    vertices[:, 1] = np.clip(vertices[:, 1], -half, half)  # grooves go on beyond their period
    mesh = facets(vertices * scale, rough.mesh.faces)
    mesh.name = name = f"Rough {rough.kind} {math.degrees(rough.sigma):.0f}°"
    thing = bpy.data.objects.new(name, mesh)
    thing.location = place
    collection.objects.link(thing)
    return thing


def put_instrument(collection: Any, size: float, place: Any = (0.0, 0.0, 0.0)) -> Any:
    """Light a place as a 45°a:0° instrument does, and look at it.

    Parameters
    ----------
    collection, size, place
        As of `put`.

    Returns
    -------
    The camera, `bpy.types.Object`: a level white diffuser gives it the radiance 1.
    """
    for theta, phi in RING_45_0.lights:
        light = bpy.data.lights.new("Rough Sample Ring", "SUN")
        light.angle = 0.0
        light.energy = math.pi / len(RING_45_0.lights) / math.cos(theta)
        sun = bpy.data.objects.new("Rough Sample Ring", light)
        sun.rotation_euler = (0, theta, phi)
        away = (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))
        sun.location = [middle + size * part for middle, part in zip(place, away, strict=True)]
        collection.objects.link(sun)
    lens = bpy.data.cameras.new("Rough Sample View")
    lens.type, lens.ortho_scale = "ORTHO", size
    lens.clip_end = 2 * _FARTHEST * size
    camera = bpy.data.objects.new("Rough Sample View", lens)
    camera.location = (place[0], place[1], place[2] + _FARTHEST * size)
    collection.objects.link(camera)
    return camera
