# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write a color that was found by measuring, with the sample that it was found for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ..blender import colors, shader_nodes, working_space
from ..matching import solve
from . import last_measurement, snapshot, state, storage

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array
    from ..blender.colors import Place
    from ..matching.color_search import Found
    from ..matching.request import Request


def write(
    material: Any, request: Request, place: Place, found: Found, unlike: Sequence[str] = ()
) -> None:
    """Set the color, store the sample, and note the reading that was measured with it.

    The material then keeps what it shows: no formula tells what it reads, so that nothing may
    derive it anew unasked. `unlike` is as of `last_measurement.LastMeasurement`.

    Raises
    ------
    MaterialError
        If the material cannot be written; nothing was changed then.
    """
    shader_nodes.refuse_read_only(material)
    space = working_space.current()
    [solution] = solve.solve([replace(request, scene=None, gloss=None)], space)
    red, green, blue = (float(value) for value in found.color)
    colors.put(material, place, (red, green, blue))
    shader = material.rough_spectra.shader if snapshot.has_spectrum(material) else "AUTO"
    storage.store(material, request, shader)
    inputs = snapshot.inputs(material.rough_spectra)
    solution = replace(
        solution, color=found.color, delta_e_instrument=found.difference, warnings=()
    )
    kept = state.fingerprint(shader_nodes.surface(material))
    what = (solution, space.name, place.node, inputs, storage.shown_gloss(material))
    storage.set_stamp(material, *what, kept=kept, measured=place.name)
    last_measurement.note(
        material,
        last_measurement.fingerprint(material),
        _rgb(found.reading),
        found.difference,
        instrument=request.read_at,
        unlike=unlike,
    )


def _rgb(reading: Array) -> tuple[float, float, float]:
    red, green, blue = (float(value) for value in reading)
    return red, green, blue
