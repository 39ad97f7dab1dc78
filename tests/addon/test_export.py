# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What other renderers are given reads as the spectrum, by their own lobes and re-imported."""

import json
import re
from math import radians
from types import SimpleNamespace
from xml.etree import ElementTree

import addon_utils
import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.export import names, targets
from rough_spectra.core.color.color_difference import adaptation, delta_e, xyz_to_lab
from rough_spectra.core.errors import DomainError, MaterialError, OutputError

from tests import their_lobes

SIGMAS = (0, 15, 30, 45)
RING = np.radians([[45.0], [0.0], [0.0]])
NEARLY = np.radians([[45.0], [1e-6], [0.0]])
"""Seen along the normal itself, LuxCore's azimuth is 0 / 0."""
FINE = np.arange(360.0, 781.0)
WHITE = tristimulus.white("D65")
# IEC 61966-2-1, to six places; and MaterialX's acescg_to_lin_rec709, whose rows are columns there.
TO_XYZ = np.array(
    [[0.412391, 0.357584, 0.180481], [0.212639, 0.715169, 0.072192], [0.019331, 0.119195, 0.950532]]
)
FROM_ACESCG = np.array(
    [
        [1.705079, -0.621798, -0.083258],
        [-0.130257, 1.140805, -0.010549],
        [-0.024003, -0.128969, 1.152972],
    ]
)
PATCHES = api.presets("colorchecker")[2::3]
"""With cyan, which linear Rec.709 does not have. All 24: tools/checks/check_exports.py."""


CASES = {
    "Bystander": ("diffuse", "none"),  # with the Principled BSDF that was there before
    "Matte": ("principled", "none"),
    "Glossy": ("principled", "keep"),
    "Alone": ("auto", "none"),
}


