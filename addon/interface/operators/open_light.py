# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Give a lamp or a world the spectrum of a file."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import StringProperty

from ....core.errors import RoughSpectraError
from . import common, targets

_FILES = "*.spdx;*.sp;*.csv;*.txt;*.tsv;*.xml;*.exr"


class LightFile:
    """Properties of every operator that reads what a lamp sends."""

    filepath: StringProperty(
        name="File",
        description="TM-27 (.spdx), ArgyllCMS (.sp), or a table of wavelengths and power",
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
    )
    filter_glob: StringProperty(
        name="Filter",
        description="Files that the browser shows",
        default=_FILES,
        options={"HIDDEN"},
    )


class ROUGHSPECTRA_OT_open_light(LightFile, bpy.types.Operator):
    """Let the light have a measured spectrum in spectral pictures, from a file"""

    bl_idname = "rough_spectra.open_light"
    bl_label = "Open Light Spectrum"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a lamp or a world that can be changed."""
        data = light_of(context)
        if data is None:
            cls.poll_message_set("Select a light, or open the World tab")
            return False
        if not data.is_editable:
            cls.poll_message_set("It is linked from another file; make it local")
            return False
        return True

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user choose a file."""
        return common.open_file(self, context)

    def execute(self, context: Any) -> set[str]:
        """Read the file, and keep its spectrum with the light."""
        from ... import api

        data: Any = light_of(context)
        try:
            api.measured_light(data, bpy.path.abspath(self.filepath))
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        sentence = rpt_("{light} has the spectrum of {file} in spectral pictures")
        self.report({"INFO"}, sentence.format(light=data.name, file=data.rough_spectra.sample_name))
        return {"FINISHED"}


def light_of(context: Any) -> Any | None:
    """Give the lamp or the world of the tab at hand, else the active lamp."""
    for name in ("light", "world"):
        data = getattr(context, name, None)
        if data is not None:
            return data
    thing = targets.active_object(context)
    return thing.data if thing is not None and thing.type == "LIGHT" else None


classes = (ROUGHSPECTRA_OT_open_light,)
