# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Give materials their measured spectra: solve, write the sockets, store, stamp."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from ...core.errors import MaterialError, RoughSpectraError
from ...core.gloss import Gloss
from ..blender import shader_nodes, working_space
from ..blender.texture_scale import Palette
from ..colorimetry.rgb_space import WorkingSpace
from ..matching import other_readings, shaders, solve
from ..matching.scene_view import SceneView
from ..matching.solution import Solution
from ..matching.solve import Request
from . import (
    derivation,
    dragged_picture,
    read_gloss,
    snapshot,
    solid_color,
    storage,
    textures,
)
from .changes import Derived, Solved
from .snapshot import Snapshot


def assign(
    pairs: Sequence[tuple[Any, Request]],
    shader: str | Sequence[str] = shaders.AUTO,
    keep_gloss: bool = True,
    glosses: Sequence[Gloss | None] = (),
    from_readings: bool = False,
    looked: textures.Looked | None = None,
    look_again: bool = True,
) -> list[Solution]:
    """Assign measured spectra to materials, all of them or none.

    Parameters
    ----------
    pairs
        Each a `bpy.types.Material` and what it is to become.
    shader
        Which node to set, one for all or one a pair; see `shader_nodes.find`.
    keep_gloss
        Whether a node that is there keeps the gloss that it has, which is then counted; else it is
        set to 0. What a request says of gloss is not looked at.
    glosses
        For each material the gloss that its node is to have instead, or None; a node that can have
        none stays matte.
    from_readings
        Whether level and roughness of the gloss are set to what a sample's set says of them, in a
        Principled BSDF; see `read_gloss.of_all`.
    looked, look_again
        As of `textures.scaled`.

    Returns
    -------
    What was matched, in the order of `pairs`; look at each one's `warnings`.

    Raises
    ------
    MaterialError
        If a material cannot be written; nothing was changed then.
    DomainError
        If a spectrum, a setting or the shader cannot be used; nothing was changed then.
    """
    nodes = [shader] * len(pairs) if isinstance(shader, str) else list(shader)
    read: list[tuple[Gloss | None, tuple[str, ...]]] = [(None, ())] * len(pairs)
    if from_readings:
        read = read_gloss.of_all([(m, request.sample) for m, request in pairs], nodes)
    work = [
        _under_gloss(
            shader_nodes.find(material, read_gloss.WITH_GLOSS if gloss else node, keep_gloss),
            storage.in_scene(material, request),
            keep_gloss,
            gloss,
        )
        for (material, request), node, (gloss, _) in zip(pairs, nodes, read, strict=True)
    ]
    given = [
        gloss if gloss is not None and shader_nodes.can_shine(place) else None
        for (place, _), gloss in zip(work, glosses or [None] * len(work), strict=True)
    ]
    work = [
        (place, request if gloss is None else replace(request, gloss=gloss))
        for (place, request), gloss in zip(work, given, strict=True)
    ]
    space, solutions = _solve(work)
    solutions = [
        replace(solution, warnings=(*told, *solution.warnings)) if told else solution
        for solution, (_, told) in zip(solutions, read, strict=True)
    ]
    solutions = _told_of_sets(work, solutions, space)
    palettes, solutions, written = textures.scaled(work, solutions, space, look_again, looked)
    together = zip(work, written, palettes, nodes, read, given, strict=True)
    for (place, request), solution, palette, asked, (told_gloss, _), gloss in together:
        if not keep_gloss:
            shader_nodes.remove_gloss(place)
        node = _write(place, solution, palette)
        if told_gloss is not None:
            shader_nodes.set_gloss(place.material, node, told_gloss)
        if gloss is not None:
            shader_nodes.put_gloss(place.material, gloss)
        before = place.material.rough_spectra.spectrum
        storage.store(place.material, request, asked)
        if place.material.rough_spectra.spectrum != before:
            dragged_picture.drop(place.material)
        storage.note_own_sigma(place.material, request.sample)
        inputs = snapshot.inputs(place.material.rough_spectra)
        storage.set_stamp(place.material, solution, space.name, node, inputs, request.gloss)
    return solutions


def remove_gloss(materials: Iterable[Any]) -> list[Solution]:
    """Set the gloss of materials with a spectrum to 0, and derive their colors without it.

    Raises
    ------
    MaterialError, DomainError
        As in `renew`; nothing was changed then.
    """
    return _renew(
        [(material, material) for material in materials], keep_gloss=False, look_again=False
    )


