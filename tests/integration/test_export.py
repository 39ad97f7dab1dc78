# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verb `export`: files for other renderers, and what is said of them."""

import bpy
from rough_spectra.addon.export import targets


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
