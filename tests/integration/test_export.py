# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verb `export`: files for other renderers, and what is said of them."""

import types

import bpy
import pytest
from rough_spectra.addon.export import targets
from rough_spectra.addon.interface.operators import export_materials


def with_wall(main, *words):
    material = bpy.data.materials.new("Wall")
    if material.node_tree is None:
        material.use_nodes = True
    bpy.data.meshes.new("Mesh").materials.append(material)
    main("assign", "--preset", "brick", "--material", "Wall", "--output", *words)


def test_targets_are_written_and_told(main, tmp_path):
    with_wall(main, tmp_path / "scene.blend", "--gloss", "none")
    # Without USD, which starts a second Blender: tests/addon/test_export.py has all of them.
    words = [f"--target={name}" for name in targets.NAMES if name != "usd"]
    told = main("export", "--output", tmp_path / "out" / "scene", *words)
    assert told.status == 0
    endings = ["gltf", "luxcore.scn", "mitsuba.xml", "mtlx", "pbrt"]
    written = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert written == [f"scene.{ending}" for ending in endings]
    lines = told.err.splitlines()
    assert lines[0].startswith("MaterialX: 1 material, at most ΔE00 0.00 at the instrument, 0.")
    assert lines[-1].startswith("wrote scene.mtlx, scene.gltf, ")


def test_one_target_one_material_and_what_is_lost(main, tmp_path):
    with_wall(main, tmp_path / "scene.blend")
    bpy.data.materials.new("Plain")
    words = ("--target", "pbrt", "--output", tmp_path / "out")
    told = main("export", "--material", "Wall", "--material", "Plain", *words)
    assert told.status == 2
    assert "warning: Wall: its gloss is left behind" in told.err
    assert "Material 'Plain' has no measured spectrum; assign one first." in told.err
    assert (tmp_path / "out.pbrt").read_text("utf-8").count("MakeNamedMaterial") == 1
    refused = main("export", "--material", "Plain", *words)
    assert (refused.status, refused.sentence.count("no measured spectrum")) == (2, 1)


def test_what_blenders_exporters_lose_is_checked(main, tmp_path):
    with_wall(main, tmp_path / "scene.blend", "--gloss", "none")
    told = main("export", "--check")
    assert told.status == 1
    lines = told.err.splitlines()
    assert lines[0].startswith("Material 'Wall': Blender's glTF exporter drops its diffuse rough")
    assert lines[-1] == "1 of 1 material would lose color or roughness"
    bpy.data.materials["Wall"].rough_spectra.tolerance = 20
    assert main("export", "--check").status == 0
    bpy.data.materials["Wall"].rough_spectra.spectrum = "{"
    damaged = main("export", "--check")
    assert damaged.status == 2
    assert "its stored spectrum cannot be read" in damaged.err


def test_the_operator_writes_what_is_chosen_and_changes_nothing(main, tmp_path):
    with_wall(main, tmp_path / "scene.blend", "--gloss", "none")
    before = [len(each) for each in (bpy.data.materials, bpy.data.objects, bpy.data.meshes)]
    export = bpy.ops.rough_spectra.export_materials
    words = {"filepath": str(tmp_path / "out"), "scope": "ALL"}
    assert export("EXEC_DEFAULT", targets={"materialx", "pbrt"}, **words) == {"FINISHED"}
    assert sorted(path.name for path in tmp_path.glob("out*")) == ["out.mtlx", "out.pbrt"]
    now = [len(each) for each in (bpy.data.materials, bpy.data.objects, bpy.data.meshes)]
    assert now == before
    with pytest.raises(RuntimeError, match="No selected object has a material; select"):
        export("EXEC_DEFAULT", **words | {"scope": "SELECTED"})


@pytest.mark.parametrize(
    ("menu", "scope"), [("TOPBAR_MT_file_export", "ALL"), ("MATERIAL_MT_context_menu", "ACTIVE")]
)
def test_it_is_in_the_menus(menu, scope):
    drawn = types.SimpleNamespace()
    layout = types.SimpleNamespace(operator=lambda *_, **__: drawn)
    assert export_materials._draw_entry in getattr(bpy.types, menu)._dyn_ui_initialize()
    export_materials._draw_entry(types.SimpleNamespace(bl_idname=menu, layout=layout), None)
    assert drawn.scope == scope
