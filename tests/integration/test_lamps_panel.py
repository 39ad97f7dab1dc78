# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps that are changed in a picture from the Render tab: the image follows, and nothing else."""

import types

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.interface.panels import lamps
from rough_spectra.addon.picture import groups, images, lamp_sliders, relit, settings

from tests.integration.support import ROOT, rgb_material
from tests.integration.test_panels import Layout, context

OPS = bpy.ops.rough_spectra
FILE = ROOT / "tests" / "fixtures" / "spdx" / "lamp.spdx"
COLUMNS, ROWS = 12, 8
SINGLE = 2e-6
"""Of the brightest pixel: single precision, and sums of three lamps and six bands."""


@pytest.fixture(scope="module")
def room(home):
    """A colored square in the light of three suns, of which each lamp's light was rendered."""
    bpy.ops.wm.read_homefile(filepath=str(home))
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.world = None
    bpy.ops.mesh.primitive_plane_add(size=4)
    bpy.context.object.data.materials.append(rgb_material("Plain", (0.7, 0.2, 0.1)))
    for name, kelvin in (("Warm", 2856), ("Cold", 8000), ("Day", 5500)):
        light = bpy.data.lights.new(name, "SUN")
        light.use_temperature, light.temperature = True, kelvin
        scene.collection.objects.link(bpy.data.objects.new(name, light))
    bpy.ops.object.camera_add(location=(0, 0, 1))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = COLUMNS, ROWS
    scene.cycles.use_denoising, scene.cycles.samples = False, 2
    scene.rough_spectra.by, scene.rough_spectra.renders = "RENDERS", 2
    before = _state()
    assert OPS.render_lamps() == {"FINISHED"}
    assert _state() == before
    yield relit.last()
    bpy.ops.wm.read_homefile(filepath=str(home))
    assert relit.last() is None


@pytest.fixture(autouse=True)
def empty_blender(room):
    """Keep the file open; all lamps are as rendered."""
    OPS.reset_lamps()


def _state():
    scene = bpy.context.scene
    lights = [(each.name, each.energy, each.rough_spectra.spectrum) for each in bpy.data.lights]
    size = scene.render.resolution_x, scene.cycles.samples, scene.cycles.use_denoising
    return lights, size, len(bpy.data.materials), len(bpy.data.scenes), len(bpy.data.objects)


def _sliders():
    return bpy.context.window_manager.rough_spectra


def _shown():
    return np.array(images.find(relit.RELIT).pixels[:]).reshape(ROWS, COLUMNS, 4)


def _drawn():
    where = context(engine="CYCLES", window_manager=bpy.context.window_manager)
    page = []
    lamps.ROUGHSPECTRA_PT_lamps.draw(types.SimpleNamespace(layout=Layout(page)), where)
    return page


def _is(picture):
    assert _shown() == pytest.approx(picture.rgb, abs=SINGLE * picture.rgb.max())


def test_as_rendered_it_is_what_the_functions_give(room):
    assert room.lights.names == ("Warm", "Cold", "Day")
    assert room.lights.parts.dtype == np.float32
    _is(api.relight(room.lights))
    again = api.picture_lights(bands=6)  # the same seed
    assert np.array_equal(room.lights.parts, again.parts)


def test_a_slider_changes_the_image(room):
    """Several, one after the other and back, as what does not move is kept."""
    first = _shown()
    sliders, state = _sliders(), _state()
    for times in (0.25, 3.0, 10.0):
        sliders.intensity_1 = times
        _is(api.relight(room.lights, intensities={"Cold": times}))
        assert sliders.intensity_1 == times
    sliders.intensity_0 = 0.0
    _is(api.relight(room.lights, intensities={"Cold": 10.0, "Warm": 0.0}))
    sliders.intensity_1 = 1.0
    sliders.intensity_2 = 0.5
    _is(api.relight(room.lights, intensities={"Day": 0.5, "Warm": 0.0}))
    assert OPS.reset_lamps() == {"FINISHED"}
    assert np.array_equal(_shown(), first)
    assert [getattr(sliders, lamp_sliders.name(n)) for n in range(3)] == [1.0] * 3
    assert _state() == state


@pytest.mark.parametrize("name", ["F11", "HP1", "sodium"])
def test_a_spectrum_changes_the_image(room, name):
    first = _shown()
    assert OPS.change_lamp(lamp=2, spectrum=name) == {"FINISHED"}
    _is(api.relight(room.lights, {"Day": name}))
    OPS.change_lamp(lamp=0, spectrum="A")
    _sliders().intensity_2 = 2.0
    _is(api.relight(room.lights, {"Day": name, "Warm": "A"}, {"Day": 2.0}))
    _sliders().observer = "10"
    _is(api.relight(room.lights, {"Day": name, "Warm": "A"}, {"Day": 2.0}, observer=10))
    _sliders().observer = "2"
    _sliders().intensity_2 = 1.0
    for lamp in (0, 2):
        OPS.change_lamp(lamp=lamp, spectrum="RENDERED")
    assert _shown() == pytest.approx(first, abs=SINGLE * first.max())


