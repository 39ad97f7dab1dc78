# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where colors stand in a scene's materials, lamps and world.

Colors count where they enter a shader: whatever makes them, textures or noise or mixing, goes on in
red, green and blue up to there. Nothing is changed here.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...core.errors import MaterialError
from ...core.numerics.arrays import Array
from ..blender import surface as surface_of
from ..blender import texture_colors
from ..colorimetry.rgb_space import WorkingSpace
from ..scene import emission, visibility
from ..scene.light_spectra import KnownLight
from .color_spectra import EVEN, LINEAR, Spectra, source_of
from .colors import Colored, Colors
from .places import Place, key, title

_GLOWS = {
    ("ShaderNodeEmission", "Color"): "Strength",
    ("ShaderNodeBackground", "Color"): "Strength",
    ("ShaderNodeBsdfPrincipled", "Emission Color"): "Emission Strength",
    ("ShaderNodeVolumePrincipled", "Emission Color"): "Emission Strength",
}
"""Sockets whose color is of light, and those of its strength."""
_BY_THREE = {
    ("ShaderNodeBsdfPrincipled", "Subsurface Radius"),
    ("ShaderNodeSubsurfaceScattering", "Radius"),
}
"""Vectors that have a number for each of red, green and blue."""
_PARTS = {
    ("ShaderNodeBsdfPrincipled", "Subsurface Radius"): "Subsurface Weight",
    ("ShaderNodeBsdfPrincipled", "Sheen Tint"): "Sheen Weight",
    ("ShaderNodeBsdfPrincipled", "Coat Tint"): "Coat Weight",
}
"""Sockets of lobes that a node may be without, and those that say how much of them it has."""
_DRAWN = {"GREASEPENCIL", "GPENCIL"}
"""Types of objects that Blender draws over what Cycles has rendered; see the worker."""


def find(
    depsgraph: Any,
    scene: Any,
    space: WorkingSpace,
    known: Mapping[str, KnownLight] | None = None,
    *,
    is_visible: bool = True,
) -> Colors:
    """Find all colors of what a scene shows.

    Parameters
    ----------
    depsgraph
        Evaluated, of the scene.
    scene
        A `bpy.types.Scene`.
    space
        The working space.
    known
        By the names of lamps, worlds and materials, the spectrum that their light has, and what
        that is, whatever they keep themselves; its luminance stays that of their color.
    is_visible
        Whether it is for the eye. If not, grays are found, too, which are the same in all bands for
        the eye alone, and what lamps keep is not asked.

    Raises
    ------
    MaterialError
        If nothing of such a name shines with one color, or a lamp keeps what is no spectrum.
    """
    spectra = Spectra(space, known or {}, is_visible)
    found = _Search(spectra, space).of(depsgraph, scene)
    if spectra.unused:
        msg = (
            f"Nothing in the scene that is called {min(spectra.unused)!r} shines with one color; "
            "check the name of the lamp, the world or the material."
        )
        raise MaterialError(msg)
    return found


