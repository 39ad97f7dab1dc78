# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The virtual instrument on the command line, and in files."""

import csv
import json
import re

import bpy
import numpy as np
import pytest
from rough_spectra.addon.readings.json_document import from_json
from rough_spectra.addon.samples import readers
from rough_spectra.core import reading
from rough_spectra.core.instruments import REGISTRY


def assigned(main, scene, tmp_path, rows, *words):
    mapping = tmp_path / "mapping.csv"
    mapping.write_text("material,sample,sigma_deg,read_at\n" + "\n".join(rows), encoding="utf-8")
    result = main("assign", "--blend", scene, "--mapping", mapping, *words)
    return result, {m.name: m.rough_spectra.read_at for m in bpy.data.materials}


def test_a_mapping_says_where_each_material_reads_right(main, scene, tmp_path):
    rows = ["Alpha,14 green,30,45as75", "Plain,5,30,"]
    result, stored = assigned(main, scene, tmp_path, rows)
    assert result.status == 0
    assert (stored["Alpha"], stored["Plain"]) == ("45as75", "45a:0")
    assert "largest predicted ΔE00 at 45°:as75°, 45°/0° 0.00" in result.err
    checked = main("check", "--blend", scene, "--material", "Alpha", "--max-delta-e", "0.05")
    assert checked.status == 0
    # At another instrument it misses, and that counts.
    words = ("--material", "Alpha", "--read-at", "45as110", "--read-at", "45as75")
    checked = main("check", "--blend", scene, *words, "--max-delta-e", "0.05")
    assert checked.status == 1
    assert "1 of 2 readings exceed ΔE00 0.05" in checked.err
    assert re.search(r"'Alpha' differs by ΔE00 \d\.\d\d at 45as110 \(.*made to read", checked.err)


def test_the_option_counts_whatever_the_mapping_says(main, scene, tmp_path):
    rows = ["Alpha,14 green,30,45as75"]
    _, stored = assigned(main, scene, tmp_path, rows, "--read-at", "di:8")
    assert stored["Alpha"] == "di:8"


def test_an_unknown_instrument_is_refused_with_file_and_row(main, scene, tmp_path):
    before = scene.read_bytes()
    result, _ = assigned(main, scene, tmp_path, ["Alpha,14 green,30,46:0"])
    assert result.status == 2
    assert "mapping.csv, row 1: read_at is '46:0'; make it one of 45a:0, " in result.sentence
    assert scene.read_bytes() == before


@pytest.fixture
def several(main, scene, tmp_path):
    """Base name of a bake of one material at three instruments."""
    base = tmp_path / "out" / "angles"
    words = [word for name in ("45as15", "45as110", "di:8") for word in ("--read-at", name)]
    result = main("bake", "--blend", scene, "--material", "Alpha", "--output", base, *words)
    assert result.status == 0
    assert "3 readings at 45as15, 45as110, di:8, largest" in result.err
    return base


def test_every_file_names_the_instrument_of_each_reading(several):
    names = ["45as15", "45as110", "di:8"]
    document = json.loads(several.with_name("angles.json").read_text(encoding="utf-8"))
    assert document["instrument"] == "45as15, 45as110, di:8"
    assert document["aperture"] == "those of the instrument, over a flat sample"
    assert [entry["instrument"] for entry in document["readings"]] == names
    for part in ("predicted", "measured"):
        text = several.with_name(f"angles.{part}.csv").read_text(encoding="utf-8")
        assert "# instrument: 45as15, 45as110, di:8\n" in text
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        assert [row["instrument"] for row in csv.DictReader(lines)] == names
        table = several.with_name(f"angles.{part}.cgats.txt").read_text(encoding="utf-8")
        rows = table.partition("BEGIN_DATA\n")[2].partition("END_DATA")[0].splitlines()
        assert "SAMPLE_ID\tSAMPLE_NAME\tMEASUREMENT_GEOMETRY\t" in table
        assert [row.split("\t")[2] for row in rows] == [f'"{name}"' for name in names]
    for ending in ("predicted.spectral.exr", "measured.exr"):
        assert (
            b"read at 45as15, 45as110, di:8; " in several.with_name(f"angles.{ending}").read_bytes()
        )


def test_predictions_are_those_of_each_instrument_and_read_back_as_such(several):
    document = json.loads(several.with_name("angles.json").read_text(encoding="utf-8"))
    first, *_ = document["readings"]
    albedo = np.array(first["predicted"]["albedo_lowest"])
    for entry in document["readings"]:
        wanted = reading.from_albedo(albedo, 0.35, "surface", entry["instrument"])
        # σ goes through a property of single precision, the albedo through six digits.
        np.testing.assert_allclose(entry["predicted"]["values"], wanted, atol=3e-6)
    # Readings of one name at several geometries are one surface's.
    [sample] = readers.read(several.with_name("angles.predicted.cgats.txt"))
    read = {each.instrument: each for each in sample.readings}
    assert set(read) == {"45as15", "45as110", "di:8"}
    for entry in document["readings"]:
        found = read[entry["instrument"]].values
        np.testing.assert_allclose(found, entry["predicted"]["values"], atol=1e-5)


@pytest.mark.parametrize("name", REGISTRY)
def test_a_table_of_one_instrument_reads_back_as_of_that(name, main, scene, tmp_path):
    base = tmp_path / "one"
    words = ("--material", "Alpha", "--predicted-only", "--read-at", name)
    assert main("bake", "--blend", scene, "--output", base, *words).status == 0
    samples = readers.read(base.with_name("one.predicted.csv"))
    assert {sample.instrument for sample in samples} == {name}


def test_compare_reads_both_at_the_instrument(main, tmp_path):
    table = tmp_path / "apart.csv"
    told = {}
    for name in ("45a:0", "45as110"):
        words = ("--sigma", "0", "45", "--read-at", name, "--output", table)
        result = main("compare", "14 green", "14 green", *words, "--kind", "albedo", "albedo")
        assert result.status == 0
        assert f"# readings: {name}, model surface" in table.read_text(encoding="utf-8")
        line = next(line for line in result.out.splitlines() if line.startswith("samples as"))
        told[name] = float(line.split("\t")[2])  # lightness
    # Darker along the normal, lighter toward the light.
    assert told["45a:0"] < 0 < told["45as110"]


def test_gloss_units_stand_beside_what_is_measured(main, scene, tmp_path):
    base = tmp_path / "shiny"
    words = ("--material", "Alpha", "--material", "Plain", "--gloss")
    assert main("bake", "--blend", scene, "--output", base, *words).status == 0
    document = json.loads(base.with_name("shiny.json").read_text(encoding="utf-8"))
    told = {entry["material"]: entry["gloss"] for entry in document["readings"]}
    # Matte: what the windows see of an even surface falls with the cosine, less than a black glass.
    assert 0 < told["Plain"][2] < told["Plain"][0] < told["Plain"][1] < 2
    assert from_json(base.with_name("shiny.json")).entries[0].gloss == tuple(told["Alpha"])
    text = base.with_name("shiny.measured.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    for row in rows:
        found = [float(row[f"gloss_{angle}"]) for angle in (20, 60, 85)]
        assert found == pytest.approx(told[row["material"]])
    refused = main("bake", "--blend", scene, "--output", base, *words, "--predicted-only")
    assert refused.status == 2
    assert "--predicted-only" in refused.err
