# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`texture` and **Material from Image**: from a cube to a file and a material that is saved."""

from math import radians
from pathlib import Path

import bpy
import numpy as np
import pytest

OPS = bpy.ops.rough_spectra
NM = (400, 450, 500, 550, 600, 650, 700)


@pytest.fixture
def cube(tmp_path):
    values = np.random.default_rng(1).integers(1000, 9000, (6, 5, len(NM))).astype("<u2")
    (tmp_path / "wall.bip").write_bytes(values.tobytes())
    lines = ("ENVI", "samples = 5", "lines = 6", f"bands = {len(NM)}", "data type = 12",
             "interleave = bip", "reflectance scale factor = 10000", "wavelength units = nm",
             "wavelength = {" + ", ".join(map(str, NM)) + "}")  # fmt: skip
    (tmp_path / "wall.hdr").write_text("\n".join(lines))
    return tmp_path / "wall.bip"


def test_a_cube_becomes_a_material_of_the_saved_file(cube, tmp_path, main):
    target, saved = tmp_path / "wall.exr", tmp_path / "scene.blend"
    words = ("--sigma", "20", "--output", str(target), "--material", "Wall", "--save", str(saved))
    result = main("texture", str(cube), *words)
    assert result.status == 0
    assert "5 × 6 pixels of color; wrote wall.exr; material 'Wall'" in result.err
    bpy.ops.wm.open_mainfile(filepath=str(saved), load_ui=False)
    nodes = bpy.data.materials["Wall"].node_tree.nodes
    image = nodes["Image Texture"].image
    assert image.size[:] == (5, 6)
    plain = bpy.data.images.load(str(target))
    assert (image.name, image.filepath_from_user()) == ("wall.exr", plain.filepath_from_user())
    assert image.alpha_mode == plain.alpha_mode
    assert image.colorspace_settings.name == "Linear Rec.709"
    assert nodes["Diffuse BSDF"].inputs["Roughness"].default_value > 0.1


def test_albedo_needs_no_material(cube, tmp_path, main):
    target = tmp_path / "wall.exr"
    result = main("texture", str(cube), "--sigma", "20", "--output", str(target))
    assert result.status == 0
    assert "5 × 6 pixels of albedo" in result.err
    assert target.stat().st_size > 0


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("--save", "x.blend"), "There is nothing to save without --material"),
        (("--material", "Wall"), "The open file has no name; say where to save it with --save"),
    ],
)
def test_what_verb_refuses(cube, tmp_path, words, sentence, main):
    output = ("--output", str(tmp_path / "wall.exr"))
    result = main("texture", str(cube), "--sigma", "20", *output, *words)
    assert result.status == 2
    assert sentence in result.err
    assert not (tmp_path / "wall.exr").exists()


def test_the_operator_makes_and_assigns(cube):
    mesh = bpy.data.meshes.new("Plane")
    thing = bpy.data.objects.new("Plane", mesh)
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    assert OPS.make_texture("EXEC_DEFAULT", filepath=str(cube), sigma=radians(20)) == {"FINISHED"}
    assert thing.active_material.name == "wall"
    assert cube.with_name("wall.texture.exr").exists()
    assert OPS.make_texture("EXEC_DEFAULT", filepath=str(cube), sigma=radians(20)) == {"FINISHED"}
    assert thing.active_material.name == "wall.001"


def test_the_operator_says_what_is_wrong(tmp_path):
    with pytest.raises(RuntimeError, match="is no file; check the path"):
        OPS.make_texture("EXEC_DEFAULT", filepath=str(tmp_path / "none.exr"))


def test_the_scale_of_a_texture_is_removed(monkeypatch):
    """The node goes, the texture stays."""
    from rough_spectra.addon.blender import texture_colors

    monkeypatch.setattr(texture_colors, "seen", lambda sockets: [np.full((9, 3), 0.4)])
    material = bpy.data.materials.new("Wall")
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs["Color"], shader.inputs[0])
    thing = bpy.data.objects.new("Plane", bpy.data.meshes.new("Plane"))
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    thing.active_material = material
    assert OPS.assign_preset("EXEC_DEFAULT", preset="everyday/brick") == {"FINISHED"}
    assert "Rough Spectra Scale" in tree.nodes
    assert OPS.remove_scale("EXEC_DEFAULT") == {"FINISHED"}
    assert "Rough Spectra Scale" not in tree.nodes
    assert shader.inputs[0].links[0].from_node.type == "TEX_NOISE"
    assert OPS.remove_scale("EXEC_DEFAULT") == {"CANCELLED"}


@pytest.mark.skipif(bpy.app.version < (5, 0, 0), reason="Blender has no wider working space")
def test_a_wider_space_looks_at_textures_in_the_background(monkeypatch):
    """An image has other colors there; the window stood still while somebody looked."""
    from rough_spectra.addon import api
    from rough_spectra.addon.blender import texture_colors, working_space
    from rough_spectra.addon.material import state

    monkeypatch.setattr(texture_colors, "seen", lambda sockets: [np.full((9, 3), 0.4)])
    material = bpy.data.materials.new("Wall")
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs["Color"], shader.inputs[0])
    api.assign([(material, api.find("everyday/brick"))])
    seen = []
    monkeypatch.setattr(texture_colors, "seen", seen.append)
    assert OPS.use_wide_gamut("EXEC_DEFAULT") == {"FINISHED"}
    assert seen == []
    assert working_space.working_space_name() == "ACEScg"
    assert state.state(material).kind == "fresh"


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="no folder that not even root may write to")
@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("Wall", "--save", "/proc/x.blend"), "/proc/x.blend cannot be written ("),
        (("Taken", "--save", "{}/x.blend"), "There is a material 'Taken' already"),
        (("Wall", "--save", "{}/x.blend", "--holds", "albedo"), "holds albedo, and a material"),
    ],
)
def test_what_cannot_be_saved_leaves_the_texture_as_it_was(cube, tmp_path, words, sentence, main):
    """It took its place before the .blend was saved, which then went on with the new one."""
    bpy.data.materials.new("Taken")
    target = tmp_path / "wall.exr"
    target.write_bytes(b"of before")
    given = [word.format(tmp_path) for word in words]
    found = sorted(tmp_path.iterdir())
    result = main(
        "texture", str(cube), "--sigma", "20", "--output", str(target), "--material", *given
    )
    assert result.status == 2
    assert sentence in result.err
    assert target.read_bytes() == b"of before"
    assert sorted(tmp_path.iterdir()) == found
