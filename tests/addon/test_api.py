# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts may rely on: its examples are true, and its names and arguments stay."""

import dataclasses
import doctest
import inspect
from math import radians
from pathlib import Path

import bpy
import pytest
from rough_spectra.addon import api

SIGNATURES = {
    "assign": "(pairs, shader='auto', gloss='keep')",
    "bake": "(surfaces, measure=True, progress=None, read_at=None, with_gloss=False)",
    "compare": "(first, second)",
    "differences": "(material)",
    "emissivity": "(sample, sigma=None, *, angles=None, temperature=300.0, background=0.0, "
    "bands=None, model='reference')",
    "estimate_gloss": "(sample, level=None, gloss=None)",
    "estimate": "(materials, *, model=None, repeatability=0.001)",
    "export": "(materials, base, targets=('materialx', 'usd', 'gltf', 'mitsuba', 'pbrt', "
    "'luxcore'))",
    "export_losses": "(materials)",
    "find": "(name)",
    "gloss": "(materials, angles=(20, 60, 85), progress=None)",
    "gloss_readings": "(sample)",
    "keep": "(material)",
    "make_texture": "(source, target, sigma, *, instrument='45a:0', illuminant='D65', "
    "model='surface', holds='albedo', scale=None, progress=None)",
    "match_by_measuring": "(material, sample=None, color='', progress=None)",
    "materials": "()",
    "measure_rough": "(sample, albedos, spot=None, *, seeds=4, samples=256, progress=None)",
    "metamerism": "(first, second, lights=('A', 'F11', 'LED-B3'))",
    "nearest": "(lab, count=10, *, illuminant='D65', observer=2)",
    "palette": "(path)",
    "paused": "()",
    "picture_image": "(picture, name='Spectral')",
    "picture_pixel": "(picture, column, row)",
    "measured_light": "(light, path)",
    "picture_lights": "(scene=None, *, tolerance=0.5, bands=None, samples=None, percentage=None, "
    "progress=None)",
    "picture_verdict": "(scene=None, *, tolerance=1.0, samples=None, percentage=None, "
    "lights=None, progress=None)",
    "presets": "(collection=None)",
    "read": "(path, region=None)",
    "read_filter": "(path)",
    "relight": "(lights, spectra=None, intensities=None, observer=2)",
    "renew": "(materials)",
    "request": "(sample, sigma=None, *, kind=None, model='auto', illuminant='D65', observer=2, "
    "tolerance=1.0, rdq=None, sdq=None, white=None, white_factor=None, read_at='45a:0')",
    "rough_sample": "(kind, sigma=None, length=None, *, seed=0, cells=512, path=None)",
    "settle": "(material)",
    "spectral_picture": "(scene=None, *, tolerance=1.0, bands=None, observer=2, direct=None, "
    "compare=True, samples=None, percentage=None, lights=None, progress=None)",
    "spots": "(thing, *, at=None, vertex_group=None, diameter=8.0, keep_neighbors=False)",
    "state": "(material)",
    "texture_material": "(made, name='')",
    "thermal_picture": "(scene=None, *, band=(8000.0, 14000.0), parts=3, ambient=293.15, "
    "sky=None, emissivity=0.95, materials=None, samples=None, percentage=None, progress=None)",
    "write_thermal": "(picture, path)",
    "infrared_picture": "(scene=None, *, band=(700.0, 1000.0), parts=3, lights=None, "
    "materials=None, samples=None, percentage=None, progress=None)",
    "write_infrared": "(picture, path, *, false_color=False)",
    "write_emissivity": "(found, base)",
    "write_picture": "(picture, path, spectra=None, *, at_bands=False)",
    "write": "(readings, base, formats=('csv', 'cgats', 'exr'))",
}
"""Every function, and how it is called. A script somewhere calls it so: adding an argument with a
default at the end breaks none; any other change does, and belongs in the changelog."""

