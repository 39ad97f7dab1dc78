# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Assigning, what a material remembers, and when it says that its color is out of date."""

import json

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import shader_nodes, working_space
from rough_spectra.addon.material import (
    changes,
    derive,
    snapshot,
    state,
    storage,
)
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.core.errors import DomainError, MaterialError

SPACE = "Linear Rec.709"


def sockets(material):
    node = shader_nodes.shader_node(material)
    color = tuple(shader_nodes.color_socket(node).default_value)[:3]
    return (*color, shader_nodes.roughness_socket(node).default_value)


def everything(material):
    """All that is stored in the group, and the names of the nodes."""
    group = material.rough_spectra
    stored = {p.identifier: getattr(group, p.identifier) for p in group.bl_rna.properties}
    stored.pop("rna_type")
    stored["solid_color"] = tuple(stored["solid_color"])  # what Blender gives goes with the file
    return stored, sorted(node.name for node in material.node_tree.nodes), sockets(material)


@pytest.fixture
def awkward():
    """A reading whose numbers have no short decimal form, with all that a file may say."""
    rng = np.random.default_rng(5)
    return Sample(
        "Grün, \"zwei\"\n'drei' 漆",
        np.arange(380.0, 731.0, 10.0) + 1 / 3,
        rng.uniform(0.1, 0.6, 36),
        "reading",
        quantity="radiance factor",
        instrument="de:8",
        geometry="d/8 specular excluded",
        aperture="8 mm",
        specular="SCE",
        sigma_source="guessed",
        source="/somewhere/file.csv",
        license="CC0-1.0",
        position="line 5",
        device="Nix Spectro 2",
        condition="M2",
        illuminant="D50",
        observer=10,
        lab=(50.1, -1 / 3, 7.0),
        xyz=(0.1, 0.2, 1 / 7),
        notes=("one", "two"),
        altered=("two scans were averaged",),
    )


def same_sample(a, b):
    np.testing.assert_array_equal(a.wavelengths, b.wavelengths)
    np.testing.assert_array_equal(a.values, b.values)
    for field in (
        *("name", "kind", "instrument", "sigma_source", "source", "license", "position"),
        *("device", "condition", "illuminant", "observer", "lab", "xyz", "notes"),
        *("quantity", "geometry", "aperture", "specular", "altered"),
    ):
        assert getattr(a, field) == getattr(b, field), field


def test_what_is_stored_is_bit_exact(make_material, awkward, request_for):
    material = make_material()
    request = request_for(awkward, 37.5, model="closure", illuminant="A", observer=10)
    derive.assign([(material, request)], "PRINCIPLED")
    loaded = storage.load(material)
    same_sample(loaded.sample, awkward)
    assert loaded.sigma == request.sigma
    assert (loaded.model, loaded.illuminant, loaded.observer) == ("closure", "A", 10)
    assert material.rough_spectra.shader == "PRINCIPLED"
    assert snapshot.has_spectrum(material)


@pytest.mark.parametrize("degrees", [0, 0.1, 1, 12.5, 15, 17.3, 30, 45, 59.99999, 60])
def test_sigma_comes_back_as_entered(make_material, colorchecker, request_for, degrees):
    material = make_material()
    derive.assign([(material, request_for(colorchecker[0], degrees))])
    assert snapshot.sigma_degrees(material.rough_spectra) == degrees
    assert storage.load(material).sigma == np.radians(degrees)


def test_sockets_hold_the_solution(make_material, colorchecker, request_for):
    material = make_material()
    (solution,) = derive.assign([(material, request_for(colorchecker[3]))])
    expected = np.append(solution.color, solution.roughness).astype(np.float32)
    np.testing.assert_array_equal(np.float32(sockets(material)), expected)
    assert (solution.color <= 1).all()
    assert (solution.color >= 0).all()
    assert state.stale_reasons(material, SPACE) == []


