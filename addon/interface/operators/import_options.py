# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators that import samples have in common: their options, and carrying them out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import radians
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ....core.errors import RoughSpectraError
from . import common

if TYPE_CHECKING:
    from ...matching.solution import Solution
    from ...samples.importing import Found
    from ...samples.sample import Sample


MATERIALS_ITEMS = (
    ("NONE", "None", "Add to the library only", 0),
    ("ASSIGN", "Assign to Active", "Assign the highlighted sample to the active material", 1),
    ("CREATE", "Create", "Make a new material of each sample that is checked", 2),
)


class ImportOptions(common.WhiteOptions, common.AssignOptions):
    """What to do with the samples of measurement files."""

    add_to_library: BoolProperty(
        name="Add to Library", description="Keep the samples in your library", default=True
    )
    collection: StringProperty(
        name="Collection", description="Where in the library; empty takes each file's name"
    )
    together: BoolProperty(
        name="One Collection",
        description="Put the samples of all files into one collection, called as their folder",
    )
    materials: EnumProperty(
        name="Materials", description="What to make of the samples", items=MATERIALS_ITEMS
    )


@contextmanager
def waiting(context: Any) -> Iterator[None]:
    """Show the wait cursor for the block, where there is a window."""
    if context.window is None or bpy.app.background:
        yield
        return
    context.window.cursor_set("WAIT")
    try:
        yield
    finally:
        context.window.cursor_set("DEFAULT")


def carry_out(operator: Any, context: Any, chosen: Sequence[Found], active: Found) -> set[str]:
    """Do with samples what the operator's `ImportOptions` say, and report it."""
    from ...material import preferences
    from ...samples import importing

    said = ""
    assigned: list[tuple[Any, Solution]] = []
    try:
        white = common.stated_white(operator)
        active, *chosen = importing.relative_to((active, *chosen), *white)
        if operator.add_to_library:
            collection = operator.collection or (
                importing.common_name(chosen) if operator.together else ""
            )
            added = importing.add(chosen, collection, preferences.user_folder())
            said = importing.summary(added)
        if operator.materials == "ASSIGN":
            request = common.new_request(active.sample, _sigma(operator, active.sample))
            assigned = common.assign_in_scope(context, operator.scope, request, operator.shader)
        elif operator.materials == "CREATE":
            assigned = _create(operator, _colored(operator, chosen))
    except RoughSpectraError as error:
        common.report_error(operator, f"{error} Nonetheless, {said}." if said else error)
        return {"CANCELLED"}
    seen = {sentence for each in chosen for sentence in each.sentences}
    for material, solution in assigned:
        for warning in solution.warnings:
            if warning not in seen:
                operator.report({"WARNING"}, f"{material.name}: {warning}")
    names = ", ".join(material.name for material, _ in assigned[:3])
    if len(assigned) > 3:
        names = rpt_("{} and {} more").format(names, len(assigned) - 3)
    made = rpt_("assigned to {}").format(names) if assigned else ""
    told = "; ".join(filter(None, (said, made))) or rpt_("Nothing was asked for")
    operator.report({"INFO"}, told)
    return {"FINISHED"}


def _sigma(operator: Any, sample: Sample) -> float:
    """Give the roughness: what the file states comes before the field."""
    return operator.sigma if sample.sigma_degrees is None else radians(sample.sigma_degrees)


def _colored(operator: Any, chosen: Sequence[Found]) -> list[Found]:
    """Leave out what no material can be made from, and say so; without anything left, refuse."""
    found = [each for each in chosen if each.sample.has_color]
    if not found:
        common.new_request(chosen[0].sample, 0.0)  # says why
    if len(found) < len(chosen):
        text = rpt_("{} samples have no color and made no material; they serve for emissivity")
        operator.report({"WARNING"}, text.format(len(chosen) - len(found)))
    return found


def _create(operator: Any, chosen: Sequence[Found]) -> list[tuple[Any, Solution]]:
    from ...blender import shader_nodes
    from ...material import derive

    requests = [common.new_request(e.sample, _sigma(operator, e.sample)) for e in chosen]
    materials = [shader_nodes.new_material(each.sample.name) for each in chosen]
    try:
        solutions = derive.assign(list(zip(materials, requests, strict=True)), operator.shader)
    except RoughSpectraError:
        bpy.data.batch_remove(materials)
        raise
    for material in materials:
        material.use_fake_user = True  # nothing uses it yet, and it is to be saved
    return list(zip(materials, solutions, strict=True))
