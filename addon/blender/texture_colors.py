# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What colors a material's texture has, seen over a flat square in a second Blender.

Any nodes may be behind a color: images of any space, procedurals, mixes and ramps of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from .background_job import Job

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array


class _Look(Job):
    """A second Blender that looks at colors."""

    doing = "looks at textures"
    interrupted = "Looking at textures was interrupted; nothing was written."
    smaller = "assign to fewer materials at once"


def seen(sockets: Sequence[Any]) -> list[Array]:
    """Give the scene-linear colors that reach sockets of materials' nodes, over a flat square.

    Parameters
    ----------
    sockets
        Linked sockets of nodes in the node trees of local materials.

    Returns
    -------
    Of each, shape (places, 3).

    Raises
    ------
    OutputError
        If the second Blender failed.
    CancelledError
        On an interrupt from the keyboard.
    """
    import numpy as np

    owners = {material.node_tree: material for material in bpy.data.materials
              if material.library is None and material.node_tree is not None}  # fmt: skip
    asked = []
    for socket in sockets:
        index = next(i for i, each in enumerate(socket.node.inputs) if each == socket)
        asked.append((owners[socket.id_data], socket.node.name, index))

    def prepare(folder: Path) -> dict[str, Any]:
        blend = folder / "materials.blend"
        bpy.data.libraries.write(
            *(str(blend), {material for material, _, _ in asked}),
            fake_user=True,
            path_remap="ABSOLUTE",
            compress=False,
        )
        listed = [(material.name, node, index) for material, node, index in asked]
        return {"blend": blend.name, "materials": listed}

    look = _Look(Path(__file__).with_name("texture_worker.py"), prepare)
    try:
        look.wait()
        return list(np.load(look.output("colors.npy")).astype(np.float64))
    finally:
        look.close()
