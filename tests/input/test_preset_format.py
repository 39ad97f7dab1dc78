# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The preset format: the schema, the reader and the validator say the same of every file."""

import json
import re
from math import radians
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.colorimetry import rgb_space, srgb, tristimulus
from rough_spectra.addon.matching import own_gloss, solve
from rough_spectra.addon.matching.request import Request
from rough_spectra.addon.samples import (
    preset_validation,
    presets,
    quality,
    readers,
)
from rough_spectra.addon.samples.readers.formats import library as library_format
from rough_spectra.core.color import color_difference

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "presets" / "schema.json").read_text("utf-8"))
BUNDLED = sorted((ROOT / "presets").glob("*/*.json"))
EVERYDAY = [name for name in presets.names() if name.startswith("everyday/")]
REC709 = rgb_space.WorkingSpace("Linear Rec.709", srgb.FROM_XYZ)
BRICK = json.loads((ROOT / "presets" / "everyday" / "brick.json").read_text("utf-8"))

TYPES = {"string": str, "array": list, "object": dict, "number": (int, float), "null": type(None)}


def allowed(schema, value):
    """JSON Schema 2020-12, as far as the schema of presets uses it."""
    for key, demand in schema.items():
        number = isinstance(value, int | float) and not isinstance(value, bool)
        ok = {
            "type": lambda demand=demand: any(
                isinstance(value, TYPES[name]) and not isinstance(value, bool)
                for name in ([demand] if isinstance(demand, str) else demand)
            ),
            "const": lambda demand=demand: type(value) is type(demand) and value == demand,
            "enum": lambda demand=demand: any(
                type(value) is type(item) and value == item for item in demand
            ),
            "pattern": lambda demand=demand: (
                not isinstance(value, str) or re.search(demand, value) is not None
            ),
            "minLength": lambda demand=demand: not isinstance(value, str) or len(value) >= demand,
            "minimum": lambda demand=demand, number=number: not number or value >= demand,
            "maximum": lambda demand=demand, number=number: not number or value <= demand,
            "minItems": lambda demand=demand: not isinstance(value, list) or len(value) >= demand,
            "maxItems": lambda demand=demand: not isinstance(value, list) or len(value) <= demand,
            "items": lambda demand=demand: (
                not isinstance(value, list) or all(allowed(demand, item) for item in value)
            ),
            "required": lambda demand=demand: all(name in value for name in demand),
            "dependentRequired": lambda demand=demand: all(
                name not in value or set(others) <= set(value) for name, others in demand.items()
            ),
            "properties": lambda demand=demand: (
                not isinstance(value, dict)
                or all(
                    allowed(demand[name], item) for name, item in value.items() if name in demand
                )
            ),
            "anyOf": lambda demand=demand: any(allowed(each, value) for each in demand),
            "additionalProperties": lambda: set(value) <= set(schema["properties"]),
        }
        if key not in ("$schema", "title", "description") and not ok[key]():
            return False
    return True