class _Search:
    def __init__(self, spectra: Spectra, space: WorkingSpace) -> None:
        self._spectra, self._space = spectra, space
        self._seen: set[tuple[tuple[str, str, str], str]] = set()

    def of(self, depsgraph: Any, scene: Any) -> Colors:
        lights: dict[Any, None] = {}
        materials: dict[Any, None] = {}
        rendered = visibility.Rendered(depsgraph.view_layer)
        for instance in depsgraph.object_instances:
            thing = instance.object
            if thing.type == "LIGHT":
                if rendered.shows(instance):
                    lights.setdefault(thing.data.original)
            elif thing.type in _DRAWN:
                self._spectra.found.tell(
                    title("Object", thing), "left out: Grease Pencil is no light"
                )
            else:
                materials |= _materials(thing)
        for thing in rendered.unseen():
            if thing.type == "LIGHT":
                lights.setdefault(thing.data)
            else:
                materials |= _materials(thing)
        override = depsgraph.view_layer.material_override
        for material in [override.original] if override is not None else materials:
            self._material(material)
        for light in lights:
            self._light(light)
        world = getattr(depsgraph.view_layer, "world_override", None) or scene.world
        if world is not None:
            self._world(world)
        return self._spectra.found

    def _material(self, material: Any) -> None:
        of = key("materials", material)
        name = self._spectra.title("Material", material)
        if not surface_of.uses_nodes(material):
            rgb = np.array(material.diffuse_color[:3], np.float64)
            self._spectra.surface(Place(of, attribute="diffuse_color"), name, rgb)
            return
        measured = self._spectra.measured(material, of, name)
        if measured is not None:
            self._spectra.found.measured.append(measured)
        self._tree(material.node_tree, of, name, set() if measured is None else {measured.place})

    def _light(self, light: Any) -> None:
        of = key("lights", light)
        name = self._spectra.title("Light", light)
        if getattr(getattr(light, "cycles", None), "is_portal", False):
            return
        self._spectra.choose(name, light)
        color = np.array(light.color[:], np.float64)
        kelvin = None
        if light.use_temperature:
            kelvin = light.temperature
            if np.ptp(color) > EVEN:
                kelvin = None
            color = color * emission.blackbody(light.temperature, self._space)
            self._spectra.found.reset.append((Place(of, attribute="use_temperature"), False))
        tree = emission.tree(light)
        if tree is None:
            self._spectra.glow(Place(of, attribute="color"), name, color, kelvin)
            return
        self._spectra.found.reset.append((Place(of, attribute="color"), (1.0, 1.0, 1.0)))
        self._tree(tree, of, name, set(), color, kelvin)

    def _world(self, world: Any) -> None:
        of = key("worlds", world)
        name = self._spectra.title("World", world)
        self._spectra.choose(name, world)
        tree = emission.tree(world)
        if tree is None:
            self._spectra.glow(
                Place(of, attribute="color"), name, np.array(world.color[:], np.float64)
            )
            return
        self._tree(tree, of, name, set())

    def _tree(
        self,
        tree: Any,
        of: tuple[str, str, str],
        name: str,
        taken: set[Place],
        times: Array | None = None,
        kelvin: float | None = None,
    ) -> None:
        """Look at the nodes that make shaders; `times` is a lamp's own color, of `kelvin`.

        The colors of a group are found once; what there is to tell of it is told of all its users.
        """
        if (of, name) in self._seen:
            return
        is_known = any(of == other for other, _ in self._seen)
        self._seen.add((of, name))
        whole = self._spectra.found
        if is_known:
            self._spectra.found = Colors(told=whole.told, untranslated=whole.untranslated)
        self._nodes(tree, of, name, taken, times, kelvin)
        self._spectra.found = whole

    def _nodes(
        self,
        tree: Any,
        of: tuple[str, str, str],
        name: str,
        taken: set[Place],
        times: Array | None,
        kelvin: float | None,
    ) -> None:
        for node in _reached(tree):
            if node.bl_idname == "ShaderNodeGroup" and node.node_tree is not None:
                inner = node.node_tree
                self._tree(inner, key("node_groups", inner), name, set(), times, kelvin)
            image = getattr(node, "image", None)
            if image is not None and texture_colors.is_missing(image):
                self._spectra.found.tell(
                    name, f"magenta, as the file of image {image.name!r} is missing"
                )
            if not any(output.type == "SHADER" for output in node.outputs):
                continue
            self._node(node, name)
            for number, socket in enumerate(node.inputs):
                place = Place(of, node.name, number)
                kind = (node.bl_idname, socket.name)
                if place in taken or not (socket.type == "RGBA" or kind in _BY_THREE):
                    continue
                if node.bl_idname == "ShaderNodeGroup" or not socket.enabled:
                    continue
                if kind in _PARTS and not _in_use(node, _PARTS[kind]):
                    continue
                if kind in _GLOWS:
                    strength = node.inputs[_GLOWS[kind]]
                    if strength.is_linked or strength.default_value != 0:
                        self._spectra.emitting(place, socket, name, times, kelvin)
                elif source_of(socket) is not None:
                    self._spectra.found.colored.append(Colored(place, None, name))
                    self._spectra.found.tell(name, LINEAR)
                else:
                    self._spectra.surface(
                        place, name, np.array(socket.default_value[:3], np.float64)
                    )

    def _node(self, node: Any, name: str) -> None:
        """Name what no matrix of three bands turns into a spectrum."""
        kind = node.bl_idname
        if kind == "ShaderNodeScript":
            self._spectra.found.leave(name, "its OSL script")
        elif kind == "ShaderNodeBsdfHairPrincipled" and node.parametrization != "COLOR":
            self._spectra.found.leave(name, "its hair's melanin or absorption")
        elif kind == "ShaderNodeVolumeCoefficients":
            self._spectra.found.leave(name, "its volume's coefficients")
        elif kind == "ShaderNodeVolumePrincipled" and _in_use(node, "Blackbody Intensity"):
            self._spectra.found.leave(name, "its volume's blackbody")
        elif kind == "ShaderNodeBsdfMetallic" and node.fresnel_type == "PHYSICAL_CONDUCTOR":
            self._spectra.found.leave(name, "its metal's IOR and extinction")
        if _in_use(node, "Thin Film Thickness"):
            self._spectra.found.leave(name, "its thin film")


def _materials(thing: Any) -> dict[Any, None]:
    """Give the materials of an object, evaluated or not."""
    slots = [slot.material for slot in thing.material_slots]
    slots += getattr(thing.data, "materials", None) or []
    return dict.fromkeys(material.original for material in slots if material is not None)


def _reached(tree: Any) -> list[Any]:
    """Give the nodes that something of the tree's outputs comes from, in their order."""
    feeding: dict[Any, set[Any]] = {}
    for link in tree.links:
        feeding.setdefault(link.to_node, set()).add(link.from_node)
    waiting = [n for n in tree.nodes if "Output" in n.bl_idname and not n.outputs]
    found = set()
    while waiting:
        node = waiting.pop()
        if node not in found:
            found.add(node)
            waiting += feeding.get(node, ())
    return [node for node in tree.nodes if node in found]


def _in_use(node: Any, name: str) -> bool:
    socket = node.inputs.get(name)
    return socket is not None and (socket.is_linked or socket.default_value != 0)
