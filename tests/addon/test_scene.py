# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Analyze a scene, match materials to it, and tell what was done."""

import json
import math
import time
from dataclasses import replace

import bpy
import numpy as np
import pytest
from mathutils import Vector
from rough_spectra.addon.blender import shader_nodes, working_space
from rough_spectra.addon.colorimetry import illuminant_spectra, tristimulus
from rough_spectra.addon.instrument import bake
from rough_spectra.addon.matching import scene_match, scene_view, solve
from rough_spectra.addon.material import (
    derivation,
    derive,
    last_measurement,
    state,
    storage,
)
from rough_spectra.addon.samples import light_source, presets
from rough_spectra.addon.scene import analysis, chosen_light, follow_scene, sampling
from rough_spectra.core import cycles
from rough_spectra.core.color import color_difference
from rough_spectra.core.errors import InputError, MaterialError
from rough_spectra.core.instruments import quadrature
from rough_spectra.core.numerics import direction_grid

from tools.checks import judge_scene, make_room

SIGMA = math.radians(30)


def analyze(view=None):
    scene = bpy.context.scene
    return analysis.analyze(bpy.context.evaluated_depsgraph_get(), scene, view)


@pytest.fixture
def plate(make_material):
    """A lit square under a camera; gives its material, which stores a spectrum."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    material = make_material("Plate")
    bpy.ops.mesh.primitive_plane_add(size=2)
    bpy.context.object.data.materials.append(material)
    lens = bpy.data.cameras.new("View")
    scene.camera = bpy.data.objects.new("View", lens)
    scene.camera.location = (0.5, 0, 3)
    scene.collection.objects.link(scene.camera)
    derive.assign([(material, solve.Request(presets.load("light skin"), SIGMA, "closure"))])
    return material


def add_lamp(name="Bulb", kind="POINT", place=(1, 0, 2), **settings):
    light = bpy.data.lights.new(name, kind)
    light.energy = 50
    for key, value in settings.items():
        setattr(light, key, value)
    lamp = bpy.data.objects.new(name, light)
    lamp.location = place
    bpy.context.scene.collection.objects.link(lamp)
    return lamp


def light_of(rgb, name="Light", share=1.0):
    xyz = np.linalg.solve(working_space.current().from_xyz, np.array(rgb, float))
    spd, words = illuminant_spectra.like(xyz)
    return scene_view.make_light(name, words, spd, share)


def view_of(*lights):
    """The lights from eight directions each."""
    spread = np.column_stack(direction_grid.hemisphere(8)).tolist()
    rows = [(*a, i, light.share / 8) for i, light in enumerate(lights) for a in spread]
    return scene_view.SceneView("Scene", lights, tuple(rows))


def spent(work):
    """Processor seconds of some work, the least of some: another process may disturb it."""
    times = []
    for _ in range(4):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def test_room_is_analyzed_faster_than_blender_casts_the_rays_and_matched_better():
    """A smaller room than the tool's; errors are of pixels that the analysis did not look at."""
    materials = make_room.furnish(objects=70, materials=16)
    judge_scene.dress(materials)
    scene, depsgraph = bpy.context.scene, bpy.context.evaluated_depsgraph_get()
    seen = judge_scene.picture(depsgraph, scene)
    before = judge_scene.errors(seen)
    report = analyze()
    down = Vector((0, 0.3, -1))

    def cast():
        for _ in range(500):
            scene.ray_cast(depsgraph, (0, 0, 1.5), down)

    rays = analysis.camera.ROWS * analysis.camera.COLUMNS + len(report.views) * 32 * 48
    assert spent(analyze) < spent(cast) / 500 * rays
    follow_scene.follow(report)
    after = judge_scene.errors({m: parts for m, parts in seen.items() if m in report.views})
    better = [after[material] < before[material] for material in after]
    assert len(after) >= 12
    assert np.mean(list(after.values())) < np.mean([before[m] for m in after])
    assert np.mean(better) >= 0.8


