# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Assign a sample of a measurement file."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import EnumProperty, StringProperty

from ....core.errors import InputError, RoughSpectraError
from ...material.properties import KIND_ITEMS
from . import common, giving, looking, targets

_KIND_ITEMS = (
    (giving.AS_FILE, "As in the File", "What the file says; a reading if it says nothing", 2),
    *KIND_ITEMS,
)
_items: list[tuple[str, str, str]] = []
"""Blender keeps no reference to dynamic enumeration texts; without this list they are freed."""


def sample_items(_operator: Any, _context: Any) -> list[tuple[str, str, str]]:
    """List the samples of the file that was read last."""
    return _items


class ROUGHSPECTRA_OT_assign_file(
    looking.LooksFirst, giving.WhiteOptions, giving.AssignOptions, bpy.types.Operator
):
    """Take the color from a file that an instrument wrote; its spectrum is kept in the material"""

    bl_idname = "rough_spectra.assign_file"
    bl_label = "Assign from File"  # the file browser's button holds no more
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 1, 3

    filepath: StringProperty(
        name="File", description="Spectra that an instrument wrote", subtype="FILE_PATH"
    )
    sample: StringProperty(name="Sample", description="Name of the sample, if the file has several")
    kind: EnumProperty(
        name="Kind",
        description="What the spectrum is",
        items=_KIND_ITEMS,
        default=giving.AS_FILE,
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need something that can carry a material."""
        return targets.can_have_material(cls, context)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user choose the file."""
        giving.begin(self, context)
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw(self, _context: Any) -> None:
        """Draw the options beside the files."""
        giving.draw_in_browser(self, ("sample", "kind", "sigma", "shader", "scope"))

    def execute(self, context: Any) -> set[str]:
        """Ask which sample if there are several, or go on."""
        from ...samples import readers

        try:
            self._samples = readers.read(bpy.path.abspath(self.filepath))
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        if len(self._samples) > 1 and not self.sample and not bpy.app.background:
            return self._ask(self._samples)
        return super().execute(context)

    def work(self, context: Any) -> looking.Work:
        """Assign to all materials in scope, or to none."""
        from ...samples import sets, stated_white

        sample = choose(self._samples, self.sample, self.filepath)
        if self.kind != giving.AS_FILE:
            sample = sample.taken_as(self.kind)
        sample = stated_white.given(sample, *giving.stated_white(self))

        def tell(assigned: Any) -> str:
            for note in (*sample.notes, *sets.sentences(sample)):
                self.report({"WARNING"}, f"{sample.name}: {note}")
            return giving.told_of(self, assigned, sample)

        return looking.assignment(self, context, sample, tell)

    def _ask(self, samples: list[Any]) -> set[str]:
        _items[:] = [(s.name, s.name, f"{s.position} of the file") for s in samples]
        bpy.ops.rough_spectra.assign_file_sample("INVOKE_DEFAULT", **_options(self))
        return {"CANCELLED"}


class ROUGHSPECTRA_OT_assign_file_sample(
    giving.WhiteOptions, giving.AssignOptions, bpy.types.Operator
):
    """Choose one of a measurement file's samples for the material"""

    bl_idname = "rough_spectra.assign_file_sample"
    bl_label = "Assign Sample of File"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}
    bl_property = "sample"

    filepath: StringProperty(name="File", description="Spectra that an instrument wrote")
    sample: EnumProperty(name="Sample", description="Sample of the file", items=sample_items)
    kind: EnumProperty(
        name="Kind",
        description="What the spectrum is",
        items=_KIND_ITEMS,
        default=giving.AS_FILE,
    )

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user search the samples by name."""
        context.window_manager.invoke_search_popup(self)
        return {"FINISHED"}

    def execute(self, _context: Any) -> set[str]:
        """Hand the choice to the operator that reads the file."""
        try:
            done = set(bpy.ops.rough_spectra.assign_file(sample=self.sample, **_options(self)))
            # That one goes on by itself, in the background; here nothing was done yet.
            return {"CANCELLED"} if done == {"RUNNING_MODAL"} else done
        except RuntimeError as error:
            self.report({"ERROR"}, str(error).removeprefix("Error: ").strip())
            return {"CANCELLED"}


def _options(operator: Any) -> dict[str, Any]:
    """Give what an operator was told, to tell it another: of the rest each material decides."""
    names = (
        *("kind", "sigma", "began_sigma", "white", "plaque", "white_factor"),
        *("shader", "scope"),
    )
    told = operator.properties.is_property_set
    return {"filepath": operator.filepath} | {n: getattr(operator, n) for n in names if told(n)}


def choose(samples: list[Any], name: str, path: str) -> Any:
    """Give the sample of a file that has this name, or its only one.

    Raises
    ------
    InputError
        If none is called so, or several are there and none is named.
    """
    from ...samples import sets

    if not name:
        if len(samples) == 1:
            return samples[0]
        names = ", ".join(sample.name for sample in samples[:5])
        more = ", …" if len(samples) > 5 else ""
        msg = f"{path} has {len(samples)} samples ({names}{more}); say which with sample=."
        raise InputError(msg)
    found = sets.by_name(samples)
    if name in found:
        return found[name]
    msg = f"{path} has no sample {name!r}; check the name."
    raise InputError(msg)


classes = (ROUGHSPECTRA_OT_assign_file, ROUGHSPECTRA_OT_assign_file_sample)
