# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Put a rough sample into the scene, as a mesh of facets."""

from __future__ import annotations

from math import radians
from pathlib import Path
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ....core.errors import RoughSpectraError
from . import common, giving

_STEEPEST = radians(80)

KIND_ITEMS = (
    ("GAUSSIAN", "Gaussian Heights", "Random surface of one scale; σ is the angle of its Rdq"),
    ("MULTISCALE", "Many Scales", "Random surface with a power law; σ is the angle of its Rdq"),
    ("GROOVES", "V-Grooves", "Level rims, slopes as those of a Gaussian surface"),
    ("GROOVES-OREN-NAYAR", "V-Grooves, Oren-Nayar", "Level rims, slopes as Oren and Nayar's"),
    ("GRAINS", "Packed Grains", "Spheres that fell on each other"),
    ("MAP", "Map of Heights", "From an image or a profilometer's file"),
)


def _names(_operator: Any, _context: Any, typed: str) -> list[str]:
    """Give the names of presets and library samples that have what was typed in them."""
    from ...material import preferences
    from ...samples import library

    return [entry.id for entry in library.search(typed, preferences.user_folder())]


class ROUGHSPECTRA_OT_add_rough_sample(bpy.types.Operator):
    """Add a rough surface of facets, as the virtual laboratory measures it"""

    bl_idname = "rough_spectra.add_rough_sample"
    bl_label = "Rough Sample"
    bl_options = {"REGISTER", "UNDO"}
    menu_place = 3, 3

    kind: EnumProperty(name="Kind", description="How the surface is made", items=KIND_ITEMS)
    sigma: FloatProperty(
        name="σ",
        description="Roughness: the tangent is Rdq of a profilometer",
        subtype="ANGLE",
        default=radians(30),
        min=0.0,
        max=_STEEPEST,
    )
    as_it_comes: BoolProperty(
        name="As It Comes",
        description="Leave grains spheres, and a map as it was measured, whatever σ says",
        default=True,
    )
    size: FloatProperty(
        name="Size", description="Width", subtype="DISTANCE", default=2.0, min=1e-4, max=1e4
    )
    cells: IntProperty(
        name="Cells", description="Of the mesh, a side", default=256, min=32, max=2048
    )
    seed: IntProperty(name="Seed", description="Another surface for each number", min=0)
    filepath: StringProperty(
        name="Heights", description="Image or text of a profilometer", subtype="FILE_PATH"
    )
    sample: StringProperty(
        name="Material",
        description="Preset or library sample that the facets are of; empty for no material",
        search=_names,
    )
    with_instrument: BoolProperty(
        name="Lights and Camera",
        description="Add a ring of suns at 45° and a view along the normal, as the instrument has",
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Need a collection to put it into, and no mode that edits something else."""
        if context.mode != "OBJECT":
            cls.poll_message_set("Leave the mode of editing first")
            return False
        return True

    def draw(self, _context: Any) -> None:
        """Draw what the kind has."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "kind")
        from_file = self.kind == "MAP"
        if from_file:
            layout.prop(self, "filepath")
        free = from_file or self.kind == "GRAINS"
        if free:
            layout.prop(self, "as_it_comes")
        row = layout.row()
        row.enabled = not (free and self.as_it_comes)
        row.prop(self, "sigma")
        layout.prop(self, "size")
        if not from_file:
            layout.prop(self, "cells")
            layout.prop(self, "seed")
        layout.prop(self, "sample")
        layout.prop(self, "with_instrument")

    def execute(self, context: Any) -> set[str]:
        """Make it, or nothing."""
        from ...laboratory import kinds, place

        free = self.kind in ("MAP", "GRAINS") and self.as_it_comes
        path = Path(bpy.path.abspath(self.filepath)) if self.filepath else None
        try:
            if context.collection.library is not None:
                msg = "The active collection is linked; choose one of this file."
                raise RoughSpectraError(msg)
            rough = kinds.make(
                self.kind.lower(),
                None if free else self.sigma,
                seed=self.seed,
                cells=self.cells,
                path=path if self.kind == "MAP" else None,
            )
            material = _material(self.sample)
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        where = context.scene.cursor.location
        thing = place.put(rough, context.collection, self.size, where)
        if material is not None:
            thing.data.materials.append(material)
        if self.with_instrument:
            context.scene.camera = place.put_instrument(context.collection, self.size, where)
        for other in context.selected_objects:
            other.select_set(False)
        thing.select_set(True)
        context.view_layer.objects.active = thing
        sentence = rpt_("{name}: {count} facets, Rdq {rdq:.3f}, Sdq {sdq:.3f}")
        mesh = rough.mesh
        self.report(
            {"INFO"},
            sentence.format(name=thing.name, count=len(mesh.faces), rdq=mesh.rdq, sdq=mesh.sdq),
        )
        return {"FINISHED"}


def _material(sample: str) -> Any | None:
    """Make a material of flat facets from a preset, or none."""
    if not sample:
        return None
    from ...laboratory import readings
    from ...material import derive, preferences
    from ...samples import library

    found = readings.facets(library.load(sample, preferences.user_folder()))
    request = giving.new_request(found, 0.0)
    material = bpy.data.materials.new(found.name)
    try:
        derive.assign([(material, request)], "DIFFUSE")
    except RoughSpectraError:
        bpy.data.materials.remove(material)
        raise
    return material


def _draw_entry(menu: Any, _context: Any) -> None:
    menu.layout.separator()
    menu.layout.operator(ROUGHSPECTRA_OT_add_rough_sample.bl_idname, icon="COLOR")


def register_menu() -> None:
    """Put it where meshes are added."""
    bpy.types.VIEW3D_MT_mesh_add.append(_draw_entry)


def unregister_menu() -> None:
    """Take it away."""
    bpy.types.VIEW3D_MT_mesh_add.remove(_draw_entry)


classes = (ROUGHSPECTRA_OT_add_rough_sample,)
