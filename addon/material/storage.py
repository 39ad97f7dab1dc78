# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Read and write what a material stores.

The truth is the spectrum; color and roughness in the shader node are derived from it. The stamp
says from what; `state` tells whether that still holds.
"""

from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Any

from ...core import limits, white_scale
from ...core.errors import InputError, MaterialError, RoughSpectraError
from ...core.gloss import Gloss, from_numbers
from ...core.numerics.memoized import memoized
from ..blender import shader_nodes, working_space
from ..colorimetry import tristimulus
from ..matching import own_gloss as gloss_of_sample
from ..matching import scene_view
from ..matching.scene_view import SceneView
from ..matching.solution import Solution
from ..matching.solve import Request
from ..samples.readers.formats import library as library_format
from ..samples.sample import Sample
from ..support.version import version
from . import changes, snapshot, state
from .derivation import DERIVATION, Stamp, get_stamp, settings, to_text
from .properties import SCHEMA
from .snapshot import (
    Inputs,
    elsewhere,
    engine_is_flat,
    has_scene,
    sigma,
    tolerance,
)

_DETAILS = (
    *("license", "position", "device", "condition", "illuminant", "observer", "lab", "xyz"),
    *("quantity", "geometry", "aperture", "specular", "surface", "called", "gloss_source"),
)
_NEWER = {"surface", "called", "gloss_source"}
"""Details that are written only where there are any: earlier materials are as they were."""
_SENTENCES = ("notes", "altered")
_SET = ("others", "gloss")
_NOBODYS = (Gloss(), Gloss(ior=1.45))
"""The gloss of a new node, and that of the cube with which Blender 4.5 begins: set by nobody."""
_COLORS = {"lab", "xyz"}
_TEXTS = set(_DETAILS) - _COLORS - {"observer"}
_MENUS = (
    *("kind", "instrument", "white", "plaque", "illuminant", "observer", "read_at"),
    *("model", "shader"),
)

_UNREADABLE = (
    *(RoughSpectraError, ValueError, KeyError, TypeError, AttributeError),
    *(RecursionError, OverflowError),  # of text nested too deep, and of numbers too large
)
"""What reading damaged text ends in."""


def store(material: Any, request: Request, shader: str) -> None:
    """Write the spectrum and all settings of a request into the material."""
    sample, group = request.sample, material.rough_spectra
    with changes.paused():
        group.schema = SCHEMA
        group.sample_name = sample.name
        group.source = sample.source
        group.kind = sample.kind
        group.instrument = sample.instrument
        # repr of a float keeps every bit of it.
        group.spectrum = json.dumps(
            {"wavelengths": sample.wavelengths.tolist(), "values": sample.values.tolist()}
        )
        group.details = json.dumps(
            {
                key: getattr(sample, key)
                for key in _DETAILS
                if key not in _NEWER or getattr(sample, key)
            }
            | {key: list(getattr(sample, key)) for key in _SENTENCES}
            | {"white_factor": sample.white_factor}
            | library_format.set_record(sample)
        )
        group.white, group.plaque, factor = _white_properties(sample)
        if factor is not None:
            group.white_factor = factor
        group.sigma = request.sigma
        group.sigma_source = sample.sigma_source
        group.illuminant = request.illuminant
        group.observer = str(request.observer)
        group.read_at = request.read_at
        group.model = request.model
        group.tolerance = request.tolerance
        group.shader = shader
        if request.scene is not None:
            group.use_scene, group.scene_view = True, request.scene.to_json()


def note_own_sigma(material: Any, sample: Sample) -> None:
    """Note the roughness that a sample came with, so that one set by the user is known."""
    material.rough_spectra.own_sigma = math.radians(sample.sigma_degrees or 0.0)


def note_own_gloss(material: Any, gloss: Gloss | None) -> None:
    """Note the gloss that a sample came with, so that one set by the user is known."""
    material.rough_spectra.own_gloss = "" if gloss is None else json.dumps(gloss.numbers())


def own_gloss(material: Any) -> Gloss | None:
    """Give the gloss that a material's sample came with; None of one without."""
    try:
        return from_numbers(tuple(json.loads(material.rough_spectra.own_gloss or "[]")))
    except (ValueError, TypeError):
        pass
    try:
        return gloss_of_sample.of_sample(load(material).sample)  # as of an asset's material
    except MaterialError:
        return None


def is_gloss_set(material: Any) -> bool:
    """Whether a material's gloss is the user's, and neither its sample's nor that of a new node."""
    shown, own = shown_gloss(material), own_gloss(material)
    if shown is None:
        return own is not None
    return not any(_same_gloss(shown, other) for other in (own, *_NOBODYS) if other is not None)


