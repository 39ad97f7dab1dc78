# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find everything in a scene that sheds light, with its color and how it reaches things."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core.numerics.arrays import Array
from ..colorimetry.rgb_space import WorkingSpace
from . import chosen_light, emission, world
from .lamps import (
    Bulb,
    Glow,
    Panel,
    Source,
    Sun,
)
from .light_spectra import KnownLight
from .surfaces import Surfaces
from .visibility import Rendered


@dataclass(frozen=True)
class Lamp:
    """One source of light.

    Parameters
    ----------
    name
        Of the object, world or emitting material.
    source
        How it reaches a point.
    rgb
        Scene-linear; times the source's irradiance this is what falls on the point.
    temperature
        Kelvin where its color is a blackbody's, or None.
    receivers, excluded
        Names of the only objects that it lights, or None for all; and of those it doesn't.
    emitter
        Index of the emitting material among `Surfaces.materials`, or -1.
    shadow
        Whether what is in its way casts a shadow.
    known
        The spectrum that was chosen for it, if any.
    """

    name: str
    source: Source
    rgb: Array
    temperature: float | None = None
    receivers: frozenset[str] | None = None
    excluded: frozenset[str] = frozenset()
    emitter: int = -1
    shadow: bool = True
    known: KnownLight | None = None

    def lights(self, name: str) -> bool:
        """Whether light linking lets it reach the object of that name."""
        return name not in self.excluded and (self.receivers is None or name in self.receivers)


def find(
    depsgraph: Any, scene: Any, surfaces: Surfaces, space: WorkingSpace
) -> tuple[list[Lamp], list[str]]:
    """List all lamps of a scene, and sentences about what could not be read of them.

    Raises
    ------
    MaterialError
        If a lamp is to have a measured spectrum, and there is none that can be used.
    """
    lamps: list[Lamp] = []
    rendered = Rendered(depsgraph.view_layer)
    warnings: list[str] = [rendered.left_out()]
    for instance in depsgraph.object_instances:
        thing = instance.object
        if thing.type != "LIGHT" or not thing.visible_diffuse or not rendered.shows(instance):
            continue
        found = _of_light(thing, np.array(instance.matrix_world), space, warnings)
        if found is not None:
            lamps.append(found)
    lit_by = getattr(depsgraph.view_layer, "world_override", None) or scene.world
    if lit_by is not None and _lights_diffuse(lit_by):
        parts, unread = world.read(lit_by, space)
        known = chosen_light.known(lit_by)
        for part in parts:
            of_part = known if part.is_of_one_color else None
            lamps.append(Lamp(part.name, part.source, part.rgb, part.temperature, known=of_part))
        warnings += unread
    lamps += _glowing(surfaces, space, warnings)
    return lamps, [sentence for sentence in dict.fromkeys(warnings) if sentence]


def _lights_diffuse(world: Any) -> bool:
    """Whether its ray visibility lets a world light diffuse surfaces."""
    visibility = getattr(world, "cycles_visibility", None)  # there while Cycles is enabled
    return visibility is None or bool(visibility.diffuse)


def _of_light(thing: Any, matrix: Array, space: WorkingSpace, warnings: list[str]) -> Lamp | None:
    light = thing.data
    if light.type == "AREA" and getattr(getattr(light, "cycles", None), "is_portal", False):
        return None  # a portal only tells Cycles where the world's light comes in
    rgb = np.array(light.color[:]) * light.energy * 2.0**light.exposure
    neutral = np.ptp(light.color[:]) < 1e-6
    temperature = None
    if light.use_temperature:
        rgb = rgb * emission.blackbody(light.temperature, space)
        temperature = light.temperature if neutral else None
    known = chosen_light.known(light.original)
    tree = emission.tree(light)
    if tree is not None:
        shining = emission.of_tree(tree, "ShaderNodeOutputLight", space)
        if shining is None:
            return None
        rgb = rgb * shining.rgb
        if shining.temperature is not None:
            temperature = shining.temperature if neutral and temperature is None else None
        elif np.ptp(shining.rgb) > 1e-6 * shining.rgb.max():
            temperature = None
        if shining.unread or shining.source is not None:
            node, known = shining.unread or shining.source.name, None
            warnings.append(
                f"Light {thing.name!r}: node {node!r} cannot be read without rendering; it counts "
                "as white."
            )
    if not rgb.max() > 0:
        return None
    receivers, excluded = _linking(thing.original)
    source, scale = _source(light, matrix)
    name, shadow = thing.original.name, bool(light.use_shadow)
    lit = receivers, excluded
    return Lamp(name, source, rgb * scale, temperature, *lit, shadow=shadow, known=known)


def _source(light: Any, matrix: Array) -> tuple[Source, float]:
    """Shape of a light, and the factor of a light whose strength isn't its whole power."""
    center, back = matrix[:3, 3], matrix[:3, 2] / np.linalg.norm(matrix[:3, 2])
    if light.type == "SUN":
        half = light.angle / 2
        disk = math.pi * math.sin(half) ** 2
        return Sun(back, half), 1.0 if light.normalize else disk
    if light.type == "AREA":
        size_y = light.size_y if light.shape in {"RECTANGLE", "ELLIPSE"} else light.size
        half_u, half_v = matrix[:3, 0] * light.size / 2, matrix[:3, 1] * size_y / 2
        is_round = light.shape in {"DISK", "ELLIPSE"}
        area = 4 * float(np.linalg.norm(np.cross(half_u, half_v)))
        area *= math.pi / 4 if is_round else 1
        panel = Panel(center, half_u, half_v, -back, is_round, light.spread / 2)
        return panel, 1.0 if light.normalize else area
    radius = light.shadow_soft_size
    scale = 1.0 if light.normalize or radius == 0 else 4 * math.pi * radius**2
    if light.type != "SPOT":
        return Bulb(center, radius), scale
    outer = math.cos(light.spot_size / 2)
    inner = outer + (1 - outer) * light.spot_blend
    return Bulb(center, radius, -back, outer, inner), scale


def _linking(thing: Any) -> tuple[frozenset[str] | None, frozenset[str]]:
    """Names of the objects that a light is linked to, and of those it is kept from."""
    collection = thing.light_linking.receiver_collection
    if collection is None:
        return None, frozenset()
    named: dict[str, set[str]] = {"INCLUDE": set(), "EXCLUDE": set()}
    for child, link in zip(collection.objects, collection.collection_objects, strict=False):
        named[link.light_linking.link_state].add(child.name)
    for child, link in zip(collection.children, collection.collection_children, strict=False):
        names = {member.name for member in child.all_objects}
        named[link.light_linking.link_state] |= names
    # A collection of exceptions alone lights everything else.
    return frozenset(named["INCLUDE"]) or None, frozenset(named["EXCLUDE"])


def _glowing(surfaces: Surfaces, space: WorkingSpace, warnings: list[str]) -> Iterator[Lamp]:
    for index, material in enumerate(surfaces.materials):
        tree = emission.tree(material)
        if tree is None:
            continue
        shining = emission.of_tree(tree, "ShaderNodeOutputMaterial", space)
        triangles = surfaces.shedding(index)
        if shining is None or not len(triangles):
            continue
        if shining.unread or shining.source is not None:
            node = shining.unread or shining.source.name
            warnings.append(
                f"Material {material.name!r}: the color of its light comes from node {node!r}, "
                "which cannot be read without rendering; it counts as white."
            )
        yield Lamp(material.name, Glow(triangles), shining.rgb, shining.temperature, emitter=index)
