# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What spectra colors stand for: measured ones, those of light, and mixtures of three."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...core.errors import RoughSpectraError
from ...core.numerics import wavelength_grid
from ...core.numerics.arrays import Array
from ..blender import shader_nodes, sockets
from ..blender.links import link_to
from ..colorimetry import illuminant_spectra
from ..colorimetry.rgb_space import WorkingSpace
from ..matching import surface_spectra
from ..material import settled, state, storage
from ..scene import chosen_light, emission
from ..scene.light_spectra import KnownLight
from .colors import Colored, Colors, Measured, Shining
from .places import Place, title

LINEAR = "a spectrum for its RGB, by three spectra of red, green and blue"
EVEN = 1e-6
"""Spread of a color's channels below which it is gray, which is the same in all bands."""


class Spectra:
    """Gives colors their spectra, one after the other, and notes them in `found`.

    Parameters
    ----------
    space, known, is_visible
        As of `find_colors.find`.
    """

    def __init__(
        self, space: WorkingSpace, known: Mapping[str, KnownLight], is_visible: bool
    ) -> None:
        self._space = space
        self._is_visible = is_visible
        self._known = known
        self.unused = set(known)
        """Names among the known that have not been met."""
        self._called: dict[str, str] = {}
        self._chosen: dict[str, KnownLight] = {}
        self.found = Colors()

    def title(self, kind: str, data: Any) -> str:
        """Give the name by which a datablock is told, and remember what it is called."""
        name = title(kind, data)
        self._called[name] = str(data.name)
        return name

    def choose(self, title: str, data: Any) -> None:
        """Remember the spectrum that a lamp or a world keeps, and that it has to be used."""
        chosen = chosen_light.known(data) if self._is_visible else None
        if chosen is not None:
            self._chosen[title] = chosen

    def measured(self, material: Any, of: tuple[str, str, str], name: str) -> Measured | None:
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
            self.found.tell(name, f"its measured spectrum is not used: {why}")
            return None
        try:
            request = settled.of(material).request
            [read], _ = surface_spectra.readings_and_albedos([request])
        except RoughSpectraError as error:
            self.found.tell(name, f"its measured spectrum is not used: {error}")
            return None
        grid = illuminant_spectra.GRID
        nm = request.sample.wavelengths
        reading = wavelength_grid.resample(read, nm, grid, method="linear", ends="hold")
        color = sockets.color_socket(node)
        place = Place(of, node.name, list(node.inputs).index(color))
        self.found.tell(name, f"measured: {request.sample.name}")
        gloss = storage.shown_gloss(material)
        whole = np.stack((nm, read))
        return Measured(place, reading, surface.roughness, request.read_at, gloss, name, whole)

    def surface(self, place: Place, name: str, rgb: Array) -> None:
        """Note the color of a surface, unless it is the same in all bands."""
        if np.ptp(rgb) > EVEN or not self._is_visible:
            self.found.colored.append(Colored(place, rgb, name))
            self.found.tell(name, LINEAR)

    def emitting(
        self, place: Place, socket: Any, name: str, times: Array | None, kelvin: float | None
    ) -> None:
        """Note what a socket's color sends, whatever sets it; `times` and `kelvin` are a lamp's."""
        own = np.ones(3) if times is None else times
        source = source_of(socket)
        constant = socket if source is None else source
        if source is None or source.node.bl_idname == "ShaderNodeRGB":
            rgb = np.array(constant.default_value[:3], np.float64)
            self.glow(place, name, rgb * own, kelvin if np.ptp(rgb) <= EVEN else None)
            return
        if source.node.bl_idname == "ShaderNodeBlackbody":
            temperature = source.node.inputs["Temperature"]
            if not temperature.is_linked and np.ptp(own) <= EVEN:
                degrees = float(temperature.default_value)
                rgb = emission.blackbody(degrees, self._space)
                self.glow(place, name, rgb * own, degrees)
                return
        self.found.shining.append(Shining(place, None, own, name, self._called[name]))
        self.found.tell(name, f"{LINEAR}, times that of D65")
        if name in self._chosen:
            _, words = self._chosen[name]
            self.found.tell(name, f"not {words}, as it has many colors")

    def glow(self, place: Place, name: str, rgb: Array, kelvin: float | None = None) -> None:
        """Note a light of one color, and what is known of it."""
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
        self.found.shining.append(Shining(place, spectrum, strength, name, called, kelvin, picked))
        self.found.tell(name, words)


def _are_apart(xyz: Array, other: Array) -> bool:
    """Whether two lights are seen to be of different colors."""
    one, two = (illuminant_spectra.to_uv(each) for each in (xyz, other))
    return float(np.linalg.norm(one - two)) > illuminant_spectra.NEAR_WHITE


def source_of(socket: Any) -> Any | None:
    """Give the output that sets a socket, seen through reroutes; None where nothing does."""
    while socket.is_linked:
        link = link_to(socket)
        if link.is_muted or not link.is_valid:
            return None
        if link.from_node.bl_idname != "NodeReroute":
            return link.from_socket
        socket = link.from_node.inputs[0]
    return None