def test_every_part_of_an_analysis_adds_up_and_survives_storage():
    materials = make_room.furnish(objects=30, materials=6)
    report = analyze()
    assert set(report.views) <= set(materials)
    assert sum(report.pixels.values()) <= 1
    for view in report.views.values():
        assert view.weights.sum() == pytest.approx(1, abs=1e-4)
        for index, light in enumerate(view.lights):
            mine = view.weights[view.light_indices == index].sum()
            assert mine == pytest.approx(light.share, abs=1e-4)
            assert light.white[1] == pytest.approx(1, abs=1e-4)
        assert len(view.place_weights) <= 24
        assert len(view.geometries) <= 24 * len(view.lights)
        parts = np.bincount(view.places, view.weights)
        assert parts == pytest.approx(view.place_weights)
        together = set(zip(view.places.tolist(), view.light_indices.tolist(), strict=True))
        assert len(together) == len(view.geometries)  # each light once at a place
        assert scene_view.from_json(view.to_json()) == view
    again = analyze()
    assert again.views == report.views


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"schema": 9}', '{"schema": 1, "lights": []}'])
def test_damaged_analysis_is_named(text, plate):
    with pytest.raises(InputError, match="analyze it again"):
        scene_view.from_json(text)
    group = plate.rough_spectra
    group.scene_view = text or "x"
    group.use_scene = True
    with pytest.raises(MaterialError, match=r"'Plate'.*analyze it again"):
        storage.load(plate)


@pytest.mark.parametrize(
    "rgb", [(1, 1, 1), (1, 0.8, 0.6), (1, 0.2, 0.8), (0.1, 0.3, 1), (0.02, 1, 0.03)]
)
def test_spectrum_of_a_light_has_its_color_and_is_one_of_light(rgb):
    light = light_of(rgb)
    found = working_space.current().from_xyz @ light.white
    assert found / found.max() == pytest.approx(np.array(rgb) / max(rgb), abs=1e-4)
    assert min(light.spd) >= 0


def test_spectra_of_standard_lights_give_the_colors_of_their_illuminants(colorchecker):
    bands = colorchecker[0].wavelengths
    values = np.stack([sample.values for sample in colorchecker])
    spectra = {"A": illuminant_spectra.planck(2855.5), "D50": illuminant_spectra.daylight(5003)}
    for name, spd in spectra.items():
        matrix = illuminant_spectra.weights(tuple(bands.tolist()), tuple(spd.tolist()))
        own = color_difference.xyz_to_lab(values @ matrix, matrix.sum(axis=0))
        assert (
            color_difference.delta_e(own, tristimulus.spectrum_to_lab(values, bands, name)).max()
            < 0.02
        )


def test_compromise_is_the_least_of_a_fine_search():
    """One gray channel in two lights that want different grays: no better one on a fine grid."""
    view = view_of(light_of((1, 0.5, 0.2), "Warm", 0.6), light_of((0.4, 0.6, 1), "Cold", 0.4))
    sample = presets.load("bluish green")
    space = working_space.current()
    values = sample.reflectance
    rough, _, _ = scene_match.match(view, values, values, "lambert", 0.0, sample.wavelengths, space)
    best = np.average(rough.over_scene, weights=view.weights)

    def cost(color):
        shader = (np.clip(color, 0, 1), rough.roughness)
        apart = scene_match.differences(
            view, shader, values, "lambert", 0.0, sample.wavelengths, space
        )
        return np.average(apart, weights=view.weights)

    random = np.random.default_rng(3)
    steps = random.normal(size=(300, 3)) * np.repeat([0.003, 0.01, 0.05], 100)[:, np.newaxis]
    assert best <= min(cost(rough.color + step) for step in steps) + 0.01