@pytest.fixture(scope="module")
def chart(tmp_path_factory, extension):
    """Patches at four σ, exported once: what came of it, the files' texts and the goals."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    pairs = []
    for degrees in SIGMAS:
        for patch in PATCHES:
            material = bpy.data.materials.new(f"{patch.split('/')[1]} {degrees}°")
            wanted = api.request(api.find(patch), radians(degrees), kind="albedo")
            pairs.append((material, wanted))
    api.assign(pairs, gloss="none")
    made = [material for material, _ in pairs]
    base = tmp_path_factory.mktemp("export") / "chart"
    found = api.export(made, base)
    predicted = [entry.predicted for entry in api.bake(made, measure=False).entries]
    white = TO_XYZ.sum(axis=1)
    xyz = np.array([each.xyz for each in predicted]) / 100 @ adaptation(WHITE, white).T
    rgb = xyz @ np.linalg.inv(TO_XYZ).T
    inside = ((rgb >= 0) & (rgb <= 1)).all(axis=1)
    texts = {name: found.files[i].read_text("utf-8") for i, name in enumerate(targets.NAMES)}
    goals = np.array([each.lab for each in predicted])
    return SimpleNamespace(found=found, texts=texts, goals=goals, inside=inside)


def lab_of_rgb(rgb):
    xyz = np.asarray(rgb) @ TO_XYZ.T
    white = TO_XYZ.sum(axis=1)
    return xyz_to_lab(xyz @ adaptation(white, WHITE).T, WHITE)


def lab_of_spectrum(wavelengths, values):
    """Lab of points that straight lines join, as renderers join them."""
    fine = np.interp(FINE, wavelengths, values)
    weights = tristimulus.weights(FINE, "D65")
    return xyz_to_lab(fine @ weights, weights.sum(axis=0))


def materialx(text):
    for surface in ElementTree.fromstring(text).iter("open_pbr_surface"):
        inputs = {each.get("name"): each for each in surface}
        assert inputs["specular_weight"].get("value") == "0"
        color = np.array([float(x) for x in inputs["base_color"].get("value").split(",")])
        roughness = float(inputs["base_diffuse_roughness"].get("value"))
        seen = their_lobes.materialx(color, roughness, RING)[0]
        wide = inputs["base_color"].get("colorspace") == "acescg"
        yield lab_of_rgb(FROM_ACESCG @ seen if wide else seen)


def usd(text):
    """By name, since Blender puts materials in an order of its own."""
    found = {}
    for name, body in re.findall(r'def Material "(\w+)"(.*?)\n        }\n', text, re.DOTALL):
        assert "float inputs:ior = 1\n" in body
        color = re.search(r"inputs:diffuseColor = \((.+)\)", body)[1]
        found[name] = lab_of_rgb([float(x) for x in color.split(",")])
        spectrum = re.search(r"custom double\[\] rough_spectra:albedo = \[(.+)\]", body)[1]
        assert len(spectrum.split(",")) == 81
        assert "custom double rough_spectra:sigma_degrees = " in body
    return found


def gltf(text):
    for material in json.loads(text)["materials"]:
        assert material["extensions"]["KHR_materials_specular"]["specularFactor"] == 0
        yield lab_of_rgb(material["pbrMetallicRoughness"]["baseColorFactor"][:3])


def mitsuba(text):
    for outer in ElementTree.fromstring(text).iter("bsdf"):
        if outer.get("type") == "twosided":
            bsdf = outer[0]
            pairs = bsdf.find("spectrum").get("value").split(", ")
            wavelengths, values = np.array([pair.split(":") for pair in pairs], float).T
            assert [wavelengths[0], wavelengths[-1]] == [360, 830]
            if bsdf.get("type") == "principled":
                sockets = {each.get("name"): float(each.get("value")) for each in bsdf[1:]}
                assert sockets["specular"] == 0
                values = their_lobes.mitsuba(values, sockets["roughness"], RING)[0]
            yield lab_of_spectrum(wavelengths, values)


def pbrt(text):
    for found in re.finditer(r'"diffuse"\s+"spectrum reflectance" \[ (.+) \]', text):
        wavelengths, values = np.array(found[1].split(), float).reshape(-1, 2).T
        assert [wavelengths[0], wavelengths[-1]] == [360, 830]
        yield lab_of_spectrum(wavelengths, values)


def luxcore(text):
    kinds = re.findall(r"(\S+)\.kd = (.+)\n\1\.sigma = (.+)\n", text)
    for _, color, sigma in kinds:
        rgb = np.array(color.split(), float)
        yield lab_of_rgb(their_lobes.luxcore(rgb, float(sigma), NEARLY)[0])


@pytest.mark.parametrize("name", targets.NAMES)
def test_45_0_is_met_by_the_targets_own_lobe(chart, name):
    """What cannot be met is told: the patches outside of linear Rec.709."""
    found = globals()[name](chart.texts[name])
    if isinstance(found, dict):
        found = [found[entry.identifier] for entry in chart.found.of(name)]
    seen = np.array(list(found))
    assert len(seen) == len(chart.goals) == len(PATCHES) * len(SIGMAS)
    apart = delta_e(seen, chart.goals)
    rgb_only = name in ("usd", "gltf", "luxcore")
    assert apart[chart.inside].max() < 0.1
    assert (apart[~chart.inside].max() > 1) == rgb_only
    entries = chart.found.of(name)
    np.testing.assert_allclose(apart, [e.delta_e_instrument for e in entries], atol=0.1)
    told = [any("outside" in warning for warning in entry.warnings) for entry in entries]
    assert told == [rgb_only and not inside for inside in chart.inside]


def test_a_rough_lobe_comes_closer_over_the_hemisphere_than_lambert(chart):
    mean = {name: np.mean([e.delta_e_mean for e in chart.found.of(name)]) for name in targets.NAMES}
    assert mean["materialx"] < 0.6
    assert mean["materialx"] < mean["luxcore"] < mean["mitsuba"] < mean["pbrt"] < 3


@pytest.fixture
def gltf_of_blender():
    addon_utils.enable("io_scene_gltf2")
    yield
    addon_utils.disable("io_scene_gltf2")


def by_hand(name, shader, gloss):
    made = bpy.data.materials.new(name)
    if made.node_tree is None:
        made.use_nodes = True
    if shader == "auto":
        made.node_tree.nodes.clear()
    api.assign([(made, api.request(api.find("light skin"), radians(30)))], shader, gloss)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0)], [], [(0, 1, 2)])
    mesh.materials.append(made)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))
    return made


def test_what_blender_imports_again_reads_right(chart, tmp_path, gltf_of_blender):
    """Of our own files; and what Blender's exporters make of materials is what was told of them."""
    made = [by_hand(name, *how) for name, how in CASES.items()]
    for each in made:
        each.rough_spectra.tolerance = 0.05
    told = {(loss.exporter, loss.material): loss for loss in api.export_losses(made)}
    assert len(told) == 2 * len(CASES)
    theirs = np.array([entry.predicted.lab for entry in api.bake(made, measure=False).entries])
    paths = {path.suffix: str(path) for path in chart.found.files}
    gltf, usd = str(tmp_path / "theirs.gltf"), str(tmp_path / "theirs.usda")
    bpy.ops.export_scene.gltf(filepath=gltf, export_format="GLTF_SEPARATE")
    bpy.ops.wm.usd_export(filepath=usd)

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    chosen = [i for i in range(len(chart.goals)) if chart.inside[i]][::6]
    bpy.ops.import_scene.gltf(filepath=paths[".gltf"])
    bpy.ops.import_scene.gltf(filepath=gltf)
    of_gltf = [bpy.data.materials[chart.found.of("gltf")[i].name] for i in chosen]
    back = [bpy.data.materials[name] for name in CASES]
    for each in back:
        each.name = f"glTF {each.name}"
    bpy.ops.wm.usd_import(filepath=paths[".usda"])
    bpy.ops.wm.usd_import(filepath=usd)
    of_usd = [bpy.data.materials[chart.found.of("usd")[i].identifier] for i in chosen]
    back += [bpy.data.materials[name] for name in CASES]
    ours = of_gltf + of_usd
    read = np.array([entry.measured.lab for entry in api.bake(ours + back).entries])

    assert delta_e(read[: len(ours)], np.tile(chart.goals[chosen], (2, 1))).max() < 0.1
    assert not any(api.state(material).kind != "none" for material in ours)
    kept = of_gltf[0]["rough-spectra"]
    assert list(kept["wavelengths"])[:2] == [380, 385]
    assert kept["sigma_degrees"] == of_usd[0]["rough_spectra:sigma_degrees"] == SIGMAS[0]

    apart = delta_e(read[len(ours) :], np.tile(theirs, (2, 1)))
    pairs = [(exporter, name) for exporter in ("glTF", "USD") for name in CASES]
    for pair, measured in zip(pairs, apart, strict=True):
        assert told[pair].delta_e_instrument == pytest.approx(measured, abs=0.03), pair
    assert "makes its Diffuse BSDF white, which is ΔE00 30.2 at" in told[pairs[0]].sentence
    assert "takes 'Principled BSDF', which is not in use" in told[pairs[4]].sentence