FIELDS = {
    "Sample": "name wavelengths values kind quantity instrument geometry aperture specular "
    "sigma_degrees sigma_source source license position device condition illuminant observer lab "
    "xyz notes altered white white_factor plaque surface called others gloss gloss_source",
    "Request": "sample sigma model illuminant observer scene flat tolerance read_at gloss",
    "Solution": "color roughness target model model_reason delta_e_instrument delta_e_mean "
    "delta_e_95 delta_e_lambert shader_reason warnings sigma_max delta_e_lights scene_reason",
    "Estimate": "sigma interval is_told reason standard_error model by_model albedo residuals "
    "chi_square freedom notes",
    "Adjusted": "color reading target delta_e is_met measurements sentence",
    "Apart": "first second delta_e_00 delta_l delta_a delta_b delta_ab shift",
    "Comparison": "measured albedos roughness interreflection model illuminant observer warnings "
    "read_at",
    "State": "kind reasons stamp",
    "Emissivity": "sample source sigma model angles temperature background wavelengths facets "
    "directional hemispherical bands warnings",
    "Entry": "target name identifier request space lobe color roughness reading albedo "
    "delta_e_instrument delta_e_mean delta_e_95 warnings",
    "Exported": "files entries faults",
    "InBand": "name first last directional hemispherical apparent",
    "InLight": "light delta_e_00 index",
    "Row": "name lab illuminant observer sample",
    "Filter": "wavelengths response",
    "GlossReadings": "sphere units",
    "GlossEstimate": "gloss misfit level_is_known",
    "Gloss": "level roughness ior tint coat coat_roughness coat_ior coat_tint multiscatter",
    "Settled": "request model_reason",
    "Readings": "working_space blender entries shard shards whole version each",
    "Reading": "material surface sample source predicted measured delta_e_00 shader_reason "
    "warnings fault instrument gloss node derivation spot",
    "Spot": "thing carrier material point normal toward diameter is_alone",
    "SpotRead": "diameter point normal azimuth is_alone covered spread_mean spread_95 noise",
    "RoughSample": "kind mesh length asked seed",
    "Loss": "material exporter delta_e_instrument delta_e_mean sentence",
    "Made": "path wanted width height roughness mean infeasible outside notes",
    "SpectralPicture": "rgb xyz observer wavelengths direct predicted enough comparison rules "
    "untranslated seconds spectra direct_words white touched",
    "Pixel": "column row wavelengths radiance xyz lab delta_e",
    "ThermalPicture": "band radiance kelvin assumed temperatures",
    "InfraredPicture": "ends parts alpha told assumed dark seconds",
    "Lights": "names spectra parts alpha wavelengths surfaces space",
    "Verdict": "rungs tolerance chosen comparison untranslated touched seconds",
    "Measured": "albedos reflectance noise spread spot_noise spot",
}
"""What the functions take and give, field by field in order."""

OWN = {"bpy": bpy, "Path": Path, "radians": radians}
"""What examples use without an import."""

OTHERS = {
    "Differences",
    "CancelledError",
    "DomainError",
    "InputError",
    "MaterialError",
    "OutputError",
    "RoughSpectraError",
}


def called(function):
    """How a function is called, without types."""
    found = inspect.signature(function)
    bare = [p.replace(annotation=p.empty) for p in found.parameters.values()]
    return str(found.replace(parameters=bare, return_annotation=found.empty))


def fields_of(kind):
    """Names of a record's fields."""
    named = getattr(kind, "_fields", None)
    return " ".join(named or [field.name for field in dataclasses.fields(kind)])


def test_names_and_arguments_stay_as_they_are():
    assert {*api.__all__} == {*SIGNATURES, *FIELDS, *OTHERS}
    assert {name: called(getattr(api, name)) for name in SIGNATURES} == SIGNATURES
    assert {name: fields_of(getattr(api, name)) for name in FIELDS} == FIELDS


def test_the_manual_calls_every_function_so():
    page = Path(__file__).resolve().parents[2] / "docs" / "scripting.md"
    text = page.read_text(encoding="utf-8").replace('"', "'")
    rows = [f"| `{name}{arguments}` |" for name, arguments in SIGNATURES.items()]
    # What an expert needs is left to `help`.
    rows = [row.replace("read(path, region=None)", "read(path)") for row in rows]
    assert [row for row in rows if row not in text] == []


def test_what_a_module_says_is_all_it_has():
    """A name without an underscore looks as if it were promised."""
    own = {
        name
        for name, value in vars(api).items()
        if getattr(value, "__module__", "").startswith(api.__name__) and not name.startswith("_")
    }
    assert own == {*SIGNATURES}


