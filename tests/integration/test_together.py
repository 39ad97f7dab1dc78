# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and sliders act on all selected objects of the sample, scripts on one material."""

import math

import bpy
import pytest
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import settled, state, storage, together
from rough_spectra.addon.preview import icons

from tests.integration.support import rgb_material
from tests.integration.test_operators import mesh_object
from tests.integration.test_simple_panel import Shown, closed, counted

OPS = bpy.ops.rough_spectra
BRICK, GREEN = "everyday/brick", "colorchecker/14-green"


@pytest.fixture
def walls(empty_file):
    """Three selected objects with a brick each, one with another sample, one that is not selected.

    The last of the bricks is the active one's.
    """
    bpy.context.scene.render.engine = "CYCLES"
    things = {}
    for name, preset in (
        ("Away", BRICK),
        ("Green", GREEN),
        ("A", BRICK),
        ("B", BRICK),
        ("C", BRICK),
    ):
        things[name] = mesh_object(name, rgb_material(name))
        OPS.assign_preset("EXEC_DEFAULT", preset=preset)
    things["Away"].select_set(False)
    yield {name: thing.active_material for name, thing in things.items()}
    icons.clear()


@pytest.fixture
def sliders(monkeypatch):
    """Names of the properties that are drawn."""
    names, real = [], Shown.prop

    def prop(self, data, name, **options):
        names.append(name)
        real(self, data, name, **options)

    monkeypatch.setattr(Shown, "prop", prop)
    return names


def degrees(material):
    return round(math.degrees(material.rough_spectra.sigma), 3)


def test_a_ball_acts_on_all_selected_objects_of_the_sample(walls):
    before = walls["Green"].rough_spectra.stamp, walls["Away"].rough_spectra.stamp
    assert OPS.set_roughness("EXEC_DEFAULT", sigma=math.radians(45)) == {"FINISHED"}
    assert [degrees(walls[name]) for name in "ABC"] == [45, 45, 45]
    assert (walls["Green"].rough_spectra.stamp, walls["Away"].rough_spectra.stamp) == before
    assert {state.state(walls[name]).kind for name in "ABC"} == {"fresh"}


def test_the_sliders_act_on_them_too_and_those_that_are_alike_are_solved_once(walls, monkeypatch):
    calls, real = [], solve.solve
    monkeypatch.setattr(solve, "solve", lambda *args: calls.append(args) or real(*args))
    group = walls["C"].rough_spectra
    walls["B"].rough_spectra.illuminant = "A"
    del calls[:]
    group.sigma_of_all = math.radians(33)
    assert len(calls) == 2  # one under each light
    assert [degrees(walls[name]) for name in "ABC"] == [33, 33, 33]
    group.gloss_of_all = 0.6
    assert [round(walls[name].rough_spectra.gloss, 3) for name in "ABC"] == [0.6, 0.6, 0.6]
    group.gloss_of_all = 0.25  # they can all shine now
    assert [round(walls[name].rough_spectra.gloss, 3) for name in "ABC"] == [0.25, 0.25, 0.25]
    for name in "ABC":
        material = walls[name]
        assert state.state(material).kind == "fresh"
        [alone] = real([storage.load(material)], storage.working_space.current())
        stamp = state.state(material).stamp
        assert stamp.color == pytest.approx(alone.color.tolist(), abs=1e-6)
        assert stamp.roughness == pytest.approx(alone.roughness, abs=1e-6)
        assert settled.shader(material)[1] == pytest.approx(alone.roughness, abs=1e-6)
    assert walls["Green"].rough_spectra.gloss == walls["Away"].rough_spectra.gloss == 0


def test_scripts_mean_one_material(walls):
    walls["C"].rough_spectra.sigma = math.radians(5)
    assert [degrees(walls[name]) for name in "ABC"] == [20, 20, 5]


def test_what_was_edited_by_hand_is_not_overwritten(walls):
    node = walls["A"].node_tree.nodes["Diffuse BSDF"]
    node.inputs["Color"].default_value = (0.1, 0.2, 0.3, 1)
    walls["C"].rough_spectra.sigma_of_all = math.radians(33)
    assert tuple(node.inputs["Color"].default_value)[:3] == pytest.approx((0.1, 0.2, 0.3))
    assert state.state(walls["B"]).kind == "fresh"


def test_a_pinned_material_is_alone(walls):
    assert together.of(walls["Away"], bpy.context.selected_objects).materials == [walls["Away"]]


def test_the_panel_says_how_many_and_draws_what_acts_on_all(walls, sliders):
    page = closed()
    assert "3 selected objects" in page
    words, numbers = counted(page)
    assert words <= 20
    assert numbers <= 3
    assert sliders == ["sigma_of_all", "gloss_of_all"]
    for thing in bpy.context.selected_objects:
        thing.select_set(thing.name == "C")
    sliders.clear()
    page = closed()
    assert not any("selected" in str(text) for text in page)
    assert sliders == ["sigma", "gloss"]


def test_objects_that_share_a_material_are_counted_and_it_is_dragged_as_ever(walls, sliders):
    for name in "AB":
        bpy.data.objects[name].active_material = walls["C"]
    page = closed()
    assert "3 selected objects" in page
    assert sliders == ["sigma", "gloss"]


def test_who_shares_the_material_unselected_is_counted_too(walls, monkeypatch):
    away = bpy.data.objects["Away"]
    assert "3 selected objects" in closed()
    away.active_material = walls["C"]
    page = closed()
    assert "4 objects, not all selected" in page
    words, numbers = counted(page)
    assert words <= 20
    assert numbers <= 3
    twin = bpy.data.objects.new("Twin", away.data)  # of the same mesh
    bpy.context.scene.collection.objects.link(twin)
    assert "5 objects, not all selected" in closed()
    monkeypatch.setattr(together, "_LASTS", math.inf)
    monkeypatch.setattr(together, "_users", None)  # nothing changed: nobody is asked again
    assert "5 objects, not all selected" in closed()
    monkeypatch.undo()
    away.select_set(True)
    twin.select_set(True)
    assert "5 selected objects" in closed()
    away.select_set(False)
    twin.select_set(False)
    bpy.data.objects.remove(twin)
    assert "4 objects, not all selected" in closed()
    other = bpy.data.objects.new("Other", away.data)  # of the mesh, but with a slot of its own
    other.material_slots[0].link = "OBJECT"
    other.material_slots[0].material = walls["Green"]
    bpy.context.scene.collection.objects.link(other)
    assert "4 objects, not all selected" in closed()
    bpy.data.objects.remove(away)  # its mesh stays, and is still a user
    assert "3 selected objects" in closed()
    assert closed(scene=bpy.data.scenes.new("Other"))


def test_of_very_many_it_is_said_up_to_how_many(walls):
    for number in range(80):
        mesh_object(f"More {number}", walls["C"])
    assert any(str(text).startswith("up to 8") for text in closed())
