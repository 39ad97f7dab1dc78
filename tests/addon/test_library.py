# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The user library: nothing is lost, whoever writes at the same time and however it ends."""

import dataclasses
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.samples import (
    importing,
    library,
    library_files,
    presets,
    readers,
    swatches,
)
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.core.color import color_difference
from rough_spectra.core.errors import InputError, OutputError
from rough_spectra.core.instruments import REGISTRY

ROOT = Path(__file__).resolve().parents[2]
NM = np.arange(400.0, 701.0, 10.0)
SECONDS = 120
"""After which a child hangs."""


def sample(name, level=0.4, **fields):
    values = np.random.default_rng(round(1e6 * level)).uniform(level, level + 0.05, NM.size)
    return Sample(name, NM, values, fields.pop("kind", "reading"), **fields)


def same(one, two):
    pairs = [(getattr(one, f.name), getattr(two, f.name)) for f in dataclasses.fields(Sample)]
    return all(map(same_field, *zip(*pairs, strict=True)))


def same_field(one, two):
    if isinstance(one, np.ndarray):
        return np.array_equal(one, two)
    if isinstance(one, tuple) and one and isinstance(one[0], Sample):
        return len(one) == len(two) and all(map(same, one, two))
    return one == two


def own(folder):
    return [entry for entry in library.entries(folder) if not entry.is_preset]


def files(folder):
    return {p.name: p.read_bytes() for p in folder.iterdir() if p.name != ".lock"}


FULL = Sample(
    'Gips "rauh"\n石膏 \U0001f9f1',
    np.array([380.0, 400.25, 500.0 + 1e-9, 700.0, 1000.0]),
    np.array([-0.01, 1 / 3, 0.1 + 0.2, 5e-324, 12.5]),
    "reading",
    quantity="radiance factor",
    instrument="de:8",
    geometry="de:8°",
    aperture="8 mm",
    specular="SCE",
    sigma_degrees=1 / 7,
    sigma_source="profilometer",
    source="C:\\data\\a.cxf",
    license="CC0-1.0",
    position="object c1",
    device="Device",
    condition="M1",
    illuminant="D50",
    observer=2,
    lab=(1 / 3, -0.1, 2.0),
    xyz=(0.1, 0.2, 0.3),
    notes=("One.", "Two."),
    altered=("Two scans were averaged.",),
    white="45:0",
    white_factor=1 / 1.03,
    surface="rough",
    called="Gips (45/0)",
    others=(
        sample("Gips glatt", surface="smooth", notes=("Three.",)),
        Sample('Gips "rauh"\n石膏 \U0001f9f1', [400.0, 700.0], [0.1, 0.2], "reading", "di:8"),
    ),
    gloss=((20.0, 1 / 3), (60.0, 23.5), (85.0, 90.0)),
    gloss_source="By a meter.",
)


def test_every_field_comes_back_to_the_last_bit(tmp_path):
    plaque = dataclasses.replace(FULL, white_factor=None, plaque="ptfe")
    left = [
        f.name
        for f in dataclasses.fields(Sample)
        if getattr(FULL, f.name) is f.default and getattr(plaque, f.name) is f.default
    ]
    assert left == [], "give the sample above a value for each field"
    plain = sample("plain")
    assert library.add([FULL, plain], "mine", tmp_path).names == (FULL.name, "plain")
    assert all(map(same, readers.read(tmp_path / "mine.json"), [FULL, plain]))
    assert same(library.load("mine/plain", tmp_path), plain)
    (first, second) = own(tmp_path)
    assert first.id == "mine/gips-rauh-石膏"
    assert first.sigma_degrees == 1 / 7
    assert any("below 0" in sentence for sentence in first.warnings)
    assert second.warnings == ()
    library.add([plaque], "plaques", tmp_path)
    assert same(readers.read(tmp_path / "plaques.json")[0], plaque)


