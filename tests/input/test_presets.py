# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The bundled materials: equal to their source, found by any name, refused when broken."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from rough_spectra.addon.samples import presets, readers
from rough_spectra.core.errors import InputError

ROOT = Path(__file__).resolve().parents[2]
GREEN = json.loads((ROOT / "presets" / "colorchecker" / "14-green.json").read_text("utf-8"))

# In a process of its own: importing colour-science leaves stand-ins for scipy in sys.modules.
DATA = """
import json, sys, warnings
warnings.simplefilter("ignore")
import colour
patches = colour.SDS_COLOURCHECKERS["ColorChecker N Ohta"]
print(json.dumps({k: [v.wavelengths.tolist(), v.values.tolist()] for k, v in patches.items()}))
"""


def run(*arguments):
    command = [sys.executable, *arguments]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stdout


def test_numbers_are_exactly_those_of_colour_science():
    patches = json.loads(run("-c", DATA).splitlines()[-1])
    samples = [presets.load(name) for name in presets.names() if name.startswith("colorchecker/")]
    assert len(samples) == len(patches) == 24
    for number, (sample, (patch, data)) in enumerate(
        zip(samples, patches.items(), strict=True), start=1
    ):
        assert sample.name.lower() == f"colorchecker {number:02} {patch}".lower()
        assert [sample.wavelengths.tolist(), sample.values.tolist()] == data
        assert f"['{patch}']" in sample.source
        assert "Ohta" in sample.source
        assert (sample.kind, sample.instrument, sample.sigma_degrees) == ("albedo", "45a:0", 0.0)
        assert sample.sigma_source.startswith("Not measured")
        assert sample.license == "BSD-3-Clause"


def test_the_tool_writes_the_same_bytes_again(tmp_path):
    run("-m", "tools.tables.make_presets", str(tmp_path))
    written = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    committed = (ROOT / "presets" / "colorchecker").glob("*.json")
    assert written == {path.name: path.read_bytes() for path in committed}


def test_green_by_hand():
    green = presets.load("14")
    assert green.name == "ColorChecker 14 Green"
    assert (green.wavelengths[0], green.wavelengths[-1], len(green.wavelengths)) == (380, 780, 81)
    assert green.values[:3].tolist() == [0.055, 0.056, 0.057]


def test_ids_are_those_in_the_files_and_sorted():
    ids = presets.names()
    assert ids == sorted(ids)
    for name in ids:
        fields = json.loads((presets.folder() / f"{name}.json").read_text("utf-8"))
        assert fields["id"] == name


def test_names_read_no_file(monkeypatch):
    monkeypatch.setattr(Path, "read_bytes", lambda self: pytest.fail("was read"))
    monkeypatch.setattr(Path, "open", lambda self: pytest.fail("was opened"))
    assert "colorchecker/01-dark-skin" in presets.names()


def test_every_name_of_every_preset_leads_to_it():
    for name in presets.names():
        sample = presets.load(name)
        stem = name.partition("/")[2]
        number = stem.partition("-")[0]
        others = (number, str(int(number))) if number.isdecimal() else (stem,)
        for called in (*others, name.upper()):
            assert presets.load(called).name == sample.name
        if name.startswith("colorchecker/"):
            assert presets.load(sample.name.upper()).name == sample.name
        assert presets.load(presets.folder() / f"{name}.json").name == sample.name


@pytest.mark.parametrize(
    ("called", "name"),
    [
        ("green", "ColorChecker 14 Green"),
        ("ColorChecker 7", "ColorChecker 07 Orange"),
        ("neutral 8", "ColorChecker 20 Neutral 8 (.23 D)"),
        ("White 9.5 (.05 D)", "ColorChecker 19 White 9.5 (.05 D)"),
        (" dark_skin ", "ColorChecker 01 Dark skin"),
    ],
)
def test_what_people_say(called, name):
    assert presets.load(called).name == name


@pytest.mark.parametrize(
    ("called", "part"),
    [
        ("gren", "colorchecker/14-green"),
        ("colorchecker/14-grean", "colorchecker/14-green"),
        ("blueflower", "colorchecker/05-blue-flower"),
        ("25", "there is no preset '25'"),
        ("", "colorchecker/01-dark-skin"),
        ("../../etc/passwd", "there is no preset"),
    ],
)
def test_an_unknown_name_gets_the_closest(called, part):
    with pytest.raises(InputError) as caught:
        presets.load(called)
    assert part in str(caught.value)
    assert str(presets.folder()) in str(caught.value)
    assert str(caught.value).endswith(".")


def test_a_name_of_two_is_refused_with_both(tmp_path, monkeypatch):
    monkeypatch.setattr(presets, "folder", lambda: tmp_path)
    with pytest.raises(InputError, match="no presets are there"):
        presets.load("chalk")
    for collection in ("school", "field"):
        (tmp_path / collection).mkdir()
        (tmp_path / collection / "01-chalk.json").write_text(json.dumps(GREEN))
    with pytest.raises(InputError, match="field/01-chalk, school/01-chalk; give the whole id"):
        presets.load("chalk")
    assert presets.load("field/01-chalk").name == GREEN["name"]