def test_solutions_come_in_the_order_asked_for(make_material, colorchecker, nix, request_for):
    """Lights, models, grids and kinds are solved in groups; each has to find its way back."""
    samples = [colorchecker[5], nix["brick"], colorchecker[2], nix["cardboard"], colorchecker[5]]
    settings = [
        {"illuminant": "F11"},
        {"model": "closure"},
        {"illuminant": "A", "model": "first-order"},
        {},
        {"illuminant": "A"},
    ]
    requests = [
        request_for(sample, 10 * i, **extra)
        for i, (sample, extra) in enumerate(zip(samples, settings, strict=True))
    ]
    materials = [make_material(str(i)) for i in range(5)]
    together = derive.assign(list(zip(materials, requests, strict=True)))
    for request, solution, material in zip(requests, together, materials, strict=True):
        (alone,) = derive.assign([(make_material("alone"), request)])
        np.testing.assert_allclose(solution.color, alone.color, rtol=1e-12)
        assert solution.roughness == pytest.approx(alone.roughness, rel=1e-12)
        assert storage.load(material).sample.name == request.sample.name


def test_nothing_to_assign():
    assert derive.assign([]) == []
    assert derive.renew([]) == []


def bad_node(material, _request):
    material.node_tree.nodes["Diffuse BSDF"].mute = True


def bad_light(_material, request):
    object.__setattr__(request, "illuminant", "D93")


def bad_model(_material, request):
    object.__setattr__(request, "model", "three-bounce")


def bad_sigma(_material, request):
    object.__setattr__(request, "sigma", 30.0)


def bad_instrument(_material, request):
    object.__setattr__(request.sample, "instrument", "d:8")


def bad_range(_material, request):
    object.__setattr__(request.sample, "wavelengths", np.arange(1000.0, 1801.0, 10.0))


@pytest.mark.parametrize(
    "spoil", [bad_node, bad_light, bad_model, bad_sigma, bad_instrument, bad_range]
)
def test_all_or_none(make_material, colorchecker, request_for, spoil):
    """One fault among three leaves all three as they were, wherever it stands."""
    for fault in range(3):
        materials = [make_material(f"{fault}{i}") for i in range(3)]
        derive.assign([(m, request_for(colorchecker[7])) for m in materials])
        samples = [Sample(s.name, s.wavelengths, s.values, s.kind) for s in colorchecker[10:13]]
        requests = [request_for(sample, 45) for sample in samples]
        spoil(materials[fault], requests[fault])
        before = [everything(m) for m in materials]
        with pytest.raises((MaterialError, DomainError)) as caught:
            derive.assign(list(zip(materials, requests, strict=True)))
        assert str(caught.value).endswith(".")
        assert [everything(m) for m in materials] == before


def test_one_material_named_twice_is_refused(make_material, colorchecker, request_for):
    material = make_material("Twice")
    with pytest.raises(MaterialError, match="'Twice' is named twice; give it one spectrum"):
        derive.assign([(material, request_for(sample)) for sample in colorchecker[:2]])
    assert not snapshot.has_spectrum(material)


def test_renew_is_all_or_none_whatever_the_shaders(make_material, colorchecker, request_for):
    first, second = make_material("a"), make_material("b")
    for material, shader in ((first, "AUTO"), (second, "PRINCIPLED")):
        derive.assign([(material, request_for(colorchecker[0]))], shader)
        material.rough_spectra.sigma = 0.9
    shader_nodes.shader_node(second).mute = True
    before = everything(first), everything(second)
    for order in ((first, second), (second, first)):
        with pytest.raises(MaterialError, match="is muted"):
            derive.renew(order)
        assert (everything(first), everything(second)) == before
    with pytest.raises(MaterialError, match="'plain' has no measured spectrum; assign one first"):
        derive.renew([first, make_material("plain")])
    assert everything(first) == before[0]


def test_renew_brings_back_what_was_derived(make_material, nix, request_for):
    material, other = make_material("a"), make_material("b")
    samples = nix["terracotta"], nix["cardboard"]
    work = list(zip((material, other), map(request_for, samples), strict=True))
    derive.assign(work[:1], "PRINCIPLED")
    derive.assign(work[1:], "DIFFUSE")
    before = [everything(m) for m in (material, other)]
    shader_nodes.color_socket(shader_nodes.shader_node(material)).default_value = (0, 0, 0, 1)
    solutions = derive.renew([other, material])
    after = [everything(m) for m in (material, other)]
    for stored, _, _ in (*before, *after):
        del stored["stamp"]  # in double precision, where company changes the last digit
    assert after == before
    assert solutions[0].target[0] != solutions[1].target[0]


