# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a user finds who works in the window."""

import os
from pathlib import Path

import pytest


def same(one, other):
    """Whether two states are equal, but for the single precision of what was read back."""
    return {**one, "color": 0, "roughness": 0} == {**other, "color": 0, "roughness": 0} and [
        *one["color"],
        one["roughness"],
    ] == pytest.approx([*other["color"], other["roughness"]], abs=1e-7)


def test_dragging_gloss(scene):
    assert scene["before"]["apart"] < 0.02
    for place, (name, steps) in enumerate(scene["dragged"].items()):
        assert len({step["gloss"][place] for step in steps}) > 3, name
        assert len({tuple(step["color"]) for step in steps}) > 3, name
        assert all(step["kind"] == "fresh" for step in steps), name
        assert max(step["apart"] for step in steps) < 0.05, name
    assert scene["after"]["gloss"] != scene["before"]["gloss"]
    assert scene["undone"] == scene["before"]


def test_choosing_for_a_texture(scene):
    for way in ("stopped", "whole"):
        assert scene[f"{way}_modal"] == ["ROUGH_SPECTRA_OT_choose_sample"]
        assert scene[f"{way}_ran"]
    assert scene["left"] == [0, 0, None, ""]
    assert scene["kind"] == "fresh"
    # The wall shows the dark half alone.
    assert [0.25 * scale for scale in scene["scale"]] == pytest.approx(scene["plain"], rel=0.01)
    assert scene["undone"] == [None, ""]


def test_reading_at_another_instrument(scene):
    assert scene["read_at"] not in ("45a:0", "")
    assert scene["chosen"]["kind"] == "fresh"
    assert scene["chosen"]["stamp"] != scene["before"]["stamp"]
    assert scene["measured"] == [pytest.approx(0, abs=0.05), True]
    read_at, state = scene["undone"]
    assert read_at == "45a:0"
    assert same(state, scene["before"])


def test_matching_by_measuring(scene):
    assert scene["stopped_ran"]
    assert scene["whole_ran"]
    assert scene["left"] == [0, 0]
    assert scene["same"] == scene["before"] == scene["undone"]
    assert scene["after"] != scene["before"]
    assert scene["measured"] == pytest.approx(0, abs=0.1)


def test_dragging_sigma(scene):
    assert len({state["sigma"] for state in scene["dragged"]}) > 4
    assert len({state["roughness"] for state in scene["dragged"]}) > 4
    assert all(state["kind"] == "fresh" for state in scene["dragged"])
    assert scene["after"]["sigma"] != scene["before"]["sigma"]
    assert same(scene["undone"], scene["before"])
    assert same(scene["redone"], scene["after"])


def test_choosing_a_sample(scene):
    assert "Foliage" in scene["chosen"]["sample"]
    assert scene["chosen"]["kind"] == "fresh"
    assert scene["undone"] is None
    assert scene["redone"] == scene["left"] == scene["chosen"]


BLENDERS_OWN = ("Could not get a list of mounted file-systems",)
TOLD = (" σ 20°: ",)
"""What a user is told of the samples in a library that a scene builds."""
MEASURE = "ROUGH_SPECTRA_OT_measure"


def test_measuring(scene):
    assert MEASURE in scene["modal"]
    assert scene["still_running"]
    assert scene["shown"]  # without the pointer over the panel
    assert scene["measured"] == [pytest.approx(0, abs=0.02), True]
    assert scene["modal_after"] == []
    assert scene["undone"] is None
    assert scene["state_then"] == "fresh"
    assert scene["redone"] == scene["measured"]


def test_stopping_a_measurement(scene):
    assert scene == {"ran": True, "left": [0, 0, None], "same": True, "modal": []}


def test_undo_while_measuring(scene):
    assert scene["entered"] == pytest.approx(0.7854, abs=1e-4)
    assert scene["undone"] == pytest.approx(0.5236, abs=1e-4)
    assert scene["running"]
    # What was measured is no longer what is there, and the panel says so.
    assert scene["measured"] == [pytest.approx(0, abs=0.02), False]