def test_a_file_gives_a_spectrum(room):
    assert OPS.change_lamp(lamp=1, spectrum="FILE", filepath=str(FILE)) == {"FINISHED"}
    _is(api.relight(room.lights, {"Cold": str(FILE)}))
    assert f"rough_spectra.change_lamp: {FILE.name}" in _drawn()
    first = _shown()
    with pytest.raises(RuntimeError, match="holds no spectrum of light"):
        OPS.change_lamp(lamp=1, spectrum="FILE", filepath=str(FILE.with_name("tile.spdx")))
    with pytest.raises(RuntimeError, match="no such lamp; render the lamps apart again"):
        OPS.change_lamp(lamp=3, spectrum="A")
    assert np.array_equal(_shown(), first)
    assert room.chosen == [None, FILE.name, None]


def test_the_panel_has_a_row_for_each(room):
    OPS.change_lamp(lamp=0, spectrum="F11")
    page = _drawn()
    assert page[:3] == [
        "rough_spectra.render_lamps",
        "rough_spectra.show_picture: Picture",
        "rough_spectra.reset_lamps",
    ]
    menu = "rough_spectra.change_lamp: "
    rows = [f"{menu}F11", f"{menu}Its Own", f"{menu}Its Own"]
    assert page[3:10] == [
        *(each for number in range(3) for each in (f"intensity_{number}", rows[number])),
        "observer",
    ]
    _, error = room.lights.weights(room.lights.spectra[1])
    off = max(error.usual, *(room._weights[n][1] for n in (0, 2)))
    assert f"6 bands; predicted: 95 % within ΔE00 {off:.2f}" in " ".join(page)


def test_more_lamps_than_rows_are_told_of(room):
    count = lamp_sliders.MOST + 2
    one = room.lights
    many = type(one)(
        tuple(f"Lamp {number}" for number in range(count)),
        np.repeat(one.spectra[:1], count, axis=0),
        np.repeat(one.parts[:1], count, axis=0),
        *(one.alpha, one.wavelengths, one.surfaces, one.space),
    )
    relit.put(relit.Relit(many, room._from_xyz))
    try:
        page = _drawn()
        assert page.count("rough_spectra.change_lamp: Its Own") == lamp_sliders.MOST
        assert "2 more lamps have no slider: the verb relight sets them" in " ".join(page)
        _sliders().intensity_15 = 4.0
        _is(api.relight(many, intensities={"Lamp 15": 4.0}))
    finally:
        relit.put(room)


def test_an_image_that_is_gone_comes_again(room):
    """An undo may take it away; another of its name stays what it is."""
    own = bpy.data.images.new("Mine", 4, 4)
    bpy.data.images.remove(images.find(relit.RELIT))
    _sliders().intensity_0 = 2.0
    _is(api.relight(room.lights, intensities={"Warm": 2.0}))
    bpy.data.images.remove(own)


def test_it_is_saved_as_it_is_shown(room, tmp_path):
    """A file keeps the image, and nothing of the sliders."""
    _sliders().intensity_0 = 3.0
    wanted = _shown()
    path = str(tmp_path / "relit.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True, check_existing=False)
    with bpy.data.libraries.load(path) as (there, here):
        here.images = [name for name in there.images if name == relit.RELIT]
    [saved] = here.images
    try:
        assert np.array(saved.pixels[:]) == pytest.approx(wanted.ravel(), rel=1e-6)
    finally:
        bpy.data.images.remove(saved)
    assert "intensity" not in str(bpy.context.window_manager.rough_spectra.keys())


def test_pixels_of_it_are_not_those_of_the_spectral_picture(room):
    """Picking reads spectra of the picture, which other lamps do not have."""
    bpy.context.scene.rough_spectra.compare = False
    bpy.context.scene.rough_spectra.renders = 1
    try:
        OPS.render_spectral()
        assert images.of(images.find(images.PICTURE)) is images.last().picture
        assert images.of(images.find(relit.RELIT)) is None
    finally:
        bpy.context.scene.rough_spectra.renders = 2


def test_lights_that_memory_does_not_hold_are_refused(room):
    wanted = settings.lamps(bpy.context.scene)
    bands = groups.bands.IN_A_PASS * 2
    needed = 3 * bands * COLUMNS * ROWS * 4
    with pytest.raises(api.DomainError, match=r"3 lamps in 6 bands .* smaller size, or fewer"):
        groups.Gathering(bpy.context.scene, wanted, needed - 1)


def test_disabling_forgets(room, extension):
    _sliders().intensity_0 = 2.0
    handlers = bpy.app.handlers.save_pre
    assert relit._pack in handlers
    extension.unregister()
    try:
        assert relit.last() is None
        assert relit._pack not in handlers
        assert not hasattr(bpy.types.WindowManager, "rough_spectra")
    finally:
        extension.register()
        relit.put(room)


def test_another_file_forgets(room, home):
    bpy.ops.wm.read_homefile(filepath=str(home))
    try:
        assert relit.last() is None
        assert _drawn() == ["rough_spectra.render_lamps"]
        with pytest.raises(RuntimeError, match="Render the lamps apart first"):
            OPS.reset_lamps()
        _sliders().intensity_0 = 5.0
        _sliders().observer = "10"
        assert (_sliders().intensity_0, _sliders().observer) == (1.0, "2")
        assert images.find(relit.RELIT) is None
    finally:
        relit.put(room)
