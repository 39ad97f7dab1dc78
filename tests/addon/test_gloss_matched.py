# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials that keep their gloss: what they read when they are rendered is the sample's."""

import re

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes, working_space
from rough_spectra.addon.instrument import arrangement
from rough_spectra.addon.instrument.measure import measure
from rough_spectra.addon.matching import assess, scene_match, solve, surface_spectra
from rough_spectra.addon.matching.request import Request
from rough_spectra.addon.material import derivation, derive, settled, state, storage
from rough_spectra.addon.preview import data
from rough_spectra.addon.samples import presets
from rough_spectra.core import cycles, ladder, reading
from rough_spectra.core.color import color_difference
from rough_spectra.core.cycles import gloss_lobe, gloss_reading
from rough_spectra.core.errors import DomainError
from rough_spectra.core.gloss import Gloss
from rough_spectra.core.numerics import direction_grid

from tests.addon.test_scene import light_of, view_of
from tools.checks import check_gloss

AT = "45a:0"
SIGMA = np.radians(20)


def request_of(name, gloss=None, **settings):
    return Request(presets.load(check_gloss.SAMPLES[name]), SIGMA, gloss=gloss, **settings)


def test_renders_read_like_the_sample_wherever_the_gloss_is_possible():
    cases = check_gloss.run(("white", "black", "brick"), (0.5, 1.0), (0.1, 0.5, 0.9), (0.0, 1.0))
    assert [case for case in cases if check_gloss.is_wrong(case)] == []
    possible = [case.measured for case in cases if not case.told]
    assert len(possible) > 30
    assert max(possible) < 0.001
    assert max(case.ignored for case in cases) > 5
    assert {case.sample for case in cases if case.told} == {"black"}


@pytest.mark.parametrize("instrument", ["0:45a-iso", "di:8", "de:8", "45as25"])
def test_renders_read_like_the_sample_at_other_instruments(instrument):
    """Noise of the sphere's light included."""
    kinds = [(1.0, 0.3, 0.0), (0.5, 0.15, 1.0)]
    materials = [check_gloss.principled(*kind) for kind in kinds]
    wanted = request_of("concrete", read_at=instrument)
    solutions = derive.assign([(material, wanted) for material in materials])
    seen = measure(materials, [arrangement.of(instrument)])[0, :, 0]
    assert check_gloss.difference(seen, solutions).max() < 0.1
    assert not any("cannot" in text for found in solutions for text in found.warnings)


@pytest.mark.parametrize(
    ("name", "gloss"),
    [
        ("black", Gloss(level=0.8)),
        ("black", Gloss(level=0.3, roughness=0.9, coat=1.0, coat_roughness=0.6)),
        ("paper", Gloss(level=1.0, roughness=0.1, coat=1.0)),
    ],
)
def test_the_gloss_that_is_said_to_be_possible_is_the_most_that_is(name, gloss):
    space = working_space.current()

    def miss(tried):
        [found] = solve.solve([request_of(name, tried)], space)
        return found.delta_e_instrument, " ".join(found.warnings)

    missed, told = miss(gloss)
    assert missed > 0.1
    assert f"ΔE00 {missed:.2f}" in told
    what, most = re.search(r"(Specular IOR Level|Coat Weight) (0\.\d+) is the most", told).groups()
    if what == "Coat Weight":
        gloss = gloss._replace(level=0.0)
    field = {"Specular IOR Level": "level", "Coat Weight": "coat"}[what]
    missed, told = miss(gloss._replace(**{field: float(most)}))
    assert missed < 1e-6
    assert "gloss" not in told
    assert miss(gloss._replace(**{field: float(most) + 0.02}))[0] > 1e-3


def test_one_call_solves_samples_of_different_gloss():
    kinds = [None, Gloss(level=0.2), None, Gloss(level=0.4, coat=0.5)]
    requests = [request_of(name, gloss) for name in ("brick", "paper") for gloss in kinds]
    space = working_space.current()
    for request, found in zip(requests, solve.solve(requests, space), strict=True):
        [alone] = solve.solve([request], space)
        np.testing.assert_allclose(found.color, alone.color, atol=1e-12)
        assert ("with gloss" in found.shader_reason) == (request.gloss is not None)


def test_numbers_of_all_angles_are_of_the_body_through_its_gloss():
    """Each of them by itself: the lobe with gloss over it, and the same gloss over the target."""
    gloss, space = Gloss(level=0.4, roughness=0.3), working_space.current()
    [found] = solve.solve([request_of("brick", gloss)], space)
    [(request, _)] = solve.settle([request_of("brick", gloss)])
    [seen], [albedo] = surface_spectra.readings_and_albedos([request])
    rgb = space.rgb_weights(request.sample.wavelengths, "D65")
    there = gloss_reading.at_instrument(gloss, AT)
    at = direction_grid.hemisphere(solve.MATCH_GEOMETRIES)
    told = assess.differences(request, (seen, albedo), (found.color, found.roughness), space)
    assert told == pytest.approx(
        (found.delta_e_instrument, found.delta_e_mean, found.delta_e_95), abs=1e-9
    )
    layer = gloss_lobe.layer(gloss, *at)
    shown = layer.over(cycles.reflectance(found.color, np.full(len(at[0]), found.roughness), *at))
    matte = ladder.reflectance(request.model, albedo, *at, request.sigma) @ rgb
    body = matte * (seen @ rgb - there.shine) / there.passed / (seen @ rgb)
    expected = color_difference.delta_e(
        space.to_lab(shown, "D65"), space.to_lab(layer.over(body), "D65")
    )
    assert found.delta_e_mean == pytest.approx(float(expected.mean()), abs=1e-9)


