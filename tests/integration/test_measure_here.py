# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A spot measured where a ray meets a surface: kept with the material, and marked."""

import bpy
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.interface.panels import sentences, text
from rough_spectra.addon.material import last_measurement

from tests.integration.support import rgb_material
from tests.integration.test_operators import mesh_object, refusal

OPS = bpy.ops.rough_spectra
DOWN = {"origin": (0.2, 0.3, 5.0), "direction": (0.0, 0.0, -1.0)}


@pytest.fixture
def wall():
    material = rgb_material("Wall")
    thing = mesh_object("Wall", material)
    OPS.assign_preset("EXEC_DEFAULT", preset="colorchecker/14-green", sigma=0.5)
    thing.location.z, thing.rotation_euler.y = 0.5, 0.2
    return thing


def test_a_spot_is_kept_with_the_material_and_marked(wall):
    assert OPS.measure_here("EXEC_DEFAULT", diameter=4.0, **DOWN) == {"FINISHED"}
    found = last_measurement.get(wall.active_material)
    assert found.current
    assert found.delta_e < 0.02
    assert found.spread < 0.01
    assert found.place == "Wall, 4 mm"
    style = sentences.style(text.Format(2000, False, 1.0, 11.0))
    lines = [sentence[0][0] for sentence in sentences.measurement(None, found, style)]
    assert lines[0].startswith("Measured on Wall, 4 mm: ΔE00 0.0")
    assert lines[1].startswith("95 % of the spot below: ΔE00 0.00")

    [mark] = bpy.data.collections["Rough Spectra Spots"].objects
    assert mark.name.startswith("Wall, 4 mm: ΔE00 0.0")
    assert (mark.type, mark.parent) == ("EMPTY", wall)
    bpy.context.view_layer.update()
    x, y, z = mark.matrix_world.translation
    assert (x, y) == pytest.approx((0.2, 0.3), abs=1e-4)
    wall.location.z += 1
    bpy.context.view_layer.update()
    assert mark.matrix_world.translation.z == pytest.approx(z + 1, abs=1e-5)

    [spot] = api.spots(wall, at=mark, diameter=4)
    [again] = api.bake([spot]).entries
    assert again.measured.rgb == pytest.approx(found.rgb, abs=2e-6)
    assert again.spot.point == pytest.approx((x, y, z + 1), abs=1e-4)


def test_no_place_no_surface_and_no_material_are_refused(wall):
    assert "click on a surface" in refusal(OPS.measure_here)
    beside = {"origin": (9.0, 9.0, 9.0), "direction": (0.0, 0.0, 1.0)}
    assert "There is no surface at this place" in refusal(OPS.measure_here, **beside)
    rgb_material("Another")
    wall.active_material = None
    assert "'Wall' has no material there" in refusal(OPS.measure_here, **DOWN)
    assert "Rough Spectra Spots" not in bpy.data.collections
