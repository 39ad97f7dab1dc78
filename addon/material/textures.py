# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scale the textures of materials so that their mean reads as the sample does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from ...core.errors import MaterialError
from ..blender import texture_scale
from ..blender.shader_nodes import SocketTarget
from ..blender.sockets import color_socket
from ..blender.surface import shader_node
from ..blender.texture_scale import Palette

if TYPE_CHECKING:
    from ..colorimetry.rgb_space import WorkingSpace
    from ..matching.request import Request
    from ..matching.solution import Solution

Work = Sequence[tuple[SocketTarget, "Request"]]


def scaled(
    work: Work, solutions: list[Solution], space: WorkingSpace, look_again: bool = True
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
    palettes = _seen(work, known)
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


def _seen(work: Work, known: dict[int, Palette | None]) -> list[Palette | None]:
    """Look at the textures that are not known; gives their palettes."""
    palettes: list[Palette | None] = [None] * len(work)
    unknown = [i for i, palette in known.items() if palette is None]
    if not unknown:
        return palettes
    from ..blender import texture_colors
    from ..matching import texture_scale as solving

    looked = texture_colors.seen([work[i][0].texture for i in unknown])
    for i, colors in zip(unknown, looked, strict=True):
        if not colors.max() > 0:
            msg = (
                f"Material {work[i][0].material.name!r}: its texture is black over a flat "
                "square, as color attributes are there; unlink it, or link one that shows."
            )
            raise MaterialError(msg)
        palettes[i] = Palette(*solving.palette(colors))
    return palettes