TEXTS = st.text(max_size=20) | st.sampled_from(
    ["\x7f", "a\x80", "\x9f", "\u2028", "\x00", "\ufeff", "\ud800", "\udcff", "\r\n", "\u202e"]
)
NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
TRIPLES = st.none() | st.tuples(NUMBERS, NUMBERS, NUMBERS)
SPECTRA = st.lists(
    st.tuples(st.floats(1000.0, 2500.0), NUMBERS),
    min_size=2,
    max_size=4,
    unique_by=lambda band: band[0],
).map(sorted)
TEXT_FIELDS = [
    field.name
    for field in dataclasses.fields(Sample)
    if field.type == "str" and field.default == "" and field.name != "plaque"
]
WHITES = st.one_of(
    st.just({}),
    st.fixed_dictionaries(
        {"white": st.sampled_from(["45:0", "8:d"]), "white_factor": st.floats(0.5, 2.0)}
    ),
)
OTHERS = st.builds(
    lambda name, spectrum, instrument: Sample(
        name, *zip(*spectrum, strict=True), "reading", instrument=instrument
    ),
    TEXTS,
    SPECTRA,
    st.sampled_from(sorted(REGISTRY)),
)
GLOSS = st.tuples(st.floats(0.0, 90.0, exclude_min=True, exclude_max=True), st.floats(0.0, 2000.0))


@st.composite
def samples(draw):
    """Whatever `Sample` accepts."""
    nm, values = zip(*draw(SPECTRA), strict=True)
    return Sample(
        draw(TEXTS | st.integers(1, 400).map("[{".__mul__)),
        np.array(nm),
        np.array(values),
        draw(st.sampled_from(["reading", "albedo"])),
        instrument=draw(st.sampled_from(sorted(REGISTRY))),
        sigma_degrees=draw(st.none() | NUMBERS),
        observer=draw(st.none() | st.integers(-(2**53), 2**53)),
        lab=draw(TRIPLES),
        xyz=draw(TRIPLES),
        others=draw(st.lists(OTHERS, max_size=2).map(tuple)),
        gloss=draw(st.lists(GLOSS, max_size=3, unique_by=lambda pair: pair[0]).map(tuple)),
        notes=draw(st.lists(TEXTS, max_size=2).map(tuple)),
        altered=draw(st.lists(TEXTS, max_size=2).map(tuple)),
        **draw(WHITES),
        **{name: draw(TEXTS) for name in draw(st.sets(st.sampled_from(TEXT_FIELDS), max_size=3))},
    )


@settings(deadline=None, max_examples=100)
@given(samples())
def test_whatever_a_sample_may_be_it_reads_back(one):
    beside = sample("beside")
    with tempfile.TemporaryDirectory() as name:
        library.add([beside, one], "mine", Path(name))
        found = readers.read(Path(name, "mine.json"))
        assert len(found) == 2
        assert all(map(same, found, [beside, one]))


@pytest.mark.parametrize("character", [*map(chr, range(0x7F, 0xA0)), "\u2028", "\u2029", "\ufeff"])
def test_a_name_written_raw_by_hand_does_not_take_the_others_along(tmp_path, character):
    name = f"Gr{character}n"
    library.add([sample(name), sample("other", 0.5)], "mine", tmp_path)
    path = tmp_path / "mine.json"
    text = path.read_bytes().decode()
    assert character not in text
    path.write_text(text.replace(f"\\u{ord(character):04x}", character), encoding="utf-8")
    assert character in path.read_text(encoding="utf-8")
    assert [entry.name for entry in own(tmp_path)] == [name, "other"]
    said = any("control character" in warning for warning in own(tmp_path)[0].warnings)
    assert said == (character < "\u00a0")
    library.add([sample("third", 0.6)], "mine", tmp_path)
    assert [entry.name for entry in own(tmp_path)] == [name, "other", "third"]
    assert character not in path.read_text(encoding="utf-8")
    preset = next(iter(presets.folder().glob("*/*.json"))).read_text(encoding="utf-8")
    fields = json.loads(preset) | {"name": name}
    (tmp_path / "one.json").write_text(json.dumps(fields, ensure_ascii=False), encoding="utf-8")
    assert presets.load(tmp_path / "one.json").name == name


def test_a_name_that_no_json_can_keep_is_refused_and_nothing_changed(tmp_path):
    library.add([sample("a")], "mine", tmp_path)
    before = files(tmp_path)
    # Two halves of one character that JSON joins.
    with pytest.raises(InputError, match=r"mine\.json: the sample .* does not read back"):
        library.add([sample("b\ud83e\uddf1", 0.5)], "mine", tmp_path)
    assert files(tmp_path) == before


