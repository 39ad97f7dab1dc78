# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which materials a command or an operator works on."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any

import bpy

from ...core.errors import InputError, MaterialError
from . import snapshot


def by_name(name: str) -> Any:
    """Give the material of that name, a local one before linked ones.

    Raises
    ------
    MaterialError
        If there is none.
    """
    return _found(bpy.data.materials, "material", name)


def is_pattern(name: str) -> bool:
    """Whether a name holds `*`, for any letters, or `?`, for any letter."""
    return "*" in name or "?" in name


def matching(name: str, known: Iterable[str]) -> list[str]:
    """Give those of the known names that a name with `*` and `?` means, in their order.

    What is called exactly so is meant alone, however many other names would fit.

    Examples
    --------
    >>> matching("Wall*", ["Wall", "Wall.001", "wall"]), matching("a?[1]", ["ab[1]", "ab1"])
    (['Wall', 'Wall.001'], ['ab[1]'])
    """
    names = list(known)
    if name in names or not is_pattern(name):
        return [name] if name in names else []
    signs = {"*": ".*", "?": "."}
    pattern = "".join(signs.get(letter, re.escape(letter)) for letter in name)
    fits = re.compile(pattern, re.DOTALL).fullmatch
    return [each for each in names if fits(each)]


def named(name: str) -> list[Any]:
    """Give the materials of that name, which may hold `*` and `?`, sorted by name.

    Raises
    ------
    MaterialError
        If there is none.
    """
    known = every()
    if name in known or not is_pattern(name):
        return [by_name(name)]
    surfaces_only = [n for n, m in known.items() if not getattr(m, "is_grease_pencil", False)]
    found = matching(name, sorted(surfaces_only))
    if not found:
        msg = f"No material of {_file()} is called like {name!r}; check the name."
        raise MaterialError(msg)
    return [known[each] for each in found]


def object_by_name(name: str) -> Any:
    """Give the object of that name, a local one before linked ones.

    Raises
    ------
    MaterialError
        If there is none.
    """
    return _found(bpy.data.objects, "object", name)


def every() -> dict[str, Any]:
    """Give all materials of the file by their names, a local one before linked ones.

    Blender looks through all of them for each name it is asked for.
    """
    found: dict[str, Any] = {}
    for material in bpy.data.materials:
        if material.library is None:
            found[material.name] = material
        else:
            found.setdefault(material.name, material)
    return found


def of_objects(objects: Iterable[Any]) -> list[Any]:
    """Materials in the objects' slots, each once, sorted by name."""
    found = {slot.material for thing in objects for slot in thing.material_slots}
    return sorted((m for m in found if m is not None), key=lambda m: (m.name, str(m.library)))


def with_spectrum() -> list[Any]:
    """All materials of the file that store a spectrum, sorted by name."""
    found = [material for material in bpy.data.materials if snapshot.has_spectrum(material)]
    return sorted(found, key=lambda m: (m.name, str(m.library)))


def in_use(materials: Iterable[Any]) -> list[Any]:
    """Leave out materials that nothing uses any more: Blender keeps them until the file is saved.

    For who clicked that they go, they are deleted.
    """
    return [material for material in materials if material.users > 0]


def surfaces(materials: Sequence[str], objects: Sequence[str]) -> list[tuple[str, Any]]:
    """Find what to measure: named materials and the surfaces of named objects.

    Returns
    -------
    Pairs of object name, or an empty string, and material. With neither named: every material
    that stores a spectrum.

    Raises
    ------
    InputError, MaterialError
        If a name is not there, or nothing is left to measure.
    """
    found = [("", each) for each in dict.fromkeys(m for name in materials for m in named(name))]
    for name in objects:
        thing = object_by_name(name)
        slots = [slot.material for slot in thing.material_slots if slot.material is not None]
        if not slots:
            msg = f"Object {name!r} has no material; give it one first."
            raise MaterialError(msg)
        found += [(name, material) for material in dict.fromkeys(slots)]
    if not materials and not objects:
        found = [("", material) for material in with_spectrum()]
    if not found:
        msg = f"No material of {_file()} has a measured spectrum; assign one first."
        raise InputError(msg)
    return found


def _found(blocks: Any, kind: str, name: str) -> Any:
    block = blocks.get((name, None)) or blocks.get(name)
    if block is None:
        msg = f"There is no {kind} {name!r} in {_file()}; check the name."
        raise MaterialError(msg)
    return block


def _file() -> str:
    return repr(bpy.data.filepath) if bpy.data.filepath else "the open file"
