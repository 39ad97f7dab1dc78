# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a material is like at this moment, read from Blender once, as plain values.

Everything that says whether a color still follows from its spectrum is a function of these values:
equal facts give equal answers, which are therefore looked up. A panel asks at every redraw, and
what it pays for is this reading alone.
"""

from __future__ import annotations

import hashlib
import math
from typing import Any, NamedTuple

import bpy

from ...core import white_scale
from ...core.instruments import DEFAULT
from ...core.numerics.memoized import memoized
from ..blender import shader_nodes
from ..blender.working_space import working_space_name

_FIRST_TOLERANCE = 1.0
"""ΔE00; that of all materials before it could be set: it must never change."""

_FLAT_ENGINES = {"BLENDER_EEVEE", "BLENDER_EEVEE_NEXT", "BLENDER_WORKBENCH"}

KNOWN_ENGINES = _FLAT_ENGINES | {"CYCLES", ""}
"""Engines of which is known what they show of a material; the last is of no scene."""

_KEPT = 1024
"""Materials whose answers are kept; with an analyzed scene one has about 7 kB of texts."""


White = tuple[str, float | None, str]
"""As a `Sample` states it: white, its factor or None, and plaque or an empty text."""

_PERFECT: White = (white_scale.PERFECT, None, "")


class Inputs(NamedTuple):
    """The spectrum, and every setting that the color follows from.

    Parameters
    ----------
    spectrum, kind, instrument, illuminant, model, shader
        As the material stores them.
    sigma_degrees, tolerance
        As the user entered them.
    scene_view
        What an analysis of the scene found, or an empty text where the color does not follow it.
    flat
        Whether the engine ignores diffuse roughness, as far as the color follows from that: with
        a scene only.
    white
        Which white, what its factor is, and which plaque: of `stated_white`.
    read_at
        The virtual instrument.
    """

    spectrum: str
    kind: str
    instrument: str
    sigma_degrees: float
    illuminant: str
    model: str
    shader: str
    tolerance: float
    scene_view: str
    flat: bool
    white: White = _PERFECT
    read_at: str = DEFAULT


class Snapshot(NamedTuple):
    """A material, and what its state depends on of the file; without a spectrum that text is empty.

    Parameters
    ----------
    inputs
        Spectrum and settings.
    stamp, error, schema
        As the material stores them.
    elsewhere
        Where a material that cannot be changed here belongs, else an empty text.
    analyzed
        Whether there is an analysis of the scene, followed or not.
    surface
        Its shader node, or None where there is no target shader's.
    working_space
        Name of the open file's working space.
    engine
        Identifier of the scene's render engine.
    """

    inputs: Inputs
    stamp: str
    error: str
    schema: int
    elsewhere: str
    analyzed: bool
    surface: shader_nodes.Surface | None
    working_space: str
    engine: str

    @property
    def flat(self) -> bool:
        """Whether the engine ignores diffuse roughness."""
        return self.engine in _FLAT_ENGINES


def of(material: Any) -> Snapshot:
    """Read all facts of a material."""
    group = material.rough_spectra
    engine, view = _engine(), group.scene_view
    return Snapshot(
        _inputs(group, view, engine),
        group.stamp,
        group.error,
        group.schema,
        elsewhere(material),
        bool(view),
        shader_nodes.surface(material),
        working_space_name(),
        engine,
    )


def inputs(group: Any) -> Inputs:
    """Read the spectrum and every setting of a material's `rough_spectra`."""
    return _inputs(group, group.scene_view, _engine())


def has_spectrum(material: Any) -> bool:
    """Whether a spectrum was assigned to the material."""
    return bool(material.rough_spectra.spectrum)


def has_scene(group: Any) -> bool:
    """Whether the color follows from an analysis of the scene."""
    return bool(group.use_scene and group.scene_view)


def sigma(group: Any) -> float:
    """σ in radians, from the degrees that the user entered."""
    return math.radians(sigma_degrees(group))


def sigma_degrees(group: Any) -> float:
    """σ in degrees as the user entered it.

    The property is single precision: 15° comes back as 15.0000004°. Five decimals of a degree are
    what it can hold, and restore what was entered.
    """
    return entered_degrees(group.sigma)


def entered_degrees(angle: float) -> float:
    """Degrees as the user entered them, from the radians of a property of Blender's."""
    return round(math.degrees(angle), 5)


def tolerance(group: Any) -> float:
    """ΔE00 as the user entered it: the property is single precision, as that of `sigma`."""
    return round(group.tolerance, 5)


def white(group: Any) -> White:
    """Give the white that the values are relative to, as the user entered it."""
    name, plaque = group.white, group.plaque
    if name == white_scale.PERFECT:
        return _PERFECT
    if plaque == white_scale.STATED:
        # Single precision, as with `sigma`.
        return name, shader_nodes.comparable(round(group.white_factor, 6)), ""
    return name, None, "" if plaque == white_scale.UNKNOWN else plaque


def engine_is_flat() -> bool:
    """Whether the scene's render engine ignores diffuse roughness."""
    return _engine() in _FLAT_ENGINES


def elsewhere(material: Any) -> str:
    """Say where a material that cannot be changed here belongs, and what to do."""
    if material.library is not None:
        path = material.library.filepath
        return f"it is linked from {path!r}; make it local to change it, or change it there"
    if material.override_library is not None:
        return "it is a library override, whose nodes Blender resets; make it local to change it"
    if not material.is_editable:
        return "it is read-only; make it local to change it"
    return ""


@memoized(maxsize=_KEPT)
def digest(found: Inputs) -> str:
    """Digest of spectrum and settings; stored in files, so that it has to stay the same."""
    told: tuple[str, ...] = (
        found.spectrum,
        found.kind,
        found.instrument,
        f"{found.sigma_degrees:.5f}",
        found.illuminant,
        found.model,
        found.shader,
    )
    if found.scene_view:
        told += (found.scene_view, engine_words(found.flat))
    if found.tolerance != _FIRST_TOLERANCE:
        told += (f"{found.tolerance}",)  # so that older stamps stay valid
    if found.white != _PERFECT:
        told += (repr(found.white),)
    if found.read_at != DEFAULT:
        told += (f"read at {found.read_at}",)
    return hashlib.sha256("\n".join(told).encode()).hexdigest()[:16]


def engine_words(flat: bool) -> str:
    """Say what it is of a render engine that matters."""
    return "one without diffuse roughness" if flat else "one with diffuse roughness"


def _inputs(group: Any, analysis: str, engine: str) -> Inputs:
    view = analysis if group.use_scene else ""
    return Inputs(
        group.spectrum,
        group.kind,
        group.instrument,
        shader_nodes.comparable(sigma_degrees(group)),
        group.illuminant,
        group.model,
        group.shader,
        shader_nodes.comparable(tolerance(group)),
        view,
        bool(view) and engine in _FLAT_ENGINES,
        white(group),
        group.read_at,
    )


def _engine() -> str:
    scene = bpy.context.scene
    return "" if scene is None else str(scene.render.engine)
