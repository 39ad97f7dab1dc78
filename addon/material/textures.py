# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scale the textures of materials so that their mean reads as the sample does."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ...core.errors import MaterialError, RoughSpectraError
from ..blender import shader_nodes, texture_scale
from ..blender.shader_nodes import SocketTarget
from ..blender.sockets import color_socket
from ..blender.surface import shader_node
from ..blender.texture_scale import Palette

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array
    from ..colorimetry.rgb_space import WorkingSpace
    from ..matching.request import Request
    from ..matching.solution import Solution

Work = Sequence[tuple[SocketTarget, "Request"]]
Looked = Mapping[Any, "Array"]


def to_look_at(materials: Iterable[Any], shader: str | None = None) -> list[tuple[Any, Any]]:
    """Give the materials whose color is a texture, with the socket that it reaches.

    Parameters
    ----------
    materials
        Each a `bpy.types.Material`.
    shader
        That is asked for; None for the setting of each.

    Where one of them cannot be written there are none: whoever writes says why.
    """
    found = []
    try:
        for material in materials:
            place = shader_nodes.find(material, shader or material.rough_spectra.shader)
            if place.texture is not None:
                found.append((material, place.texture))
    except RoughSpectraError:
        return []
    return found


def scaled(
    work: Work,
    solutions: list[Solution],
    space: WorkingSpace,
    look_again: bool = True,
    looked: Looked | None = None,
) -> tuple[list[Palette | None], list[Solution], list[Solution]]:
    """Find the scale of each material's texture; materials without one stay as they are.

    Parameters
    ----------
    work, solutions
        Materials, what they are to become, and what was solved for one color all over.
    space
        The working space.
    look_again
        Whether textures are looked at even where it is known what they were: that takes a second
        Blender, and a dragged slider has no time for it.
    looked
        Colors of textures that somebody has looked at just before, (places, 3), by material.

    Returns
    -------
    palettes
        To be kept with the scale, or None.
    solutions
        With what is to be known of the texture; the color is the one whose reading the mean is.
    written
        With the scale in place of the color.

    Raises
    ------
    MaterialError
        If a texture is black wherever it was looked at.
    OutputError
        If the second Blender failed.
    """
    textured = [i for i, (place, _) in enumerate(work) if place.texture is not None]
    palettes: list[Palette | None] = [None] * len(work)
    found, written = list(solutions), list(solutions)
    if not textured:
        return palettes, found, written
    from ...core.cycles import instrument_lobe
    from ..matching import texture_scale as solving

    known = dict.fromkeys(textured) if look_again else {i: _kept(work[i][0]) for i in textured}
    palettes = _seen(work, known, looked or {})
    for i in textured:
        request, solution, palette = work[i][1], solutions[i], palettes[i] or known[i]
        assert palette is not None
        color, roughness, read_at = solution.color, solution.roughness, request.read_at
        target = instrument_lobe.reflectance(color, roughness, read_at)
        scale = solving.solve(
            palette.channels,
            palette.colors,
            palette.weights,
            target,
            roughness,
            space,
            request.illuminant,
            read_at,
        )
        found[i] = replace(
            solution,
            delta_e_instrument=max(solution.delta_e_instrument, scale.delta_e),
            warnings=(*solution.warnings, *scale.notes),
        )
        written[i] = replace(found[i], color=scale.factors)
    return palettes, found, written


def _kept(place: SocketTarget) -> Palette | None:
    return texture_scale.kept_palette(color_socket(shader_node(place.material)))


def _seen(work: Work, known: dict[int, Palette | None], looked: Looked) -> list[Palette | None]:
    """Look at the textures that are not known; gives their palettes."""
    palettes: list[Palette | None] = [None] * len(work)
    unknown = [i for i, palette in known.items() if palette is None]
    if not unknown:
        return palettes
    from ..blender import texture_colors
    from ..matching import texture_scale as solving

    colors_of = {i: looked[work[i][0].material] for i in unknown if work[i][0].material in looked}
    open_ones = [i for i in unknown if i not in colors_of]
    if open_ones:
        seen = texture_colors.seen([work[i][0].texture for i in open_ones])
        colors_of |= dict(zip(open_ones, seen, strict=True))
    for i in unknown:
        colors = colors_of[i]
        if not colors.max() > 0:
            msg = (
                f"Material {work[i][0].material.name!r}: its texture is black wherever it was "
                "looked at, as color attributes are; unlink it, or link one that shows."
            )
            raise MaterialError(msg)
        palettes[i] = Palette(*solving.palette(colors))
    return palettes