def test_a_collection_larger_than_what_is_read_is_refused(tmp_path, monkeypatch):
    library.add([sample("a")], "mine", tmp_path)
    before = files(tmp_path)
    monkeypatch.setattr(library_files, "LARGEST", 1000)
    with pytest.raises(InputError, match="add them to another collection"):
        library.add([sample("b", 0.5)], "mine", tmp_path)
    assert files(tmp_path) == before


@pytest.mark.parametrize(
    "fields",
    [
        {"sigma_degrees": math.nan},
        {"lab": (1.0, math.inf, 0.0)},
        {"xyz": (1.0, 2.0)},
        {"observer": 2.5},
        {"notes": "one"},
        {"device": None},
    ],
)
def test_what_no_file_could_keep_is_no_sample(fields):
    with pytest.raises(InputError, match=next(iter(fields))):
        sample("a", **fields)


def test_numbers_of_numpy_become_those_of_python():
    one = sample("a", observer=np.int64(10), lab=np.float32([1, 2, 3]), sigma_degrees=np.float32(3))
    assert (type(one.observer), type(one.sigma_degrees)) == (int, float)
    assert one.lab == (1.0, 2.0, 3.0)
    assert {type(number) for number in one.lab} == {float}


SET = sample("Tile", others=(sample("Tile", 0.5, instrument="di:8"),), gloss=((60.0, 8.0),))


@pytest.mark.parametrize(
    ("fields", "word"),
    [
        ({"others": 5}, "'others'"),
        ({"others": [1]}, "'others'"),
        ({"others": [{}]}, "'values'"),
        ({"others": [{"values": [0.1, 0.2]}]}, "31 wavelengths stand against 2"),
        ({"others": [{"values": [0.1] * 31, "kind": "albedo"}]}, "no reading"),
        ({"others": [{"values": [0.1] * 31, "others": [{}]}]}, "a set of its own"),
        ({"others": [{"values": [0.1] * 31, "instrument": "x"}]}, "'instrument'"),
        ({"others": [{"values": [1e999] * 31}]}, "400 nm"),
        ({"gloss": [60, 8]}, "'gloss'"),
        ({"gloss": {"sixty": 8}}, "'sixty'"),
        ({"gloss": {"60": "8"}}, "'gloss'"),
        ({"gloss": {"60": -1}}, "-1 gloss units"),
        ({"gloss": {"60": 8, "60.0": 9}}, "twice"),
        ({"gloss": {"90": 8}}, "90°"),
        ({"gloss": {"nan": 8}}, "must be 2 numbers"),
    ],
)
def test_a_damaged_set_is_a_sentence_that_names_file_and_sample(tmp_path, fields, word):
    library.add([SET], "mine", tmp_path)
    path = tmp_path / "mine.json"
    document = json.loads(path.read_text())
    document["samples"][0] |= fields
    path.write_text(json.dumps(document))
    with pytest.raises(InputError, match=re.escape(word)) as caught:
        readers.read(path)
    assert str(path) in str(caught.value)
    assert "Tile" in str(caught.value)


def test_the_same_spectrum_with_a_set_is_another_sample(tmp_path):
    alone = dataclasses.replace(SET, others=(), gloss=())
    assert library.add([alone], "mine", tmp_path).names == ("Tile",)
    assert library.add([SET], "mine", tmp_path).names == ("Tile 2",)
    assert library.add([SET, alone], "mine", tmp_path).present == ("Tile", "Tile")
    assert same(library.load("mine/tile-2", tmp_path), dataclasses.replace(SET, name="Tile 2"))


def test_a_set_that_is_none_is_no_sample():
    for others in ((SET,), (sample("a", kind="albedo"),), ("a",)):
        with pytest.raises(InputError):
            dataclasses.replace(SET, others=others)
    for gloss in (((60.0,),), (5.0,), "60", ((60.0, 1.0), (60.0, 2.0))):
        with pytest.raises(InputError):
            dataclasses.replace(SET, gloss=gloss)