@pytest.mark.parametrize("path", BUNDLED, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_every_bundled_preset_is_valid_and_without_remark(path):
    assert allowed(SCHEMA, json.loads(path.read_text("utf-8")))
    verdict = preset_validation.validate(path)
    assert verdict.faults == ()
    assert verdict.remarks == ()


def test_the_everyday_ones_are_those_that_were_asked_for():
    names = {name.partition("/")[2] for name in EVERYDAY}
    assert len(names) >= 60
    wanted = {"plaster", "chalk", "brick", "terracotta", "concrete", "sand", "paper", "clay"}
    assert names >= wanted | {"cloth"}


@pytest.mark.parametrize("name", EVERYDAY)
def test_an_everyday_preset_says_where_everything_comes_from(name):
    sample = presets.load(name)
    assert sample.kind == "reading"
    assert "https://" in sample.source
    assert sample.license in ("CC0-1.0", "public domain (U.S. Geological Survey)")
    assert re.match(rf"Estimate, not measured: {sample.sigma_degrees:.0f}°,", sample.sigma_source)
    units = f"{sample.gloss[0][1]:.0f} units at 60°" if sample.gloss else "none"
    assert re.match(rf"Estimate, not measured: {units},", sample.gloss_source)
    assert sample.altered == ()
    assert sample.wavelengths[0] <= 400
    assert sample.wavelengths[-1] >= 700
    assert quality.check([sample]) == [()]


@pytest.mark.parametrize(
    "slug", ["blackboard", "brick", "cardboard", "egg-shell", "paper", "terracotta"]
)
def test_numbers_are_exactly_those_of_the_nix_export(slug):
    sample = presets.load(f"everyday/{slug}")
    file = re.search(r"'([^']+)'$", sample.source)[1]
    text = (ROOT / "tests" / "fixtures" / "nix" / file).read_text("utf-8-sig")
    header, row = (
        next(line for line in text.splitlines() if line.startswith(start)).split(";")
        for start in ("Index;", "1;")
    )
    found = {
        int(re.match(r"R(\d+) nm", label)[1]): float(value)
        for label, value in zip(header, row, strict=True)
        if label.startswith("R4") or re.match(r"R\d+ nm", label)
    }
    assert found == dict(zip(sample.wavelengths.tolist(), sample.values.tolist(), strict=True))


def test_an_everyday_preset_reads_as_the_device_said_and_is_in_the_gamut():
    """The Nix's own L*a*b* is independent of ours; Rec.709 and the preset's own gloss bound it."""
    samples = [presets.load(name) for name in EVERYDAY]
    requests = [
        Request(sample, radians(sample.sigma_degrees), gloss=own_gloss.of_sample(sample))
        for sample in samples
    ]
    assert {sample.name for sample in samples if sample.gloss} == {
        request.sample.name for request in requests if request.gloss
    }
    solutions = solve.solve(requests, REC709)
    for request, found in zip(requests, solutions, strict=True):
        assert found.warnings == (), request.sample.name
        assert found.delta_e_instrument < 0.002, request.sample.name
    nix = [sample for sample in samples if sample.lab]
    assert len(nix) == 16
    for sample in nix:
        weights = tristimulus.weights(sample.wavelengths, sample.illuminant, sample.observer)
        lab = color_difference.xyz_to_lab(sample.reflectance @ weights, weights.sum(axis=0))
        assert float(color_difference.delta_e(lab, np.array(sample.lab))) < 0.02, sample.name


def test_numbers_of_the_geological_survey_by_hand():
    """One value a nanometer from 350 nm, after the title: line 202 of the file is 550 nm."""
    concrete = presets.load("concrete")
    assert concrete.values[concrete.wavelengths == 550].tolist() == [2.8622860e-001]
    assert np.isin([755, 760, 765, 770], presets.load("sand").wavelengths).tolist() == [
        True,
        False,
        False,
        True,
    ]


ABSENT = object()
CHANGES = [
    *((name, ABSENT) for name in BRICK),
    *((name, value) for name in SCHEMA["properties"] for value in (None, "", 7, True, [], ["a"])),
    ("kind", "albedo"),
    ("sigma_degrees", 60),
    ("sigma_degrees", 60.5),
    ("sigma_degrees", 90.5),
    ("rdq", 0.36),
    ("sdq", 0.5147),
    ("sdq", 2.5),
    ("rdq", -0.1),
    ("sigma_degrees", -1),
    ("instrument", "di:8"),
    ("instrument", "8:di"),
    ("schema", 2),
    ("observer", 2),
    ("observer", 5),
    ("condition", "M3"),
    ("lab", [1, 2]),
    ("lab", [1, 2, "3"]),
    ("id", "Everyday/Brick"),
    ("nmae", "Brick"),
    ("gloss", {}),
    ("gloss", {"60": 5, "85": 2100}),
    ("gloss", {"60": 2100.5}),
    ("gloss", {"60": "5"}),
    ("gloss", {"60": True}),
    ("gloss", {"30": 5}),
    ("rdq", 1.7321),
]


@pytest.mark.parametrize(("field", "value"), CHANGES)
def test_schema_and_validator_agree(tmp_path, field, value):
    fields = {**BRICK, field: value}
    if value is ABSENT:
        del fields[field]
    path = tmp_path / "brick.json"
    path.write_text(json.dumps(fields), "utf-8")
    faults = preset_validation.validate(path).faults
    assert bool(faults) == (not allowed(SCHEMA, fields)), faults
    for sentence in faults:
        assert sentence.startswith(f"{path}, field")
        assert f"'{field}'" in sentence
        assert sentence.endswith(".")
    if not faults:
        assert len(readers.read(path)) == 1


def test_every_fault_is_said_at_once(tmp_path):
    path = tmp_path / "bad.json"
    fields = {**BRICK, "kind": "color", "license": "", "values": [9.0, *BRICK["values"][1:]]}
    path.write_text(json.dumps(fields), "utf-8")
    sentences = preset_validation.validate(path).faults
    assert [re.search(r"fields? '(\w+)'", text)[1] for text in sentences] == [
        "license",
        "kind",
        "wavelengths",
    ]


def test_a_spectrum_without_the_red_is_a_fault(tmp_path):
    path = tmp_path / "short.json"
    short = {**BRICK, "wavelengths": BRICK["wavelengths"][:-2], "values": BRICK["values"][:-2]}
    path.write_text(json.dumps(short), "utf-8")
    [sentence] = preset_validation.validate(path).faults
    assert "field 'wavelengths': it covers 400 to 680 nm" in sentence
    assert sentence.endswith("measure the whole range.")


def test_optional_fields_reach_the_sample():
    brick = presets.load("everyday/brick")
    assert (brick.device, brick.condition) == ("Nix Spectro 2", "M1")
    assert (brick.illuminant, brick.observer) == ("D50", 2)
    assert brick.lab == pytest.approx((42.8292362, 21.1443305, 19.6993482))
    assert presets.load("plaster").notes[0].startswith("The sample is ground gypsum")


def test_gloss_and_its_source_are_read_and_kept_by_a_library(tmp_path):
    path = tmp_path / "egg.json"
    fields = {**BRICK, "gloss": {"85": 9, "60": 2.5}, "gloss_source": "By a meter."}
    path.write_text(json.dumps(fields), "utf-8")
    [egg] = readers.read(path)
    assert (egg.gloss, egg.gloss_source) == (((60.0, 2.5), (85.0, 9.0)), "By a meter.")
    again = library_format.sample_of(library_format.record(egg), "egg")
    assert (again.gloss, again.gloss_source) == (egg.gloss, egg.gloss_source)


def test_gloss_without_a_source_is_a_fault(tmp_path):
    path = tmp_path / "egg.json"
    fields = {**BRICK, "gloss": {"60": 2.5}}
    fields.pop("gloss_source", None)
    path.write_text(json.dumps(fields), "utf-8")
    assert not allowed(SCHEMA, fields)
    [sentence] = preset_validation.validate(path).faults
    assert "field 'gloss_source': it is missing beside 'gloss'" in sentence


def test_a_preset_of_an_earlier_version_has_no_gloss(tmp_path):
    path = tmp_path / "old.json"
    old = {key: value for key, value in BRICK.items() if not key.startswith("gloss")}
    path.write_text(json.dumps(old), "utf-8")
    assert preset_validation.validate(path).faults == ()
    [sample] = readers.read(path)
    assert (sample.gloss, sample.gloss_source) == ((), "")


def test_the_verb_reports_every_file_and_fails(tmp_path, capsys):
    from rough_spectra.addon.commands import command_line

    (tmp_path / "brick.json").write_text(json.dumps(BRICK), "utf-8")
    assert command_line.main(["validate", str(tmp_path)]) == 0
    (tmp_path / "worse.json").write_text("{", "utf-8")
    assert command_line.main(["validate", str(tmp_path)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "1 presets, 0 faults"
    assert lines[1].startswith(f"{tmp_path / 'worse.json'}, line 1: the JSON is broken")
    assert lines[2] == "2 presets, 1 faults"