def test_the_gltf_of_blender_warns(tmp_path, gltf_of_blender, capfd):
    entry = bpy.context.preferences.addons.new()
    entry.module = "rough_spectra"
    made = [by_hand(name, *CASES[name]) for name in ("Bystander", "Matte")]
    smooth = by_hand("Smooth", "principled", "none")
    smooth.rough_spectra.sigma = 0
    try:
        bpy.ops.export_scene.gltf(
            filepath=str(tmp_path / "out.gltf"), export_format="GLTF_SEPARATE"
        )
    finally:
        bpy.context.preferences.addons.remove(entry)
    said = [line for line in capfd.readouterr().out.splitlines() if "WARNING" in line]
    assert len(said) == len(made)
    assert "Material 'Bystander': Blender's glTF exporter makes its Diffuse BSDF white" in said[0]
    assert "Material 'Matte': Blender's glTF exporter drops its diffuse roughness" in said[1]


def test_names_are_such_that_every_renderer_takes_them():
    given = ["Wall", "wall", "10 PRINT", "Ä", "a.b", "a b", ""]
    found = names.identifiers(given)
    assert found == ["Wall", "wall_2", "m_10_PRINT", "material", "a_b", "a_b_2", "material_2"]


def test_names_that_break_xml_and_lines_do_not(tmp_path, extension):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    nasty = bpy.data.materials.new('"<a>" -- & \n]')
    api.assign([(nasty, api.find("green"))], gloss="none")
    found = api.export([nasty], tmp_path / "out", ["materialx", "gltf", "mitsuba", "pbrt"])
    for path in found.files:
        if path.suffix in (".xml", ".mtlx"):
            ElementTree.fromstring(path.read_text("utf-8"))
    lines = (tmp_path / "out.pbrt").read_text("utf-8").splitlines()
    assert all(line.startswith(("#", "MakeNamed", "    ")) or not line for line in lines)


def test_coarse_bands_are_joined_by_more_than_lines(tmp_path, extension):
    """At 20 nm straight lines cut off every bend."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    blue = api.find("colorchecker/13-blue")
    coarse = api.Sample("Blue", blue.wavelengths[::4], blue.values[::4], "reading")
    material = bpy.data.materials.new("Blue")
    api.assign([(material, coarse)], gloss="none")
    [entry] = api.bake([material], measure=False).entries
    api.export([material], tmp_path / "out", "pbrt")
    [lab] = pbrt((tmp_path / "out.pbrt").read_text("utf-8"))
    assert delta_e(lab, np.array(entry.predicted.lab)) < 0.1
    lines = lab_of_spectrum(coarse.wavelengths, coarse.values)
    assert delta_e(lines, np.array(entry.predicted.lab)) > 0.1


def test_what_is_left_behind_is_named(tmp_path, extension, make_material):
    glossy = make_material("Glossy", "ShaderNodeBsdfPrincipled")
    api.assign([(glossy, api.find("green"))])
    plain = bpy.data.materials.new("Plain")
    found = api.export([glossy, plain], tmp_path / "out", ["gltf"])
    assert found.warnings == ["Glossy: its gloss is left behind: what is exported is matte"]
    assert found.faults == ("Material 'Plain' has no measured spectrum; assign one first.",)
    with pytest.raises(MaterialError, match="no measured spectrum"):
        api.export([plain], tmp_path / "out")
    with pytest.raises(DomainError, match="'obj' is not known; choose of materialx"):
        api.export([glossy], tmp_path / "out", "obj")
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        api.export([glossy], tmp_path / "file" / "out")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "out.gltf"]
