# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials measured with the virtual instruments."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import bpy

from ...core.errors import DomainError, MaterialError
from ...core.limits import SPOT_DIAMETER
from ...core.numerics.arrays import Array
from ..blender import working_space
from ..instrument import gloss as instrument_gloss
from ..instrument import spot as instrument_spot
from ..instrument import surfaces as instrument_surfaces
from ..instrument.spot import Spot
from ..readings import writers
from ..readings.document import Readings
from .checks import check_enabled, checked


def spots(
    thing: bpy.types.Object,
    *,
    at: bpy.types.Object | None = None,
    vertex_group: str | None = None,
    diameter: float = SPOT_DIAMETER,
    keep_neighbors: bool = False,
) -> list[Spot]:
    """Say where on an object a virtual instrument is put down, for `bake`.

    Parameters
    ----------
    thing
        A mesh, or what Blender makes a mesh of, in the open scene.
    at
        An empty, or any object, whose z axis meets the surface at the spot and points to the
        instrument; azimuths count from its x axis.
    vertex_group
        The spot is in the middle of it. Without either there is one spot in the middle of each of
        the object's materials.
    diameter
        Of the spot, millimeters.
    keep_neighbors
        Whether other objects shade and light the spot; else they are hidden.

    Returns
    -------
    Each has, among others, its `material`, and `point` and `normal` in the scene.

    Raises
    ------
    MaterialError
        There is no such place, or it has no material; or the object's surface cannot be measured.
    DomainError
        The diameter is no length, or there are two places.

    Examples
    --------
    >>> import bmesh
    >>> shape, mesh = bmesh.new(), bpy.data.meshes.new("Ball")
    >>> _ = bmesh.ops.create_uvsphere(shape, u_segments=64, v_segments=32, radius=1)
    >>> shape.to_mesh(mesh)
    >>> ball, wall = bpy.data.objects.new("Ball", mesh), bpy.data.materials.new("Wall")
    >>> bpy.context.scene.collection.objects.link(ball)
    >>> mesh.materials.append(wall)
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> [entry] = bake(spots(ball, diameter=4)).entries
    >>> [round(value, 2) for value in entry.measured.rgb], entry.delta_e_00 < 0.1
    ([0.36, 0.36, 0.36], True)
    >>> entry.spot.diameter, entry.spot.covered
    (4, 1.0)
    """
    check_enabled()
    if not isinstance(thing, bpy.types.Object):
        raise MaterialError(f"{thing!r} is no object; give one of bpy.data.objects.")
    if at is not None and vertex_group is not None:
        raise DomainError("A spot has one place; give `at` or `vertex_group`, not both.")
    how = {"diameter": diameter, "is_alone": not keep_neighbors}
    if at is not None:
        return [instrument_spot.at_empty(thing, at, **how)]
    if vertex_group is not None:
        return [instrument_spot.at_group(thing, vertex_group, **how)]
    return instrument_spot.on_materials(thing, **how)


def bake(
    surfaces: Iterable[bpy.types.Material | tuple[str, bpy.types.Material] | Spot],
    measure: bool = True,
    progress: Callable[[int, int], None] | None = None,
    read_at: str | Iterable[str] | None = None,
    with_gloss: bool = False,
) -> Readings:
    """Predict the readings of materials at virtual instruments, and measure them in Cycles.

    Cycles renders in a second Blender, and this call waits for it. The open file is not changed.

    Parameters
    ----------
    surfaces
        Materials; or pairs of a name to tell them by, such as that of an object, and a material:
        they are measured as flat samples. Or what `spots` gave, measured on the object itself. What
        has no spectrum is measured and not predicted.
    measure
        Whether to measure; predictions alone need no second Blender.
    progress
        Called with renders done and renders in all.
    read_at
        Instruments instead of each material's own, one or several.
    with_gloss
        Whether to measure gloss units, too, as `gloss` does; they are in each reading's `gloss`.

    Returns
    -------
    Its `entries` have one `Reading` for each surface and instrument, in this order; each names its
    `instrument`: `predicted.values`, one a
    band; `measured.rgb`; `delta_e_00` between the two; `warnings`; and `fault`, why a prediction
    or a measurement is missing, which does not stop the others. `largest_delta_e` is the largest.
    A spot's reading has a `spot`: among others `spread_mean` and `spread_95`, ΔE00 from the reading
    over the spot, and `covered`, the share of the spot that the object fills.

    Raises
    ------
    MaterialError
        A surface is no material.
    DomainError
        An instrument is not known.
    OutputError
        The second Blender failed.
    CancelledError
        On an interrupt from the keyboard.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], gloss="none")
    >>> [entry] = bake([wall]).entries
    >>> [round(value, 3) for value in entry.measured.rgb]
    [0.311, 0.31, 0.311]
    >>> entry.delta_e_00 < 0.01
    True
    """
    found: list[tuple[str, Any] | Spot] = []
    for surface in surfaces:
        if isinstance(surface, Spot):
            found.append(surface)
        else:
            name, material = surface if isinstance(surface, tuple) else ("", surface)
            found.append((name, checked(material)))
    at = (read_at,) if isinstance(read_at, str) else tuple(read_at or ())
    return instrument_surfaces.read(found, measure, progress, at, with_gloss)


def gloss(
    materials: Iterable[bpy.types.Material],
    angles: Iterable[float] = (20, 60, 85),
    progress: Callable[[int, int], None] | None = None,
) -> Array:
    """Measure the gloss of materials with the virtual gloss meter of ISO 2813, in Cycles.

    Cycles renders in a second Blender, and this call waits for it. The open file is not changed.

    Parameters
    ----------
    materials
        Any materials, with a spectrum or without.
    angles
        Degrees: 20, 60 and 85.
    progress
        Called with renders done and renders in all.

    Returns
    -------
    Gloss units, shape (materials, angles): 100 is polished black glass of the index 1.567. Exact to
    0.1 for mirrors, to some 2 % for rough surfaces.

    Raises
    ------
    MaterialError
        One is no material.
    DomainError
        There is no gloss meter of an angle.
    OutputError
        The second Blender failed.
    CancelledError
        On an interrupt from the keyboard.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> [[units]] = gloss([wall], [60])
    >>> bool(units < 2)  # matte: what the window sees of the diffuse light
    True
    """
    found = [checked(material) for material in materials]
    space = working_space.current()
    return instrument_gloss.measured(found, space, tuple(angles), progress)


def write(
    readings: Readings,
    base: str | os.PathLike[str],
    formats: Iterable[str] = writers.FORMATS,
) -> list[Path]:
    """Write all files of a bake, or none; what an earlier bake wrote beside them goes.

    Parameters
    ----------
    readings
        What `bake` gave.
    base
        Folder and base name; endings are added: "out/chart" becomes out/chart.json,
        out/chart.predicted.csv and so on. Folders are made.
    formats
        Any of "csv", "cgats" and "exr", to be written beside the JSON document.

    Returns
    -------
    The files written.

    Raises
    ------
    DomainError
        A format is not known; nothing was written.
    OutputError
        A file cannot be written or replaced; none was touched.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> [path.name for path in write(bake([wall], measure=False), "out/chart", ["csv"])]
    ['chart.predicted.csv', 'chart.json']
    """
    chosen = (formats,) if isinstance(formats, str) else tuple(formats)
    unknown = [name for name in chosen if name not in writers.FORMATS]
    if unknown:
        msg = f"The format {unknown[0]!r} is not known; choose of {', '.join(writers.FORMATS)}."
        raise DomainError(msg)
    return writers.write(readings, Path(base), chosen)