def renew(materials: Iterable[Any], looked: textures.Looked | None = None) -> list[Solution]:
    """Derive color and roughness again from what the materials store.

    Parameters
    ----------
    materials
        Each a `bpy.types.Material`.
    looked
        As of `textures.scaled`.

    Raises
    ------
    MaterialError
        If a material stores no spectrum or cannot be written; nothing was changed then.
    DomainError
        If a spectrum cannot be used; nothing was changed then.
    """
    return _renew([(material, material) for material in materials], looked=looked)


def follow_scene(views: Mapping[Any, SceneView]) -> list[Solution]:
    """Match materials with a spectrum to what an analysis of the scene found, all or none.

    Raises
    ------
    MaterialError, DomainError
        As in `renew`; nothing was changed then.
    """
    requests = [_stored(material, material, view) for material, view in views.items()]
    space, solutions = _solve(requests)
    palettes, solutions, written = textures.scaled(requests, solutions, space, look_again=False)
    for (place, request), solution, palette in zip(requests, written, palettes, strict=True):
        node = _write(place, solution, palette)
        storage.store(place.material, request, place.material.rough_spectra.shader)
        inputs = snapshot.inputs(place.material.rough_spectra)
        storage.set_stamp(place.material, solution, space.name, node, inputs, request.gloss)
    return solutions


def renewable(
    materials: Iterable[Any], views: Mapping[Any, SceneView] | None = None
) -> tuple[list[Any], list[str]]:
    """Tell the materials that can be renewed from those that can't, and why: a sentence each.

    With views, those that can follow these instead of what they store.
    """
    able, sentences = [], []
    for material in materials:
        try:
            _stored(material, material, views[material] if views else None)
        except RoughSpectraError as error:
            sentences.append(str(error))
        else:
            able.append(material)
    return able, sentences


def follow(pairs: Sequence[tuple[Any, Any]]) -> None:
    """Derive color and roughness again, unasked; what goes wrong is kept with the material.

    Parameters
    ----------
    pairs
        Each a material and the one that its settings come from: itself, or, while it is animated,
        as it was evaluated.
    """
    try:
        _renew(pairs, look_again=False, follows=True)
    except RoughSpectraError as error:
        if len(pairs) == 1:
            pairs[0][0].rough_spectra.error = str(error)
            return
        # One that fails must not hold up the others.
        for pair in pairs:
            follow([pair])


def follow_setting(material: Any, known: Snapshot) -> Derived:
    """Do the same for one material whose setting was changed, and give what was found.

    Parameters
    ----------
    material
        A `bpy.types.Material` that follows: see `state.follows`.
    known
        Its facts since the change.
    """
    try:
        place, request = _followed(_stored(material, material))
        work = [(place, request)]
        space, solutions = _solve(work)
        [solution] = _told_of_sets(work, solutions, space)
        [palette], [solution], [written] = textures.scaled(work, [solution], space, False)
    except RoughSpectraError as error:
        material.rough_spectra.error = str(error)
        return Derived(material, snapshot.of(material), None)
    known = _follow(place, (request, written), palette, known, space)
    request = replace(request, model=solution.model)
    return Derived(material, known, Solved(request, solution, space))


def follow_settings(pairs: Sequence[tuple[Any, Snapshot]]) -> list[Derived]:
    """Do the same for several materials whose settings were changed at once.

    Those that have all settings and gloss in common are solved once.

    Parameters
    ----------
    pairs
        Each as of `follow_setting`.

    Returns
    -------
    What was found, of those that were solved; the others became the same.
    """
    done: list[Derived] = []
    solved: dict[tuple[Any, ...], Solved | None] = {}
    for material, known in pairs:
        surface = known.surface
        last = derivation.parse(known.stamp)
        for_flat = last and derivation.matched_flat(last)
        key = known.inputs, for_flat, surface and (surface.gloss, surface.shader)
        found = solved.get(key)
        if found is None or surface is None or surface.linked or surface.scaled:
            done.append(follow_setting(material, known))
            solved[key] = done[-1].solved
            continue
        try:
            place, request = _followed(_stored(material, material))
        except RoughSpectraError as error:
            material.rough_spectra.error = str(error)
            continue
        _follow(place, (request, found.solution), None, known, found.space)
    return done


