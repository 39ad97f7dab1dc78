# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make a material of a spectral image, a few lines at a time; ESC stops."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import ExitStack
from math import radians
from pathlib import Path
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import EnumProperty, FloatProperty, StringProperty

from ....core.errors import InputError
from ...material.properties import ILLUMINANT_ITEMS, INSTRUMENT_ITEMS, SIGMA
from ...support import events
from . import common, targets
from .background import InBackground

_SECONDS_AT_ONCE = 0.05
_FILES = "*.exr;*.hdr;*.img;*.dat;*.raw;*.bil;*.bip;*.bsq;*.png;*.tif;*.tiff;*.jpg"


class _Steps:
    """A conversion in pieces, watched as a job in a second Blender is."""

    def __init__(self, conversion: Any) -> None:
        self.conversion = conversion
        self.done = self.total = 0
        self._steps = iter(conversion)
        self._traces = ExitStack()
        events.unregistering.subscribe(self.close)

    def poll(self) -> bool:
        """Go on for a moment; returns whether all is done."""
        end = time.monotonic() + _SECONDS_AT_ONCE
        while time.monotonic() < end:
            state = next(self._steps, None)
            if state is None:
                return True
            self.done, self.total = state
        return False

    def wait(self) -> None:
        """Do all that is left."""
        while not self.poll():
            pass

    def when_closed(self, act: Callable[[], None]) -> None:
        """Call a function once this is closed."""
        self._traces.callback(act)

    def close(self) -> None:
        """Stop, and leave nothing half done."""
        self._steps.close()
        events.unregistering.unsubscribe(self.close)
        self._traces.close()


class ROUGHSPECTRA_OT_make_texture(InBackground, bpy.types.Operator):
    """Make a material of an image that a spectral camera or a scanner took of a rough surface"""

    bl_idname = "rough_spectra.make_texture"
    bl_label = "Material from Image"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 1, 5

    filepath: StringProperty(
        name="Image",
        description="Spectral OpenEXR, ENVI cube or its header, or RGB",
        subtype="FILE_PATH",
    )
    filter_glob: StringProperty(
        name="Filter", description="Files that are shown", default=_FILES, options={"HIDDEN"}
    )
    output: StringProperty(
        name="Texture",
        description="EXR to write; empty for one beside the image",
        subtype="FILE_PATH",
    )
    sigma: FloatProperty(**SIGMA)
    instrument: EnumProperty(
        name="Instrument", description="That the image was taken with", items=INSTRUMENT_ITEMS
    )
    illuminant: EnumProperty(
        name="Illuminant",
        description="Light under which the color is right; of RGB, the one it was taken for",
        items=ILLUMINANT_ITEMS,
    )
    scale: FloatProperty(
        name="Stands for 1",
        description="Of a cube, the number that stands for a reflectance of 1; 0 takes the file's",
        min=0.0,
    )

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Let the user choose the image."""
        return common.open_file(self, context)

    def draw(self, _context: Any) -> None:
        """Draw the options beside the files."""
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in ("sigma", "instrument", "illuminant", "scale", "output"):
            layout.prop(self, name)

    def start(self, context: Any) -> Any:
        """Open the image."""
        from ...blender import working_space
        from ...material import snapshot
        from ...textures import convert
        from ...textures.wanted import Wanted

        if not self.filepath:
            raise InputError("No image is named; choose one.")
        source = Path(bpy.path.abspath(self.filepath))
        output = bpy.path.abspath(self.output)
        target = Path(output) if output else source.with_name(f"{source.stem}.texture.exr")
        wanted = Wanted(
            radians(snapshot.entered_degrees(self.sigma)),
            self.instrument,
            self.illuminant,
            holds="color",
            scale=self.scale or None,
        )
        thing = targets.active_object(context)
        self._object = "" if thing is None else thing.name
        return _Steps(convert.Conversion(source, target, wanted, working_space.current()))

    def state(self, done: int, total: int) -> str:
        """Say how many lines are done."""
        return rpt_("Making a texture: {done} of {total} lines").format(done=done, total=total)

    def finish(self, job: Any) -> str:
        """Make the material, and put it on the active object."""
        from ...textures import material as of_texture

        made = job.conversion.made
        name = made.path.name.removesuffix(".exr").removesuffix(".texture")
        material = of_texture.make(made, of_texture.free_name(name))
        thing = bpy.data.objects.get((self._object, None)) if self._object else None
        if thing is not None and hasattr(thing.data, "materials"):
            thing.active_material = material
        for note in made.notes:
            self.report({"WARNING"}, note)
        sentence = rpt_("Made {name!r} of {width} × {height} pixels; wrote {path}")
        return sentence.format(
            name=material.name, width=made.width, height=made.height, path=made.path
        )


classes = (ROUGHSPECTRA_OT_make_texture,)