def test_a_later_change_of_settings_counts(make_material, colorchecker, request_for):
    material, fresh = make_material("a"), make_material("b")
    derive.assign([(material, request_for(colorchecker[4], 10))])
    group = material.rough_spectra
    group.sigma, group.model, group.illuminant = np.radians(40), "closure", "A"
    derive.renew([material])
    derive.assign([(fresh, request_for(colorchecker[4], 40, model="closure", illuminant="A"))])
    assert sockets(material) == sockets(fresh)


def change(material, what):
    node, group = shader_nodes.shader_node(material), material.rough_spectra
    if what == "color":
        node.inputs[0].default_value[1] += 2e-6
    elif what == "roughness":
        shader_nodes.roughness_socket(node).default_value += 2e-6
    elif what == "color linked":
        tree = material.node_tree
        tree.links.new(tree.nodes.new("ShaderNodeRGB").outputs[0], node.inputs[0])
    elif what == "specular":
        node.inputs["Specular IOR Level"].default_value = 0.6
    elif what == "metallic":
        node.inputs["Metallic"].default_value = 0.5
    elif what == "mute":
        node.mute = True
    elif what == "unlinked":
        material.node_tree.links.clear()
    elif what == "renamed":
        node.name = "Other"
    elif what == "sigma":
        group.sigma += np.radians(1e-4)
    elif what == "spectrum":
        group.spectrum = group.spectrum.replace("0.0", "0.1", 1)
    else:
        setattr(group, *what)


@pytest.mark.parametrize(
    ("what", "reason"),
    [
        ("color", "color or roughness was edited by hand"),
        ("roughness", "color or roughness was edited by hand"),
        ("color linked", "Base Color comes from another node"),
        ("specular", "its gloss was changed"),
        ("metallic", "Metallic is in use"),
        ("mute", "'Principled BSDF' is muted"),
        ("unlinked", "the surface no longer comes from 'Principled BSDF'"),
        ("renamed", "the surface no longer comes from 'Principled BSDF'"),
        ("sigma", "σ was changed from 30° to 30.0001°"),
        ("spectrum", "the spectrum was replaced"),
        (("illuminant", "A"), "the illuminant was changed from D65 to A"),
        (("model", "closure"), "the model was changed from Two-bounce to Closure"),
        (("kind", "reading"), "the kind was changed from Albedo to Reading"),
        (("shader", "DIFFUSE"), "the shader was changed from Principled BSDF to Diffuse BSDF"),
        (("stamp", ""), "nothing was derived from the spectrum yet"),
        (("stamp", '{"color": 1}'), "nothing was derived from the spectrum yet"),
    ],
)
def test_each_change_that_matters_is_told(make_material, colorchecker, request_for, what, reason):
    material = make_material(node="ShaderNodeBsdfPrincipled")
    derive.assign([(material, request_for(colorchecker[6]))], "PRINCIPLED")
    assert state.stale_reasons(material, SPACE) == []
    with changes.paused():  # else a setting would be followed at once
        change(material, what)
    assert state.stale_reasons(material, SPACE) == [reason]


def test_changes_that_do_not_matter_are_not_told(make_material, colorchecker, request_for):
    material = make_material(node="ShaderNodeBsdfPrincipled", Specular_IOR_Level=0)
    derive.assign([(material, request_for(colorchecker[6]))])
    material.rough_spectra.observer = "10"  # of reports only
    material.rough_spectra.sigma_source = "measured with a profilometer"
    shader_nodes.shader_node(material).inputs["Roughness"].default_value = 0.1
    material.name = "renamed"
    assert state.stale_reasons(material, SPACE) == []


def test_change_of_working_space_is_told_and_renewed(
    make_material, colorchecker, request_for, set_working_space
):
    material, fresh = make_material("a"), make_material("b")
    derive.assign([(material, request_for(colorchecker[6]))])
    set_working_space("ACEScg")
    space = working_space.current().name
    assert state.stale_reasons(material, space) == [
        "the working space changed from Linear Rec.709 to ACEScg"
    ]
    derive.renew([material])
    assert state.stale_reasons(material, space) == []
    derive.assign([(fresh, request_for(colorchecker[6]))])
    assert sockets(material) == sockets(fresh)