def test_presets_are_listed_once_until_one_comes_or_goes(tmp_path, monkeypatch):
    monkeypatch.setattr(presets, "folder", lambda: tmp_path)
    (tmp_path / "school").mkdir()
    (tmp_path / "school" / "01-chalk.json").write_text(json.dumps(GREEN))
    assert presets.path_of("chalk").name == "01-chalk.json"
    listed = presets._list.cache_info().misses
    for _ in range(50):
        assert presets.path_of("1") == presets.path_of("school/01-chalk")
        assert presets.names() == ["school/01-chalk"]
    assert presets._list.cache_info().misses == listed
    (tmp_path / "school" / "02-board.json").write_text(json.dumps(GREEN))
    assert presets.names() == ["school/01-chalk", "school/02-board"]
    assert presets.path_of("board").name == "02-board.json"
    (tmp_path / "school" / "01-chalk.json").unlink()
    assert presets.names() == ["school/02-board"]


ABSENT = object()


@pytest.mark.parametrize(
    ("field", "value", "parts"),
    [
        ("schema", 2, ["'2'", "newer version"]),
        ("schema", True, ["must be 1"]),
        ("schema", ABSENT, ["is missing", "must be 1"]),
        ("kind", "color", ["'color'", "'reading', 'albedo' or 'emissivity'"]),
        ("kind", ["albedo"], ["'reading', 'albedo' or 'emissivity'"]),
        ("name", ABSENT, ["is missing", "text"]),
        ("name", "  ", ["text that is not empty"]),
        ("source", None, ["'None'", "text"]),
        ("license", 3, ["'3'", "text"]),
        ("instrument", "", ["text"]),
        ("sigma_source", ABSENT, ["is missing"]),
        ("sigma_degrees", ABSENT, ["is missing", "null if nobody knows"]),
        ("sigma_degrees", -1, ["'-1'", "from 0 to 60"]),
        ("sigma_degrees", 90.5, ["'90.5'"]),
        ("sigma_degrees", float("nan"), ["'nan'"]),
        ("sigma_degrees", "30", ["'30'", "must be a number"]),
        ("instrument", "30:0", ["'30:0'", "45a:0", "di:8"]),
        ("instrument", ["45a:0"], ["must be a text"]),
        ("values", ABSENT, ["is missing", "list of numbers"]),
        ("values", "0.5", ["list of numbers"]),
        ("values", [0.5, True], ["number 2 is 'True'"]),
        ("values", [0.5, None], ["number 2 is 'None'"]),
        ("values", [0.5, 10**400], ["number 2 is '1000"]),
        ("values", [0.5], ["81 wavelengths", "1 values"]),
        ("values", [5.5] * 81, ["380 nm", "number 1", "times white"]),
        ("values", [float("nan")] * 81, ["380 nm", "NaN"]),
        ("lab", [50, float("nan"), 0], ["number 2 is 'nan'"]),
        ("xyz", [0.1, 0.2, float("inf")], ["number 3 is 'inf'"]),
        ("wavelengths", list(range(780, 375, -5)), ["775 nm", "number 2", "sort"]),
    ],
)
def test_a_broken_field_is_named(tmp_path, field, value, parts):
    fields = {**GREEN, field: value}
    if value is ABSENT:
        del fields[field]
    path = tmp_path / "broken.json"
    path.write_text(json.dumps(fields))
    with pytest.raises(InputError) as caught:
        presets.load(path)
    sentence = str(caught.value)
    assert sentence.startswith(str(path))
    assert sentence.endswith(".")
    for part in [f"'{field}'", *parts]:
        assert part in sentence


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ('{"format": "rough-spectra-preset",\n"schema" 1}', "line 2: the JSON is broken"),
        ('{"x": "rough-spectra-preset"}', "field 'format': it is missing"),
        ('{"format": "rough-spectra-preset", "a": ' + "[" * 10**5, "too deep"),
        ('{"format": "rough-spectra-preset", "a": ' + "9" * 10**4 + "}", "number too long"),
    ],
)
def test_broken_json(tmp_path, text, part):
    path = tmp_path / "broken.json"
    path.write_text(text)
    with pytest.raises(InputError, match=part) as caught:
        presets.load(path)
    assert str(caught.value).startswith(str(path))
    assert str(caught.value).endswith(".")


def test_an_unknown_sigma_stays_unknown(tmp_path):
    path = tmp_path / "clay.JSON"
    path.write_text(json.dumps({**GREEN, "sigma_degrees": None, "kind": "reading"}))
    clay = presets.load(path)
    assert (clay.sigma_degrees, clay.kind) == (None, "reading")
    assert readers.read(path)[0].values.tolist() == clay.values.tolist()
