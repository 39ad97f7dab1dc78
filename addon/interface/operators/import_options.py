# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators that import samples have in common: their options, and carrying them out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from math import radians
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ....core.errors import RoughSpectraError
from . import giving, looking

if TYPE_CHECKING:
    from ...matching.solution import Solution
    from ...samples.importing import Found
    from ...samples.sample import Sample


MATERIALS_ITEMS = (
    ("NONE", "None", "Add to the library only", 0),
    ("ASSIGN", "Assign to Active", "Assign the highlighted sample to the active material", 1),
    ("CREATE", "Create", "Make a new material of each sample that is checked", 2),
)


class ImportOptions(looking.LooksFirst, giving.WhiteOptions, giving.AssignOptions):
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

    def carry_out(self, context: Any, chosen: Sequence[Found], active: Found) -> set[str]:
        """Do with samples what the options say, and report it; `active` is what is assigned."""
        self._chosen, self._active = chosen, active
        return looking.LooksFirst.execute(self, context)

    def work(self, context: Any) -> looking.Work:
        """Add to the library and make or set materials; nothing where looking is stopped."""
        from ...samples import importing

        white = giving.stated_white(self)
        active, *chosen = importing.relative_to((self._active, *self._chosen), *white)
        tell = partial(_tell, self, chosen)
        assigning = None
        if self.materials == "ASSIGN":
            sigma = _sigma(self, active.sample)
            assigning = looking.assignment(self, context, active.sample, tell, sigma)

        def act(materials: Sequence[Any], looked: Mapping[Any, Any]) -> str:
            said, made = self._add(chosen) if self.add_to_library else "", ""
            try:
                if assigning is not None:
                    made = assigning.act(materials, looked)
                elif self.materials == "CREATE":
                    made = tell(_create(self, _colored(self, chosen)))
            except RoughSpectraError as error:
                if not said:
                    raise
                msg = f"{error} Nonetheless, {said}."
                raise RoughSpectraError(msg) from error
            return "; ".join(filter(None, (said, made))) or rpt_("Nothing was asked for")

        nothing = looking.Work((), None, act)
        return nothing if assigning is None else assigning._replace(act=act)

    def _add(self, chosen: Sequence[Found]) -> str:
        from ...material import preferences
        from ...samples import importing

        collection = self.collection or (importing.common_name(chosen) if self.together else "")
        return importing.summary(importing.add(chosen, collection, preferences.user_folder()))


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


def _tell(operator: Any, chosen: Sequence[Found], assigned: Sequence[tuple[Any, Solution]]) -> str:
    """Report what is to be known of the materials; gives the sentence on which there are."""
    seen = {sentence for each in chosen for sentence in each.sentences}
    for material, solution in assigned:
        for warning in solution.warnings:
            if warning not in seen:
                operator.report({"WARNING"}, f"{material.name}: {warning}")
    names = ", ".join(material.name for material, _ in assigned[:3])
    if len(assigned) > 3:
        names = rpt_("{} and {} more").format(names, len(assigned) - 3)
    return rpt_("assigned to {}").format(names)


def _sigma(operator: Any, sample: Sample) -> float:
    """Give the roughness: what the file states comes before the field."""
    return operator.sigma if sample.sigma_degrees is None else radians(sample.sigma_degrees)


def _colored(operator: Any, chosen: Sequence[Found]) -> list[Found]:
    """Leave out what no material can be made from, and say so; without anything left, refuse."""
    found = [each for each in chosen if each.sample.has_color]
    if not found:
        giving.new_request(chosen[0].sample, 0.0)  # says why
    if len(found) < len(chosen):
        text = rpt_("{} samples have no color and made no material; they serve for emissivity")
        operator.report({"WARNING"}, text.format(len(chosen) - len(found)))
    return found


def _create(operator: Any, chosen: Sequence[Found]) -> list[tuple[Any, Solution]]:
    from ...blender import shader_nodes
    from ...matching import own_gloss
    from ...material import derive, storage

    requests = [giving.new_request(e.sample, _sigma(operator, e.sample)) for e in chosen]
    glosses = [own_gloss.of_sample(each.sample) for each in chosen]
    materials = [
        shader_nodes.new_material(each.sample.name, gloss is not None)
        for each, gloss in zip(chosen, glosses, strict=True)
    ]
    pairs = list(zip(materials, requests, strict=True))
    try:
        solutions = derive.assign(pairs, operator.shader, glosses=glosses)
    except RoughSpectraError:
        bpy.data.batch_remove(materials)
        raise
    for material, gloss in zip(materials, glosses, strict=True):
        if gloss is not None:
            storage.note_own_gloss(material, storage.shown_gloss(material))
        material.use_fake_user = True  # nothing uses it yet, and it is to be saved
    return list(zip(materials, solutions, strict=True))