def _same_gloss(one: Gloss, other: Gloss) -> bool:
    """Whether two are the same in the single precision of sockets."""
    pairs = zip(one.numbers(), other.numbers(), strict=True)
    return all(abs(a - b) <= 1e-5 for a, b in pairs)


def load(material: Any, view: SceneView | None = None) -> Request:
    """Read back what `store` wrote.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    view
        Lights and directions instead of those that are stored, which may then be damaged.

    Raises
    ------
    MaterialError
        If the material has no spectrum, one stored by a newer version, or anything stored that
        cannot be used: what is given can be solved.
    """
    group = material.rough_spectra
    if not group.spectrum:
        msg = f"Material {material.name!r} has no measured spectrum; assign one first."
        raise MaterialError(msg)
    _refuse_newer(material)
    _refuse_damaged(material)
    try:
        sample = _sample(
            group.sample_name,
            group.spectrum,
            group.details,
            group.kind,
            group.instrument,
            group.sigma_source,
            group.source,
            snapshot.white(group),
        )
    except _UNREADABLE as error:
        reason = " ".join(str(error).split()).rstrip(".") or type(error).__name__
        msg = (
            f"Material {material.name!r}: its stored spectrum cannot be read ({reason}); assign "
            "the sample again."
        )
        raise MaterialError(msg) from error
    request = Request(
        sample=sample,
        sigma=sigma(group),
        model=group.model,
        illuminant=group.illuminant,
        observer=int(group.observer),
        tolerance=tolerance(group),
        read_at=group.read_at,
        scene=view,
        flat=view is not None and engine_is_flat(),
        gloss=shown_gloss(material),
    )
    return in_scene(material, request)


def shown_gloss(material: Any) -> Gloss | None:
    """Give the gloss of what the surface shows; None where it has none, or no number of it."""
    surface = shader_nodes.surface(material)
    if surface is None or surface.gloss is None:
        return None
    return surface.gloss if all(map(math.isfinite, surface.gloss.numbers())) else None


def fault(material: Any, view: SceneView | None = None) -> str:
    """Say why what a material stores cannot be used; empty where it can, or stores nothing."""
    if not material.rough_spectra.spectrum:
        return ""
    try:
        load(material, view)
    except MaterialError as error:
        return str(error)
    return ""


@memoized(maxsize=256)
def _sample(
    name: str,
    spectrum: str,
    details: str,
    kind: Any,
    instrument: str,
    about_sigma: str,
    cited: str,
    white: snapshot.White,
) -> Sample:
    """Read a sample from what is stored of it; once, while a slider is dragged."""
    bands, more = json.loads(spectrum), json.loads(details or "{}")
    relative_to, factor, plaque = white
    exact = more.get("white_factor")
    if factor is not None and isinstance(exact, float) and round(exact, 6) == factor:
        factor = exact  # the property holds fewer digits than the file had
    lists = ("lab", "xyz", *_SENTENCES)
    pairs = {key: tuple(more[key]) for key in lists if more.get(key)}
    plain = {key: more[key] for key in _DETAILS if key in more and key not in pairs}
    for key in _TEXTS & plain.keys():
        if not isinstance(plain[key], str):
            raise TypeError(f"{key} is no text")
    if not all(isinstance(text, str) for key in _SENTENCES for text in pairs.get(key, ())):
        raise TypeError("a note is no text")
    for key in _COLORS & pairs.keys():
        pairs[key] = _color(pairs[key])
    sample = Sample(
        name=name,
        wavelengths=bands["wavelengths"],
        values=bands["values"],
        kind=kind,
        instrument=instrument,
        sigma_source=about_sigma,
        source=cited,
        white=relative_to,
        white_factor=factor,
        plaque=plaque,
        **(plain | pairs),
    )
    tristimulus.weights(sample.wavelengths)  # refuses what holds too little of a color
    return library_format.with_set(sample, {key: more[key] for key in _SET if key in more})


def _white_properties(sample: Sample) -> tuple[str, str, float | None]:
    """Give the white, the plaque and its factor as the material's properties have them."""
    plaque = sample.plaque
    if sample.white_factor is not None and sample.white != white_scale.PERFECT:
        plaque = white_scale.STATED
    elif not plaque:
        # Who chooses another white later most likely has this plaque.
        plaque = white_scale.PTFE if sample.white == white_scale.PERFECT else white_scale.UNKNOWN
    return sample.white, plaque, sample.white_factor


