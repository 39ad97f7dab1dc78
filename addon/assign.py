# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Give materials their measured spectra: solve, write the sockets, store, stamp."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from ..core.errors import MaterialError
from . import nodes, storage, target, working_space
from .target import Request, Solution


def assign(pairs: Sequence[tuple[Any, Request]], shader: nodes.Shader = "AUTO") -> list[Solution]:
    """Assign measured spectra to materials, all of them or none.

    Parameters
    ----------
    pairs
        Each a `bpy.types.Material` and what it is to become.
    shader
        Which node to set; see `nodes.find`.

    Returns
    -------
    What was matched, in the order of `pairs`; look at each one's `warnings`.

    Raises
    ------
    MaterialError
        If a material cannot be written; nothing was changed then.
    DomainError
        If a spectrum or a setting cannot be used; nothing was changed then.
    """
    return _apply([(nodes.find(material, shader), request, shader) for material, request in pairs])


def renew(materials: Iterable[Any]) -> list[Solution]:
    """Derive color and roughness again from what the materials store.

    Raises
    ------
    MaterialError
        If a material stores no spectrum or cannot be written; nothing was changed then.
    """
    work = []
    for material in materials:
        shader = material.rough_spectra.shader
        work.append((nodes.find(material, shader), storage.load(material), shader))
    return _apply(work)


def _apply(work: list[tuple[nodes.Place, Request, nodes.Shader]]) -> list[Solution]:
    materials = [place.material for place, _, _ in work]
    if len(set(materials)) < len(materials):
        twice = next(m for m in materials if materials.count(m) > 1)
        msg = f"Material {twice.name!r} is named twice; give it one spectrum."
        raise MaterialError(msg)
    space = working_space.current()
    solutions = target.solve([request for _, request, _ in work], space)
    for (place, request, shader), solution in zip(work, solutions, strict=True):
        red, green, blue = solution.color.tolist()
        node = nodes.write(place, (red, green, blue), solution.roughness)
        storage.store(place.material, request, shader)
        storage.set_stamp(place.material, solution, space.name, node)
    return solutions