def test_a_file_has_one_sample_a_line_so_that_changes_can_be_seen(tmp_path):
    library.add([sample("a"), sample("b", 0.5)], "mine", tmp_path)
    before = (tmp_path / "mine.json").read_text(encoding="utf-8").splitlines()
    library.add([sample("c", 0.6)], "mine", tmp_path)
    after = (tmp_path / "mine.json").read_text(encoding="utf-8").splitlines()
    assert next(line for line in after if '"name"' in line).rstrip(",") == before[4].rstrip(",")
    assert len(after) == len(before) + 1
    assert len(set(before) - set(after)) == 1  # the last line got its comma
    assert set(files(tmp_path)) == {"mine.json"}


def test_nothing_is_overwritten_and_nothing_added_twice(tmp_path):
    added = library.add([sample("a"), sample("a", 0.5)], "mine", tmp_path)
    assert added.names == ("a", "a 2")
    assert added.ids == ("mine/a", "mine/a-2")
    assert added.renamed == (("a", "a 2"),)
    content = files(tmp_path)
    again = library.add([sample("a"), sample("a", 0.5)], "mine", tmp_path)
    assert (again.ids, again.names, again.present) == (added.ids, (), ("a", "a"))
    assert files(tmp_path) == content
    more = library.add([sample("b"), sample("A!"), sample("a", kind="albedo")], "mine", tmp_path)
    assert more.names == ("b", "A!", "a 3")
    assert more.ids == ("mine/b", "mine/a-3", "mine/a-3-2")


def test_remove_and_rename_leave_the_other_ids_alone(tmp_path):
    library.add([sample("x+1"), sample("x-1", 0.5), sample("y", 0.6)], "mine", tmp_path)
    assert [entry.id for entry in own(tmp_path)] == ["mine/x-1", "mine/x-1-2", "mine/y"]
    library.remove(["mine/x-1"], tmp_path)
    assert [(entry.id, entry.name) for entry in own(tmp_path)] == [
        ("mine/x-1-2", "x-1"),
        ("mine/y", "y"),
    ]
    assert library.rename("mine/y", "Putz, rauh", tmp_path) == "mine/putz-rauh"
    assert same(library.load("mine/putz-rauh", tmp_path), sample("Putz, rauh", 0.6))
    content = files(tmp_path)
    for change, word in (
        (lambda: library.rename("mine/putz-rauh", "x-1", tmp_path), "another sample is called"),
        (lambda: library.rename("mine/putz-rauh", " ", tmp_path), "needs a name"),
        (lambda: library.rename("mine/gone", "z", tmp_path), "'gone'"),
        (lambda: library.remove(["mine/putz-rauh", "mine/gone"], tmp_path), "'gone'"),
        (lambda: library.remove(["colorchecker/14-green"], tmp_path), "14-green"),
        (lambda: library.remove(["../mine/x-1-2"], tmp_path), "'../mine/x-1-2'"),
    ):
        with pytest.raises(InputError, match=word):
            change()
        assert files(tmp_path) == content
    library.remove(["mine/x-1-2", "mine/putz-rauh"], tmp_path)
    assert files(tmp_path) == {}


def test_fields_of_others_stay_when_the_file_is_written_again(tmp_path):
    library.add([sample("a")], "mine", tmp_path)
    path = tmp_path / "mine.json"
    fields = json.loads(path.read_text(encoding="utf-8"))
    fields["curator"] = "someone"
    fields["samples"][0]["tags"] = ["rough", 1.10]
    path.write_text(json.dumps(fields, indent=4), encoding="utf-8")
    library.add([sample("b", 0.5)], "mine", tmp_path)
    written = json.loads(path.read_text(encoding="utf-8"))
    assert written["curator"] == "someone"
    assert written["samples"][0] == fields["samples"][0]


