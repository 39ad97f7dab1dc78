# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel says of a material, whatever a user of Blender does to it."""

import json
import math

import bpy
import pytest
from rough_spectra.addon.blender import shader_nodes
from rough_spectra.addon.material import (
    changes,
    derivation,
    derive,
    state,
    storage,
)
from rough_spectra.addon.material.properties import SCHEMA
from rough_spectra.core.errors import MaterialError

OPS = bpy.ops.rough_spectra


def sockets(material):
    node = shader_nodes.shader_node(material)
    return (
        *shader_nodes.color_socket(node).default_value[:3],
        shader_nodes.roughness_socket(node).default_value,
    )


def kind(material):
    return state.state(material).kind


def edit(material, value=0.9):
    shader_nodes.color_socket(shader_nodes.shader_node(material)).default_value[0] = value


@pytest.fixture
def make(make_material, colorchecker, request_for):
    """Make a material with a spectrum, on an object of its own that is active."""

    def make(name="Wall", patch=6):
        material = make_material(name)
        material.use_fake_user = True
        thing = bpy.data.objects.new(name, bpy.data.meshes.new(name))
        thing.data.materials.append(material)
        bpy.context.collection.objects.link(thing)
        bpy.context.view_layer.objects.active = thing
        thing.select_set(True)
        derive.assign([(material, request_for(colorchecker[patch]))])
        return material

    return make


def test_none_without_spectrum(make_material):
    assert state.state(make_material()) == state.State("none")


def test_fresh_and_what_was_derived(make):
    told = state.state(make())
    assert (told.kind, told.reasons) == ("fresh", ())
    assert told.stamp.version.count(".") == 2


def test_a_spectrum_without_anything_derived_is_stale(make):
    material = make()
    material.rough_spectra.stamp = ""
    assert state.state(material).reasons == ("nothing was derived from the spectrum yet",)


def test_keep_accepts_edits_until_the_next(make):
    material = make()
    spectrum = material.rough_spectra.spectrum
    with pytest.raises(RuntimeError, match="nothing to keep"):
        OPS.keep()
    edit(material)
    assert state.state(material).reasons == ("color or roughness was edited by hand",)
    assert OPS.keep() == {"FINISHED"}
    assert kind(material) == "kept"
    assert state.state(material).reasons == ("color or roughness was edited by hand, and is kept",)
    assert sockets(material)[0] == pytest.approx(0.9)
    assert material.rough_spectra.spectrum == spectrum
    edit(material, 0.8)
    assert state.state(material).reasons == (
        "color or roughness was edited by hand after earlier edits were kept",
    )
    assert OPS.keep() == {"FINISHED"}
    material.rough_spectra.sigma = math.radians(40)
    assert state.state(material).reasons == ("σ was changed from 30° to 40°",)
    material.rough_spectra.sigma = math.radians(36.92308)
    assert state.state(material).reasons == ("σ was changed from 30° to 36.92°",)
    assert sockets(material)[0] == pytest.approx(0.8)
    assert OPS.renew() == {"FINISHED"}
    assert kind(material) == "fresh"


def test_keep_takes_any_surface(make):
    material = make()
    tree = material.node_tree
    glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
    tree.links.new(glossy.outputs[0], tree.get_output_node("CYCLES").inputs["Surface"])
    assert state.state(material).reasons == ("the surface no longer comes from 'Diffuse BSDF'",)
    assert OPS.keep() == {"FINISHED"}
    assert kind(material) == "kept"


def test_renewing_all_leaves_edits_and_what_cannot_be(make, make_material):
    fresh, stale, edited, kept, broken, plain = (
        *(make(name) for name in ("fresh", "stale", "edited", "kept", "broken")),
        make_material("plain"),
    )
    edit(edited)
    edit(kept)
    storage.keep(kept)
    shader_nodes.shader_node(broken).mute = True
    for material in (stale, kept):
        with changes.paused():
            material.rough_spectra.sigma = math.radians(40)
    before = sockets(fresh), sockets(plain)
    assert OPS.renew(scope="ALL_STALE") == {"FINISHED"}
    assert [kind(m) for m in (fresh, stale, edited, kept, broken)] == [
        *("fresh", "fresh", "stale", "stale", "stale"),
    ]
    assert (sockets(fresh), sockets(plain)) == before
    assert sockets(edited)[0] == sockets(kept)[0] == pytest.approx(0.9)
    assert OPS.renew(scope="SELECTED", overwrite_edits=True) == {"FINISHED"}
    assert [kind(m) for m in (edited, kept, broken)] == ["fresh", "fresh", "stale"]


def change_shader(material):
    tree = material.node_tree
    other = tree.nodes.new("ShaderNodeBsdfPrincipled")
    tree.links.new(other.outputs[0], tree.get_output_node("CYCLES").inputs["Surface"])


