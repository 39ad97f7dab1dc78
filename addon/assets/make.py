# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fill the open, empty file with materials marked as assets. Runs in the second Blender."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ...core import instruments
from ..blender import shader_nodes, sockets
from ..instrument.worker import end_if_orphaned, report
from ..matching import own_gloss
from ..matching.request import Request
from ..material import derive
from ..samples.readers.formats import library as library_format
from . import previews

if TYPE_CHECKING:
    from ..matching.solution import Solution
    from ..samples.sample import Sample

BLEND = "assets.blend"
RESULT = "result.json"
"""Files that a job leaves; the second is the last one, and holds the warnings by material."""

_SUMMARY = 1000
"""Characters of a citation in a description: some libraries cite twenty authors."""


def run(job: dict[str, Any], folder: Path) -> None:
    """Make what the job lists and save it in the job's folder."""
    entries = job["assets"]
    requests = [_request(entry, job) for entry in entries]
    materials = [
        _material(entry["name"], request.sample, job["shader"])
        for entry, request in zip(entries, requests, strict=True)
    ]
    solutions = derive.assign(list(zip(materials, requests, strict=True)), job["shader"])
    for material, entry, request, solution in zip(
        materials, entries, requests, solutions, strict=True
    ):
        _mark(material, entry, request, solution)
    report(folder, 0, len(materials))
    for done, (material, picture) in enumerate(previews.render(materials, folder), start=1):
        previews.put(material, picture)
        report(folder, done, len(materials))
        end_if_orphaned(job["asked_by"], folder)
    bpy.ops.wm.save_as_mainfile(
        filepath=str(folder / BLEND), check_existing=False, compress=True, copy=True
    )
    warnings = {m.name: s.warnings for m, s in zip(materials, solutions, strict=True)}
    (folder / RESULT).write_text(
        json.dumps({name: found for name, found in warnings.items() if found}), encoding="utf-8"
    )


def _material(name: str, sample: Sample, shader: str) -> Any:
    """Make a material that has the sample's own gloss where its shader has any, else no node."""
    material = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    material.node_tree.nodes.clear()  # a new material has a shader that nobody asked for
    place = shader_nodes.find(material, shader)
    gloss = own_gloss.of_sample(sample) if sockets.OF_NODE[place.make].gloss else None
    if gloss is not None:
        shader_nodes.write(place, (0.0, 0.0, 0.0), 0.0)
        shader_nodes.put_gloss(material, gloss)
    return material


def _request(entry: dict[str, Any], job: dict[str, Any]) -> Request:
    return Request(
        sample=library_format.sample_of(entry["sample"], entry["name"]),
        sigma=entry["sigma"],
        model=job["model"],
        illuminant=job["illuminant"],
        observer=job["observer"],
        read_at=job["read_at"],
    )


def _mark(material: Any, entry: dict[str, Any], request: Request, solution: Solution) -> None:
    sample = request.sample
    material.asset_mark()
    asset = material.asset_data
    asset.catalog_id = entry["catalog_id"]
    asset.author = entry["author"]
    asset.license = sample.license
    asset.copyright = _shortened(sample.source)
    asset.description = _description(request, solution)
    for tag in ("Rough Spectra", entry["catalog"], f"σ {sample.sigma_degrees:g}°", sample.kind):
        asset.tags.new(tag, skip_if_exists=True)


def _description(request: Request, solution: Solution) -> str:
    """Say what an artist wants to know: σ, how close the material comes, and whose numbers."""
    sample, where = request.sample, instruments.spoken(request.read_at)
    return "\n".join(
        (
            f"σ {sample.sigma_degrees:g}°: {sample.sigma_source}",
            f"Predicted ΔE00: {solution.delta_e_instrument:.2f} at {where}, over all angles mean "
            f"{solution.delta_e_mean:.2f}, 95 % {solution.delta_e_95:.2f}.",
            *([f"Gloss: {sample.gloss_source}"] if sample.gloss_source else []),
            f"Source: {_shortened(sample.source)}",
            *sample.notes,
            *solution.warnings,
        )
    )


def _shortened(text: str) -> str:
    return text if len(text) <= _SUMMARY else f"{text[: _SUMMARY - 1]}…"
