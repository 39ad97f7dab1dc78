# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where colors stand in a scene's materials, lamps and world, and what spectra they stand for.

Colors count where they enter a shader: whatever makes them, textures or noise or mixing, goes on in
red, green and blue up to there. Nothing is changed here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np

from ...core.errors import MaterialError, RoughSpectraError
from ...core.gloss import Gloss
from ...core.numerics import wavelength_grid
from ...core.numerics.arrays import Array
from ..blender import shader_nodes, sockets, texture_colors
from ..blender import surface as surface_of
from ..blender.links import link_to
from ..colorimetry import illuminant_spectra
from ..colorimetry.rgb_space import WorkingSpace
from ..matching import surface_spectra
from ..material import settled, state, storage
from ..scene import chosen_light, emission, visibility
from ..scene.light_spectra import KnownLight
from .scene_copy import path_of

LINEAR = "a spectrum for its RGB, by three spectra of red, green and blue"
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
_EVEN = 1e-6
"""Spread of a color's channels below which it is gray, which is the same in all bands."""


@dataclass(frozen=True)
class Place:
    """Where a color stands.

    Parameters
    ----------
    of
        Collection of `bpy.data`, name and library's whole path of what it belongs to.
    node, socket
        Name of the node, and number of its input; empty and -1 for an attribute.
    attribute
        Name of a property of `of` itself, or empty.
    """

    of: tuple[str, str, str]
    node: str = ""
    socket: int = -1
    attribute: str = ""


@dataclass(frozen=True, eq=False)
class Measured:
    """A surface with a measured spectrum.

    Parameters
    ----------
    place
        Of its color.
    reading
        At the virtual instrument, at `illuminant_spectra.GRID`.
    roughness, read_at, gloss
        Cycles' diffuse roughness, the instrument, and what lies over the diffuse lobe.
    name
        By which its material is told.
    whole
        Its sample's wavelengths, whatever they are, and the reading there, shape (2, bands).
    """

    place: Place
    reading: Array
    roughness: float
    read_at: str
    gloss: Gloss | None
    name: str = ""
    whole: Array | None = None


@dataclass(frozen=True, eq=False)
class Colored:
    """A surface of which RGB is known; `rgb` is None where another node sets it.

    `name` is by which its material is told.
    """

    place: Place
    rgb: Array | None
    name: str = ""


@dataclass(frozen=True, eq=False)
class Shining:
    """What sends light.

    Parameters
    ----------
    place
        Of its color.
    spectrum
        At `GRID`, with a luminance of 1; None where another node sets the color.
    strength
        Luminance of the color, or by what a color of another node is multiplied, shape (3,).
    name, called
        By which it is told, such as "Light 'Sun'", and what the lamp, world or material is called.
    kelvin
        Temperature that is set for it, or None.
    picked
        Mean of its color's channels, by which Cycles picks it among other lamps; None where
        another node sets the color.
    """

    place: Place
    spectrum: Array | None
    strength: Array
    name: str = ""
    called: str = ""
    kelvin: float | None = None
    picked: float | None = None


@dataclass(eq=False)
class Colors:
    """All that was found.

    Parameters
    ----------
    measured, colored, shining
        Surfaces and lamps.
    reset
        Attributes and what they have to be in all renders, because `shining` has taken them over.
    told
        Names of materials, lamps and world, and the rules by which they got their spectra.
    untranslated
        Names, and what of them stays red, green and blue.
    """

    measured: list[Measured] = field(default_factory=list)
    colored: list[Colored] = field(default_factory=list)
    shining: list[Shining] = field(default_factory=list)
    reset: list[tuple[Place, Any]] = field(default_factory=list)
    told: dict[str, list[str]] = field(default_factory=dict)
    untranslated: dict[str, list[str]] = field(default_factory=dict)

    def tell(self, name: str, rule: str) -> None:
        """Note a rule once."""
        rules = self.told.setdefault(name, [])
        if rule not in rules:
            rules.append(rule)

    def leave(self, name: str, what: str) -> None:
        """Note what stays red, green and blue."""
        left = self.untranslated.setdefault(name, [])
        if what not in left:
            left.append(what)


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
    search = _Search(space, known or {}, is_visible)
    found = search.of(depsgraph, scene)
    if search.unused:
        msg = (
            f"Nothing in the scene that is called {min(search.unused)!r} shines with one color; "
            "check the name of the lamp, the world or the material."
        )
        raise MaterialError(msg)
    return found


