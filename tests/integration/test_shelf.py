# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The shelf that ships: every preset as a material, up to date, offered once, local when wanted."""

from types import SimpleNamespace

import bpy
import pytest
from rough_spectra.addon.assets import catalogs, shelf
from rough_spectra.addon.blender import shader_nodes
from rough_spectra.addon.interface import shelf as shelf_in_view
from rough_spectra.addon.matching import own_gloss
from rough_spectra.addon.material import preferences, state, storage
from rough_spectra.addon.material.derivation import get_stamp
from rough_spectra.addon.samples import presets
from rough_spectra.core.cycles import gloss_estimate

from tests.integration.test_operators import mesh_object
from tools.tables import make_shelf

OPS = bpy.ops.rough_spectra
BLEND = str(shelf.folder() / shelf.BLEND)


def load(link=False, names=None, **options):
    with bpy.data.libraries.load(BLEND, link=link, assets_only=True, **options) as (there, wanted):
        wanted.materials = names or list(there.materials)
    return {material.name: material for material in wanted.materials}


def _group(name):
    collection, _, slug = name.partition("/")
    return "ColorChecker" if collection == "colorchecker" else make_shelf.group(slug)


def test_every_preset_is_on_the_shelf_and_up_to_date(empty_file):
    """If this fails, presets or what is derived changed: run `tools.tables.make_shelf` again."""
    found = load()
    samples = {sample.name: sample for sample in presets.load_all()}
    catalog_file = shelf.folder() / catalogs.FILE_NAME
    merged = catalogs.merge(catalog_file, ["ColorChecker", *make_shelf.GROUPS])
    assert merged.text == catalog_file.read_text("utf-8")
    ids = {title: merged.ids[title] for title in ("ColorChecker", *make_shelf.GROUPS)}
    groups = {presets.load(name).name: _group(name) for name in presets.names()}
    assert set(found) == set(samples)
    for name, material in found.items():
        stored = storage.load(material)
        sample = samples[name]
        assert stored.sample.values.tolist() == sample.values.tolist(), name
        assert stored.sample.gloss == sample.gloss
        assert stored.sample.gloss_source == sample.gloss_source
        assert state.state(material).kind == "fresh", name
        assert shader_nodes.shader_node(material).bl_idname == "ShaderNodeBsdfPrincipled"
        assert tuple(material.preview.image_size) == (128, 128)
        assert material.diffuse_color[:3] == material.rough_spectra.solid_color[:], name
        assert material.asset_data.catalog_id == ids[groups[name]], name


def test_a_glossy_sample_comes_with_its_gloss_and_a_matte_one_without(empty_file):
    found = load(names=["Egg shell, white", "Brick"])
    egg = presets.load("egg-shell-white")
    gloss = shader_nodes.gloss_of(shader_nodes.shader_node(found["Egg shell, white"]))
    wanted = own_gloss.of_sample(egg)
    assert gloss.numbers() == pytest.approx(wanted.numbers(), abs=1e-6)
    read = gloss_estimate.readings(wanted, 0.6, (60,)).units[60]
    assert read == pytest.approx(dict(egg.gloss)[60], rel=0.05)
    assert shader_nodes.gloss_of(shader_nodes.shader_node(found["Brick"])) is None


def dragged(name):
    """Give a mesh what a drag from the shelf does: Blender takes the asset's mark off the copy."""
    material = load(names=[name])[name]
    material.asset_clear()
    mesh_object("Wall", material)
    return material


@pytest.mark.parametrize("of_today", [True, False])
def test_what_was_dragged_shows_the_sample_that_it_is_given_later(empty_file, of_today):
    wall = dragged("Terracotta")
    if of_today:
        wall.diffuse_color = (*wall.rough_spectra.solid_color, 1.0)
    else:  # as libraries that were built before have it
        wall.diffuse_color = (*get_stamp(wall).color, 1.0)
    assert (wall.preview.is_image_custom, wall.preview.is_icon_custom) == (True, True)
    OPS.choose_sample("EXEC_DEFAULT", sample="colorchecker/14-green")
    red, green, blue, _ = wall.diffuse_color
    assert green > max(red, blue)
    assert wall.diffuse_color[:3] == wall.rough_spectra.solid_color[:]
    # Blender draws the ball of the material again: nothing is left of the terracotta's.
    assert (wall.preview.is_image_custom, wall.preview.is_icon_custom) == (False, False)
    assert len(wall.preview.icon_pixels) == 0


def test_a_color_that_the_user_gave_what_was_dragged_stays(empty_file):
    wall = dragged("Terracotta")
    wall.diffuse_color = (0.1, 0.2, 0.3, 0.5)
    OPS.choose_sample("EXEC_DEFAULT", sample="colorchecker/14-green")
    assert tuple(wall.diffuse_color) == pytest.approx((0.1, 0.2, 0.3, 0.5))