def _follow(
    place: shader_nodes.SocketTarget,
    found: tuple[Request, Solution],
    palette: Palette | None,
    known: Snapshot,
    space: WorkingSpace,
) -> Snapshot:
    """Write what was solved for a setting, and give the facts since; parameters as they go."""
    request, written = found
    material = place.material
    node = _write(place, written, palette)
    inputs = known.inputs._replace(flat=request.flat)
    text = storage.set_stamp(material, written, space.name, node, inputs, request.gloss)
    if place.make or known.surface is None:
        return snapshot.of(material)
    surface = shader_nodes.written(known.surface, written.color, written.roughness)
    return known._replace(stamp=text, error="", surface=surface)


def _renew(
    pairs: Sequence[tuple[Any, Any]],
    keep_gloss: bool = True,
    look_again: bool = True,
    looked: textures.Looked | None = None,
    follows: bool = False,
) -> list[Solution]:
    work = [_stored(material, source, keep_gloss=keep_gloss) for material, source in pairs]
    if follows:
        work = list(map(_followed, work))
    space, solutions = _solve(work)
    solutions = _told_of_sets(work, solutions, space)
    palettes, solutions, written = textures.scaled(work, solutions, space, look_again, looked)
    together = zip(work, written, palettes, pairs, strict=True)
    for (place, request), solution, palette, (_, source) in together:
        if not keep_gloss:
            shader_nodes.remove_gloss(place)
        inputs = snapshot.inputs(source.rough_spectra)._replace(flat=request.flat)
        node = _write(place, solution, palette)
        storage.set_stamp(place.material, solution, space.name, node, inputs, request.gloss)
    return solutions


def _stored(
    material: Any, source: Any, view: SceneView | None = None, keep_gloss: bool = True
) -> tuple[shader_nodes.SocketTarget, Request]:
    request = storage.load(source, view)  # first: it refuses a shader that is none
    place = shader_nodes.find(material, source.rough_spectra.shader, keep_gloss)
    return _under_gloss(place, request, keep_gloss)


def _followed(
    work: tuple[shader_nodes.SocketTarget, Request],
) -> tuple[shader_nodes.SocketTarget, Request]:
    """Leave what was matched to a scene for Cycles to Cycles, whichever engine is on meanwhile."""
    place, request = work
    last = derivation.get_stamp(place.material)
    if not request.flat or last is None or derivation.matched_flat(last) is not False:
        return work
    return place, replace(request, flat=False)


def _under_gloss(
    place: shader_nodes.SocketTarget, request: Request, keep: bool, given: Gloss | None = None
) -> tuple[shader_nodes.SocketTarget, Request]:
    """Put the gloss of the node that is to be set, or is given, which may be another than shown."""
    gloss = given or (shader_nodes.gloss_at(place) if keep else None)
    return place, request if gloss == request.gloss else replace(request, gloss=gloss)


def _solve(
    work: Sequence[tuple[shader_nodes.SocketTarget, Request]],
) -> tuple[WorkingSpace, list[Solution]]:
    """Match every request; gives the working space too."""
    seen = set()
    for place, _ in work:
        if place.material in seen:
            msg = f"Material {place.material.name!r} is named twice; give it one spectrum."
            raise MaterialError(msg)
        seen.add(place.material)
    space = working_space.current()
    return space, solve.solve([request for _, request in work], space)


def _told_of_sets(
    work: Sequence[tuple[shader_nodes.SocketTarget, Request]],
    solutions: Sequence[Solution],
    space: WorkingSpace,
) -> list[Solution]:
    """Add what is to be said of the other readings of sets."""
    told = [
        other_readings.missed(request, solution, space) if request.sample.others else ""
        for (_, request), solution in zip(work, solutions, strict=True)
    ]
    return [
        replace(solution, warnings=(*solution.warnings, sentence)) if sentence else solution
        for solution, sentence in zip(solutions, told, strict=True)
    ]


def _write(place: shader_nodes.SocketTarget, solution: Solution, palette: Palette | None) -> str:
    red, green, blue = solution.color.tolist()
    solid_color.show(place.material, solution.target)
    return shader_nodes.write(place, (red, green, blue), solution.roughness, palette)
