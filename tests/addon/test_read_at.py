# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The virtual instrument: what a material is made to read right at, and is measured with."""

import json
import math
from dataclasses import replace

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.instrument import arrangement, bake
from rough_spectra.addon.instrument.measure import RING_45_0, measure
from rough_spectra.addon.material import derivation, last_measurement, snapshot, state, storage
from rough_spectra.core import cycles, reading
from rough_spectra.core.errors import DomainError
from rough_spectra.core.instruments import REGISTRY, quadrature

QUICK = [name for name in REGISTRY if not name.endswith("-iso")]
"""Instruments without rings or cones of light, which take 128 pictures each."""


@pytest.mark.parametrize("name", REGISTRY)
def test_lights_and_views_of_the_renders_are_those_of_the_instrument(name):
    """Moments of directions against the core's quadrature, which is made apart from them."""
    shots = [s for s in arrangement.of(name).shots if not isinstance(s.light, arrangement.Glow)]
    of = quadrature.of(name)
    if not shots:  # a sphere: only its views are directions
        views = np.array([s.view for s in arrangement.of(name).shots])
        assert np.mean(np.sin(views) ** 2) == pytest.approx(
            np.sin(of.theta_r) ** 2 @ of.weights, abs=2e-5
        )
        return
    light = np.array([s.light for s in shots])
    view = np.array([s.view for s in shots])
    between = light[:, 1] - np.array([s.quarter for s in shots]) * (np.pi / 2)
    weights = np.array([s.weight for s in shots]) / len(shots)
    for mine, theirs in (
        (np.sin(light[:, 0]) ** 2, np.sin(of.theta_i) ** 2),
        (np.sin(view) ** 2, np.sin(of.theta_r) ** 2),
        (
            np.sin(light[:, 0]) * np.sin(view) * np.cos(between),
            np.sin(of.theta_i) * np.sin(of.theta_r) * np.cos(of.delta_phi),
        ),
    ):
        assert mine @ weights == pytest.approx(theirs @ of.weights, abs=1e-6)


@pytest.mark.parametrize(("kind", "names"), [("albedo", [*REGISTRY]), ("reading", QUICK)])
def test_what_is_assigned_reads_its_target_at_its_instrument_in_cycles(colorchecker, kind, names):
    """Readings are of a real sphere; the target is the core's, whatever made the color."""
    sigma = math.radians(35)
    sample = replace(colorchecker[13], kind=kind, instrument="di:8")  # green, in gamut everywhere
    materials = [bpy.data.materials.new(name) for name in names]
    requests = [api.request(sample, sigma, read_at=name) for name in names]
    solutions = api.assign(zip(materials, requests, strict=True), gloss="none")
    found = api.bake(materials)
    assert found.instruments == tuple(names)
    assert [entry.instrument for entry in found.entries] == names
    rho = sample.values
    if kind == "reading":
        rho = reading.to_albedo(sample.values, sigma, "surface", "di:8")
    for entry, solution in zip(found.entries, solutions, strict=True):
        wanted = reading.from_albedo(rho, sigma, "surface", entry.instrument)
        np.testing.assert_allclose(entry.predicted.values, wanted, atol=1e-6)
        assert entry.delta_e_00 <= (0.1 if entry.instrument in {"di:8", "de:8"} else 0.05)
        assert solution.delta_e_instrument < 1e-3
    # One color would not do: the targets are far apart.
    lightness = {entry.instrument: entry.predicted.lab[0] for entry in found.entries}
    assert lightness["45as75"] - lightness["45as-15"] > 8


def test_several_instruments_read_one_material_in_one_go(make_material):
    bare = make_material("Bare", Roughness=0.5)
    wall = bpy.data.materials.new("Wall")
    api.assign([(wall, api.request(api.find("brick"), math.radians(30), read_at="45as75"))])
    found = api.bake([("here", wall), bare], read_at=["45as75", "45as110", "45a:0"])
    told = [(e.material, e.surface, e.instrument) for e in found.entries]
    names = ("45as75", "45as110", "45a:0")
    assert told == [*(("Wall", "here", n) for n in names), *(("Bare", "", n) for n in names)]
    own, other, _ = found.entries[:3]
    assert own.delta_e_00 < 0.05 < other.delta_e_00
    assert not any("made to read" in sentence for sentence in own.warnings)
    assert "made to read right at 45°:as75°" in other.warnings
    # A rough surface is the lighter the nearer the view is to the light.
    bare_values = [entry.measured.rgb[0] for entry in found.entries[3:]]
    assert bare_values[1] > bare_values[0] > bare_values[2]


def test_a_bake_in_parts_at_several_instruments_is_the_bake_of_all():
    from rough_spectra.addon.readings import document

    materials = [bpy.data.materials.new(name) for name in "ABC"]
    api.assign([(m, api.request(api.find("brick"), 0.3)) for m in materials])
    at = ("45a:0", "45as15")
    whole = api.bake(materials, measure=False, read_at=at)
    parts = [
        replace(api.bake(materials[i::2], measure=False, read_at=at), shard=i + 1, shards=2)
        for i in range(2)
    ]
    assert document.merge(parts).entries == whole.entries


def test_an_unknown_instrument_is_refused_with_the_names():
    with pytest.raises(DomainError, match=r"virtual instrument '46:0' .* choose one of 45a:0"):
        api.request(api.find("brick"), read_at="46:0")
    wall = bpy.data.materials.new("Wall")
    with pytest.raises(DomainError, match=r"'46:0' is not known; choose one of: 45a:0"):
        api.bake([wall], read_at="46:0")