def test_all_survives_save_and_load(make_material, awkward, request_for, tmp_path):
    material = make_material("Kept")
    material.use_fake_user = True
    derive.assign([(material, request_for(awkward, 12.3))])
    before = everything(material)
    path = str(tmp_path / "scene.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=path)
    material = bpy.data.materials["Kept"]
    assert everything(material) == before
    same_sample(storage.load(material).sample, awkward)
    assert state.stale_reasons(material, SPACE) == []


@pytest.mark.parametrize("link", [False, True])
def test_all_survives_append_and_link(make_material, awkward, request_for, tmp_path, link):
    material = make_material("Kept")
    material.use_fake_user = True
    derive.assign([(material, request_for(awkward, 12.3))])
    before = everything(material)
    path = str(tmp_path / "scene.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=link) as (_, wanted):
        wanted.materials = ["Kept"]
    (material,) = wanted.materials
    assert everything(material) == before
    same_sample(storage.load(material).sample, awkward)
    assert state.stale_reasons(material, SPACE) == []
    if link:
        for act in (
            lambda: derive.assign([(material, request_for(awkward))]),
            lambda: derive.renew([material]),
        ):
            with pytest.raises(MaterialError, match="make it local first"):
                act()
        assert everything(material) == before


def test_a_copy_keeps_its_own_spectrum(make_material, awkward, colorchecker, request_for):
    material = make_material("Kept")
    derive.assign([(material, request_for(awkward))])
    copy = material.copy()
    assert state.stale_reasons(copy, SPACE) == []
    derive.assign([(copy, request_for(colorchecker[0]))])
    same_sample(storage.load(material).sample, awkward)


def test_undo_and_redo_take_spectrum_and_sockets_along(make_material, colorchecker, request_for):
    make_material("Undone")
    window = bpy.data.window_managers[0].windows[0]
    with bpy.context.temp_override(window=window, screen=window.screen):
        states = []
        for sample in (None, *colorchecker[:2]):
            material = bpy.data.materials["Undone"]
            if sample is not None:
                derive.assign([(material, request_for(sample))])
            states.append(everything(material))
            assert bpy.ops.ed.undo_push(message="step") == {"FINISHED"}
        for expected in (states[1], states[0]):
            bpy.ops.ed.undo()
            assert everything(bpy.data.materials["Undone"]) == expected
        assert not snapshot.has_spectrum(bpy.data.materials["Undone"])
        bpy.ops.ed.redo()
        assert everything(bpy.data.materials["Undone"]) == states[1]


def test_a_newer_schema_is_not_guessed_at(make_material, colorchecker, request_for):
    material = make_material("Future")
    derive.assign([(material, request_for(colorchecker[0]))])
    material.rough_spectra.schema += 1
    for act in (storage.load, lambda m: derive.renew([m])):
        with pytest.raises(MaterialError, match="'Future' was stored by a newer Rough Spectra"):
            act(material)


@pytest.mark.parametrize(
    ("stored", "text"),
    [
        *(("spectrum", text) for text in ("{", "[]", '{"wavelengths": [400, 500]}', "1")),
        ("spectrum", '{"wavelengths": 1, "values": 2}'),
        *(("details", text) for text in ("[1]", "7", '{"notes": 5}', "{")),
    ],
)
def test_damaged_storage_is_one_sentence(make_material, colorchecker, request_for, stored, text):
    material = make_material("Damaged")
    derive.assign([(material, request_for(colorchecker[0]))])
    setattr(material.rough_spectra, stored, text)
    with pytest.raises(MaterialError, match="'Damaged': its stored spectrum cannot be read"):
        storage.load(material)


def test_stored_values_that_no_spectrum_has_are_refused(make_material, colorchecker, request_for):
    material = make_material("Damaged")
    derive.assign([(material, request_for(colorchecker[0]))])
    for values in ([0.1, float("nan")], [0.1, 5.5]):
        stored = {"wavelengths": [400, 500], "values": values}
        material.rough_spectra.spectrum = json.dumps(stored)
        with pytest.raises(MaterialError, match="'Damaged': its stored spectrum cannot be read"):
            storage.load(material)
