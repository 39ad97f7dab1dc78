# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A profilometer's Rdq or Sdq in place of σ: from every place that states it to the material."""

import json
import math

import bpy
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.assets import plan
from rough_spectra.addon.commands import command_line
from rough_spectra.addon.material import snapshot
from rough_spectra.addon.samples import library, library_files, preset_validation, readers
from rough_spectra.addon.samples.stated_sigma import StatedSigma
from rough_spectra.core.errors import InputError
from rough_spectra.core.limits import MATCHED_SIGMA_DEGREES

RDQ, SDQ = 0.35, 0.35 * math.sqrt(2)
DEGREES = math.degrees(math.atan(0.35))
PRESET = {
    "format": "rough-spectra-preset",
    "schema": 1,
    "name": "My wall",
    "source": "Measured by me",
    "license": "CC0-1.0",
    "kind": "reading",
    "instrument": "45a:0",
    "sigma_source": "Stylus, 4 mm across the trowel's strokes.",
    "wavelengths": [400, 500, 600, 700],
    "values": [0.6, 0.65, 0.7, 0.72],
}


def material(name="paper"):
    return bpy.data.materials.get(name) or bpy.data.materials.new(name)


def stated(found):
    """σ in degrees and its source, as the material stores them after a save and a load."""
    group = found.rough_spectra
    return snapshot.sigma_degrees(group), group.sigma_source


