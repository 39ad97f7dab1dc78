# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures are made outside of drawing, renewed when something changed, and bounded in number."""

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes, working_space
from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.addon.matching import scene_view, solve
from rough_spectra.addon.material import derive, settled, snapshot
from rough_spectra.addon.preview import data, icons, theme
from rough_spectra.addon.preview.drawing import looks
from rough_spectra.core.numerics import direction_grid


@pytest.fixture(autouse=True)
def _no_pictures():
    icons.clear()
    yield
    icons.clear()


@pytest.fixture
def material(make_material, colorchecker):
    material = make_material()
    derive.assign([(material, solve.Request(colorchecker[13], 0.4))])
    return material


def asked(material, figure, units):
    """The icon that a panel gets while it draws."""
    state = (snapshot.of(material), theme.current(bpy.context.preferences))
    return icons.icon_id(material.session_uid, figure, side(units), state)


def side(units):
    """Pixels of a picture in this Blender."""
    system = bpy.context.preferences.system
    return icons.side(units, icons.unit(theme.scale(bpy.context.preferences), system.pixel_size))


def ask(material, figure="sheet", units=10.0):
    asked(material, figure, units)


def pixels(figure="sheet"):
    """What was given to Blender, first row on top."""
    [picture] = [p for w, p in icons._pictures.items() if w.figure == figure]
    preview = icons._kept.get(picture.name)
    width, height = preview.image_size
    return np.array(preview.image_pixels_float[:]).reshape(height, width, 4)[::-1]


def test_drawing_makes_nothing_and_the_timer_makes_it(material):
    ask(material)
    assert not icons._pictures
    assert bpy.app.timers.is_registered(icons._work)
    icons._work()
    wide = side(10)
    assert pixels().shape == (wide, wide, 4)
    assert pixels()[..., 3].max() == 1


def test_nothing_is_made_twice_until_something_changes(material):
    for figure in ("sheet", "swatches"):
        ask(material, figure)
    icons._work()
    ask(material)
    assert not icons._pending
    before = pixels("swatches")
    node = next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfDiffuse")
    node.inputs["Color"].default_value = (0.9, 0.1, 0.1, 1)
    ask(material, "swatches")
    assert icons._pending
    icons._work()
    after = pixels("swatches")
    half = after.shape[1] // 2
    assert (after[5, 15 : half - 15] == before[5, 15 : half - 15]).all()
    assert (after[5, half + 15 : -15] != before[5, half + 15 : -15]).any()


def test_leaving_the_scene_shows_though_the_node_is_edited(material):
    """Then nothing is derived again and the stamp stays, but the target's color is another."""
    reddish = np.linspace(0, 1, illuminant_spectra.GRID.size)
    lights = (scene_view.make_light("Fire", "red", reddish, 1.0),)
    group = material.rough_spectra
    group.scene_view = scene_view.SceneView("Scene", lights, ((0.5, 0.5, 1.0, 0, 1.0),)).to_json()
    group.use_scene = True
    node = next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfDiffuse")
    node.inputs["Color"].default_value = (0.9, 0.1, 0.1, 1)
    ask(material, "swatches")
    icons._work()
    before = pixels("swatches")
    group.use_scene = False
    ask(material, "swatches")
    icons._work()
    assert (pixels("swatches") != before).any()


def test_the_plot_over_angles_is_of_the_scenes_main_light(material):
    """In a red light a green surface is dark: the target's curve is lower, and so is Blender's."""
    reddish = np.linspace(0, 1, illuminant_spectra.GRID.size) ** 4
    lights = (
        scene_view.make_light("Fire", "red", reddish / illuminant_spectra.to_xyz(reddish)[1], 1),
    )
    spread = np.column_stack(direction_grid.hemisphere(16)).tolist()
    rows = tuple((*angles, 0, 1 / 16) for angles in spread)
    space = working_space.current()
    before = data.collect(material, space)
    derive.follow_scene({material: scene_view.SceneView("Scene", lights, rows)})
    found = data.collect(material, space)
    assert found.target_curve.max() < 0.9 * before.target_curve.max()
    # A surface without roughness sends on its color times the light's.
    color, _ = settled.shader(material)
    node = shader_nodes.shader_node(material)
    shader_nodes.roughness_socket(node).default_value = 0
    seen = color * np.maximum(space.from_xyz @ lights[0].white, 0)
    luminance = np.linalg.solve(space.from_xyz, seen)[1]
    assert data.collect(material, space).blender_curve == pytest.approx(luminance, rel=1e-4)