def test_pictures_show_the_gloss(make_material):
    gloss = Gloss(level=0.45, roughness=0.2)
    material = check_gloss.principled(gloss.level, gloss.roughness, 0.0)
    [solution] = derive.assign([(material, request_of("brick"))])
    space = working_space.current()
    shown = data.collect(material, space)
    assert shown.blender.color == pytest.approx(shown.target.color, abs=1e-5)
    matte = check_gloss.principled(0.0, 0.5, 0.0)
    derive.assign([(matte, request_of("brick"))])
    without = data.collect(matte, space)
    # The lobe's tip towers over the body, in both curves.
    for with_gloss, plain in (
        (shown.blender_curve, without.blender_curve),
        (shown.target_curve, without.target_curve),
    ):
        assert with_gloss.max() > 3 * plain.max()
    assert shown.reading == pytest.approx(without.reading)
    assert settled.differences(material, space)[0] == pytest.approx(
        solution.delta_e_instrument, abs=1e-3
    )


@pytest.mark.parametrize("gloss", [None, Gloss(level=0.4, coat=0.3, coat_tint=(0.9, 0.8, 0.6))])
def test_in_a_scene_what_is_left_over_is_what_the_shader_does(gloss):
    """Ways of one light, each with a place of its own, and 45°/0°."""
    view, space = view_of(light_of((1, 0.7, 0.4), "Warm")), working_space.current()
    [(request, _)] = solve.settle([request_of("brick", gloss, scene=view)])
    [found] = solve.solve([request], space)
    [read], [albedo] = surface_spectra.readings_and_albedos([request])
    [light], bands, angles = view.lights, request.sample.wavelengths, np.array(view.angles)
    lamp = scene_match.light_rgb(light.white, space.from_xyz)
    shown = cycles.reflectance(found.color, np.full(angles.shape[1], found.roughness), *angles)
    matte = ladder.reflectance(request.model, albedo, *angles, request.sigma)
    wanted = matte @ light.weights(bands)
    if gloss is not None:
        layer, there = gloss_lobe.layer(gloss, *angles), gloss_reading.at_instrument(gloss, AT)
        shown = layer.over(shown)
        whole = read @ light.weights(bands) @ space.from_xyz.T / lamp
        share = (whole - there.shine) / there.passed / whole
        body = wanted @ space.from_xyz.T / lamp * share
        wanted = layer.over(body) * lamp @ np.linalg.inv(space.from_xyz).T
    apart = color_difference.delta_e(
        scene_match.to_lab(shown, light, space), color_difference.xyz_to_lab(wanted, light.white)
    )
    weights = view.place_weights / view.place_weights.sum()
    assert found.delta_e_mean == pytest.approx(float(apart @ weights), abs=1e-6)
    told = solve.differences(request, view, found.color, found.roughness, space)
    np.testing.assert_allclose(told, apart, atol=1e-6)
    seen = cycles.reflectance(found.color, found.roughness, *reading.INSTRUMENT_ANGLES[AT])
    lab = scene_match.to_lab(gloss_reading.reading(seen, gloss, AT), light, space)
    goal = color_difference.xyz_to_lab(read @ light.weights(bands), light.white)
    assert found.delta_e_instrument == pytest.approx(
        float(color_difference.delta_e(lab, goal)), abs=1e-6
    )


def test_gloss_survives_save_and_load(tmp_path):
    material = check_gloss.principled(0.4, 0.3, 0.2)
    material.use_fake_user, material.name = True, "Kept"
    derive.assign([(material, request_of("brick"))])
    before = storage.load(material).gloss
    path = str(tmp_path / "scene.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    material = bpy.data.materials["Kept"]
    assert state.state(material).kind == "fresh"
    assert storage.load(material).gloss == before
    assert derivation.get_stamp(material).gloss == before.numbers()


def test_a_gloss_that_is_no_number_is_refused():
    with pytest.raises(DomainError, match="A number of the gloss is none"):
        request_of("brick", Gloss(roughness=float("nan")))
    material = check_gloss.principled(0.4, 0.3, 0.0)
    derive.assign([(material, request_of("brick"))])
    node = shader_nodes.shader_node(material)
    node.inputs["Roughness"].default_value = float("nan")
    assert "no number" in str(settled.obstacle(shader_nodes.surface(material)))
