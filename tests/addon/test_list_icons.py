# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The small balls of a list: of the color, roughness and gloss that an assignment gives."""

import math
import types

import numpy as np
import pytest
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.interface.operators import find_nearest
from rough_spectra.addon.matching import own_gloss, solve
from rough_spectra.addon.preview import figures, list_icons
from rough_spectra.addon.preview.figures import data
from rough_spectra.addon.samples import preset_index, presets


@pytest.fixture(autouse=True)
def forgotten():
    yield
    list_icons.clear()


@pytest.mark.parametrize("name", ["brick", "carpet-gray", "nylon-blue", "chalk", "fleece-black"])
def test_a_ball_looks_as_what_is_assigned(name):
    entries = {entry.id: entry for entry in preset_index.entries()}
    entry = entries[f"everyday/{name}"]
    sample, space = presets.load(entry.id), working_space.current()
    gloss = own_gloss.of_sample(sample)
    assert preset_index.glosses_of_presets().get(entry.id) == gloss
    sigma = entry.sigma_degrees
    [solution] = solve.solve([solve.Request(sample, math.radians(sigma), gloss=gloss)], space)
    side, screen = 32, data.to_screen(space.key)
    wanted = figures.ball(side, solution.color, solution.roughness, screen, gloss)
    [found] = list_icons.drawn(np.array([entry.swatch]), sigma, gloss, side)
    # One roughness for all colors, and a gloss that does not darken what is below: some levels.
    assert np.abs(found.astype(int) - wanted).max() <= 24
    assert np.abs(found.astype(int) - wanted).mean() < 4


def test_what_looks_alike_shares_an_icon(monkeypatch):
    red, green = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    wanted = [
        list_icons.Pictured(red, 0.0),
        list_icons.Pictured(green, 0.0),
        list_icons.Pictured(red, 0.2),
        list_icons.Pictured(red, 30.0),
        list_icons.Pictured(None, 0.0),
    ]
    assert len(list_icons.icon_ids(wanted)) == 5
    assert len(list_icons._kept) == 4
    monkeypatch.setattr(list_icons, "_BOUND", 2)
    list_icons.icon_ids(wanted[:1])
    assert len(list_icons._kept) == 2


def test_a_name_in_the_list_of_colors_ends_with_a_word():
    item = types.SimpleNamespace(name="Brick", sample="everyday/brick")
    assert find_nearest._told(item) == "Brick (everyday)"
    item.name, item.sample = "ColorChecker 19 White 9.5 (.05 D)", "colorchecker/19-white-9-5"
    assert find_nearest._told(item) == "ColorChecker 19 White 9.5 (.05 D)"
    item.name = "Wall of the old town hall, east side, second floor"
    assert find_nearest._told(item) == "Wall of the old town hall, east side,…"
