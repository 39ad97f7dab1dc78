# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""σ from readings in its dialog, and a rough sample from the menu."""

import math

import bpy
from driver import area, middle, move, over, press, scene
from stage import OPS, empty_file, green_file, ours, state, undo_step, wall

ROUGH = 25.0
"""Degrees that the second reading was made with."""


@scene
def estimating_sigma(found):
    """Open the dialog, name a file, confirm, and undo."""
    yield from green_file()
    storage = ours("addon.material.storage")
    albedo = storage.load(wall()).sample
    read = ours("core.reading").from_albedo(albedo.reflectance, math.radians(ROUGH), "surface")
    path = f"{bpy.app.tempdir}blasted.csv"
    with open(path, "w", encoding="utf-8") as file:
        file.write("nm,Blasted green\n")
        for nm, value in zip(albedo.wavelengths, read, strict=True):
            file.write(f"{nm:g},{value:.6f}\n")
    found["before"] = state()
    x, y = middle(area("PROPERTIES"))
    yield from move(x, y)
    operator = ours("addon.interface.operators.estimate_sigma").ROUGHSPECTRA_OT_estimate_sigma
    draw, found["told"], dialogs = operator.draw, [], []

    def note(self, context):
        dialogs.append(self)
        if self.found not in found["told"]:
            found["told"].append(self.found)
        draw(self, context)

    operator.draw = note
    with over(area("PROPERTIES")):
        OPS.estimate_sigma("INVOKE_DEFAULT", source="FILE")
    yield 1.0
    dialogs[-1].filepath = path  # as the field does; a virtual keyboard has no slash
    found["told"].append(dialogs[-1].found)
    operator.draw = draw
    yield from press("RET")
    yield 1.0
    found["estimated"] = state()
    found["degrees"] = math.degrees(wall().rough_spectra.sigma)
    found["source"] = wall().rough_spectra.sigma_source
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = state()
    with over(area("PROPERTIES")):
        OPS.estimate_sigma("INVOKE_DEFAULT", source="FILE", filepath=path)
    yield 0.5
    yield from press("ESC")
    yield 0.5
    found["left"] = state()


@scene
def adding_a_rough_sample(found):
    """Search for it in the 3D view, look at the mesh and its panel, and undo."""
    yield from empty_file("VIEW_3D")
    undo_step("Empty")
    before = [len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.materials)]
    yield from move(*middle(area("VIEW_3D")))
    with over(area("VIEW_3D")):
        OPS.add_rough_sample(
            "INVOKE_DEFAULT", sample="colorchecker/14-green", cells=64, with_instrument=True
        )
    yield 1.0
    sample = bpy.context.view_layer.objects.active
    found["facets"] = len(sample.data.polygons)
    found["slopes"] = _slopes(sample)
    found["lights"] = sum(thing.type == "LIGHT" for thing in bpy.data.objects)
    found["material"] = sample.active_material is not None
    yield from press("Z", ctrl=True)
    yield 0.5
    after = [len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.materials)]
    found["same"] = before == after


def _slopes(thing):
    """Root mean square slope of a profile, by the facets' areas seen from above."""
    total = seen = 0.0
    for facet in thing.data.polygons:
        x, y, z = facet.normal
        total += facet.area * z * (x * x + y * y) / (z * z)
        seen += facet.area * z
    return math.sqrt(total / seen / 2)
