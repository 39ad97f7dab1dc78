# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let materials follow an analysis of their scene, and tell what that changes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core.errors import InputError, MaterialError
from ..blender import working_space
from ..matching import solve
from ..matching.solution import Solution
from ..material import (
    derive,
    settled,
    snapshot,
    state,
    storage,
)
from .analysis import SceneReport


@dataclass(frozen=True)
class Change:
    """What following the scene did to one material.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    before
        Mean ΔE00 over the scene's lights and directions of what its shader showed, or None where
        that cannot be said, as with gloss.
    solution
        What was matched.
    """

    material: Any
    before: float | None
    solution: Solution


def candidates(report: SceneReport, materials: Sequence[Any] | None = None) -> list[Any]:
    """Give the materials with a spectrum that the analysis saw in light, sorted by name.

    Raises
    ------
    InputError
        If there is none; the sentence says why.
    """
    wanted = list(report.pixels) if materials is None else list(materials)
    measured = [material for material in wanted if snapshot.has_spectrum(material)]
    if not measured:
        where = "in view" if materials is None else "chosen"
        msg = f"No material {where} has a measured spectrum; assign one first."
        raise InputError(msg)
    found = [material for material in measured if material in report.views]
    if not found:
        names = ", ".join(material.name for material in measured[:5])
        if any(material in report.unlit for material in measured):
            msg = f"No light reaches {names}; add a light, or turn one on."
        else:
            msg = f"{names}: not in the picture; turn the camera to it."
        raise InputError(msg)
    return sorted(found, key=lambda material: str(material.name))


def choose(
    report: SceneReport, materials: Sequence[Any] | None = None, overwrite_edits: bool = False
) -> tuple[list[Any], list[str]]:
    """Give the `candidates` that may be written, and a sentence for each that is left as it is.

    Edits by hand are spared unless they are to be overwritten. What cannot be written, such as a
    linked material, only holds up the others where it was asked for.

    Raises
    ------
    RoughSpectraError
        If none is left.
    """
    found = candidates(report, materials)
    sentences = []
    if not overwrite_edits:
        edited = [material for material in found if state.edited_by_hand(material)]
        found = [material for material in found if material not in edited]
        sentences = [
            f"{material.name} was edited by hand and is left so; renew it, or overwrite edits."
            for material in edited
        ]
    if materials is None:
        found, refused = derive.renewable(found, report.views)
        sentences += refused
    if not found:
        raise MaterialError(sentences[0])
    return found, sentences


def follow(report: SceneReport, materials: Sequence[Any] | None = None) -> list[Change]:
    """Match materials to what an analysis found, all or none.

    Parameters
    ----------
    report
        What `analysis.analyze` gave.
    materials
        The only ones that are to follow; None for all in view that store a spectrum.

    Raises
    ------
    RoughSpectraError
        If there is nothing to match, or a material cannot be written; nothing was changed then.
    """
    chosen = candidates(report, materials)
    before = [_mean_now(report, material) for material in chosen]
    solutions = derive.follow_scene({material: report.views[material] for material in chosen})
    return [Change(*row) for row in zip(chosen, before, solutions, strict=True)]


def table(report: SceneReport, changes: Sequence[Change]) -> list[str]:
    """Lines of text: each material with its lights, and ΔE00 before and after."""
    lines = [f"{'material':24} {'light':32} {'share':>6} {'before':>7} {'after':>7}"]
    for change in changes:
        before = "" if change.before is None else f"{change.before:.2f}"
        name = change.material.name
        lines.append(
            f"{name:24} {'all':32} {'':>6} {before:>7} {change.solution.delta_e_mean:7.2f}"
        )
        apart = dict(change.solution.delta_e_lights)
        lines += [
            f"{'':24} {light.name + ', ' + light.words:32.32} {light.share:6.0%} {'':>7} "
            f"{apart.get(light.name, 0.0):7.2f}"
            for light in report.views[change.material].lights
        ]
    return lines


def _mean_now(report: SceneReport, material: Any) -> float | None:
    found = snapshot.of(material)
    if settled.obstacle(found.surface) is not None:
        return None
    color, roughness = settled.shader(material, found)
    view, rough = report.views[material], 0.0 if found.flat else roughness
    request, space = storage.load(material, view), working_space.current()
    apart = solve.differences(request, view, color, rough, space)
    return float(np.average(apart, weights=view.place_weights))


def unlit_sentence(report: SceneReport) -> str:
    """Say which materials with a spectrum no lamp reaches directly; empty if none."""
    names = [material.name for material in report.unlit if snapshot.has_spectrum(material)]
    if not names:
        return ""
    return (
        f"No lamp reaches {', '.join(sorted(names))} but by way of other surfaces: matched to all "
        "lights of the picture, from all around."
    )