def test_refresh_makes_visible_pictures_at_once(material):
    ask(material, "swatches")
    icons._work()
    before = pixels("swatches")
    node = next(n for n in material.node_tree.nodes if n.bl_idname == "ShaderNodeBsdfDiffuse")
    node.inputs["Color"].default_value = (0.9, 0.1, 0.1, 1)
    icons.refresh(material)
    assert (pixels("swatches") != before).any()
    ask(material, "swatches")
    assert not icons._pending


def test_a_picture_has_the_colors_of_its_figure(material):
    """Every byte, alpha and order of rows included."""
    from rough_spectra.addon.blender import working_space
    from rough_spectra.addon.preview import data
    from rough_spectra.addon.preview.figures import compose

    ask(material)
    icons._work()
    look = theme.current(bpy.context.preferences)
    found = data.collect(material, working_space.current(), snapshot.engine_is_flat())
    wide = side(10)
    canvas = compose.picture("sheet", found, wide, look)
    np.testing.assert_array_equal(np.rint(pixels() * 255), canvas)


def test_a_material_without_spectrum_is_tried_once(make_material):
    material = make_material()
    ask(material)
    icons._work()
    ask(material)
    assert not icons._pending
    assert asked(material, "sheet", 10.0) == 0


def test_a_socket_without_a_number_is_tried_once_and_shows_nothing(material):
    node = shader_nodes.shader_node(material)
    asked(material, "sheet", 10)
    shader_nodes.color_socket(node).default_value[0] = float("nan")
    asked(material, "sheet", 10)
    assert icons._work() is None
    assert asked(material, "sheet", 10) == 0
    assert not icons._pending


@pytest.mark.parametrize("roughness", [-0.5, 1.5])
def test_a_roughness_that_cycles_clips_is_pictured_clipped(material, roughness):
    node, space = shader_nodes.shader_node(material), working_space.current()
    found = []
    for value in (roughness, min(max(roughness, 0.0), 1.0)):
        shader_nodes.roughness_socket(node).default_value = value
        ask(material, "swatches")
        assert icons._work() is None
        found.append((settled.differences(material, space), pixels("swatches").tolist()))
    assert found[0] == found[1]


def test_pictures_of_removed_materials_are_not_made(material):
    ask(material)
    bpy.data.materials.remove(material)
    icons._work()
    assert not icons._pictures


def test_old_pictures_go(material, monkeypatch):
    monkeypatch.setattr(icons, "_BOUND", 3)
    for units in (3.0, 4.0, 5.0, 6.0, 7.0):
        ask(material, "swatches", units)
        icons._work()
    assert len(icons._pictures) == 3
    assert len(icons._kept) == 3


def test_both_themes_are_readable():
    """Blender's own light and dark theme, as they are shipped with this version."""
    from pathlib import Path

    before = theme.current(bpy.context.preferences).background
    [light] = [
        path
        for folder in bpy.utils.preset_paths("interface_theme")
        for path in Path(folder).glob("*ight.xml")
    ]
    bpy.ops.script.execute_preset(
        filepath=str(light), menu_idname="USERPREF_MT_interface_theme_presets"
    )
    look = theme.current(bpy.context.preferences)
    assert max(look.background) > 0.7 > 0.3 > max(before)
    for color in (look.text, look.faint, look.target, look.blender):
        assert looks.contrast(color, look.background) >= 4.5
    bpy.ops.preferences.reset_default_theme()
    assert theme.current(bpy.context.preferences).background == before


@pytest.mark.parametrize(
    ("scale", "pixel", "units", "drawn"),
    # Measured on the screen of Blender 5.2.
    [
        (1.0416666, 1, 6, 119),
        (1.0416666, 1, 12.5, 255),
        (2.0833332, 2, 7.5, 302),
        (2.0833332, 2, 6, 239),
        (2.0833332, 2, 5.5, 218),
        (2.0833332, 2, 5, 197),
    ],
)
def test_pictures_have_the_size_that_blender_draws(scale, pixel, units, drawn):
    class System:
        ui_scale, pixel_size = scale, float(pixel)

    class Preferences:
        system = System

    assert icons.side(units, icons.unit(theme.scale(Preferences), pixel)) == drawn
