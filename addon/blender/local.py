# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make what is linked from another file local."""

from __future__ import annotations

from typing import Any

from ...core.errors import MaterialError


def make_local(material: Any, thing: Any = None) -> Any:
    """Make a linked, packed or overridden material local.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    thing
        The object whose slot holds it, or None. Where the slot is of linked data, which would keep
        the linked material, the slot becomes the object's own.

    Returns
    -------
    The local material: the same, or a copy where linked data need the linked one.

    Raises
    ------
    MaterialError
        If Blender cannot make it local, or the object is linked itself; nothing was changed then.
    """
    slots = [] if thing is None else [s for s in thing.material_slots if s.material == material]
    if slots and not thing.is_editable:
        msg = (
            f"Material {material.name!r} is on object {thing.name!r}, which is linked; make the "
            "object local first."
        )
        raise MaterialError(msg)
    name = material.name
    local = material.make_local(clear_liboverride=True)
    if local is None or not local.is_editable:
        msg = f"Material {name!r} cannot be made local; append it from its file instead."
        raise MaterialError(msg)
    for slot in slots:
        if slot.material != local:
            slot.link = "OBJECT"
            slot.material = local
    return local
