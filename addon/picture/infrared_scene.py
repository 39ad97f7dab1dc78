# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What lamps and surfaces of a scene are in parts of the infrared, and what is known of none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import bpy
import numpy as np

from ...core.emissivity import Filter
from ...core.errors import MaterialError
from ...core.numerics.arrays import Array
from ..blender import sockets
from ..blender import surface as surface_of
from ..colorimetry import illuminant_spectra
from ..colorimetry.rgb_space import WorkingSpace
from ..matching import emission
from ..samples.sample import Sample
from ..scene import chosen_light
from . import color_spectra, infrared_light, passes, places
from .colors import Colored, Colors, Measured, Shining
from .infrared_light import Light
from .infrared_wanted import IN_A_RENDER, LEAST, MOST, Wanted, covers
from .places import Place

_NODES = 2000
"""Wavelengths in a part of the band."""


class InfraredScene:
    """What was found, put into parts of a band.

    Parameters
    ----------
    found
        As `find_colors.find` gives it for what is not visible.
    space
        The working space.
    wanted
        What is asked for.

    Attributes
    ----------
    edits
        What the worker has to set.
    told, assumed, dark
        As of `infrared.InfraredPicture`.

    Raises
    ------
    MaterialError
        If nothing is known to shine in the band, or a name is nobody's.
    DomainError, InputError
        If a light is none that is known.
    """

    def __init__(self, found: Colors, space: WorkingSpace, wanted: Wanted) -> None:
        known = {name: infrared_light.find(light) for name, light in wanted.lights.items()}
        self._wanted = wanted
        self._luminance = np.linalg.inv(space.from_xyz)[1]
        edges = np.linspace(*wanted.ends, wanted.parts + 1)
        share = (np.arange(_NODES) + 0.5) / _NODES
        self._nm = edges[:-1, np.newaxis] + share * np.diff(edges)[:, np.newaxis]
        self._through = np.ones_like(self._nm)
        if isinstance(wanted.band, Filter):
            nm, response = (np.asarray(a) for a in (wanted.band.wavelengths, wanted.band.response))
            self._through = np.interp(self._nm, nm, response)
        # Nanometers: light of even power per nanometer that is 1 here has a luminance of 1.
        even = np.ones(illuminant_spectra.GRID.size)
        self._white = float(illuminant_spectra.to_xyz(even)[1])
        self.told: dict[str, str] = {}
        self.assumed: dict[str, str] = {}
        self.dark: dict[str, str] = {}
        self._light = np.zeros_like(self._nm)  # of all lamps, which surfaces are averaged under
        self.edits = [*self._lamps(found.shining, known), *self._surfaces(found)]

    def _lamps(self, shining: list[Shining], known: Mapping[str, Light]) -> list[dict[str, Any]]:
        """Say what lamps send in each part."""
        for name in known:
            if name not in {each.called for each in shining}:
                msg = (
                    f"Nothing in the scene that is called {name!r} shines; check the name of the "
                    "lamp, the world or the material."
                )
                raise MaterialError(msg)
        edits = []
        for each in shining:
            light = known.get(each.called) or _own(each)
            sent = np.zeros_like(self._nm)
            if light is None:
                self.dark[each.name] = "nothing is known of it there"
            elif not covers(light.ends, self._wanted.ends):
                self.dark[each.name] = f"{light.words} covers {light.ends[0]:g} to " + (
                    f"{light.ends[1]:g} nm"
                )
            else:
                self.told[each.name] = light.words
                sent = light.sent(self._nm) * self._through
            parts = sent.mean(axis=1) / self._through.mean() * self._white
            if each.spectrum is None:  # textures: as bright as to the eye
                mixed = self._luminance * each.strength
                edits.append(self._matrices(each.place, np.outer(parts, mixed)))
            else:
                mixed = each.strength[:1]
                edits.append(self._colors(each.place, parts * mixed[0]))
            self._light += sent * mixed.sum()
        if not self._light.any():
            first, last = self._wanted.ends
            msg = (
                f"Nothing in the scene is known to shine at {first:g} to {last:g} nm, of which a "
                "color tells nothing; give a lamp a temperature, or a spectrum that reaches there."
            )
            raise MaterialError(msg)
        return edits

    def _surfaces(self, found: Colors) -> list[dict[str, Any]]:
        """Say what surfaces reflect in each part."""
        given = {}
        shown = {each.place for each in found.measured} | {each.place for each in found.colored}
        for name, value in self._wanted.materials.items():
            place, measured = self._given(name, value)
            if place not in shown:
                msg = f"The scene shows no material {name!r}; check the name."
                raise MaterialError(msg)
            given[place] = measured
        known: list[Measured] = list(given.values())
        unknown: list[Colored] = []
        for each in found.measured:
            if each.place in given:
                continue
            assert each.whole is not None
            if covers(each.whole[0], self._wanted.ends):
                known.append(each)
                self.told[each.name] = "; ".join(_rules(found, each.name))
            else:
                nm = each.whole[0]
                self.assumed[each.name] = f"its sample covers {nm[0]:g} to {nm[-1]:g} nm"
                eye = illuminant_spectra.observer()[:, 1]
                known.append(replace(each, whole=_even(each.reading @ eye / eye.sum())))
        named = {each.name for each in known}
        for colored in found.colored:
            if colored.place in given:
                continue
            unknown.append(colored)
            if colored.name not in named:
                why = "; ".join(_rules(found, colored.name))
                self.assumed[colored.name] = why or "it has no spectrum"
        return [
            *(self._colors(each.place, self._reflected(each)) for each in known),
            *(self._as_seen(each) for each in unknown),
        ]

    def _given(self, name: str, value: Sample | float) -> tuple[Place, Measured]:
        """Give the place of a material's color, and what it is to be there."""
        material = bpy.data.materials.get(name)
        if material is None:
            raise MaterialError(f"There is no material {name!r} in the file; check the name.")
        title = places.title("Material", material)
        of = places.key("materials", material)
        place, roughness = Place(of, attribute="diffuse_color"), 0.0
        if surface_of.uses_nodes(material):
            node = surface_of.shader_node(material)
            if node is None:
                msg = f"{title} has no Principled BSDF and no Diffuse BSDF to give a reflectance."
                raise MaterialError(msg)
            color = sockets.color_socket(node)
            place = Place(of, node.name, list(node.inputs).index(color))
            roughness = float(sockets.roughness_socket(node).default_value)
        if isinstance(value, Sample):
            facets = emission.compute(value, 0.0, angles=(0.0,), bands=()).facets
            whole = np.stack((value.wavelengths, 1 - facets))
            self.told[title] = f"measured: {value.name}"
        else:
            whole = _even(value)
            self.told[title] = f"a reflectance of {value:g}"
        return place, Measured(place, whole[1], roughness, "45a:0", None, title, whole)

    def _reflected(self, each: Measured) -> Array:
        """Color of a surface in each part."""
        assert each.whole is not None
        weights = self._light + np.where(self._light.any(axis=1, keepdims=True), 0, 1)
        weights = weights / weights.sum(axis=1, keepdims=True)
        reading = np.sum(np.interp(self._nm, *each.whole) * weights, axis=1)
        gray = np.repeat(self._luminance[:, np.newaxis], IN_A_RENDER, axis=1)
        found = [
            passes.matched(replace(each, reading=part), gray, np.eye(IN_A_RENDER))
            for part in reading.reshape(-1, IN_A_RENDER)
        ]
        return np.concatenate(found)

    def _as_seen(self, each: Colored) -> dict[str, Any]:
        """Let a color of which nothing is known be as bright as to the eye."""
        if each.rgb is None:
            whole = np.ones(self._wanted.parts)
            return self._matrices(each.place, np.outer(whole, self._luminance))
        bright = max(float(each.rgb @ self._luminance), 0.0)
        return self._colors(each.place, np.full(self._wanted.parts, bright))

    def _colors(self, place: Place, parts: Array) -> dict[str, Any]:
        return passes.edit(place, "colors", list(parts.reshape(-1, IN_A_RENDER)))

    def _matrices(self, place: Place, rows: Array) -> dict[str, Any]:
        return passes.edit(place, "matrices", list(rows.reshape(-1, IN_A_RENDER, 3)))


def _own(each: Shining) -> Light | None:
    """Give what a lamp itself tells: a table kept with it, or the temperature that is set."""
    if each.place.of[0] in {"lights", "worlds"}:
        data = places.owner(each.place.of)
        if data.rough_spectra.spectrum != chosen_light.COLOR:
            kept = chosen_light.source(data)
            return None if kept is None else infrared_light.measured(kept)
    if each.kelvin is None or not infrared_light.COLDEST <= each.kelvin <= infrared_light.HOTTEST:
        return None
    return infrared_light.blackbody(each.kelvin)


def _rules(found: Colors, name: str) -> list[str]:
    """Give what is told of a material beside what becomes of RGB where eyes see."""
    return [rule for rule in found.told.get(name, ()) if rule != color_spectra.LINEAR]


def _even(value: float) -> Array:
    """Give a reflectance that is the same everywhere."""
    return np.array(((LEAST, MOST), (value, value)))