def test_the_material_keeps_it_and_follows_when_it_is_changed(tmp_path):
    wall = bpy.data.materials.new("Wall")
    wall.use_fake_user = True
    request = api.request(api.find("brick"), math.radians(40))
    api.assign([(wall, request)])
    group = wall.rough_spectra
    assert group.read_at == "45a:0"
    before, stamp = group.stamp, derivation.get_stamp(wall)
    group.read_at = "45as110"  # followed at once
    assert state.state(wall).kind == "fresh"
    now = derivation.get_stamp(wall)
    assert now.color != stamp.color
    assert storage.load(wall).read_at == "45as110"
    group.read_at = "45a:0"
    assert derivation.get_stamp(wall).color == stamp.color
    assert json.loads(group.stamp)["inputs"] == json.loads(before)["inputs"]
    with api.paused():
        group.read_at = "di:8"
    known = state.state(wall)
    assert known.kind == "stale"
    assert known.reasons == ("the virtual instrument was changed from 45°a:0° to di:8° Sphere",)
    api.renew([wall])
    path = str(tmp_path / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    wall = bpy.data.materials["Wall"]
    assert storage.load(wall).read_at == "di:8"
    assert state.state(wall).kind == "fresh"


def test_what_was_stored_before_there_was_a_choice_is_read_at_45_0():
    wall = bpy.data.materials.new("Wall")
    api.assign([(wall, api.request(api.find("brick"), 0.4))])
    group = wall.rough_spectra
    data = json.loads(group.stamp)
    del data["settings"]["virtual instrument"]
    group.stamp = json.dumps(data)
    assert state.state(wall).kind == "fresh"
    with api.paused():
        group.read_at = "45as15"
    [reason] = state.state(wall).reasons
    assert reason == "the virtual instrument was changed from 45°a:0° to 45°:as15°"


def test_the_operator_measures_at_the_materials_instrument():
    wall = bpy.data.materials.new("Wall")
    thing = bpy.data.objects.new("Wall", bpy.data.meshes.new("Wall"))
    thing.data.materials.append(wall)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    api.assign([(wall, api.request(api.find("brick"), math.radians(40), read_at="45as75"))])
    assert bpy.ops.rough_spectra.measure(scope="ACTIVE") == {"FINISHED"}
    found = last_measurement.get(wall, snapshot.of(wall))
    assert found.instrument == "45as75"
    assert found.current
    assert found.delta_e < 0.05
    ring = measure([wall], [RING_45_0])[0, 0, 0]
    assert found.rgb[0] > 1.05 * ring[0]


def test_each_material_is_rendered_at_its_own_instruments_only():
    materials = [bpy.data.materials.new(name) for name in "AB"]
    api.assign(
        [
            (materials[0], api.request(api.find("brick"), 0.4)),
            (materials[1], api.request(api.find("brick"), 0.4, read_at="45as75")),
        ]
    )
    surfaces = [("", materials[0]), ("x", materials[1]), ("y", materials[0])]
    plan = bake.plan(surfaces, bake.prepare(surfaces))
    assert [each.members for each in plan.work[1]] == [(0,), (1,)]
    values = measure(*plan.work)
    assert np.isnan(values[0, 1]).all()
    np.testing.assert_array_equal(plan.taken(values), values[[0, 1, 0], [0, 1, 0]])


def told(sample, sigma, read_at, kind="reading"):
    material = bpy.data.materials.new("Told")
    wanted = api.request(sample, math.radians(sigma), kind=kind, read_at=read_at)
    [solution] = api.assign([(material, wanted)], gloss="none")
    return solution, [text for text in solution.warnings if "misses its target" in text]


@pytest.mark.parametrize(("read_at", "sigma"), [("45as15", 0), ("45as-15", 30), ("45as110", 30)])
def test_a_reading_beyond_white_is_no_matter_of_gamut(colorchecker, read_at, sigma):
    """As gloss gives beside the mirror direction, and fine powders toward the light."""
    white = colorchecker[18]
    shiny = replace(white, values=2.0 * white.values, instrument=read_at)
    solution, [sentence] = told(shiny, sigma, read_at)
    visible = (shiny.wavelengths >= 400) & (shiny.wavelengths <= 700)
    peak = int(np.argmax(np.where(visible, shiny.values, 0)))
    where = f"{shiny.values[peak]:.4f} at {shiny.wavelengths[peak]:g} nm"
    assert f"reads {where} at {REGISTRY[read_at].title.split(',')[0]}" in sentence
    assert "gamut" not in sentence
    # A white of that roughness, by Cycles' formula in the same direction.
    of = quadrature.of(read_at)
    angles = of.theta_i, of.theta_r, of.delta_phi
    white = of.weights @ cycles.reflectance(np.ones(3), solution.roughness, *angles)
    stated = float(sentence.split("more than the ")[1].split()[0])
    assert stated == pytest.approx(white[0], abs=1e-4)


@pytest.mark.parametrize("read_at", ["45a:0", "45as110"])
def test_a_color_outside_the_primaries_is(colorchecker, read_at):
    _, [sentence] = told(colorchecker[17], 0, read_at, "albedo")
    assert "outside the gamut of Linear Rec.709: R would be -" in sentence


def test_what_fluoresces_reads_beyond_white(colorchecker):
    green = colorchecker[13]
    _, [sentence] = told(replace(green, values=5.2 * green.values), 0, "45a:0")
    assert "more than the 1.0000 of a white material there" in sentence
    assert "gamut" not in sentence