@pytest.mark.parametrize("sigma", [0.2, 0.8])
def test_compromise_in_color_and_roughness_is_the_least_near_and_far(colorchecker, sigma):
    """Steps of every size and anywhere in the domain, in two lights, find nothing better.

    But for what a quadratic form misses of differences of several ΔE00: two in a hundred.
    """
    view = view_of(light_of((1, 0.5, 0.2), "Warm", 0.6), light_of((0.4, 0.6, 1), "Cold", 0.4))
    space = working_space.current()
    random = np.random.default_rng(4)
    sizes = np.repeat([0.001, 0.01, 0.05, 0.3], 60)[:, np.newaxis]
    for sample in colorchecker[3::7]:
        rho, bands = sample.values, sample.wavelengths
        rough, _, _ = scene_match.match(view, rho, rho, "closure", sigma, bands, space)
        best = np.average(rough.over_scene, weights=view.weights)
        found = np.append(rough.color, rough.roughness)
        for tried in np.clip(found + random.normal(size=(240, 4)) * sizes, 0, 1):
            shader = (tried[:3], float(tried[3]))
            apart = scene_match.differences(view, shader, rho, "closure", sigma, bands, space)
            assert best <= 1.02 * np.average(apart, weights=view.weights) + 0.005


def test_compromise_is_no_worse_than_either_lights_own_color(colorchecker):
    warm, cold = light_of((1, 0.6, 0.25), "Warm", 0.5), light_of((0.3, 0.5, 1), "Cold", 0.5)
    both = view_of(warm, cold)
    space = working_space.current()
    for sample in colorchecker[::3]:
        arguments = (sample.values, sample.values, "closure", SIGMA, sample.wavelengths, space)
        mixed, _, _ = scene_match.match(both, *arguments)
        mean = np.average(mixed.over_scene, weights=both.weights)
        for light in (warm, cold):
            alone, _, _ = scene_match.match(view_of(light), *arguments)
            shader = (alone.color, alone.roughness)
            apart = scene_match.differences(
                both, shader, sample.values, "closure", SIGMA, sample.wavelengths, space
            )
            assert mean <= np.average(apart, weights=both.weights) + 0.02


@pytest.mark.parametrize("read_at", ["45a:0", "45as75", "di:8"])
def test_what_a_match_leaves_over_is_what_its_shader_does(colorchecker, read_at):
    """In the scene and at the instrument; also when the view was used before, with other bands."""
    view = view_of(light_of((1, 0.6, 0.25), "Warm", 0.7), light_of((0.02, 1, 0.03), "Lime", 0.3))
    space, sample = working_space.current(), colorchecker[5]
    read, bands = 0.9 * sample.values, sample.wavelengths
    arguments = (read, "closure", SIGMA, bands, space, read_at)
    first = scene_match.match(view, sample.values, *arguments)
    half = (read[::2], "closure", SIGMA, bands[::2], space, read_at)
    scene_match.match(view, sample.values[::2], *half)
    again = scene_match.match(scene_view.from_json(view.to_json()), sample.values, *arguments)
    for found, same in zip(first[:2], again[:2], strict=True):
        assert (found.color == same.color).all()
        shader = (found.color, found.roughness)
        over = scene_match.differences(view, shader, sample.values, *arguments[1:])
        assert found.over_scene == pytest.approx(over, abs=1e-9)
        of = quadrature.of(read_at)
        directions = (of.theta_i, of.theta_r, of.delta_phi)
        seen = of.weights @ cycles.reflectance(
            *(np.tile(shader[0], (of.weights.size, 1)), np.full(of.weights.size, shader[1])),
            *directions,
        )
        for light, apart in zip(view.lights, found.instrument.tolist(), strict=True):
            wanted = color_difference.xyz_to_lab(read @ light.weights(bands), light.white)
            own = color_difference.delta_e(scene_match.to_lab(seen, light, space), wanted)
            assert apart == pytest.approx(float(own), abs=1e-9)


