# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectral pictures from the interface: the operator, its images, and what is told."""

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.picture import images, pixel, settings

from tests.integration.support import rgb_material

COLUMNS, ROWS = 12, 8


@pytest.fixture
def room(empty_file):
    """A colored square in the light of a lamp's color, which covers the picture."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.world = bpy.data.worlds.new("World")
    scene.world.rough_spectra.spectrum = "A"
    bpy.ops.mesh.primitive_plane_add(size=4)
    bpy.context.object.data.materials.append(rgb_material("Plain", (0.7, 0.2, 0.1)))
    bpy.ops.object.camera_add(location=(0, 0, 1))
    scene.camera = bpy.context.object
    # Half of it, in both directions.
    scene.render.resolution_x, scene.render.resolution_y = 2 * COLUMNS, 2 * ROWS
    scene.rough_spectra.percentage = 50
    scene.rough_spectra.by, scene.rough_spectra.renders = "RENDERS", 1
    scene.cycles.use_denoising, scene.cycles.samples = False, 2
    return scene


def test_it_makes_two_images_and_changes_nothing_else(room):
    before = {
        "size": (room.render.resolution_x, room.render.resolution_percentage),
        "format": room.render.image_settings.file_format,
        "samples": room.cycles.samples,
        "materials": len(bpy.data.materials),
    }
    own = bpy.data.images.new(images.PICTURE, 4, 4)  # somebody's own, called so by chance
    assert bpy.ops.rough_spectra.render_spectral() == {"FINISHED"}
    of_error, shown = (image for image in bpy.data.images if image != own)
    assert (shown.name, of_error.name) == ("Spectral.001", images.MAP)
    assert tuple(shown.size) == tuple(of_error.size) == (COLUMNS, ROWS)
    last = images.last()
    held = np.array(shown.pixels[:]).reshape(ROWS, COLUMNS, 4)
    assert held == pytest.approx(last.picture.rgb.astype(np.float32))
    assert images.of(shown) is images.of(of_error) is last.picture
    assert images.of(own) is None
    assert before == {
        "size": (room.render.resolution_x, room.render.resolution_percentage),
        "format": room.render.image_settings.file_format,
        "samples": room.cycles.samples,
        "materials": len(bpy.data.materials),
    }
    # The map is white where RGB is off most, and black where not at all.
    level = np.array(of_error.pixels[:]).reshape(ROWS, COLUMNS, 4)[..., :3].sum(axis=-1)
    delta_e = last.picture.comparison.delta_e
    assert last.top >= 1
    assert (np.argsort(level.ravel(), kind="stable")[-1] == delta_e.argmax()) or np.ptp(level) == 0
    assert last.told[0].startswith("3 bands")

    # The next one takes the places of both, wherever they are used.
    texture = bpy.data.textures.new("Uses", "IMAGE")
    texture.image = shown
    room.rough_spectra.percentage = 100
    room.rough_spectra.compare = False
    assert bpy.ops.rough_spectra.render_spectral() == {"FINISHED"}
    assert tuple(texture.image.size) == (2 * COLUMNS, 2 * ROWS)
    assert own in list(bpy.data.images)
    names = {image.name for image in bpy.data.images}
    assert names == {"Spectral", images.MAP, "Spectral.001"}
    assert images.of(of_error) is None  # it is of the picture before
    read = pixel.read(images.last().picture, 3, 4)
    assert read.delta_e is None

    # Another file has no picture.
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert images.last() is None


def test_a_pixel_has_the_color_of_its_spectrum(room):
    import colour

    with pytest.raises(RuntimeError, match="Render a spectral picture first"):
        bpy.ops.rough_spectra.pick_pixel(place=(5, 3))
    bpy.ops.rough_spectra.render_spectral()
    picture = images.last().picture
    assert images.picked() is None
    assert bpy.ops.rough_spectra.pick_pixel(place=(5, 3)) == {"FINISHED"}
    read = pixel.read(picture, 5, 3)
    assert read.delta_e == picture.comparison.delta_e[3, 5]
    assert read.xyz == pytest.approx(picture.xyz[3, 5])
    shape = colour.SpectralShape(360, 780, 1)
    observer = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"].copy().align(shape).values
    nm = np.arange(360, 781)
    assert np.interp(nm, read.wavelengths, read.radiance) @ observer == pytest.approx(read.xyz)
    # The light is that of A, which white is, too.
    white = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"]["A"]
    lab = colour.XYZ_to_Lab(np.array(read.xyz), white)
    assert read.lab == pytest.approx(lab, abs=0.05)
    picked = images.picked()
    assert (picked.column, picked.row, picked.lab) == (5, 3, read.lab)
    with pytest.raises(api.DomainError, match="no pixel 12, 3"):
        pixel.read(picture, COLUMNS, 3)
    with pytest.raises(RuntimeError, match="no pixel 1, 99"):
        bpy.ops.rough_spectra.pick_pixel(place=(1, 99))


def test_a_spectrum_is_plotted_where_its_numbers_are():
    from rough_spectra.addon.preview.drawing import looks
    from rough_spectra.addon.preview.figures import radiance

    look = looks.look((0.2, 0.2, 0.2), (0.9, 0.9, 0.9), 1.0)
    nm = np.arange(360.0, 781.0, 10.0)
    canvas = radiance.picture(180, nm, np.where(nm < 600, 0.0, 5.0), look)
    bright = canvas[..., 3].astype(int) * (canvas[..., :3].min(axis=-1) > 180)
    left, right = bright[:120, 20:100].sum(axis=1), bright[:120, 130:175].sum(axis=1)
    assert right[:10].max() > 50 * 255 * 0.5 > 10 * left[:10].max()


@pytest.mark.parametrize(
    ("set_to", "wanted"),
    [
        ({"by": "TOLERANCE", "tolerance": 0.5}, {"tolerance": 0.5, "bands": None}),
        ({"by": "RENDERS", "renders": 4}, {"bands": 12}),
        ({"direct": "AUTO"}, {"direct": None}),
        ({"direct": "APART"}, {"direct": True}),
        ({"direct": "TOGETHER"}, {"direct": False}),
        ({"observer": "10"}, {"observer": 10}),
        ({"percentage": 10}, {"percentage": 8}),
        ({"percentage": 1}, {"percentage": 1}),
        ({"compare": False}, {"plain": False}),
    ],
)
def test_settings_ask_for_what_they_say(room, set_to, wanted):
    room.render.resolution_percentage = 80
    for name, value in set_to.items():
        setattr(room.rough_spectra, name, value)
    found = settings.wanted(room)
    assert {name: getattr(found, name) for name in wanted} == wanted


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("scene.render.engine = 'BLENDER_WORKBENCH'", "Only Cycles"),
        ("scene.camera = None", "has no camera"),
        ("scene.world.rough_spectra.spectrum = 'MEASURED'", "has none; open a file"),
    ],
)
def test_what_cannot_be_is_said(room, change, words):
    exec(change, {"scene": room})
    with pytest.raises(RuntimeError, match=words):
        bpy.ops.rough_spectra.render_spectral()
    assert images.last() is None


def test_stored_numbers_stay(room):
    found = {
        prop.identifier: {item.value: item.identifier for item in prop.enum_items}
        for prop in room.rough_spectra.bl_rna.properties
        if prop.type == "ENUM"
    }
    assert found == {
        "by": {0: "TOLERANCE", 1: "RENDERS"},
        "observer": {0: "2", 1: "10"},
        "direct": {0: "AUTO", 1: "APART", 2: "TOGETHER"},
    }
