# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`spectral`: from a .blend to a picture, its map and what is said of it."""

import bpy
import pytest
from rough_spectra.addon.support.openimageio import openimageio

from tests.integration.support import ROOT, rgb_material

LAMP = ROOT / "tests" / "fixtures" / "spdx" / "lamp.spdx"


@pytest.fixture
def blend(tmp_path):
    """A colored square in an even light, which covers the picture."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.world = bpy.data.worlds.new("World")
    bpy.ops.mesh.primitive_plane_add(size=4)
    bpy.context.object.data.materials.append(rgb_material("Plain", (0.7, 0.2, 0.1)))
    bpy.ops.object.camera_add(location=(0, 0, 1))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 12, 8
    scene.cycles.use_denoising = False
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_a_picture_and_its_map(blend, tmp_path, main):
    before = blend.read_bytes()
    target = tmp_path / "out" / "room.exr"
    words = (
        "--blend",
        blend,
        "-o",
        target,
        "--bands",
        "3",
        "--samples",
        "2",
        "--light",
        f"World={LAMP}",
        "--spectral",
        target.with_name("room.spectral.exr"),
    )
    result = main("spectral", *words)
    assert result.status == 0, result.err
    assert "Material 'Plain': a spectrum for its RGB, by three spectra" in result.err
    assert "World 'World': measured: lamp.spdx" in result.err
    assert "3 bands (" in result.err
    assert "the RGB picture is off by ΔE00" in result.err
    assert "wrote room.exr, room-delta-e.exr, room.spectral.exr" in result.err
    for name, channels in (("room.exr", "RGBA"), ("room-delta-e.exr", "Y")):
        file = openimageio().ImageInput.open(str(target.with_name(name)))
        spec = file.spec()
        assert (spec.width, spec.height, "".join(spec.channelnames)) == (12, 8, channels)
        file.close()
    assert blend.read_bytes() == before


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("--bands", "4"), "give 3, 6, 9"),
        (("--light", "Moon=F11"), "called 'Moon' shines"),
        (("--light", "World=F99"), "'F99' is neither a file nor"),
        (("--scene", "Nowhere"), "There is no scene 'Nowhere'"),
        (("-o", "room.png"), "is no EXR by its name"),
        (("--spectral", "room.exr"), "no spectral image by its name"),
    ],
)
def test_what_is_refused_before_rendering(words, sentence, blend, tmp_path, main):
    result = main("spectral", "--blend", blend, "-o", tmp_path / "room.exr", *words)
    assert result.status == 2
    assert sentence in result.err
    assert not (tmp_path / "room.exr").exists()


def test_a_farm_renders_pictures_of_its_scenes(blend, tmp_path, main):
    words = f"spectral --output {tmp_path}/out/{{name}}.exr --bands 3 --samples 1 --no-comparison"
    result = main("job", "--files", blend.parent, "--", words)
    assert result.status == 0, result.err
    file = openimageio().ImageInput.open(str(tmp_path / "out" / "scene.exr"))
    assert (file.spec().width, file.spec().height) == (12, 8)
    file.close()