def test_the_target_of_a_match_is_the_mean_over_the_lights_by_their_shares(colorchecker):
    """Each channel of the reading over that of the light, as a renderer multiplies them."""
    view = view_of(light_of((1, 0.6, 0.25), "Warm", 0.7), light_of((0.5, 0.7, 1), "Cold", 0.3))
    space, sample = working_space.current(), colorchecker[5]
    bands = sample.wavelengths
    arguments = (sample.values, "closure", SIGMA, bands, space)
    *_, found = scene_match.match(view, sample.values, *arguments)
    ratios = [
        (space.from_xyz @ (sample.values @ light.weights(bands))) / (space.from_xyz @ light.white)
        for light in view.lights
    ]
    assert np.abs(ratios[0] - ratios[1]).max() > 1e-3
    assert found == pytest.approx(0.7 * ratios[0] + 0.3 * ratios[1], rel=1e-9)


def test_means_are_of_the_lights_that_shine():
    """One of them has no direction left."""
    names = ("Warm", "Cold", "Gone")
    lights = tuple(
        light_of((1, 0.6, 0.25), name, share)
        for name, share in zip(names, (0.6, 0.4, 0), strict=True)
    )
    rows = ((0.1, 0.2, 0.3, 0, 0.2, 0), (0.4, 0.2, 0.3, 1, 0.4, 0), (0.1, 0.5, 0.3, 0, 0.4, 1))
    view = scene_view.SceneView("Scene", lights, rows)
    means = dict(scene_match.mean_of_lights(view, np.array([3.0, 6.0])))
    assert means == {"Warm": pytest.approx(5.0), "Cold": pytest.approx(3.0)}


def test_equal_views_are_one_key():
    view = view_of(light_of((1, 1, 1)))
    same = scene_view.SceneView(view.scene, view.lights, view.geometries)
    other = replace(view, scene="Other")
    assert {view: 1}[same] == 1
    assert other not in {view: 1}


def test_a_place_holds_its_lights_in_their_parts():
    """Two lamps at three places, one of which the second does not reach; a third is too faint."""
    hit, lamp = np.repeat([4, 7, 9], 3), np.tile([0, 1, 2], 3)
    light = np.choose(lamp, (3.0, 1.0, 0.02))
    light[-2] = 0
    angle = np.linspace(0.1, 1.0, 9)
    samples = sampling.Samples(angle, angle, angle, hit, lamp, light, np.zeros((9, 3)))
    weights = sampling.per_place(samples, 10, np.zeros(10, int))
    chosen, weight, place = sampling.reduce(samples, weights, lamp)
    assert weight.sum() == pytest.approx(1)
    for number, parts in ((4, (0.75, 0.25)), (7, (0.75, 0.25)), (9, (1.0,))):
        mine = hit[chosen] == number
        assert len(set(place[mine])) == 1
        assert weight[mine][np.argsort(lamp[chosen[mine]])] * 3 == pytest.approx(parts)


def test_an_analysis_whose_places_have_no_light_is_refused():
    view = view_of(light_of((1, 1, 1)))
    rows = tuple((*row, 2 * number) for number, row in enumerate(view.geometries))
    text = scene_view.SceneView("Scene", view.lights, rows).to_json()
    with pytest.raises(InputError, match="a place has no light"):
        scene_view.from_json(text)


def test_an_analysis_without_its_scene_is_refused_and_rounded_angles_are_not():
    view = view_of(light_of((1, 1, 1)))
    data = json.loads(view.to_json())
    del data["scene"]
    with pytest.raises(InputError, match="analyze it again"):
        scene_view.from_json(json.dumps(data))
    data = json.loads(view.to_json())
    data["geometries"][0][:2] = [-5e-4, np.pi / 2 + 5e-4]
    read = scene_view.from_json(json.dumps(data))
    assert read.geometries[0][:2] == (0.0, np.pi / 2)


