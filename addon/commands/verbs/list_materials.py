# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`list`: what the materials of a .blend hold, without rendering."""

from __future__ import annotations

import argparse
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from ...support.shown_text import inform, out, tell

if TYPE_CHECKING:
    from ...colorimetry.rgb_space import WorkingSpace

NAME = "list"
SUMMARY = "what the materials of a .blend hold, without rendering"
DESCRIPTION = (
    "Print a line a material that stores a spectrum: sample, roughness, settings, the color in its "
    "node, the predicted ΔE00, and whether the color still follows. Columns are separated by tabs "
    "and named by the first line; --json tells all that is stored. The .blend is not changed."
)

COLUMNS = (
    *("material", "sample", "kind", "instrument", "sigma_deg", "illuminant", "observer", "model"),
    *("read_at", "shader", "R", "G", "B", "roughness", "delta_e_00", "state"),
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `list`."""
    parser.add_argument(
        "--material",
        action="append",
        default=[],
        metavar="NAME",
        help="a material, repeatable, * and ? stand for any letters and any letter; without it all "
        "that store a spectrum",
    )


def run(options: argparse.Namespace) -> int:
    """Print what is stored; exit status 0, or 2 where a material is damaged."""
    import bpy

    from ...blender import working_space
    from ...material import selection, snapshot
    from ..result import add

    named = [found for name in options.material for found in selection.named(name)]
    materials = list(dict.fromkeys(named)) if options.material else selection.with_spectrum()
    space = working_space.current()
    found = [_facts(material, space) for material in materials]
    out(*COLUMNS)
    for each in found:
        out(*_row(each))
    faults = [each["fault"] for each in found if each["fault"]]
    for fault in faults:
        tell(f"rough_spectra: {fault}")
    add(
        options,
        blend=bpy.data.filepath,
        working_space=space.name,
        blender=bpy.app.version_string,
        materials=found,
    )
    stored = sum(map(snapshot.has_spectrum, bpy.data.materials))
    inform(f"{stored} of {len(bpy.data.materials)} materials store a spectrum")
    return 2 if faults else 0


def _facts(material: Any, space: WorkingSpace) -> dict[str, Any]:
    """Give all that is stored of a material, and what its node shows."""
    from ....core.errors import RoughSpectraError
    from ...instrument import stored
    from ...material import snapshot, storage

    node, derived = stored.node(material, space), stored.derivation(material)
    facts: dict[str, Any] = {
        "material": material.name,
        "library": "" if material.library is None else material.library.filepath,
        "users": material.users - material.use_fake_user,
        "stored": None,
        "node": None if node is None else asdict(node),
        "derivation": None if derived is None else asdict(derived),
        "fault": "",
    }
    if not snapshot.has_spectrum(material):
        return facts
    try:
        request = storage.load(material)
    except RoughSpectraError as error:
        return facts | {"fault": str(error)}
    sample, group = request.sample, material.rough_spectra
    facts["stored"] = {
        "sample": sample.name,
        "source": sample.source,
        "kind": sample.kind,
        "instrument": sample.instrument,
        "sigma_degrees": snapshot.sigma_degrees(group),
        "sigma_source": sample.sigma_source,
        "illuminant": request.illuminant,
        "observer": request.observer,
        "model": request.model,
        "read_at": request.read_at,
        "shader": group.shader.lower(),
        "tolerance": request.tolerance,
        "follows_scene": request.scene is not None,
        "wavelengths": sample.wavelengths.tolist(),
        "values": sample.values.tolist(),
        "gloss": [list(pair) for pair in sample.gloss],
        "readings": len(sample.readings),
    }
    return facts


def _row(facts: dict[str, Any]) -> tuple[str, ...]:
    stored, node, derived = facts["stored"] or {}, facts["node"] or {}, facts["derivation"] or {}
    color = node.get("color")
    cells = [
        *(facts["material"], stored.get("sample"), stored.get("kind"), stored.get("instrument")),
        None if not stored else f"{stored['sigma_degrees']:g}",
        *(stored.get("illuminant"), stored.get("observer"), stored.get("model")),
        *(stored.get("read_at"), node.get("shader")),
        *((None,) * 3 if color is None else (f"{value:.6f}" for value in color)),
        None if node.get("roughness") is None else f"{node['roughness']:.6f}",
        f"{derived['delta_e_instrument']:.4f}" if derived.get("state") == "fresh" else None,
        "damaged" if facts["fault"] else derived.get("state"),
    ]
    return tuple("" if cell is None else str(cell) for cell in cells)