@pytest.mark.parametrize(
    ("old", "new", "word"),
    [
        ('"schema": 1', '"schema": 2', "newer Rough Spectra"),
        ('"schema": 1', '"schema": 0', "'schema'"),
        ('"samples": [', '"samples": [3,', "'samples'"),
        ('"samples": [', '"samples": [{"name": "n"},', "sample 1 'n': the field 'kind'"),
        ('"kind": "reading"', '"kind": "color"', "sample 1 'a': the field 'kind'"),
        ('"kind": "reading"', '"kind": "reading", "lab": [1, 2]', "'lab' must be three numbers"),
        ('"kind": "reading"', '"kind": "reading", "observer": "2"', "'observer'"),
        ('"kind": "reading"', '"kind": "reading", "notes": "x"', "'notes'"),
        ('"kind": "reading"', '"kind": "reading", "instrument": "x"', "'instrument'"),
        ('"wavelengths": [400', '"wavelengths": ["400"', "'wavelengths'"),
        ('"wavelengths": [400', f'"wavelengths": [{"9" * 400}', "too long"),
        ('"wavelengths": [400', '"wavelengths": [800', "mine.json, sample 1 'a': the wavelength"),
        ('"values": [', '"values": [NaN, ', "values"),
        ('"values": [', '"values": ', "line 5"),
        ("{", "[" * 100000, "brackets"),
    ],
)
def test_a_damaged_or_newer_file_is_reported_and_left_as_it_is(tmp_path, old, new, word):
    library.add([sample("a", source="elsewhere.csv")], "mine", tmp_path)
    library.add([sample("b")], "other", tmp_path)
    path = tmp_path / "mine.json"
    path.write_text(path.read_text(encoding="utf-8").replace(old, new, 1), encoding="utf-8")
    before = files(tmp_path)
    (fault,) = library.contents(tmp_path).faults
    assert str(path) in fault
    assert [entry.id for entry in own(tmp_path)] == ["other/b"]
    for change in (
        lambda: library.add([sample("c")], "mine", tmp_path),
        lambda: library.add_all({"other": [sample("c")], "mine": [sample("c")]}, tmp_path),
        lambda: library.remove(["other/b", "mine/a"], tmp_path),
        lambda: library.rename("mine/a", "b", tmp_path),
    ):
        with pytest.raises(InputError) as caught:
            change()
        assert str(path) in str(caught.value)
        assert word in str(caught.value) or "is no Rough Spectra library" in str(caught.value)
        assert files(tmp_path) == before


def test_preset_files_in_the_folder_are_read_too(tmp_path):
    green = presets.folder() / "colorchecker" / "14-green.json"
    shutil.copy(green, tmp_path / "loose.json")
    (tmp_path / "chart").mkdir()
    shutil.copy(green, tmp_path / "chart" / "14-green.json")
    (tmp_path / "colorchecker").mkdir()
    shutil.copy(green, tmp_path / "colorchecker" / "99-new.json")
    (tmp_path / "notes.txt").write_text("not a sample", encoding="utf-8")
    found = library.contents(tmp_path)
    ids = [entry.id for entry in found.entries if not entry.is_preset]
    assert ids == ["chart/14-green", "loose/colorchecker-14-green"]
    assert len(found.faults) == 1
    assert "'colorchecker' is taken" in found.faults[0]
    with pytest.raises(InputError, match="no Rough Spectra library"):
        library.add([sample("a")], "loose", tmp_path)


@pytest.mark.parametrize("name", ["a/b", "..", "", "con", ".hidden", "a\0", "x" * 300, "a."])
def test_a_collection_that_no_file_can_be_called_is_refused(tmp_path, name):
    with pytest.raises(InputError, match="cannot be called"):
        library.add([sample("a")], name, tmp_path / "library")
    assert list(tmp_path.rglob("*.json")) == []


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("con", "con-"),
        ("CON .x", "CON- .x"),
        ("com¹", "com¹-"),
        ("comic", "comic"),
        ("conout$.csv", "conout$-.csv"),
        ("con" + " " * 77 + "abc", "con-"),
        ("a\x85b\u202ec\ud800", "a-b-c"),
        ("e\u0301", "é"),
        (" .-a-. ", "a"),
        ("a" * 79 + " b", "a" * 79),
        ("\U0001f9f1" * 90, "\U0001f9f1" * 50),
        ("..", "samples"),
    ],
)
def test_names_of_collections_are_those_of_files_everywhere(tmp_path, text, name):
    assert library_files.collection_name(text) == name
    assert library_files.collection_name(name) == name
    (entry,) = library.add([sample("a")], name, tmp_path).ids
    assert same(library.load(entry, tmp_path), sample("a"))