def test_renewing_all_leaves_other_shaders(make):
    material = make()
    material.rough_spectra.shader = "PRINCIPLED"
    assert kind(material) == "fresh"
    change_shader(material)
    before = sockets(material)
    assert OPS.renew(scope="ALL_STALE") == {"CANCELLED"}
    assert sockets(material) == before
    assert kind(material) == "stale"
    OPS.renew()
    assert kind(material) == "fresh"
    shader_nodes.shader_node(material).name = "Plaster"
    assert OPS.renew(scope="ALL_STALE") == {"FINISHED"}
    assert kind(material) == "fresh"


@pytest.mark.parametrize("channel", [0, 1, 2, None])
def test_a_socket_that_holds_no_number_is_an_edit(make, channel):
    material = make()
    node = shader_nodes.shader_node(material)
    if channel is None:
        shader_nodes.roughness_socket(node).default_value = math.nan
    else:
        shader_nodes.color_socket(node).default_value[channel] = math.nan
    assert state.state(material).reasons == ("color or roughness was edited by hand",)


@pytest.mark.parametrize("setting", ["sigma", "tolerance"])
def test_a_setting_that_is_no_number_is_refused(make, setting):
    material = make()
    before = sockets(material)
    setattr(material.rough_spectra, setting, math.nan)
    assert sockets(material) == before
    told = state.state(material)
    assert told.kind == "error"
    assert "is not a number" in told.reasons[0]
    setattr(material.rough_spectra, setting, 1.0)
    assert kind(material) == "fresh"


def test_undo_and_redo_at_every_step(make):
    make()
    window = bpy.data.window_managers[0].windows[0]

    def wall():
        return bpy.data.materials["Wall"]

    steps = [
        lambda: setattr(wall().rough_spectra, "sigma", math.radians(45)),
        lambda: edit(wall()),
        lambda: storage.keep(wall()),
        lambda: derive.renew([wall()]),
        lambda: setattr(wall().rough_spectra, "illuminant", "A"),
    ]
    with bpy.context.temp_override(window=window, screen=window.screen):
        seen = []
        for step in (lambda: None, *steps):
            step()
            bpy.ops.ed.undo_push(message="step")
            seen.append((state.state(wall()), sockets(wall())))
        assert [told.kind for told, _ in seen] == [
            *("fresh", "fresh", "stale", "kept", "fresh", "fresh")
        ]
        for expected in reversed(seen[:-1]):
            bpy.ops.ed.undo()
            assert (state.state(wall()), sockets(wall())) == expected
        for expected in seen[1:]:
            bpy.ops.ed.redo()
            assert (state.state(wall()), sockets(wall())) == expected


def test_a_copy_is_in_step_and_on_its_own(make):
    material = make()
    copy = material.copy()
    assert state.state(copy) == state.state(material)
    before = sockets(material)
    copy.rough_spectra.sigma = math.radians(50)
    assert kind(copy) == kind(material) == "fresh"
    assert sockets(material) == before != sockets(copy)


@pytest.fixture
def library(make, tmp_path):
    """Path of a saved file whose material is in step; an empty file is open."""
    make()
    path = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return path


def bring(path, link):
    with bpy.data.libraries.load(path, link=link) as (_, wanted):
        wanted.materials = ["Wall"]
    return wanted.materials[0]


@pytest.mark.parametrize("how", ["reload", "append"])
def test_reloaded_and_appended_materials_follow(library, how):
    if how == "reload":
        bpy.ops.wm.open_mainfile(filepath=library)
        material = bpy.data.materials["Wall"]
    else:
        material = bring(library, link=False)
    assert kind(material) == "fresh"
    before = sockets(material)
    material.rough_spectra.sigma = math.radians(50)
    assert kind(material) == "fresh"
    assert sockets(material) != before


def test_a_linked_material_is_not_written_and_says_what_to_do(library):
    material = bring(library, link=True)
    told = state.state(material)
    assert told.kind == "linked"
    assert told.reasons[0].endswith("make it local to change it, or change it there")
    assert len(told.reasons) == 1
    before = sockets(material), material.rough_spectra.stamp
    # Python may write to linked data; nothing must follow.
    material.rough_spectra.sigma = math.radians(50)
    assert (sockets(material), material.rough_spectra.stamp) == before
    assert state.state(material).reasons[1:] == ("σ was changed from 30° to 50°",)
    with pytest.raises(MaterialError, match="make it local"):
        storage.keep(material)


def test_made_local_it_follows_again(library):
    material = bring(library, link=True)
    material.use_fake_user = True
    local = material.make_local()
    assert kind(local) == "fresh"
    before = sockets(local)
    local.rough_spectra.sigma = math.radians(50)
    assert kind(local) == "fresh"
    assert sockets(local) != before