class _Search:
    def __init__(
        self, space: WorkingSpace, known: Mapping[str, KnownLight], is_visible: bool
    ) -> None:
        self._space = space
        self._is_visible = is_visible
        self._known = known
        self.unused = set(known)
        self._called: dict[str, str] = {}
        self._chosen: dict[str, KnownLight] = {}
        self._found = Colors()
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
                self._found.tell(title("Object", thing), "left out: Grease Pencil is no light")
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
        return self._found

    def _title(self, kind: str, data: Any) -> str:
        """Give the name by which a datablock is told, and remember what it is called."""
        name = title(kind, data)
        self._called[name] = str(data.name)
        return name

    def _choose(self, title: str, data: Any) -> None:
        """Remember the spectrum that a lamp or a world keeps, and that it has to be used."""
        chosen = chosen_light.known(data) if self._is_visible else None
        if chosen is not None:
            self._chosen[title] = chosen

    def _material(self, material: Any) -> None:
        of = key("materials", material)
        name = self._title("Material", material)
        if not surface_of.uses_nodes(material):
            rgb = np.array(material.diffuse_color[:3], np.float64)
            self._surface(Place(of, attribute="diffuse_color"), name, rgb)
            return
        measured = self._measured(material, of, name)
        if measured is not None:
            self._found.measured.append(measured)
        self._tree(material.node_tree, of, name, set() if measured is None else {measured.place})

    def _measured(self, material: Any, of: tuple[str, str, str], name: str) -> Measured | None:
        """Give what is known of a material with a spectrum, or say why it goes by its RGB."""
        if not material.rough_spectra.spectrum:
            return None
        known = state.state(material)
        fresh = known.kind == "fresh" or (known.kind == "linked" and len(known.reasons) == 1)
        why = "" if fresh else (known.reasons or ("it does not follow from its spectrum",))[0]
        surface, node = shader_nodes.surface(material), shader_nodes.shader_node(material)
        obstacle = settled.obstacle(surface)
        if not why and obstacle is not None:
            why = str(obstacle)
        if why or surface is None or node is None:
            self._found.tell(name, f"its measured spectrum is not used: {why}")
            return None
        try:
            request = settled.of(material).request
            [read], _ = surface_spectra.readings_and_albedos([request])
        except RoughSpectraError as error:
            self._found.tell(name, f"its measured spectrum is not used: {error}")
            return None
        grid = illuminant_spectra.GRID
        nm = request.sample.wavelengths
        reading = wavelength_grid.resample(read, nm, grid, method="linear", ends="hold")
        color = sockets.color_socket(node)
        place = Place(of, node.name, list(node.inputs).index(color))
        self._found.tell(name, f"measured: {request.sample.name}")
        gloss = storage.shown_gloss(material)
        whole = np.stack((nm, read))
        return Measured(place, reading, surface.roughness, request.read_at, gloss, name, whole)

    def _light(self, light: Any) -> None:
        of = key("lights", light)
        name = self._title("Light", light)
        if getattr(getattr(light, "cycles", None), "is_portal", False):
            return
        self._choose(name, light)
        color = np.array(light.color[:], np.float64)
        kelvin = None
        if light.use_temperature:
            kelvin = light.temperature
            if np.ptp(color) > _EVEN:
                kelvin = None
            color = color * emission.blackbody(light.temperature, self._space)
            self._found.reset.append((Place(of, attribute="use_temperature"), False))
        tree = emission.tree(light)
        if tree is None:
            self._glow(Place(of, attribute="color"), name, color, kelvin)
            return
        self._found.reset.append((Place(of, attribute="color"), (1.0, 1.0, 1.0)))
        self._tree(tree, of, name, set(), color, kelvin)

    def _world(self, world: Any) -> None:
        of = key("worlds", world)
        name = self._title("World", world)
        self._choose(name, world)
        tree = emission.tree(world)
        if tree is None:
            self._glow(Place(of, attribute="color"), name, np.array(world.color[:], np.float64))
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
        whole = self._found
        if is_known:
            self._found = Colors(told=whole.told, untranslated=whole.untranslated)
        self._nodes(tree, of, name, taken, times, kelvin)
        self._found = whole

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
                self._found.tell(name, f"magenta, as the file of image {image.name!r} is missing")
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
                        self._emitting(place, socket, name, times, kelvin)
                elif _source(socket) is not None:
                    self._found.colored.append(Colored(place, None, name))
                    self._found.tell(name, LINEAR)
                else:
                    self._surface(place, name, np.array(socket.default_value[:3], np.float64))

    def _surface(self, place: Place, name: str, rgb: Array) -> None:
        if np.ptp(rgb) > _EVEN or not self._is_visible:
            self._found.colored.append(Colored(place, rgb, name))
            self._found.tell(name, LINEAR)

    def _emitting(
        self, place: Place, socket: Any, name: str, times: Array | None, kelvin: float | None
    ) -> None:
        own = np.ones(3) if times is None else times
        source = _source(socket)
        constant = socket if source is None else source
        if source is None or source.node.bl_idname == "ShaderNodeRGB":
            rgb = np.array(constant.default_value[:3], np.float64)
            self._glow(place, name, rgb * own, kelvin if np.ptp(rgb) <= _EVEN else None)
            return
        if source.node.bl_idname == "ShaderNodeBlackbody":
            temperature = source.node.inputs["Temperature"]
            if not temperature.is_linked and np.ptp(own) <= _EVEN:
                degrees = float(temperature.default_value)
                rgb = emission.blackbody(degrees, self._space)
                self._glow(place, name, rgb * own, degrees)
                return
        self._found.shining.append(Shining(place, None, own, name, self._called[name]))
        self._found.tell(name, f"{LINEAR}, times that of D65")
        if name in self._chosen:
            _, words = self._chosen[name]
            self._found.tell(name, f"not {words}, as it has many colors")

    def _glow(self, place: Place, name: str, rgb: Array, kelvin: float | None = None) -> None:
        xyz = np.linalg.solve(self._space.from_xyz, np.maximum(rgb, 0))
        if not xyz[1] > 0:
            return
        known = self._known.get(self._called[name])
        if known is not None:
            self.unused.discard(self._called[name])
        known = known or self._chosen.get(name)
        spectrum, words = known or illuminant_spectra.like(xyz / xyz[1], kelvin)
        if known is not None and _are_apart(illuminant_spectra.to_xyz(spectrum), xyz):
            words += ", though its RGB is another color"
        called, strength = self._called[name], np.full(3, xyz[1])
        picked = float(np.maximum(rgb, 0).mean())
        self._found.shining.append(Shining(place, spectrum, strength, name, called, kelvin, picked))
        self._found.tell(name, words)

    def _node(self, node: Any, name: str) -> None:
        """Name what no matrix of three bands turns into a spectrum."""
        kind = node.bl_idname
        if kind == "ShaderNodeScript":
            self._found.leave(name, "its OSL script")
        elif kind == "ShaderNodeBsdfHairPrincipled" and node.parametrization != "COLOR":
            self._found.leave(name, "its hair's melanin or absorption")
        elif kind == "ShaderNodeVolumeCoefficients":
            self._found.leave(name, "its volume's coefficients")
        elif kind == "ShaderNodeVolumePrincipled" and _in_use(node, "Blackbody Intensity"):
            self._found.leave(name, "its volume's blackbody")
        elif kind == "ShaderNodeBsdfMetallic" and node.fresnel_type == "PHYSICAL_CONDUCTOR":
            self._found.leave(name, "its metal's IOR and extinction")
        if _in_use(node, "Thin Film Thickness"):
            self._found.leave(name, "its thin film")