def test_collections_that_differ_in_capitals_lose_nothing_to_each_other(tmp_path):
    many = {"Walls": [sample("a")], "walls": [sample("b", 0.5)], "WALLS": [sample("a")]}
    added = library.add_all(many, tmp_path)
    assert [each.ids for each in added] == [("Walls/a",), ("Walls/b",), ("Walls/a",)]
    assert set(files(tmp_path)) == {"Walls.json"}
    library.add_all({"walls": [sample("c", 0.6)], "Walls": [sample("d", 0.7)]}, tmp_path)
    assert [entry.name for entry in own(tmp_path)] == ["a", "b", "c", "d"]


@pytest.mark.parametrize("name", ["ColorChecker", "colorchecker", "EVERYDAY"])
def test_a_collection_called_as_one_of_presets_gets_a_number_and_is_found(tmp_path, name):
    for _ in range(2):  # the second time all of them are there
        added = library.add([sample("a"), sample("b", 0.5)], name, tmp_path)
        assert added.ids == (f"{name} 2/a", f"{name} 2/b")
        assert (added.wanted, added.collection) == (name, f"{name} 2")
        said = importing.summary([added])
        assert f"collection {name!r} is called '{name} 2' there, as presets have its name" in said
    assert added.present == ("a", "b")
    assert [entry.name for entry in own(tmp_path)] == ["a", "b"]
    assert [entry.id for entry in library.search(f"{name} 2/a", tmp_path)] == [f"{name} 2/a"]
    assert same(library.load(f"{name} 2/b", tmp_path), sample("b", 0.5))
    assert library.contents(tmp_path).faults == ()
    library.remove([f"{name} 2/a"], tmp_path)
    assert [entry.name for entry in own(tmp_path)] == ["b"]


def test_a_collection_called_as_a_folder_of_presets_gets_a_number(tmp_path):
    shutil.copytree(presets.folder() / "colorchecker", tmp_path / "mine")
    added = library.add([sample("01 dark skin")], "Mine", tmp_path)
    assert added.ids == ("Mine 2/01-dark-skin",)
    assert same(library.load("Mine 2/01-dark-skin", tmp_path), sample("01 dark skin"))
    assert library.contents(tmp_path).faults == ()


def test_a_collection_is_the_same_in_capitals(tmp_path):
    library.add([sample("a")], "Walls", tmp_path)
    assert library.add([sample("b")], "walls", tmp_path).ids == ("Walls/b",)
    assert set(files(tmp_path)) == {"Walls.json"}


def test_a_linked_file_stays_a_link(tmp_path):
    folder, elsewhere = tmp_path / "library", tmp_path / "repository.json"
    library.add([sample("a")], "mine", folder)
    shutil.move(folder / "mine.json", elsewhere)
    (folder / "mine.json").symlink_to(elsewhere)
    library.add([sample("b")], "mine", folder)
    assert (folder / "mine.json").is_symlink()
    assert [found.name for found in readers.read(elsewhere)] == ["a", "b"]


def test_an_absent_folder_is_an_empty_library_and_is_not_made(tmp_path):
    absent = tmp_path / "none"
    assert len(library.entries(absent)) == len(presets.names())
    assert library.contents(absent).faults == ()
    assert library.load("green", absent).name == "ColorChecker 14 Green"
    assert not absent.exists()


def test_load_takes_ids_names_and_presets_and_says_what_else_there_is(tmp_path):
    library.add([sample("Screed"), sample("Green")], "one", tmp_path)
    assert library.load("one/screed", tmp_path).name == "Screed"
    assert library.load("Screed", tmp_path).name == "Screed"
    assert library.load("14", tmp_path).name == "ColorChecker 14 Green"
    # What a mapping file means does not change with the library.
    assert library.load("Green", tmp_path).name == "ColorChecker 14 Green"
    assert library.load("one/green", tmp_path).name == "Green"
    library.add([sample("Screed", 0.6)], "two", tmp_path)
    with pytest.raises(InputError, match=r"could be any of one/screed, two/screed"):
        library.load("Screed", tmp_path)
    with pytest.raises(InputError, match=r"no preset 'Marble'.*nor has the library"):
        library.load("Marble", tmp_path)


