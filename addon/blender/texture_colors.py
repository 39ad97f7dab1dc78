# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What colors a material's texture has, seen in a second Blender.

Any nodes may be behind a color: images of any space, procedurals, mixes and ramps of them. What
goes by UVs is looked at where the objects with the material show it; all else over a flat square.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ...core.errors import MaterialError
from . import uv_coverage
from .background_job import Job, waited

SIDE = 355
"""Tiles of a side, each a place in the UV maps. Half as many as the square has places: a tile costs
more, and places that follow no grid need fewer."""

_IMAGES = ("ShaderNodeTexImage", "ShaderNodeTexEnvironment")

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array


class Look(Job):
    """A second Blender that looks at the colors that reach sockets of materials' nodes.

    Parameters
    ----------
    sockets
        Linked sockets of nodes in the node trees of local materials.

    Raises
    ------
    MaterialError
        If an image on the way is missing.
    OutputError
        As in `Job`.
    """

    doing = "looks at textures"
    interrupted = "Looking at textures was interrupted; nothing was written."
    smaller = "assign to fewer materials at once"

    def __init__(self, sockets: Sequence[Any]) -> None:
        owners = {
            material.node_tree: material
            for material in bpy.data.materials
            if material.library is None and material.node_tree is not None
        }
        asked = []
        for socket in sockets:
            index = next(i for i, each in enumerate(socket.node.inputs) if each == socket)
            asked.append((owners[socket.id_data], socket.node.name, index))
            _refuse_missing(owners[socket.id_data], socket)

        def prepare(folder: Path) -> dict[str, Any]:
            blend = folder / "materials.blend"
            bpy.data.libraries.write(
                *(str(blend), {material for material, _, _ in asked}),
                fake_user=True,
                path_remap="ABSOLUTE",
                compress=False,
            )
            listed = [
                (material.name, node, index, _leave_places(folder, number, material))
                for number, (material, node, index) in enumerate(asked)
            ]
            return {"blend": blend.name, "materials": listed, "side": SIDE}

        super().__init__(Path(__file__).with_name("texture_worker.py"), prepare)

    def colors(self) -> list[Array]:
        """Give the scene-linear colors of each socket, (places, 3), once `poll` says it has ended.

        Raises
        ------
        OutputError
            If the second Blender failed.
        """
        import numpy as np

        with np.load(self.output("colors.npz")) as found:
            return [colors.astype(np.float64) for colors in found.values()]


def seen(sockets: Sequence[Any]) -> list[Array]:
    """Look and wait; as `Look`.

    Raises
    ------
    OutputError
        If the second Blender failed.
    CancelledError
        On an interrupt from the keyboard.
    """
    with waited(Look(sockets)) as look:
        return look.colors()


def _refuse_missing(material: Any, socket: Any) -> None:
    """Refuse a texture without its image: renders show magenta in its place."""
    waiting, seen = [link.from_node for link in socket.links], set()
    while waiting:
        node = waiting.pop()
        if node in seen:
            continue
        seen.add(node)
        waiting += [link.from_node for each in node.inputs for link in each.links]
        if node.bl_idname not in _IMAGES:
            continue
        where = f"Material {material.name!r}, node {node.name!r}"
        if node.image is None:
            msg = f"{where} has no image; choose one, or unlink the node."
            raise MaterialError(msg)
        if is_missing(node.image):
            msg = (
                f"{where}: the file of image {node.image.name!r} is missing; find it (File ▸ "
                "External Data ▸ Find Missing Files), or unlink the node."
            )
            raise MaterialError(msg)


def is_missing(image: Any) -> bool:
    """Whether the file of an image is not there: renders show magenta then."""
    if image.source != "FILE" or image.packed_file is not None:
        return False
    return not Path(bpy.path.abspath(image.filepath, library=image.library)).is_file()


def _leave_places(folder: Path, number: int, material: Any) -> list[str]:
    """Leave where to look for the second Blender; gives the UV maps' names, none for a square."""
    import numpy as np

    places = uv_coverage.places(material, SIDE**2)
    if places is None:
        return []
    np.save(folder / f"places-{number}.npy", np.stack(list(places.values())).astype(np.float32))
    return list(places)