def _materials(thing: Any) -> dict[Any, None]:
    """Give the materials of an object, evaluated or not."""
    slots = [slot.material for slot in thing.material_slots]
    slots += getattr(thing.data, "materials", None) or []
    return dict.fromkeys(material.original for material in slots if material is not None)


def _are_apart(xyz: Array, other: Array) -> bool:
    """Whether two lights are seen to be of different colors."""
    one, two = (illuminant_spectra.to_uv(each) for each in (xyz, other))
    return float(np.linalg.norm(one - two)) > illuminant_spectra.NEAR_WHITE


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


def _source(socket: Any) -> Any | None:
    """Give the output that sets a socket, seen through reroutes; None where nothing does."""
    while socket.is_linked:
        link = link_to(socket)
        if link.is_muted or not link.is_valid:
            return None
        if link.from_node.bl_idname != "NodeReroute":
            return link.from_socket
        socket = link.from_node.inputs[0]
    return None


def title(kind: str, data: Any) -> str:
    """Give the name by which a datablock is told, such as "Material 'Wall'"."""
    return f"{kind} {data.name!r}"


def key(collection: str, data: Any) -> tuple[str, str, str]:
    """Give where a datablock is found, as in `Place`."""
    return collection, str(data.name), path_of(data.library)


def owner(of: tuple[str, str, str]) -> Any:
    """Give the datablock that is found there; see `key`."""
    collection, name, path = of
    blocks = getattr(bpy.data, collection)
    for library in bpy.data.libraries if path else (None,):
        found = blocks.get((name, None if library is None else library.filepath))
        if found is not None and path_of(library) == path:
            return found
    raise KeyError(of)
