# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Stored data as a damaged file holds it: a sentence that names the material, and no exception."""

import json
import math

import bpy
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.colorimetry.illuminant_spectra import GRID
from rough_spectra.addon.interface.panels import sentences
from rough_spectra.addon.matching import scene_view, solve
from rough_spectra.addon.matching.solve import Request
from rough_spectra.addon.material import (
    changes,
    derivation,
    derive,
    last_measurement,
    settled,
    snapshot,
    state,
    storage,
)
from rough_spectra.addon.samples import presets
from rough_spectra.core.errors import MaterialError

DEEP = "[" * 20_000
NUMBERS = {"sigma": (math.nan, math.inf, 1e30, -5.0), "tolerance": (math.nan, -1.0)}
MENUS = ("kind", "instrument", "illuminant", "observer", "model", "shader")
SETS = [("others", "5"), ("others", '[{"values": "x"}]'), ("gloss", '{"x": 1}'), ("gloss", "[1]")]
DAMAGES = [
    *((name, 9_999) for name in MENUS),
    *((name, value) for name, values in NUMBERS.items() for value in values),
    *(("spectrum", text) for text in ("{", DEEP, "[]", '{"wavelengths": [1e999], "values": [0]}')),
    ("spectrum", '{"wavelengths": [400, 410], "values": [0.5, 0.5]}'),
    ("spectrum", '{"wavelengths": "400 nm", "values": {}}'),
    *(("details", text) for text in ("[1]", DEEP, '{"lab": [1, "x", 3]}', '{"license": 5}')),
    *(("details", f'{{"{key}": {value}}}') for key, value in SETS),
]

each_damage = pytest.mark.parametrize(
    ("name", "value"), DAMAGES, ids=[f"{name} {str(value)[:20]}" for name, value in DAMAGES]
)


def stored(material):
    """Where Blender keeps a material's settings, past the checks of its properties."""
    group = material.rough_spectra
    return group.bl_system_properties_get() if bpy.app.version >= (5, 0, 0) else group


def damage(material, name, value):
    with changes.paused():
        stored(material)[name] = value


@pytest.fixture
def materials(make_material):
    found = [make_material(f"M{i}") for i in range(3)]
    derive.assign([(m, Request(presets.load("14"), 0.35, model="two-bounce")) for m in found])
    return found


@each_damage
def test_what_is_damaged_is_named_and_the_others_are_renewed(name, value, materials):
    first, second, third = materials
    damage(second, name, value)
    with pytest.raises(MaterialError, match=r"^Material 'M1': .*\.$"):
        storage.load(second)
    assert storage.fault(second).startswith("Material 'M1': ")
    for material in (first, third):
        with changes.paused():
            material.rough_spectra.sigma = 0.5
    assert bpy.ops.rough_spectra.renew("EXEC_DEFAULT", scope="ALL_STALE") == {"FINISHED"}
    assert [state.state(m).kind for m in (first, third)] == ["fresh", "fresh"]


@each_damage
def test_in_an_animation_the_others_follow(name, value, materials):
    mesh = bpy.data.meshes.new("Wall")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    bpy.context.collection.objects.link(bpy.data.objects.new("Wall", mesh))
    for material in materials:
        mesh.materials.append(material)
        with changes.paused():
            for frame, sigma in ((1, 0.1), (10, 0.6)):
                material.rough_spectra.sigma = sigma
                material.rough_spectra.keyframe_insert("sigma", frame=frame)
    if name == "sigma":
        pytest.skip("an animated σ is not the stored one")
    damage(materials[1], name, value)
    scene = bpy.context.scene
    scene.frame_set(1)
    before = [derivation.get_stamp(m).roughness for m in materials]
    scene.frame_set(10)
    after = [derivation.get_stamp(m).roughness for m in materials]
    assert (after[0], after[2]) != (before[0], before[2])
    assert after[0] == after[2]
    assert "Material 'M1'" in materials[1].rough_spectra.error


JSON = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(-(10**25), 10**400),
        st.floats(),
        st.text(max_size=5),
        st.sampled_from(["", "nan", "0"]),
    ),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner),
    max_leaves=4,
)


def places(data, path=()):
    """Every place in a document."""
    yield path
    if isinstance(data, (dict, list)):
        for key, value in data.items() if isinstance(data, dict) else enumerate(data):
            yield from places(value, (*path, key))


def replaced(data, path, value):
    if not path:
        return value
    data = json.loads(json.dumps(data))
    inner = data
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = value
    return data


@st.composite
def damaged(draw, text):
    """Give a text like this one, with a value replaced, cut off, nested too deep, or garbled."""
    how = draw(st.sampled_from(["value", "value", "value", "cut", "deep", "garbled"]))
    if how == "deep":
        return text[:-1] + ', "more": ' + DEEP
    if how == "cut":
        return text[: draw(st.integers(0, len(text)))]
    if how == "garbled":
        at = draw(st.integers(0, len(text) - 1))
        return text[:at] + draw(st.text(max_size=2)).replace("\0", "") + text[at + 1 :]
    data = json.loads(text)
    shallow = [path for path in places(data) if len(path) < 3 or path[-1] in (0, 7, "name", "spd")]
    return json.dumps(replaced(data, draw(st.sampled_from(shallow)), draw(JSON)))


def texts():
    """Every text that a material stores, as it is when nothing is damaged."""
    material = bpy.data.materials.new("Whole")
    derive.assign([(material, Request(presets.load("14"), 0.35, model="two-bounce"))])
    light = scene_view.make_light("Sun", "daylight", 0 * GRID + 1.0, 1.0)
    view = scene_view.SceneView("Scene", (light,), ((0.7, 0.0, 0.0, 0, 1.0),))
    group = material.rough_spectra
    last_measurement.note(material, last_measurement.fingerprint(material), (0.1, 0.2, 0.3), 0.5)
    names = ("spectrum", "details", "stamp", "measured")
    return {name: getattr(group, name) for name in names} | {"scene_view": view.to_json()}


class Plain:
    """A format that leaves sentences as they are: no region is there to fit."""

    def sentence(self, text, icon="NONE", inset=0.0):
        return str(text), icon, inset


@settings(
    max_examples=300,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(data=st.data())
def test_no_stored_text_raises_but_what_names_the_material(data, extension):
    material = bpy.data.materials.get("Whole")
    if material is None:
        texts()
        material = bpy.data.materials["Whole"]
        material["whole"] = json.dumps(texts())
    whole = json.loads(material["whole"])
    name = data.draw(st.sampled_from(sorted(whole)))
    group = material.rough_spectra
    with changes.paused():
        for other, text in whole.items():
            setattr(group, other, text)
        group.use_scene = name == "scene_view"
        setattr(group, name, data.draw(damaged(whole[name])))
    if not group.spectrum:
        return
    fault = storage.fault(material)
    if fault:
        assert fault.startswith("Material 'Whole': ")
        assert fault.endswith(".")
    else:
        solve.solve([storage.load(material)], working_space.current())
    found = snapshot.of(material)
    told = state.state(material)
    assert all(isinstance(reason, str) for reason in told.reasons)
    last_measurement.get(material)
    style = sentences.Style(Plain(), "", "", "")
    sentences.reasons(found, style)
    sentences.difference(found, settled.numbers(found, found.flat), style)
    sentences.source(
        group.source,
        group.details,
        (group.sigma, group.sigma_source),
        (*snapshot.white(group), group.instrument),
        style,
    )
    sentences.scene(found, "Scene", style)
    state.follows(found)
    state.edited_by_hand(material)
