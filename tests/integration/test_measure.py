# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measuring a material in place: real renders, and a note that knows when it is out of date."""

import json

import bpy
import pytest
from rough_spectra.addon.blender import shader_nodes, texture_colors
from rough_spectra.addon.instrument import measure
from rough_spectra.addon.interface.panels import sentences, text
from rough_spectra.addon.material import last_measurement

from tests.integration.support import rgb_material
from tests.integration.test_operators import mesh_object, refusal

OPS = bpy.ops.rough_spectra


def test_the_reading_stands_beside_the_prediction_until_something_changes():
    material = rgb_material("Wall")
    mesh_object("Wall", material)
    OPS.assign_preset("EXEC_DEFAULT", preset="colorchecker/14-green", sigma=0.5)
    assert last_measurement.get(material) is None
    assert OPS.measure("EXEC_DEFAULT") == {"FINISHED"}
    found = last_measurement.get(material)
    assert found.current
    assert found.delta_e < 0.02
    node = next(node for node in material.node_tree.nodes if node.type == "BSDF_DIFFUSE")
    kept = tuple(node.inputs["Color"].default_value)
    node.inputs["Color"].default_value = (0.5, 0.1, 0.1, 1)
    assert not last_measurement.get(material).current
    assert OPS.measure("EXEC_DEFAULT") == {"FINISHED"}
    wrong = last_measurement.get(material)
    assert wrong.current
    assert wrong.delta_e > 20
    assert wrong.rgb[0] > found.rgb[0]
    node.inputs["Color"].default_value = kept
    assert not last_measurement.get(material).current
    material.rough_spectra.measured = '{"of": 3}'
    assert last_measurement.get(material) is None


def test_what_a_flat_sample_lacks_is_told_wherever_it_is_measured(main, tmp_path):
    """A color attribute reads as black there: the panel, the terminal and the JSON say so."""
    material = rgb_material("Wall")
    mesh_object("Wall", material)
    OPS.assign_preset("EXEC_DEFAULT", preset="colorchecker/14-green")
    tree = material.node_tree
    node = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    paint = tree.nodes.new("ShaderNodeVertexColor")
    paint.layer_name = "Paint"
    tree.links.new(paint.outputs["Color"], node.inputs["Color"])
    lacks = "flat sample has no 'Paint' (Color Attribute); Measure Here, or bake --object"
    assert OPS.measure("EXEC_DEFAULT") == {"FINISHED"}
    found = last_measurement.get(material)
    [said] = found.unlike
    assert lacks in said
    style = sentences.style(text.Format(400, False, 1.0, 11.0))
    shown = sentences.measurement(None, found, style)
    assert lacks in " ".join(line for each in shown for line, _ in each)
    result = main("bake", "--material", "Wall", "--output", str(tmp_path / "wall"))
    assert f"material 'Wall': a {lacks}" in result.err
    [reading] = json.loads((tmp_path / "wall.json").read_text(encoding="utf-8"))["readings"]
    assert any(lacks in warning for warning in reading["warnings"])
    assert reading["measured"]["rgb"] == [0, 0, 0]


def test_what_is_animated_is_seen_as_at_the_frame_of_the_scene():
    """The second Blender showed its first frame, and read what nobody saw."""
    material = rgb_material("Wall")
    tree = material.node_tree
    node = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    source = tree.nodes.new("ShaderNodeRGB").outputs[0]
    tree.links.new(source, node.inputs["Color"])
    for frame, value in ((1, 0.1), (11, 0.2), (12, 0.4)):
        source.default_value = (value, value, value, 1)
        source.keyframe_insert("default_value", frame=frame)
    for curve in shader_nodes.curves(tree.animation_data):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    bpy.context.scene.frame_set(11, subframe=0.5)
    assert measure.measure([material])[0, 0, 0] == pytest.approx([0.3] * 3, abs=1e-5)
    [colors] = texture_colors.seen([node.inputs["Color"]])
    assert colors == pytest.approx(0.3, abs=1e-5)


def test_a_material_without_a_spectrum_is_measured_too():
    material = rgb_material("Plain", (0.2, 0.4, 0.6))
    mesh_object("Wall", material)
    assert OPS.measure("EXEC_DEFAULT") == {"FINISHED"}
    found = last_measurement.get(material)
    assert found.delta_e is None
    assert found.rgb == pytest.approx((0.2, 0.4, 0.6), abs=1e-5)


def test_all_materials_with_a_spectrum_are_measured(scene):
    bpy.ops.wm.open_mainfile(filepath=str(scene))
    assert OPS.measure("EXEC_DEFAULT", scope="ALL") == {"FINISHED"}
    readings = {m.name: last_measurement.get(m) for m in bpy.data.materials}
    assert {name for name, found in readings.items() if found} == {
        material.name for material in bpy.data.materials if material.rough_spectra.spectrum
    }
    assert all(found.delta_e < 0.05 for found in readings.values() if found)


def test_gloss_is_measured_as_predicted_and_bump_is_not():
    """Gloss counts in the prediction; with bump it is of the surface without, and said so."""
    materials = []
    for name in ("Bumpy", "Glossy"):
        materials.append(rgb_material(name))
        mesh_object(name, materials[-1])
        OPS.assign_preset("EXEC_DEFAULT", preset="colorchecker/24-black-2", sigma=0.3)
        materials[-1].rough_spectra.shader = "PRINCIPLED"
        assert last_measurement.get(materials[-1]) is None
    bumpy, glossy = materials
    tree = bumpy.node_tree
    noise, bump = tree.nodes.new("ShaderNodeTexNoise"), tree.nodes.new("ShaderNodeBump")
    noise.inputs["Scale"].default_value, bump.inputs["Distance"].default_value = 5.0, 1.0
    tree.links.new(noise.outputs[0], bump.inputs["Height"])
    tree.links.new(bump.outputs[0], tree.nodes["Principled BSDF"].inputs["Normal"])
    gloss = glossy.node_tree.nodes["Principled BSDF"].inputs
    gloss["Specular IOR Level"].default_value = 1.0
    gloss["Roughness"].default_value = 0.8
    assert OPS.measure("EXEC_DEFAULT", scope="ALL") == {"FINISHED"}
    found = last_measurement.get(bumpy)
    assert found.predicted == pytest.approx(0, abs=0.01)
    assert found.delta_e > 1
    found = last_measurement.get(glossy)
    # Black reflects less than this gloss alone: so it was told, and so it is measured.
    assert found.delta_e > 1
    assert found.predicted == pytest.approx(found.delta_e, abs=0.01)
    # Each of them is measured before the last change as soon as what it adds has changed.
    assert found.current
    gloss["Roughness"].default_value = 0.6
    assert not last_measurement.get(glossy).current
    gloss["Specular IOR Level"].default_value = 0.0
    assert not last_measurement.get(glossy).current
    tree.links.remove(tree.nodes["Principled BSDF"].inputs["Normal"].links[0])
    assert not last_measurement.get(bumpy).current


def test_without_anything_to_measure_the_operator_says_so():
    with pytest.raises(RuntimeError, match="There is no material to measure"):
        OPS.measure("EXEC_DEFAULT")
    rgb_material("Plain")
    assert "no material" in refusal(OPS.measure)
    assert "No material" in refusal(OPS.measure, scope="ALL")