def test_another_file_while_measuring(scene):
    assert scene == {"ran": True, "left": [0, 0], "modal": []}


def test_switched_off_while_measuring(scene):
    assert scene["ran"] == [1, 1, 2]
    assert scene["left"] == [0, 0, []]
    assert scene["modal"] == []
    assert scene["measured_again"] == [pytest.approx(0, abs=0.02), True]


def test_failing_to_measure(scene):
    assert scene["log"][-1] == "Blender quit"
    assert "(TypeError: must be real number, not str); nothing was written." in scene["said"]


def test_quitting_while_measuring(scene):
    [process], [folder] = scene["process"], scene["folder"]
    assert not Path(folder).exists()
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)


def test_stopping_a_bake(scene):
    assert scene == {"ran": True, "left": [0, 0, 0]}


def test_baking(scene):
    assert scene["files"]


def test_stopping_an_asset_library(scene):
    assert scene == {"ran": True, "left": [0, 0, 0, 0]}


def test_wheels_of_extensions(scene):
    wheels = ["colour_science", "defusedxml", "tiny_wheel"]
    assert [name.partition("-")[0] for name in scene["before"]] == wheels
    assert scene["after"] == scene["before"]
    assert scene["files"] == ["rough-spectra-everyday.blend", "rough-spectra-seven.blend"]
    assert scene["imported"] == 42
    assert scene["read_at"] == ["de:8"]
    assert scene["ours"]


def test_searching(scene):
    assert {words: bool(ran) for words, ran in scene.items()} == dict.fromkeys(scene, True)


def test_sidebar_and_menus(scene):
    assert scene["material"]
    assert scene["category"] == "Rough Spectra"
    assert len(scene["drawn"]) == 4


def test_preferences(scene):
    chosen = ["A", "10", 0.5, "di:8"]
    assert scene == {"new": chosen, "saved": chosen, "library": True}


def test_another_language(scene):
    assert scene["before"] == scene["after"] == "Measured: ΔE00 0.10, not visible"
    assert scene["drawn"] == "Gemessen: ΔE00 0.10, nicht sichtbar"
    assert scene["label"] == "Erneuern"


def test_off_and_on(scene):
    assert scene["same"]


def test_a_dropped_file(scene):
    assert scene["PROPERTIES"]
    assert not scene["TEXT_EDITOR"]
    assert scene["left"] == [None, True]
    assert scene["agreed"]["sample"] == "Plaster"
    assert scene["agreed"]["kind"] == "fresh"
    assert scene["added"] == ["Loess", "Plaster"]
    assert scene["undone"] is None


def test_a_file_from_the_menu(scene):
    assert scene["options"] == "ROUGH_SPECTRA_OT_import_samples"
    assert scene["added"] == ["Lime", "Loam"]
    assert scene["material"] is None


def test_other_files(scene):
    assert scene["saved"]
    assert scene["reloaded"]
    assert scene["appended"] == "fresh"
    assert scene["linked"] == scene["overridden"] == "linked"
    assert scene["override"]
    assert scene["local"] == [True, "fresh"]


def test_nothing_unwanted_was_printed(session):
    assert session["status"] == 0
    for word in ("traceback", "error", "warning", "rough_spectra", "memory"):
        lines = [line for line in session["said"].splitlines() if word in line.lower()]
        assert [line for line in lines if not any(own in line for own in BLENDERS_OWN + TOLD)] == []


def test_estimating_sigma(scene):
    assert scene["told"][0] == ""
    assert scene["told"][-1].startswith("σ 25")
    assert scene["degrees"] == pytest.approx(25, abs=0.1)
    assert "Blasted green" in scene["source"]
    assert scene["estimated"]["kind"] == "fresh"
    assert scene["estimated"]["color"] != scene["before"]["color"]
    assert same(scene["undone"], scene["before"])
    assert same(scene["left"], scene["before"])


def test_adding_a_rough_sample(scene):
    assert scene["facets"] >= 2 * 64 * 64
    assert scene["slopes"] == pytest.approx(0.5774, rel=0.05)  # tan 30°
    assert scene["lights"] >= 8
    assert scene["material"]
    assert scene["same"]
