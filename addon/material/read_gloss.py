# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The gloss that a sample's readings tell, for a material that is to have it."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ...core.errors import DomainError
from ...core.gloss import Gloss
from ..blender import shader_nodes
from ..matching import shaders

if TYPE_CHECKING:
    from ..samples.sample import Sample

WITH_GLOSS = "PRINCIPLED"
"""The shader that can have it."""

_FITS = 0.05
"""Relative misfit up to which a lobe is said to fit."""


def of_all(
    pairs: Sequence[tuple[Any, Sample]], wanted: Sequence[str]
) -> list[tuple[Gloss | None, tuple[str, ...]]]:
    """Find the gloss of each material's sample, with what is to be said of it.

    `wanted` has the shader that is asked for in each.

    Coat, IOR and tint stay as the node has them. None where the readings say nothing of gloss, or
    that there is none: then the material keeps what it has.

    Raises
    ------
    MaterialError, DomainError
        As of `shader_nodes.find`.
    """
    return [
        _of_one(material, sample, shader)
        for (material, sample), shader in zip(pairs, wanted, strict=True)
    ]


def _of_one(material: Any, sample: Sample, shader: str) -> tuple[Gloss | None, tuple[str, ...]]:
    from ..samples import gloss_of_set

    if not gloss_of_set.tells(sample):
        return None, ()
    if shader not in (shaders.AUTO, WITH_GLOSS):
        msg = (
            f"Material {material.name!r}: a {shader} BSDF has no gloss; ask for a Principled BSDF."
        )
        raise DomainError(msg)
    base = shader_nodes.gloss_at(shader_nodes.find(material, WITH_GLOSS)) or Gloss()
    try:
        found = gloss_of_set.estimate(sample, gloss=base)
    except DomainError as error:
        return None, (f"The gloss stays as it was: {error}",)
    # As the sockets hold it: what is matched has to be what is there afterwards.
    level, roughness = array("f", (found.gloss.level, found.gloss.roughness))
    told = [_NOT_ALL.format(100 * found.misfit)] if found.misfit > _FITS else []
    return found.gloss._replace(level=level, roughness=roughness), tuple(told)


_NOT_ALL = "No gloss of one lobe reads all that the set says of it: it is off by up to {:.0f} %."