def test_two_lights_are_told_apart_and_explained(plate):
    add_lamp("Warm", use_temperature=True, temperature=2700)
    add_lamp("Blue", place=(-1, 0.5, 2), color=(0.3, 0.5, 1))
    [change] = follow_scene.follow(analyze())
    assert {name for name, _ in change.solution.delta_e_lights} == {"Warm", "Blue"}
    assert change.solution.delta_e_mean < change.before
    sentence = derivation.get_stamp(plate).scene_reason
    assert "2 colors of light" in sentence
    assert "Warm ΔE00" in sentence
    assert derivation.get_stamp(plate).delta_e_lights == change.solution.delta_e_lights


def test_roughness_is_taken_where_it_is_better_on_average(colorchecker):
    """Lights that contradict each other make up the largest error, with and without roughness."""
    warm, cold = light_of((1, 0.6, 0.25), "Warm", 0.6), light_of((0.3, 0.5, 1), "Cold", 0.4)
    sample, space = colorchecker[1], working_space.current()
    arguments = (sample.values, sample.values, "closure", SIGMA, sample.wavelengths, space)
    for view in (view_of(warm, cold), view_of(replace(warm, share=1.0))):
        rough, lambert, _ = scene_match.match(view, *arguments)
        taken, reason = scene_match.choose_shader(view, lambert, rough, 1.0)
        assert taken is rough
        assert "on average in its scene" in reason
        taken, reason = scene_match.choose_shader(view, lambert, rough, 50.0)
        assert taken is lambert
        assert "within 50" in reason


def test_lights_of_one_color_count_as_one(plate):
    for number in range(3):
        add_lamp(f"Bulb {number}", place=(number - 1, 0, 2), color=(1, 0.7, 0.4))
    view = analyze().views[plate]
    assert [light.name.endswith("and 2 more") for light in view.lights] == [True]


def test_lamps_send_the_spectra_that_were_chosen_for_them(plate, tmp_path):
    """What spectral pictures go by; a lamp of the same color with no such choice stays apart."""
    path = tmp_path / "line.csv"
    path.write_text("nm,power\n588.8,0\n589.3,1\n589.8,0\n", encoding="utf-8")
    color = (1, 0.85, 0.7)
    for number, spectrum in enumerate(("F11", "F11", "COLOR", "MEASURED")):
        lamp = add_lamp(f"Bulb {number}", place=(number - 1, 0, 2), color=color)
        if spectrum == "MEASURED":
            chosen_light.keep(lamp.data, light_source.read(path), str(path))
        else:
            lamp.data.rough_spectra.spectrum = spectrum
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("Sky")
    scene.world.rough_spectra.spectrum = "D65"
    view = analyze().views[plate]
    found = {light.words: light for light in view.lights}
    assert len(found) == 4
    assert {"CIE F11", "CIE D65", "measured: line.csv"} < set(found)
    f11, line = found["CIE F11"], found["measured: line.csv"]
    assert f11.spd == pytest.approx(illuminant_spectra.cie("F11"), rel=1e-3)
    assert np.dot(illuminant_spectra.GRID, line.spd) / np.sum(line.spd) == pytest.approx(
        589.3, abs=1
    )
    # By hand: the reading under F11, of its white, in place of that under a lamp of its color.
    sample = presets.load("light skin")
    weights = f11.weights(sample.wavelengths)
    seen = sample.values @ illuminant_spectra.weights(
        tuple(sample.wavelengths.tolist()), tuple(illuminant_spectra.cie("F11").tolist())
    )
    assert sample.values @ weights == pytest.approx(seen, rel=1e-3)
    bpy.data.lights["Bulb 3"].rough_spectra.measured = "[1"
    with pytest.raises(MaterialError, match="is damaged"):
        analyze()


def test_light_linking_shadows_and_hidden_lights_count(plate):
    add_lamp(
        "Linked elsewhere", color=(0, 1, 0)
    ).light_linking.receiver_collection = bpy.data.collections.new("Others")
    others = bpy.data.collections["Others"]
    others.objects.link(bpy.context.scene.camera)
    add_lamp("Hidden", color=(0, 0, 1)).hide_render = True
    add_lamp("Below", place=(0, 0, -2), color=(1, 0, 0))
    add_lamp("Bulb", color=(1, 0.8, 0.6))
    assert [light.name for light in analyze().views[plate].lights] == ["Bulb"]


