# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The target shaders: nodes that can be made to read like a sample, one file each.

A shader is added by its file here, with a `SHADER`, and by the map of its node's sockets in
`addon.blender.sockets`. Everything that lists shaders follows: the menus of the panel and of the
operators, the options of the command line, and the sentences that name them.

Blender reads this at its start: nothing here may import numpy.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ....core.errors import DomainError
from ...support.discovery import modules
from ..target_shader import TargetShader

AUTO = "AUTO"
"""Asks for the shader that is there, whichever of them it is."""

_FOUND: list[TargetShader] = [module.SHADER for module in modules(__name__, __path__)]

REGISTRY: Mapping[str, TargetShader] = MappingProxyType(
    {shader.name: shader for shader in sorted(_FOUND, key=lambda shader: shader.number)}
)
"""Every target shader by its name, in the order of their numbers."""

NAMES = tuple(REGISTRY)

DEFAULT = next(shader for shader in REGISTRY.values() if shader.is_default)
"""The one that is made where a material has none."""


def find(name: str) -> TargetShader:
    """Give the target shader of this name; of `AUTO`, the one that is made where none is.

    Raises
    ------
    DomainError
        If there is none; the message lists the names.

    Examples
    --------
    >>> find("PRINCIPLED").title
    'Principled BSDF'
    """
    if name == AUTO:
        return DEFAULT
    if name not in REGISTRY:
        msg = f"Shader {name!r} is not known; choose one of: {', '.join((AUTO, *REGISTRY))}."
        raise DomainError(msg)
    return REGISTRY[name]


def listed() -> str:
    """Name all of them for a sentence.

    Examples
    --------
    >>> listed()
    'Diffuse or Principled BSDF'
    """
    *others, last = (shader.title for shader in REGISTRY.values())
    return f"{', '.join(title.removesuffix(' BSDF') for title in others)} or {last}"