def test_the_same_sample_again_and_an_asset_keep_their_picture(empty_file):
    wall = dragged("Terracotta")
    OPS.choose_sample("EXEC_DEFAULT", sample="everyday/terracotta")
    assert wall.preview.is_image_custom
    wall.asset_mark()
    OPS.choose_sample("EXEC_DEFAULT", sample="colorchecker/14-green")
    assert wall.preview.is_image_custom


@pytest.fixture
def user(extension):
    """The preferences of a user who has the extension enabled; tests run from a clone."""
    chosen = bpy.context.preferences
    libraries, count = chosen.filepaths.asset_libraries, len(chosen.filepaths.asset_libraries)
    addon = chosen.addons.new()
    addon.module = preferences.PACKAGE
    yield SimpleNamespace(chosen=addon.preferences, libraries=libraries)
    chosen.addons.remove(addon)
    while len(libraries) > count:
        libraries.remove(libraries[-1])


def test_the_library_is_offered_once_and_dragged_as_a_copy(user):
    count = len(user.libraries)
    assert shelf.offer().startswith("Rough Spectra")
    assert len(user.libraries) == count + 1
    assert user.libraries[-1].path == str(shelf.folder())
    assert user.libraries[-1].import_method == "APPEND"
    assert bpy.context.preferences.is_dirty
    assert shelf.offer() is None  # it is there
    user.libraries.remove(user.libraries[-1])
    assert shelf.offer() is None  # it was taken out
    assert len(user.libraries) == count
    assert shelf.offer(again=True).startswith("Rough Spectra")


def test_switched_on_for_a_session_alone_it_has_its_library_too(user, monkeypatch):
    """As by `blender --addons`, which leaves no mark in the preferences: the shelf was empty."""
    monkeypatch.setattr(preferences, "PACKAGE", "switched_on_by_a_command")
    count, dirty = len(user.libraries), bpy.context.preferences.is_dirty
    assert shelf.offer().startswith("Rough Spectra")
    assert user.libraries[-1].import_method == "APPEND"
    assert shelf.offer() is None
    assert len(user.libraries) == count + 1
    assert bpy.context.preferences.is_dirty == dirty  # nothing for Blender to save
    assert user.chosen.shelf_folder == ""


def test_a_library_of_an_extension_that_moved_is_found_again(user):
    user.libraries.new(name="Rough Spectra", directory="/somewhere/else/presets/shelf")
    user.chosen.shelf_folder = "/somewhere/else/presets/shelf"
    count = len(user.libraries)
    assert shelf.offer() is None
    assert len(user.libraries) == count
    assert user.libraries[-1].path == str(shelf.folder())


def test_the_shelf_shows_what_is_ours_in_object_mode(extension, monkeypatch):
    asked = []
    monkeypatch.setattr(bpy.app.timers, "register", lambda *a, **k: asked.append(a), raising=False)
    cls = shelf_in_view.ROUGHSPECTRA_AST_materials
    shelf_in_view._asked.clear()
    assert cls.poll(SimpleNamespace(mode="OBJECT"))
    assert not cls.poll(SimpleNamespace(mode="SCULPT"))
    assert len(asked) == 1
    shelf_in_view._asked.clear()
    ours = SimpleNamespace(id_type="MATERIAL", metadata=SimpleNamespace(tags={"Rough Spectra": 1}))
    other = SimpleNamespace(id_type="MATERIAL", metadata=SimpleNamespace(tags={}))
    assert cls.asset_poll(ours)
    assert not cls.asset_poll(other)


def cube(material):
    mesh = bpy.data.meshes.new("Cube")
    mesh.materials.append(material)
    thing = bpy.data.objects.new("Cube", mesh)
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    return thing


@pytest.mark.parametrize(
    "options", [{}, *([{"pack": True}] if bpy.app.version >= (5, 0, 0) else [])]
)
def test_a_linked_material_is_made_local_and_follows_sigma(empty_file, options):
    linked = load(link=True, names=["Brick"], **options)["Brick"]
    thing = cube(linked)
    assert not thing.active_material.is_editable
    assert bpy.ops.rough_spectra.make_local.poll()
    assert bpy.ops.rough_spectra.make_local() == {"FINISHED"}
    own = thing.active_material
    assert own.is_editable
    assert not bpy.ops.rough_spectra.make_local.poll()
    before = list(shader_nodes.color_socket(shader_nodes.shader_node(own)).default_value)
    own.rough_spectra.sigma = 0.7
    bpy.context.view_layer.update()
    assert state.state(own).kind == "fresh"
    assert list(shader_nodes.color_socket(shader_nodes.shader_node(own)).default_value) != before
