# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What was just solved is handed along: nobody loads, reads or solves it again."""

import json
import math

import bpy
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.colorimetry import illuminant_spectra
from rough_spectra.addon.matching import scene_view, solve
from rough_spectra.addon.material import changes, derivation, derive, settled, snapshot, storage
from rough_spectra.addon.preview import data, icons, theme
from rough_spectra.core.numerics import direction_grid


@pytest.fixture(autouse=True)
def _no_pictures():
    icons.clear()
    yield
    icons.clear()


@pytest.fixture(params=["ShaderNodeBsdfDiffuse", "ShaderNodeBsdfPrincipled"])
def material(request, make_material, colorchecker):
    material = make_material(node=request.param)
    derive.assign([(material, solve.Request(colorchecker[13], 0.4))])
    return material


def light_from_the_scene(material):
    reddish = np.linspace(0.2, 1, illuminant_spectra.GRID.size)
    light = scene_view.make_light(
        "Fire", "red", reddish / illuminant_spectra.to_xyz(reddish)[1], 1.0
    )
    rows = np.column_stack(direction_grid.hemisphere(8)).tolist()
    view = scene_view.SceneView("Scene", (light,), tuple((*row, 0, 1 / 8) for row in rows))
    derive.follow_scene({material: view})


def show(material):
    """Make the panel's pictures visible."""
    basis = (snapshot.of(material), theme.current(bpy.context.preferences))
    for figure in ("sheet", "swatches"):
        icons.icon_id(material.session_uid, figure, 200, basis)
    icons._work()


def counted(monkeypatch, module, name):
    calls = []
    real = getattr(module, name)

    def function(*arguments, **options):
        calls.append(arguments)
        return real(*arguments, **options)

    monkeypatch.setattr(module, name, function)
    return calls


@pytest.mark.parametrize("engine", ["CYCLES", "BLENDER_WORKBENCH"])
@pytest.mark.parametrize("scene", [False, True])
def test_a_step_loads_once_looks_once_and_parses_nothing(material, monkeypatch, engine, scene):
    bpy.context.scene.render.engine = engine
    if scene:
        light_from_the_scene(material)
    show(material)
    material.rough_spectra.sigma = 0.5  # what does not depend on σ is read now
    loads = counted(monkeypatch, storage, "load")
    snapshots = counted(monkeypatch, snapshot, "of")
    solved = counted(monkeypatch, solve, "solve")
    parsed = counted(monkeypatch, json, "loads")
    before = {wish: picture.basis for wish, picture in icons._pictures.items()}
    material.rough_spectra.sigma = 0.6
    assert len(before) == 2
    assert all(icons._pictures[wish].basis != basis for wish, basis in before.items())
    assert [len(calls) for calls in (loads, snapshots, solved, parsed)] == [1, 1, 1, 0]


def drive_the_color(material):
    """Sockets that are driven are not set, so that a change of σ fails."""
    node = next(node for node in material.node_tree.nodes if "Bsdf" in node.bl_idname)
    node.inputs[0].driver_add("default_value", 0)
    material.rough_spectra.sigma = 0.7


CHANGES = {
    "σ": lambda material: setattr(material.rough_spectra, "sigma", 0.7),
    "σ = 0": lambda material: setattr(material.rough_spectra, "sigma", 0.0),
    "kind": lambda material: setattr(material.rough_spectra, "kind", "reading"),
    "model": lambda material: setattr(material.rough_spectra, "model", "reference"),
    "illuminant": lambda material: setattr(material.rough_spectra, "illuminant", "F11"),
    "shader there": lambda material: setattr(material.rough_spectra, "shader", "DIFFUSE"),
    "shader made": lambda material: setattr(material.rough_spectra, "shader", "PRINCIPLED"),
    "driven": drive_the_color,
    "no number": lambda material: setattr(material.rough_spectra, "sigma", math.nan),
}


@pytest.mark.parametrize("engine", ["CYCLES", "BLENDER_WORKBENCH"])
@pytest.mark.parametrize("scene", [False, True])
@pytest.mark.parametrize("change", CHANGES)
def test_what_is_handed_along_is_what_would_be_read(material, engine, scene, change):
    bpy.context.scene.render.engine = engine
    if scene:
        light_from_the_scene(material)
    heard = []
    changes.derived.subscribe(heard.append)
    try:
        CHANGES[change](material)
    finally:
        changes.derived.unsubscribe(heard.append)
    [done] = heard
    fresh = snapshot.of(material)
    assert done.material == material
    assert done.known == fresh
    assert derivation.parse(fresh.stamp) == derivation._read(fresh.stamp)
    assert (done.solved is None) == bool(fresh.error) == (change in {"driven", "no number"})
    if done.solved is None:
        return
    space = working_space.current()
    assert done.solved.request == settled.of(material).request
    shown, apart = data.of_derived(done, done.solved)
    assert apart == settled.differences(material, space, fresh.flat)
    again = data.collect(material, space, fresh.flat)
    for name, value in vars(again).items():
        if isinstance(value, np.ndarray):
            np.testing.assert_array_equal(getattr(shown, name), value)
        elif not isinstance(value, data.data.Patch):
            assert getattr(shown, name) == value


def test_everyone_who_subscribed_is_told(material):
    heard = [[], []]
    for one in heard:
        changes.derived.subscribe(one.append)
    material.rough_spectra.sigma = 0.7
    for one in heard:
        changes.derived.unsubscribe(one.append)
    assert heard[0] == heard[1]
    assert len(heard[0]) == 1


NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
TEXTS = st.text(st.characters(), max_size=12)
STAMPS = st.builds(
    derivation.Stamp,
    **dict.fromkeys(derivation._TEXTS, TEXTS),
    **dict.fromkeys(derivation._NUMBERS, NUMBERS),
    color=st.tuples(NUMBERS, NUMBERS, NUMBERS),
    warnings=st.lists(TEXTS, max_size=3).map(tuple),
    settings=st.dictionaries(TEXTS, TEXTS, max_size=4).map(lambda found: tuple(found.items())),
    delta_e_lights=st.lists(st.tuples(TEXTS, NUMBERS), max_size=3).map(tuple),
    derivation=st.integers(0, 99),
    sigma_max=st.none() | NUMBERS,
    gloss=st.none() | st.lists(NUMBERS, max_size=3).map(tuple),
)


@given(STAMPS)
def test_a_stamp_reads_as_it_was_written(stamp):
    """Known or not: what the text says is what was told when it was written."""
    text = derivation.to_text(stamp)
    assert derivation.parse(text) == stamp
    assert derivation._read(text) == stamp


@pytest.mark.parametrize("name", [*derivation._NUMBERS, "sigma_max", "delta_e_lights", "gloss"])
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_a_stamp_that_nobody_could_read_is_not_taken_for_known(material, name, value):
    found = derivation.get_stamp(material)
    several = {"delta_e_lights": (("Sun", value),), "gloss": (value,)}
    damaged = found._replace(**{name: several.get(name, value)})
    assert derivation.parse(derivation.to_text(damaged)) is None


def test_texts_of_stamps_are_forgotten_in_the_end(material, monkeypatch):
    monkeypatch.setattr(derivation, "_KEPT", 3)
    derivation._known.clear()
    stamp = derivation.get_stamp(material)
    texts = [derivation.to_text(stamp._replace(node=str(number))) for number in range(5)]
    assert list(derivation._known) == texts[2:]
    derivation.parse(texts[2])
    derivation.to_text(stamp._replace(node="another"))
    assert texts[2] in derivation._known
    assert texts[3] not in derivation._known
