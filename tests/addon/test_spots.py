# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spots on surfaces read what a formula, or a flat sample, says that they have to."""

import dataclasses

import bpy
import numpy as np
import pytest
from rough_spectra.addon.instrument import arrangement, measure, spot_measure

from tests.addon import spot_scene

NAMES = ("45a:0", "45as110", "0:45a", "di:8")
"""A ring, light from one side and a view from aside, views all around, and a hemisphere."""


def to_lab(rgb):
    """Something even to tell differences with, where their size does not matter."""
    return np.asarray(rgb) * 100


@pytest.fixture(scope="module")
def found(extension):
    """Everything that is measured here, in one scene by one second Blender, and its flat colors."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    things, flats = spot_scene.build()
    bpy.context.view_layer.update()
    asked = spot_scene.spots(things)
    rings = [arrangement.of(name) for name in NAMES]
    wanted = [rings if name in ("shiny", "leaning") else rings[:1] for name in asked]
    results = spot_measure.measure(list(asked.values()), wanted)
    shiny = {"members": (list(flats).index("shiny"),)}
    geometries = [rings[0], *(dataclasses.replace(ring, **shiny) for ring in rings[1:])]
    seen = measure.measure(list(flats.values()), geometries, rays=16384)
    shown = {name: seen[:, number, 0] for number, name in enumerate(flats)}
    return dict(zip(asked, results, strict=True)), shown


def read(found, name):
    return found[0][name].values(0)[0]


def flat(found, name):
    return found[1][name][0]


def said(found, name):
    return " ".join(found[0][name].warnings(0, to_lab))


def test_a_cubes_face_reads_as_the_flat_sample(found):
    """Wherever it is turned, in the last digits of single precision."""
    assert read(found, "cube") == pytest.approx(flat(found, "paint"), rel=1e-5)
    assert said(found, "cube") == ""
    told = found[0]["cube"].read(0, to_lab)
    assert told.covered == 1
    assert (told.spread_mean, told.spread_95, told.noise) == pytest.approx((0, 0, 0), abs=1e-3)


@pytest.mark.parametrize("number", range(len(NAMES)))
def test_every_instrument_reads_a_tilted_shiny_face_as_the_flat_sample(found, number):
    """What a hemisphere reads is estimated, and gloss varies fast over the edge of its trap."""
    values = found[0]["shiny"].values(number)[0]
    tolerance = 0.01 if NAMES[number] == "di:8" else 2e-4
    assert values == pytest.approx(found[1]["shiny"][number], rel=tolerance)


@pytest.mark.parametrize("number", range(3))
def test_azimuths_count_from_the_empty_x_axis(found, number):
    """Normals lean to that side: of each light comes what Lambert's law says.

    Cycles takes a little off where a normal leans away from its face.
    """
    shots = arrangement.of(NAMES[number]).shots
    expected = 0.0
    for shot in shots:
        theta, phi = shot.light
        toward = np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
        expected += 0.5 * (toward @ spot_scene.LEAN) / np.cos(theta) / len(shots)
    assert found[0]["leaning"].values(number)[0] == pytest.approx([expected] * 3, rel=2e-3)


def test_a_spheres_top_reads_less_the_wider_the_spot(found):
    """A matte facet at α from the top gets cos α of the light: its mean over the spot is known."""
    # Its facets lean by a degree against the normals that Cycles takes.
    assert read(found, "ball") == pytest.approx(flat(found, "matte"), rel=5e-4)
    share = 0.4**2  # (radius of the spot / radius of the sphere)²
    expected = 2 / (3 * share) * (1 - (1 - share) ** 1.5)
    assert read(found, "wide ball") == pytest.approx(flat(found, "matte") * expected, rel=1e-3)
    assert said(found, "ball") == ""
    assert "the surface turns by 2" in said(found, "wide ball")
    assert said(found, "wide ball").endswith("take a smaller spot")


@pytest.mark.parametrize("name", ["waves", "displaced"])
def test_waves_read_the_mean_of_their_slopes(found, name):
    """So dark that no light between slopes counts, and so flat that none shades another.

    Whether they are a mesh, or displacement of a flat one in the material.
    """
    x = np.linspace(0, 1, 1000, endpoint=False)
    slope = spot_scene.STEEPEST * np.cos(2 * np.pi * x)
    expected = np.mean(1 / np.hypot(1, slope))
    assert expected < 0.96
    assert read(found, name) == pytest.approx(flat(found, "dark") * expected, rel=3e-3)
    assert found[0][name].values(0)[1].min() > 1e-4


def test_a_surface_that_displacement_moves_far_away_is_found_and_told(found):
    assert read(found, "raised") == pytest.approx(flat(found, "matte"), rel=1e-5)
    assert "what is seen lies 300.0 mm off the place asked for" in said(found, "raised")
    assert found[0]["raised"].read(0, to_lab).point == pytest.approx((6.1, 10, 0.3), abs=1e-4)


def test_light_between_slopes_counts(found):
    """White waves read more of their color than dark ones."""
    dark = read(found, "waves") / flat(found, "dark")
    white = read(found, "white waves") / flat(found, "white")
    assert (white / dark > 1.01).all()


def test_a_color_attribute_is_read_and_its_spread_told(found):
    halves = np.stack([flat(found, "left"), flat(found, "right")])
    assert read(found, "attribute") == pytest.approx(halves.mean(axis=0), rel=2e-3)
    assert found[0]["attribute"].values(0)[1] == pytest.approx(halves.std(axis=0), rel=0.03)
    told = found[0]["attribute"].read(0, to_lab)
    assert 0 < told.spread_mean <= told.spread_95


def test_a_tile_and_a_named_uv_map_are_read(found):
    assert read(found, "tile") == pytest.approx(flat(found, "tile"), rel=1e-4)
    assert read(found, "named") == pytest.approx(flat(found, "tile"), rel=1e-4)


def test_neighbors_and_the_scenes_light_are_kept_out_unless_asked_for(found):
    alone, beside = read(found, "alone"), read(found, "beside")
    assert alone == pytest.approx(flat(found, "paint"), rel=1e-5)
    red, green, blue = beside / alone
    assert 0.5 < green < 0.75  # a wall stands in the way of three lights of eight
    assert blue == pytest.approx(green, rel=1e-3)
    assert 1.005 < red / green < 1.1  # it is red, and its glow is taken off
    assert "nothing" not in said(found, "beside")


def test_the_instrument_stands_in_a_closed_room(found):
    assert read(found, "room") == pytest.approx(flat(found, "matte"), rel=2e-3)


def test_an_instance_is_measured_where_it_stands(found):
    result = found[0]["instance"]
    assert result.spot.thing[0] == "Stored"
    assert result.spot.carrier[0] == "Instance"
    assert read(found, "instance") == pytest.approx(flat(found, "paint"), rel=1e-5)


def test_what_hangs_over_an_edge_and_other_materials_are_told(found):
    """At the edge of a square that is half paint and half dark."""
    expected = (flat(found, "paint") + flat(found, "dark")) / 2
    assert read(found, "edge") == pytest.approx(expected, rel=1e-3)
    covered = found[0]["edge"].read(0, to_lab).covered
    apart = 0.54  # of the edge from the middle, in radii
    beyond = (np.arccos(apart) - apart * np.sqrt(1 - apart**2)) / np.pi
    assert covered == pytest.approx(1 - beyond, abs=0.02)
    told = found[0]["edge"].warnings(0, to_lab)
    assert told == (
        f"fills {covered:.0%} of the spot; the rest is not counted",
        "other materials fill 50% of what is read",
    )
