# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mark the place of a reading in the scene, by an empty: no render shows it.

Its z axis points to the instrument and its x axis to azimuth 0, so that `bake --at` measures there
again.
"""

from __future__ import annotations

from typing import Any

import bpy
import mathutils
import numpy as np

from ..readings.document import Reading
from .spot import Key, key

COLLECTION = "Rough Spectra Spots"
_SIZE = 2.0
"""Length of the arrow, in diameters of the spot."""


def put(scene: Any, carrier: Key, reading: Reading, units: float) -> Any:
    """Put a mark into the scene's collection of marks, and give it.

    Parameters
    ----------
    scene
        Of this file.
    carrier
        The object that the mark moves with, if it is still there.
    reading
        Of a spot.
    units
        Diameter of the spot, in units of the scene.
    """
    spot = reading.spot
    assert spot is not None
    name = f"{reading.surface}, {spot.diameter:g} mm"
    if reading.delta_e_00 is not None:
        name += f": ΔE00 {reading.delta_e_00:.2f}"
    mark = bpy.data.objects.new(name, None)
    mark.empty_display_type, mark.empty_display_size = "SINGLE_ARROW", _SIZE * units
    mark.show_name = True
    up, ahead = np.array(spot.normal), np.array(spot.azimuth)
    axes = np.stack((ahead, np.cross(up, ahead), up, spot.point), axis=1)
    matrix = mathutils.Matrix((*axes.tolist(), (0, 0, 0, 1)))
    _collection(scene).objects.link(mark)
    thing = next((each for each in scene.objects if key(each) == carrier), None)
    if thing is not None:
        mark.parent, mark.matrix_parent_inverse = thing, thing.matrix_world.inverted_safe()
    mark.matrix_basis = matrix
    if reading.measured is not None:
        mark["reading"] = list(reading.measured.rgb)
        mark["instrument"] = reading.instrument
        mark["spread ΔE00, 95 %"] = spot.spread_95 or 0.0
    return mark


def _collection(scene: Any) -> Any:
    found = bpy.data.collections.get((COLLECTION, None)) or bpy.data.collections.new(COLLECTION)
    if found.name not in scene.collection.children:
        scene.collection.children.link(found)
    return found