def test_a_library_override_is_left_alone_and_says_so(library, tmp_path):
    material = bring(library, link=True).override_create()
    material.use_fake_user = True
    before = sockets(material)
    material.rough_spectra.sigma = math.radians(50)
    assert sockets(material) == before
    told = state.state(material)
    assert told.kind == "linked"
    assert told.reasons == (
        "it is a library override, whose nodes Blender resets; make it local to change it",
        "σ was changed from 30° to 50°",
    )
    path = str(tmp_path / "shot.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    found = next(m for m in bpy.data.materials if m.override_library is not None)
    assert state.state(found).kind == "linked"
    assert sockets(found) == before
    # Local, it says what differs, and renews.
    found.override_library.destroy()
    local = bpy.data.materials["Wall"].make_local()
    assert kind(local) in {"fresh", "stale"}
    derive.renew([local])
    assert kind(local) == "fresh"


def test_another_working_space_is_told_kept_and_renewed(make, set_working_space):
    material, kept = make(), make("Kept")
    set_working_space("ACEScg")
    for m in (material, kept):
        assert state.state(m).reasons == (
            "the working space changed from Linear Rec.709 to ACEScg",
        )
    # Its sockets are converted; whether they were edited before is not known: left alone.
    before = sockets(material)
    material.rough_spectra.sigma = math.radians(31)
    assert sockets(material) == before
    storage.keep(kept)
    assert kind(kept) == "kept"
    assert OPS.renew(scope="ALL_STALE") == {"FINISHED"}
    assert kind(material) == "fresh"
    set_working_space("Linear Rec.709")
    assert kind(material) == kind(kept) == "stale"


def test_an_older_stamp_is_read_without_loss(make):
    """As version 0.1.0 first wrote it: without settings, version or what was kept."""
    material = make()
    group = material.rough_spectra
    data = json.loads(group.stamp)
    for key in ("settings", "version", "derivation"):
        del data[key]
    group.stamp = json.dumps(data)
    details = json.loads(group.details)
    group.details = json.dumps({key: details[key] for key in ("license", "position", "notes")})
    [reason] = state.state(material).reasons
    assert reason.startswith("the model has changed since Rough Spectra derived it: σ is ")
    with changes.paused():
        group.sigma = math.radians(40)
    assert state.state(material).reasons == ("the spectrum or a setting was changed", reason)
    spectrum = group.spectrum
    derive.renew([material])
    assert kind(material) == "fresh"
    assert (group.spectrum, group.schema) == (spectrum, SCHEMA)


def test_what_another_version_derived_is_told(make):
    material = make()
    group = material.rough_spectra
    group.stamp = json.dumps(json.loads(group.stamp) | {"derivation": 99, "version": "9.9.9"})
    assert state.state(material).reasons == ("it was derived by a newer Rough Spectra 9.9.9",)
    before = sockets(material)
    group.sigma = math.radians(40)
    assert sockets(material) == before
    assert OPS.renew() == {"FINISHED"}
    assert kind(material) == "fresh"


def test_what_a_newer_version_notes_besides_does_not_matter(make):
    material = make()
    group = material.rough_spectra
    group.stamp = json.dumps(json.loads(group.stamp) | {"weather": "fair"})
    assert kind(material) == "fresh"


@pytest.mark.parametrize(
    "damage",
    [{"color": "red"}, {"color": [1]}, {"roughness": "x"}, {"delta_e_mean": None}, {"warnings": 1}],
)
def test_a_damaged_stamp_counts_as_none(make, damage):
    material = make()
    group = material.rough_spectra
    group.stamp = json.dumps(json.loads(group.stamp) | damage)
    assert state.state(material).reasons == ("nothing was derived from the spectrum yet",)


def test_what_a_newer_version_stored_is_not_touched(make):
    material = make()
    group = material.rough_spectra
    group.schema, group.stamp = SCHEMA + 1, '{"of": "the future"}'
    before = sockets(material)
    told = state.state(material)
    assert (told.kind, told.stamp) == ("error", None)
    assert "update the extension" in told.reasons[0]
    group.sigma = math.radians(50)
    for act in (OPS.renew, OPS.keep):
        with pytest.raises(RuntimeError):
            act()
    assert OPS.renew(scope="ALL_STALE") == {"CANCELLED"}
    assert sockets(material) == before
    assert (group.schema, group.stamp, group.error) == (SCHEMA + 1, '{"of": "the future"}', "")


def test_a_stamp_is_parsed_once(make, monkeypatch):
    material = make()
    state.state(material)
    monkeypatch.setattr(derivation.json, "loads", None)
    assert kind(material) == "fresh"