def assign(tmp_path, *arguments):
    """Run the verb on a new file, and give its material as the saved file has it."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    material().use_fake_user = True
    output = tmp_path / "out.blend"
    assert command_line.main(["assign", *map(str, arguments), "--output", str(output)]) == 0
    bpy.ops.wm.open_mainfile(filepath=str(output))
    return bpy.data.materials["paper"]


@pytest.mark.parametrize(
    ("columns", "cells", "source"),
    [
        ("rdq", f"{RDQ}", "Rdq 0.35 (19.3°): Stated in map.csv, row 1."),
        ("sdq", f"{SDQ:.4f}", "Sdq 0.495 (19.3°): Stated in map.csv, row 1."),
        ("sdq,rdq", f"{SDQ:.2f},{RDQ}", "Rdq 0.35 (19.3°): Stated in map.csv, row 1."),
        ("sigma_deg,rdq", f"{DEGREES},", "Stated in map.csv, row 1."),
    ],
)
def test_a_column_of_a_mapping(tmp_path, columns, cells, source):
    mapping = tmp_path / "map.csv"
    mapping.write_text(f"material,sample,{columns}\npaper,14,{cells}\n", encoding="utf-8")
    degrees, told = stated(assign(tmp_path, "--mapping", mapping))
    assert degrees == pytest.approx(DEGREES, abs=2e-3)
    assert told == source


def test_sigma_counts_where_a_slope_agrees_with_it(tmp_path):
    mapping = tmp_path / "map.json"
    row = {"material": "paper", "sample": "14", "sigma_deg": 19, "rdq": 0.35}
    mapping.write_text(json.dumps([row]), encoding="utf-8")
    degrees, told = stated(assign(tmp_path, "--mapping", mapping))
    assert (degrees, told) == (19, "Rdq 0.35 (19.3°): Stated in map.json, entry 1.")


@pytest.mark.parametrize(("option", "value"), [("--rdq", RDQ), ("--sdq", SDQ)])
def test_an_option_of_assign(tmp_path, option, value):
    words = ("--preset", "brick", "--material", "paper", option, value)
    degrees, told = stated(assign(tmp_path, *words))
    assert degrees == pytest.approx(DEGREES, abs=1e-4)
    word = option[2:].title()
    assert told == f"{word} {value:g} (19.3°): Stated as an option."


@pytest.mark.parametrize(
    "words",
    [("--rdq", "0.3", "--sigma", "20"), ("--rdq", "0.3", "--sdq", "0.3"), ("--rdq", "19")],
)
def test_options_that_cannot_be(words, capsys, tmp_path):
    material()
    words = (*words, "--preset", "14", "--material", "paper", "--output", tmp_path / "o.blend")
    try:
        status = command_line.main(["assign", *map(str, words)])
    except SystemExit as stop:  # argparse's own
        status = stop.code
    assert status == 2
    assert "--rdq" in capsys.readouterr().err
    assert not snapshot.has_spectrum(material())


@pytest.mark.parametrize(
    ("fields", "degrees", "source"),
    [
        ({"rdq": RDQ}, DEGREES, "Rdq 0.35 (19.3°): "),
        ({"sdq": 0.5, "sigma_degrees": None}, math.degrees(math.atan(0.5 / 2**0.5)), "Sdq 0.5 ("),
        ({"rdq": 0.35, "sigma_degrees": 19.3}, 19.3, "Rdq 0.35 (19.3°): "),
    ],
)
def test_a_preset_and_what_becomes_of_it(tmp_path, fields, degrees, source):
    """Read, kept in the library, read from there, stored with a material."""
    path = tmp_path / "wall.json"
    path.write_text(json.dumps(PRESET | fields), encoding="utf-8")
    assert preset_validation.validate(path).faults == ()
    [sample] = readers.read(path)
    assert sample.sigma_degrees == pytest.approx(degrees, abs=1e-9)
    assert sample.sigma_source.startswith(source)
    assert sample.sigma_source.endswith(PRESET["sigma_source"])
    library_files.add_all({"walls": [sample]}, tmp_path / "library")
    again = library.load("walls/my-wall", tmp_path / "library")
    assert (again.sigma_degrees, again.sigma_source) == (sample.sigma_degrees, sample.sigma_source)
    api.assign([(material(), again)])
    assert stated(material()) == (pytest.approx(degrees, abs=1e-4), sample.sigma_source)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({}, "field 'sigma_degrees': it is missing"),
        ({"rdq": "0.3"}, "field 'rdq': it is '0.3' and must be a number"),
        ({"rdq": 20}, "field 'rdq': rdq is 20, and materials are matched up to 1.732"),
        ({"sdq": -1}, "field 'sdq': sdq is -1, and it is the rms slope of an area"),
        ({"rdq": 0.35, "sigma_degrees": 30}, "sigma_degrees and rdq contradict each other"),
    ],
)
def test_a_preset_with_a_fault(tmp_path, fields, words):
    path = tmp_path / "wall.json"
    path.write_text(json.dumps(PRESET | fields), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        readers.read(path)
    assert str(path) in str(caught.value)
    assert words in str(caught.value)
    assert str(caught.value) in preset_validation.validate(path).faults


def test_a_preset_of_an_earlier_version_is_read_and_named(tmp_path):
    path = tmp_path / "wall.json"
    path.write_text(json.dumps(PRESET | {"sigma_degrees": 75}), encoding="utf-8")
    assert readers.read(path)[0].sigma_degrees == 75
    [fault] = preset_validation.validate(path).faults
    assert "field 'sigma_degrees': σ is 75°, and materials are matched up to 60°" in fault


def test_a_library_that_states_a_slope(tmp_path):
    sample = {"name": "Wall", "kind": "reading", "wavelengths": [400, 700], "values": [0.5, 0.5]}
    path = tmp_path / "walls.json"

    def read(**more):
        head = {"format": "rough-spectra-library", "schema": 1, "samples": [sample | more]}
        path.write_text(json.dumps(head), encoding="utf-8")
        return readers.read(path)[0]

    found = read(rdq=RDQ, sigma_source="Stylus.")
    assert found.sigma_degrees == pytest.approx(DEGREES)
    assert found.sigma_source == "Rdq 0.35 (19.3°): Stylus."
    with pytest.raises(InputError, match="sample 1 'Wall': sigma_degrees and sdq contradict"):
        read(sigma_degrees=30, sdq=0.35)
    with pytest.raises(InputError, match="sample 1 'Wall': the field 'rdq' must be a number"):
        read(rdq="steep")


def test_a_script():
    wanted = api.request(api.find("brick"), sdq=SDQ)
    assert math.degrees(wanted.sigma) == pytest.approx(DEGREES)
    assert api.request(api.find("brick"), math.radians(19), rdq=RDQ).sigma == math.radians(19)
    with pytest.raises(api.DomainError, match="'Brick': sigma and rdq contradict each other"):
        api.request(api.find("brick"), math.radians(30), rdq=RDQ)


def test_an_asset_library():
    [asset] = plan.assets([plan.of_name("brick")], [StatedSigma(rdq=RDQ)], 63)
    assert asset.name == "Brick σ 19.29°"
    assert asset.sample.sigma_source == "Rdq 0.35 (19.3°): given for the asset library."
    with pytest.raises(InputError, match=r"Rdq is 19, and .* give them as σ"):
        plan.assets([plan.of_name("brick")], [StatedSigma(rdq=19)], 63)


def test_the_largest_slopes_are_those_of_the_largest_sigma():
    for slope in (StatedSigma(rdq=math.sqrt(3)), StatedSigma(sdq=math.sqrt(6))):
        assert slope.fault() == ("", "")
        assert slope.settled == pytest.approx(MATCHED_SIGMA_DEGREES, abs=1e-12)
        assert slope.settled <= MATCHED_SIGMA_DEGREES
