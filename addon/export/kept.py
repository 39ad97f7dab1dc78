# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender's own exporters make of a material, and how far that is from its target.

Both know a Principled BSDF without its diffuse roughness, so that Lambert's law is left below the
gloss. glTF's finds nothing in a Diffuse BSDF, and white is what it then writes. USD's takes the
first Principled or Diffuse BSDF among the nodes, in use or not; a preview surface knows no level of
its gloss, and what has none comes back with the usual one. tests/addon/test_export.py holds
it to what Blender 4.5 and 5.2 import again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ...core.color import color_difference
from ...core.cycles import gloss_reading
from ...core.errors import RoughSpectraError
from ...core.gloss import Gloss
from ...core.numerics import direction_grid
from ...core.numerics.arrays import Array
from ..blender import shader_nodes, working_space
from ..blender.sockets import OF_SHADER, color_socket, roughness_socket
from ..matching import assess, glossy, solve, surface_spectra
from ..material import settled, snapshot

_USUAL = Gloss(level=0.5)
"""Of a Principled BSDF that nobody set, with a roughness of its own each time."""
_WHITE_METAL = Gloss(level=12.5, roughness=1.0)
"""What glTF has for a material that says nothing: facets at this level reflect all light."""
_DIFFUSE, _PRINCIPLED = (OF_SHADER[name].node for name in ("DIFFUSE", "PRINCIPLED"))
_REMEDY = "use Rough Spectra's own export, or a Principled BSDF without roughness"


@dataclass(frozen=True)
class Loss:
    """What an exporter of Blender's makes of a material, where that is seen.

    Parameters
    ----------
    material, exporter
        Names; the exporter is "glTF" or "USD".
    delta_e_instrument, delta_e_mean
        ΔE00 between what is imported again, and the target: at the virtual instrument, and the
        mean over the hemisphere.
    sentence
        Says so, with what to do.
    """

    material: str
    exporter: str
    delta_e_instrument: float
    delta_e_mean: float
    sentence: str


class _Imported(NamedTuple):
    """Color, shape (3,), and gloss that come back, and what became of the material in words."""

    color: Array
    gloss: Gloss | None
    words: str


def losses(materials: Iterable[Any], exporters: Iterable[str] = ()) -> list[Loss]:
    """Tell what Blender's exporters would lose of materials, where it is seen.

    Parameters
    ----------
    materials
        Of `bpy.types.Material`; those without a spectrum have nothing to lose.
    exporters
        "glTF" or "USD"; without any, both.

    Returns
    -------
    One for each material and exporter that end farther apart than the material's own tolerance, at
    the instrument or in the mean.
    """
    found: list[Loss] = []
    for material in dict.fromkeys(materials):
        if snapshot.has_spectrum(material):
            for exporter in tuple(exporters) or tuple(_EXPORTERS):
                found += _losses(material, exporter)
    return found


def _losses(material: Any, exporter: str) -> Iterator[Loss]:
    try:
        request = settled.of(material).request
    except RoughSpectraError:
        return  # what cannot be read has no target; other places say so
    node = shader_nodes.shader_node(material)
    if node is None:
        return
    back = _EXPORTERS[exporter](material, node)
    request = replace(request, scene=None, flat=False)
    at, mean = _apart(request, back)
    if max(at, mean) <= request.tolerance:
        return
    sentence = (
        f"Material {material.name!r}: Blender's {exporter} exporter {back.words}, which is ΔE00 "
        f"{at:.1f} at {request.read_at} and {mean:.1f} in the mean over all angles; {_REMEDY}."
    )
    yield Loss(material.name, exporter, at, mean, sentence)


def _apart(request: solve.Request, back: _Imported) -> tuple[float, float]:
    """ΔE00 at the instrument, and its mean over the hemisphere."""
    space, read_at = working_space.current(), request.read_at
    angles = direction_grid.hemisphere(solve.MATCH_GEOMETRIES)
    [read], [albedo] = surface_spectra.readings_and_albedos([request])
    spectra = np.vstack((assess.in_directions(request, albedo, angles), read))
    rgb = spectra @ space.rgb_weights(request.sample.wavelengths, request.illuminant)
    targets = glossy.target(request.gloss, rgb[-1], rgb[:-1], angles, read_at)
    flat = np.tile(back.color, (angles[0].size, 1))
    shown = glossy.over(back.gloss, flat, angles)
    at = gloss_reading.reading(back.color, back.gloss, read_at)
    apart = color_difference.delta_e(
        space.to_lab(np.vstack((shown, at)), request.illuminant),
        space.to_lab(np.vstack((targets, rgb[-1])), request.illuminant),
    )
    return float(apart[-1]), float(apart[:-1].mean())


def _by_gltf(_material: Any, node: Any) -> _Imported:
    if node.bl_idname == _PRINCIPLED:
        gloss = shader_nodes.gloss_of(node)
        return _Imported(_color(node), gloss, "drops its diffuse roughness")
    return _Imported(np.ones(3), _WHITE_METAL, f"makes its {node.bl_label} white")


def _by_usd(material: Any, used: Any) -> _Imported:
    kinds = (_PRINCIPLED, _DIFFUSE)
    node = next(each for each in material.node_tree.nodes if each.bl_idname in kinds)
    rough = node.inputs["Roughness"].default_value
    gloss = _USUAL._replace(roughness=float(np.clip(rough, 0, 1)))
    if node.bl_idname == _PRINCIPLED:
        gloss = gloss._replace(ior=node.inputs["IOR"].default_value)
    if node != used:
        return _Imported(_color(node), gloss, f"takes {node.name!r}, which is not in use")
    if node.bl_idname == _DIFFUSE:
        return _Imported(_color(node), gloss, "takes its roughness for that of a gloss")
    own = shader_nodes.gloss_of(node)
    words = "drops its diffuse roughness" if roughness_socket(node).default_value else ""
    if own is None or own.level != _USUAL.level:
        words = f"{words} and gives it" * bool(words) or "gives it"
        words += " a gloss of the level 0.5"
    return _Imported(_color(node), gloss, words or "changes it")


def _color(node: Any) -> Array:
    return np.clip(np.array(color_socket(node).default_value[:3]), 0.0, 1.0)


_EXPORTERS: dict[str, Callable[[Any, Any], _Imported]] = {"glTF": _by_gltf, "USD": _by_usd}