def _color(numbers: tuple[Any, ...]) -> tuple[float, float, float]:
    first, second, third = map(float, numbers)
    if not all(map(math.isfinite, (first, second, third))):
        raise ValueError("a color holds what is no number")
    return first, second, third


def in_scene(material: Any, request: Request) -> Request:
    """Let a request follow the analysis of the scene that the material stores, if it is to.

    Raises
    ------
    MaterialError
        If what is stored cannot be read.
    """
    group = material.rough_spectra
    if request.scene is not None or not has_scene(group):
        return request
    try:
        view = scene_view.from_json(group.scene_view)
    except InputError as error:
        msg = f"Material {material.name!r}: {error}"
        raise MaterialError(msg) from error
    return replace(request, scene=view, flat=engine_is_flat())


def _refuse_newer(material: Any) -> None:
    schema = material.rough_spectra.schema
    if schema > SCHEMA:
        msg = (
            f"Material {material.name!r} was stored by a newer Rough Spectra (schema {schema}); "
            "update the extension to work with it."
        )
        raise MaterialError(msg)


def _refuse_damaged(material: Any) -> None:
    """Refuse settings that Blender's own properties would not take, as a damaged file holds them.

    Blender gives an empty text for a stored number that no item of a menu has.
    """
    group = material.rough_spectra
    for name in _MENUS:
        if not getattr(group, name):
            msg = (
                f"Material {material.name!r}: its stored {name} is none that this version knows; "
                "choose one again."
            )
            raise MaterialError(msg)
    for label, value, lowest, highest in (
        ("σ", snapshot.sigma_degrees(group), 0.0, limits.LARGEST_SIGMA_DEGREES),
        ("The tolerance", tolerance(group), 0.0, math.inf),
    ):
        if not math.isfinite(value):
            msg = f"{label} is not a number; set it again, or mend its driver."
        elif not lowest <= value <= highest:
            msg = f"{label} is {value:g}, outside {lowest:g} to {highest:g}; set it again."
        else:
            continue
        raise MaterialError(f"Material {material.name!r}: {msg}")
    white, factor, plaque = snapshot.white(group)
    fault = white_scale.fault(white, group.instrument, factor, plaque)
    if fault:
        raise MaterialError(f"Material {material.name!r}: {fault}.")
    beyond = state.beyond(snapshot.sigma_degrees(group))
    if beyond:
        raise MaterialError(f"Material {material.name!r}: {beyond}.")


def set_stamp(
    material: Any,
    solution: Solution,
    working_space: str,
    node: str,
    inputs: Inputs,
    gloss: Gloss | None,
    *,
    kept: str = "",
    measured: str = "",
) -> str:
    """Note what was derived and from which spectrum and settings; gives the text of the stamp.

    `gloss` is what lies over the color.
    """
    red, green, blue = solution.color.tolist()
    text = to_text(
        Stamp(
            inputs=snapshot.digest(inputs),
            settings=tuple(settings(inputs).items()),
            working_space=working_space,
            node=node,
            color=(red, green, blue),
            roughness=solution.roughness,
            model=solution.model,
            model_reason=solution.model_reason,
            shader_reason=solution.shader_reason,
            delta_e_instrument=solution.delta_e_instrument,
            delta_e_mean=solution.delta_e_mean,
            delta_e_95=solution.delta_e_95,
            sigma_max=solution.sigma_max,
            warnings=solution.warnings,
            delta_e_lights=solution.delta_e_lights,
            scene_reason=solution.scene_reason,
            gloss=() if gloss is None else gloss.numbers(),
            version=version(),
            derivation=DERIVATION,
            kept=kept,
            measured=measured,
        )
    )
    material.rough_spectra.stamp = text
    material.rough_spectra.error = ""
    return text


def keep(material: Any) -> None:
    """Accept what the surface shows as edited by hand; the spectrum stays as it is.

    Raises
    ------
    MaterialError
        If nothing was derived from a spectrum yet, or the material is linked.
    """
    last = get_stamp(material)
    if last is None:
        msg = f"Material {material.name!r} has nothing derived from a spectrum yet; renew it."
        raise MaterialError(msg)
    group, place = material.rough_spectra, elsewhere(material)
    if place:
        msg = f"Material {material.name!r}: {place}."
        raise MaterialError(msg)
    _refuse_newer(material)
    inputs = snapshot.inputs(group)
    group.stamp = to_text(
        last._replace(
            inputs=snapshot.digest(inputs),
            settings=tuple(settings(inputs).items()),
            working_space=working_space.working_space_name(),
            kept=state.fingerprint(shader_nodes.surface(material)),
            measured="",
        )
    )
    group.error = ""