def test_glass_lets_light_pass(plate, make_material):
    add_lamp("Bulb")
    bpy.ops.mesh.primitive_plane_add(size=20, location=(0, 0, 1))
    bpy.context.object.data.materials.append(make_material("Pane"))
    assert plate not in analyze().views
    pane = bpy.context.object.data.materials
    pane[0] = make_material("Glass", node="ShaderNodeBsdfGlass")
    assert plate in analyze().views


def test_directions_are_those_of_the_scene(plate):
    bpy.context.scene.camera.data.type = "ORTHO"
    bpy.context.scene.camera.data.ortho_scale = 0.5
    lamp = add_lamp("Sun", "SUN", angle=0.0)
    lamp.rotation_euler = (0, math.radians(40), 0)
    theta_i, theta_r, _ = analyze().views[plate].angles
    assert theta_i == pytest.approx(math.radians(40), abs=1e-3)
    assert theta_r == pytest.approx(0, abs=1e-3)


def test_viewport_sees_what_the_camera_sees(plate):
    add_lamp("Bulb", color=(1, 0.7, 0.5))
    scene = bpy.context.scene
    through_camera = analyze()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    render = scene.render
    lens = scene.camera.calc_matrix_camera(depsgraph, x=render.resolution_x, y=render.resolution_y)
    eye = analysis.View(scene.camera.matrix_world.inverted(), lens)
    found = analyze(eye)
    assert found.pixels[plate] == pytest.approx(through_camera.pixels[plate], abs=0.01)
    angles = [report.views[plate].angles[1].mean() for report in (found, through_camera)]
    assert angles[0] == pytest.approx(angles[1], abs=0.02)


def test_objects_of_many_faces_are_met_as_others_are(plate, make_material, monkeypatch):
    """The same room, with every object but the plate's counted as heavy, and with none."""
    from rough_spectra.addon.scene import dense_meshes

    materials = make_room.furnish(objects=40, materials=6)
    light = analyze()
    monkeypatch.setattr(dense_meshes, "TRIANGLES", 100)
    found = analyze()
    assert found.pixels == pytest.approx(light.pixels, abs=2e-3)
    for material in set(materials) & light.views.keys():
        mine, other = found.views[material], light.views[material]
        shares = {lamp.name: lamp.share for lamp in other.lights}
        for lamp in mine.lights:
            assert lamp.share == pytest.approx(shares.get(lamp.name, 0), abs=0.1)


def test_nothing_to_analyze_is_said(plate, make_material):
    with pytest.raises(InputError, match=r"No light reaches Plate"):
        follow_scene.follow(analyze())
    add_lamp("Bulb")
    with pytest.raises(InputError, match=r"No material chosen has a measured spectrum"):
        follow_scene.follow(analyze(), [make_material("Bare")])
    bpy.context.scene.camera.rotation_euler = (math.pi, 0, 0)
    with pytest.raises(InputError, match=r"Plate: not in the picture"):
        follow_scene.follow(analyze(), [plate])
    bpy.context.scene.camera = None
    with pytest.raises(InputError, match="no camera"):
        analyze()


def test_engine_without_roughness_gets_the_flat_color_of_the_scene(plate):
    add_lamp("Bulb", color=(1, 0.7, 0.5))
    report = analyze()
    [rough] = follow_scene.follow(report)
    assert rough.solution.roughness > 0.1
    bpy.context.scene.render.engine = "BLENDER_WORKBENCH"
    assert state.state(plate).kind == "fresh"  # by an engine alone nothing need change
    derive.renew([plate])
    found = derivation.get_stamp(plate)
    assert found.roughness == 0
    assert "ignores diffuse roughness" in found.shader_reason
    assert state.state(plate).kind == "fresh"
    # The flat color is the best of all flat ones nearby, and not simply the rough one's.
    view, space = report.views[plate], working_space.current()
    request = storage.load(plate)
    flat = solve.differences(request, view, np.array(found.color), 0.0, space)
    same = solve.differences(request, view, rough.solution.color, 0.0, space)
    assert np.average(flat, weights=view.weights) < np.average(same, weights=view.weights)
    # A roughness that this engine does not show makes no difference.
    shader_nodes.roughness_socket(shader_nodes.shader_node(plate)).default_value = 0.9
    [change] = follow_scene.follow(report)
    assert change.before == pytest.approx(np.average(flat, weights=view.place_weights), abs=1e-4)


