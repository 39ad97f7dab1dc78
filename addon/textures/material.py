# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the material that shows a texture of colors."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy

from ...core.errors import MaterialError
from ..blender import working_space
from ..blender.sockets import color_socket, roughness_socket
from .wanted import Made, Wanted

_APART = 300.0
"""Between nodes."""


def make(made: Made, name: str = "", part: Path | None = None) -> Any:
    """Make a material of a Diffuse BSDF that shows a texture.

    Parameters
    ----------
    made
        Its texture holds colors, so that every pixel reads what was measured.
    name
        Of the material; empty for that of the texture's file.
    part
        Where the texture lies until it is published; None where it has its place.

    Raises
    ------
    MaterialError
        If there is a material of this name, or the texture holds albedo, which Cycles' Diffuse
        shows too bright or too dark.
    """
    name = name or made.path.stem
    check(made.path, made.wanted, name)
    material = bpy.data.materials.new(name)
    material.use_fake_user = True  # nothing uses it yet, and it is to be saved
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
    picture = tree.nodes.new("ShaderNodeTexImage")
    shader.location, picture.location = (-_APART, 0), (-2 * _APART, 0)
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    tree.links.new(picture.outputs["Color"], color_socket(shader))
    roughness_socket(shader).default_value = made.roughness
    picture.image = _image(made.path, part)
    return material


def check(path: Path, wanted: Wanted, name: str) -> None:
    """Refuse what `make` does, before there is a texture.

    Raises
    ------
    MaterialError
        As in `make`.
    """
    if wanted.holds != "color":
        msg = f"{path} holds albedo, and a material needs colors; make it with holds='color'."
        raise MaterialError(msg)
    if bpy.data.materials.get((name, None)) is not None:
        msg = f"There is a material {name!r} already; give the new one another name."
        raise MaterialError(msg)


def free_name(name: str) -> str:
    """Give this name, or with a number where a material is called so already."""
    found, number = name, 0
    while bpy.data.materials.get((found, None)) is not None:
        number += 1
        found = f"{name}.{number:03d}"
    return found


def _image(path: Path, part: Path | None) -> Any:
    if part is None or path.is_file():
        image = bpy.data.images.load(str(path.absolute()), check_existing=True)
        image.reload()
    else:
        image = bpy.data.images.load(str(part.absolute()))
        image.name, image.filepath = path.name, str(path.absolute())
        image.alpha_mode = "PREMUL"  # as Blender loads what is called .exr
    settings = image.colorspace_settings
    space = working_space.working_space_name()
    known = settings.bl_rna.properties["name"].enum_items
    # By its name Blender converts it when the file's working space changes.
    settings.name = space if space in known else "Non-Color"
    return image