def test_search_finds_every_word_in_name_collection_or_source(tmp_path):
    library.add([sample("Rough Plaster", source="Site 7"), sample("Brick")], "walls", tmp_path)
    ids = lambda text: [entry.id for entry in library.search(text, tmp_path)]  # noqa: E731
    assert ids("plaster ROUGH") == ["walls/rough-plaster"]
    assert ids("site walls") == ["walls/rough-plaster"]
    assert ids("14 green") == ["colorchecker/14-green"]
    assert ids("") == [entry.id for entry in library.entries(tmp_path)]
    assert ids("plaster brick") == []


def test_nearest_agrees_with_one_by_one(tmp_path):
    infrared = Sample("infrared", NM + 1000, np.full(NM.size, 0.3), "reading")
    library.add([infrared, *(sample(f"{i}", 0.05 + 0.02 * i) for i in range(40))], "m", tmp_path)
    rgb = (0.3, 0.5, 0.2)
    found = library.nearest(swatches.to_lab(rgb), 5, tmp_path)
    white = tristimulus.white("D65", 2)
    linear = np.where(np.array(rgb) > 0.04045, ((np.array(rgb) + 0.055) / 1.055) ** 2.4, 0)
    # IEC 61966-2-1, scaled to the white of the spectra
    matrix = np.array(
        [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    )
    lab = color_difference.xyz_to_lab((matrix @ linear) / matrix.sum(axis=1) * white, white)
    expected = sorted(
        (
            float(
                color_difference.delta_e(
                    tristimulus.spectrum_to_lab(s.reflectance, s.wavelengths), lab
                )
            )
        )
        for s in (library.load(e.id, tmp_path) for e in library.entries(tmp_path))
        if s.wavelengths[0] < 700
    )
    assert [difference for _, difference in found] == pytest.approx(expected[:5], abs=0.02)
    assert all(entry.name != "infrared" for entry, _ in library.nearest(lab, 999, tmp_path))
    assert next(e for e in own(tmp_path) if e.name == "infrared").swatch is None


def test_swatches_of_known_colors():
    white, black = (Sample(n, NM, np.full(NM.size, v), "albedo") for n, v in (("w", 1), ("b", 0)))
    rgb, lab = swatches.of_samples([white, black])
    assert rgb[0] == pytest.approx([1, 1, 1], abs=1e-3)
    assert rgb[1] == pytest.approx([0, 0, 0], abs=1e-6)
    assert lab[0] == pytest.approx([100, 0, 0], abs=1e-6)
    # The published sRGB of ColorChecker 14 Green (BabelColor, 2012) is 70 148 73; ΔE00 below 3.
    green = presets.load("14")
    assert (
        color_difference.delta_e(
            swatches.of_samples([green])[1][0], swatches.to_lab(np.array([70, 148, 73]) / 255)
        )
        < 3
    )


def test_asking_again_costs_no_reading_and_a_change_is_seen(tmp_path):
    library.add([sample(f"{i}", i / 2000) for i in range(1000)], "mine", tmp_path)
    assert library.cached(tmp_path) is None
    first = library.contents(tmp_path)
    assert library.search("77", tmp_path)
    assert library.contents(tmp_path) is first
    assert library.cached(tmp_path) is first
    library.add([sample("new", 0.9)], "mine", tmp_path)
    assert library.cached(tmp_path) is None
    assert len(own(tmp_path)) == 1001


def child(folder, lines):
    """Start a Python of its own with the extension's modules, and `add(name, level)`."""
    code = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
from tools.run.run_command_line import load_extension
load_extension()
import os, signal
from pathlib import Path
import numpy as np
from rough_spectra.addon.samples import library
from rough_spectra.addon.support import atomic_files as outputs
from rough_spectra.addon.samples.sample import Sample
NM = np.arange(400.0, 701.0, 10.0)
folder = Path({str(folder)!r})
def add(name, level):
    library.add([Sample(name, NM, np.full(NM.size, level), "reading")], "mine", folder)
"""
    return subprocess.Popen(
        [sys.executable, "-c", code + textwrap.dedent(lines)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
    )


def test_two_processes_that_add_at_once_lose_nothing(tmp_path):
    work = """
        for i in range(25):
            add(f"{who} {i}", 0.2 + i / 100)
    """
    both = [child(tmp_path, f"who = {who!r}\n{textwrap.dedent(work)}") for who in "AB"]
    for process in both:
        assert process.wait(SECONDS) == 0, process.stderr.read()
        process.stderr.close()
        process.stdout.close()
    names = [found.name for found in readers.read(tmp_path / "mine.json")]
    assert sorted(names) == sorted(f"{who} {i}" for who in "AB" for i in range(25))
    assert set(files(tmp_path)) == {"mine.json"}


@pytest.mark.parametrize("moment", ["write", "_finish"])
def test_a_killed_process_leaves_the_old_file_and_no_lock(tmp_path, moment):
    library.add([sample("before")], "mine", tmp_path)
    old = (tmp_path / "mine.json").read_bytes()
    process = child(
        tmp_path,
        f"""
        real = outputs.AtomicFiles.{moment}
        def die(*arguments):
            if {moment!r} == "write":
                real(*arguments)
            os.kill(os.getpid(), signal.SIGKILL)
        outputs.AtomicFiles.{moment} = die
        add("lost", 0.3)
        """,
    )
    assert process.wait(SECONDS) == -signal.SIGKILL
    process.stderr.close()
    process.stdout.close()
    assert (tmp_path / "mine.json").read_bytes() == old
    assert any(name.endswith(".part") for name in files(tmp_path))
    assert [entry.name for entry in own(tmp_path)] == ["before"]
    library.add([sample("after", 0.5)], "mine", tmp_path)  # neither waits nor trips over it
    assert [entry.name for entry in own(tmp_path)] == ["before", "after"]
    assert set(files(tmp_path)) == {"mine.json"}


def test_a_lock_that_another_keeps_is_a_sentence_and_not_a_hang(tmp_path):
    from rough_spectra.addon.support import file_lock

    refused = pytest.raises(OutputError, match="another program")
    with file_lock.locked(tmp_path), refused, file_lock.locked(tmp_path, 0.1):
        pass
    with file_lock.locked(tmp_path, 0.1):
        pass
    (tmp_path / "file").write_text("x", encoding="utf-8")
    with pytest.raises(OutputError, match="cannot be written"):
        library.add([sample("a")], "mine", tmp_path / "file")


def test_adding_takes_time_in_proportion(tmp_path):
    values = np.random.default_rng(1).uniform(0.1, 0.6, (5_000, NM.size))
    many = [Sample(f"patch {i // 2}", NM, row, "reading") for i, row in enumerate(values)]
    seconds = []
    for count in (100, 500, 5_000):  # the first imports
        start = time.process_time()
        assert len(library.add(many[:count], f"of {count}", tmp_path).names) == count
        seconds.append(time.process_time() - start)
    print(f"added in {seconds[-1]:.2f} s")
    assert seconds[2] < 25 * seconds[1]  # seen: 10; quadratic would be 100


def test_what_has_no_color_is_kept_found_and_told(tmp_path):
    nm = np.linspace(8000.0, 14000.0, NM.size)
    warm = Sample("Warm sand", nm, np.linspace(0.8, 1.002, NM.size), "emissivity", "emissivity")
    dark = Sample("Infrared felt", nm, np.linspace(0.1, 0.2, NM.size), "reading")
    library.add([warm, dark, sample("Seen")], "mixed", tmp_path)
    for each in (warm, dark):
        [entry] = library.search(each.name, tmp_path)
        assert same(library.load(entry.id, tmp_path), each)
        assert (entry.swatch, entry.lab, entry.kind) == (None, None, each.kind)
        assert any("has no color" in sentence for sentence in entry.warnings)
    near = [entry.name for entry, _ in library.nearest((50, 0, 0), 1000, tmp_path)]
    assert "Seen" in near
    assert not {"Warm sand", "Infrared felt"} & set(near)