def test_following_can_be_switched_off_and_on(plate):
    before = derivation.get_stamp(plate).color
    add_lamp("Bulb", color=(1, 0.5, 0.2))
    [change] = follow_scene.follow(analyze())
    assert derivation.get_stamp(plate).color != before
    plate.rough_spectra.use_scene = False
    derive.renew([plate])
    assert derivation.get_stamp(plate).color == before
    plate.rough_spectra.use_scene = True
    derive.renew([plate])
    assert derivation.get_stamp(plate).color == pytest.approx(change.solution.color.tolist())


def test_measurement_finds_what_was_matched_to_the_scene(plate):
    """The reading is held to the compromise, and the sentence tells how far off the truth it is."""
    add_lamp("Warm", use_temperature=True, temperature=2700)
    add_lamp("Blue", place=(-1, 0.5, 2), color=(0.3, 0.5, 1))
    [change] = follow_scene.follow(analyze())
    [reading] = bake.bake([("", plate)]).entries
    assert reading.delta_e_00 < 0.01
    assert reading.measured.illuminant == f"scene: {storage.load(plate).scene.lights[0].name}"
    promised = cycles.reflectance(
        change.solution.color, change.solution.roughness, math.pi / 4, 0, 0
    )
    assert reading.measured.rgb == pytest.approx(promised, abs=1e-5)
    sentence = next(w for w in reading.warnings if "follows its scene" in w)
    assert f"{change.solution.delta_e_instrument:.2f}" in sentence


def test_panel_holds_a_measurement_to_the_spectrum_as_it_predicts_it(plate):
    add_lamp("Warm", use_temperature=True, temperature=2700)
    add_lamp("Blue", place=(-1, 0.5, 2), color=(0.3, 0.5, 1))
    assert bpy.ops.rough_spectra.analyze_scene() == {"FINISHED"}
    predicted = derivation.get_stamp(plate).delta_e_instrument
    assert predicted > 0.5
    with bpy.context.temp_override(material=plate):
        assert bpy.ops.rough_spectra.measure("EXEC_DEFAULT") == {"FINISHED"}
    assert last_measurement.get(plate).delta_e == pytest.approx(predicted, abs=0.01)


def test_operator_matches_and_reports(plate):
    add_lamp("Bulb", use_temperature=True, temperature=2856)
    assert bpy.ops.rough_spectra.analyze_scene() == {"FINISHED"}
    assert plate.rough_spectra.use_scene
    assert state.state(plate).kind == "fresh"
    for light in list(bpy.data.lights):
        bpy.data.lights.remove(light)
    with pytest.raises(RuntimeError, match="No light reaches Plate"):
        bpy.ops.rough_spectra.analyze_scene()


def test_verb_prints_lights_and_saves(plate, tmp_path, capsys):
    from rough_spectra.addon.commands import command_line

    add_lamp("Bulb", use_temperature=True, temperature=2856)
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    assert command_line.main(["analyze", "--blend", str(path)]) == 0
    told = capsys.readouterr().err
    assert "blackbody of 2856 K" in told
    assert "matched 1 material to scene 'Scene'" in told
    bpy.ops.wm.open_mainfile(filepath=str(path))
    assert bpy.data.materials["Plate"].rough_spectra.use_scene
    assert command_line.main(["analyze", "--scene", "Nowhere"]) == 2
    assert "no scene 'Nowhere'" in capsys.readouterr().err