@pytest.mark.parametrize("name", SIGNATURES)
def test_the_example_of(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = inspect.getdoc(getattr(api, name))
    assert "\nExamples\n--------\n>>> " in text, "give it an example that runs"
    example = doctest.DocTestParser().get_doctest(text, {**vars(api), **OWN}, name, None, 0)
    said = []
    doctest.DocTestRunner(verbose=False).run(example, out=said.append)
    assert not said, "".join(said)


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"sigma": 30}, "σ is 30 radians; give 0 to π/3, as math.radians(30) is."),
        ({"sigma": radians(75)}, "σ is 75°, and materials are matched up to 60°; give 0 to 60"),
        ({"sigma": -0.1}, "σ is -0.1 radians; give 0 to π/3, as math.radians(30) is."),
        ({"sigma": float("nan")}, "σ is not a number; set it again, or mend its driver."),
        ({"tolerance": 0}, "The tolerance is ΔE00 0; give 0.05 to 20."),
        ({"model": "mirror"}, "The model 'mirror' is not known; choose one of auto, lambert, "),
        ({"illuminant": "D93"}, "The illuminant 'D93' is not known; choose one of A, D50, "),
        ({"observer": 3}, "The observer 3 is not known; choose one of 2, 10."),
        ({"kind": "gloss"}, "kind is 'gloss'; make it 'reading', 'albedo' or 'emissivity'."),
    ],
)
def test_a_setting_that_no_material_could_store_is_refused(settings, sentence):
    """Before the first of many materials is written, however the request is made."""
    sample = api.find("green")
    with pytest.raises((api.DomainError, api.InputError)) as caught:
        api.request(sample, **settings)
    assert sentence in str(caught.value)
    if "kind" not in settings:
        with pytest.raises(api.DomainError) as caught:
            api.Request(sample, **{"sigma": 0.0} | settings)
        assert sentence in str(caught.value)


def test_the_ends_of_the_range_are_in_it():
    assert api.request(api.find("green"), radians(60)).sigma == radians(60)
    wall = bpy.data.materials.new("Wall")
    api.assign([(wall, api.request(api.find("green"), radians(60), tolerance=0.05))])
    assert api.settle(wall).request.sigma == radians(60)
    assert api.settle(wall).request.tolerance == 0.05


def test_what_is_left_out_is_as_the_sample_says():
    brick = api.find("everyday/brick")
    assert brick.sigma_degrees > 0
    assert api.request(brick).sigma == radians(brick.sigma_degrees)
    assert api.request(brick).sample is brick
    assert api.request(brick, 0.0).sigma == 0
    other = {"reading": "albedo", "albedo": "reading"}[brick.kind]
    assert api.request(brick, kind=other).sample.kind == other
    wall, twin = (bpy.data.materials.new(name) for name in ("Wall", "Twin"))
    first, second = api.assign([(wall, brick), (twin, api.request(brick))])
    assert first.color.tolist() == second.color.tolist()


def test_a_name_is_no_material_and_nothing_is_changed():
    wall = bpy.data.materials.new("Wall")
    sample = api.find("green")
    for call in (
        lambda: api.assign([(wall, sample), ("Door", sample)]),
        lambda: api.renew(["Door"]),
        lambda: api.state("Door"),
        lambda: api.bake([wall, "Door"]),
    ):
        with pytest.raises(api.MaterialError) as caught:
            call()
        assert str(caught.value) == "'Door' is no material; give one of bpy.data.materials."
    assert api.materials() == []


def test_an_unknown_shader_or_format_is_named(tmp_path):
    wall = bpy.data.materials.new("Wall")
    with pytest.raises(api.DomainError, match="'glass' is not known; choose one of auto, diffuse"):
        api.assign([(wall, api.find("green"))], shader="glass")
    assert api.materials() == []
    readings = api.bake([wall], measure=False)
    with pytest.raises(api.DomainError, match="'xlsx' is not known; choose of csv, cgats, exr"):
        api.write(readings, tmp_path / "chart", ["csv", "xlsx"])
    assert list(tmp_path.iterdir()) == []


def test_surfaces_keep_their_names_and_order():
    wall, door = (bpy.data.materials.new(name) for name in ("Wall", "Door"))
    api.assign([(wall, api.find("neutral 6.5")), (door, api.find("green"))])
    entries = api.bake([("House", wall), door, wall], measure=False).entries
    assert [(entry.surface, entry.material) for entry in entries] == [
        ("House", "Wall"),
        ("", "Door"),
        ("", "Wall"),
    ]


def test_without_the_extension_a_sentence_says_so(extension):
    extension.unregister()
    try:
        with pytest.raises(api.RoughSpectraError, match="is not enabled in this Blender; enable"):
            api.materials()
    finally:
        extension.register()
