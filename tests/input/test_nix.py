# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nix exports: six real files, and what can be wrong with one."""

import csv
from pathlib import Path

import pytest
from rough_spectra.addon.samples import readers

from tests.input.refused import refusal

FOLDER = Path(__file__).resolve().parents[1] / "fixtures" / "nix"
FILES = sorted(FOLDER.glob("*.csv"))
BRICK = (FOLDER / "brick.csv").read_text()


def write(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "export.csv"
    path.write_bytes(text.encode(encoding))
    return path


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_everything_equals_the_file(path):
    with path.open(newline="") as file:
        header, row = list(csv.reader(file, delimiter=";"))[3:5]
    columns = {}
    for label, text in zip(header, row, strict=True):
        columns.setdefault(label, text)
    bands = [label for label in header if label.endswith(" nm")]
    (sample,) = readers.read(path)
    assert sample.wavelengths.tolist() == [float(label[1:-3]) for label in bands]
    assert sample.values.tolist() == [float(columns[label]) for label in bands]
    assert sample.name == columns["User Color Name"].strip()
    assert sample.lab == tuple(float(columns[label]) for label in ("L", "a", "b"))
    assert sample.xyz == tuple(float(columns[label]) for label in ("X", "Y", "Z"))
    assert sample.illuminant == columns["Illuminant"]
    assert sample.observer == int(columns["Observer"])
    assert sample.condition == columns["Measurement Mode"]
    assert sample.device == "Nix Spectro 2"
    assert (sample.kind, sample.instrument, sample.sigma_degrees) == ("reading", "45a:0", None)
    assert (sample.source, sample.position) == (str(path), "line 5")


def test_numbers_picked_by_hand():
    assert len(FILES) == 6
    (brick,) = readers.read(FOLDER / "brick.csv")
    assert brick.values[0] == 0.0627012774
    assert brick.values[-1] == 0.293368677
    assert brick.lab == (42.8292362, 21.1443305, 19.6993482)  # not the L, c, h that follow
    assert (brick.illuminant, brick.observer, brick.condition) == ("D50", 2, "M1")
    (paper,) = readers.read(FOLDER / "office-paper.csv")
    assert paper.name == "Office Paper"
    assert (paper.illuminant, paper.observer, paper.condition) == ("D65", 10, "M2")


def test_several_rows_keep_their_order_and_lines(tmp_path):
    rows = [path.read_text().splitlines()[4] for path in FILES]
    top = BRICK.splitlines()[:4]
    path = write(tmp_path, "\r\n".join([*top, *rows[:3], "", *rows[3:]]) + "\r\n")
    samples = readers.read(path)
    assert [sample.name for sample in samples] == [readers.read(f)[0].name for f in FILES]
    assert [sample.position for sample in samples] == [f"line {n}" for n in (5, 6, 7, 9, 10, 11)]


def test_lines_are_counted_as_an_editor_counts_them(tmp_path):
    row = BRICK.splitlines()[4].replace('"-";Fri', '"two\nlines";Fri')
    samples = readers.read(write(tmp_path, BRICK + row + "\n" + row))
    assert [sample.position for sample in samples] == ["line 5", "line 6", "line 8"]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_encodings_and_line_ends_change_nothing(tmp_path, encoding, newline):
    text = BRICK.replace('"Brick"', '"Brück; alt"').replace("\n", newline)
    (sample,) = readers.read(write(tmp_path, text, encoding))
    assert sample.name == "Brück; alt"
    assert sample.values[0] == 0.0627012774


def test_a_spreadsheet_that_took_the_first_line_does_no_harm(tmp_path):
    (sample,) = readers.read(write(tmp_path, BRICK.removeprefix("sep=;\n")))
    assert sample.position == "line 4"
    assert sample.values[0] == 0.0627012774


def test_a_name_is_found_where_the_user_gave_none(tmp_path):
    (sample,) = readers.read(write(tmp_path, BRICK.replace('"-";"Brick"', '"RAL 3016";"-"')))
    assert sample.name == "RAL 3016"
    (sample,) = readers.read(write(tmp_path, BRICK.replace('"Brick"', '"-"')))
    assert sample.name == "export 1"


def test_a_color_the_device_did_not_state_is_none(tmp_path):
    text = BRICK.replace("4.28292362e+1;2.11443305e+1", "-;2.11443305e+1").replace(
        ";D50;2;", ";-;-;"
    )
    (sample,) = readers.read(write(tmp_path, text))
    assert sample.lab is None
    assert (sample.illuminant, sample.observer) == ("", None)
    assert sample.xyz == (0.159930183, 0.13043846, 0.0563151029)


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ("6.22216538e-2", "-", ["line 5", "'R410 nm'", "'-'", "missing"]),
        ("6.22216538e-2", "", ["line 5", "'R410 nm'", "missing"]),
        ("6.22216538e-2", "NaN", ["line 5", "column 'R410 nm'", "410 nm", "NaN"]),
        ("6.22216538e-2", "-6.22216538e-2", ["line 5", "'R410 nm'", "below 0"]),
        ("6.22216538e-2", "6.22216538", ["line 5", "'R410 nm'", "times white"]),
        ("6.22216538e-2", "6_2", ["line 5", "'R410 nm'", "'6_2'", "not a number"]),
        (";2.85290043e-1;2.93368677e-1", "", ["line 5", "before column 'R690 nm'", "62 of 64"]),
        ("2.93368677e-1", "2.93368677e-1;7", ["line 5", "65 columns", "64"]),
        ("R420 nm", "R410 nm", ["410 nm stands twice", "'R410 nm'"]),
        ("R420 nm", "R405 nm", ["405 nm at column 'R405 nm' follows 410 nm"]),
        ("4.28292362e+1;2.1", "high;2.1", ["line 5", "'L'", "'high'", "not a number"]),
        ("sep=;", "sep=,", ["line 4", "separated by commas", "by semicolons"]),
    ],
)
def test_each_fault_is_named_with_its_place(tmp_path, old, new, parts):
    assert old in BRICK
    sentence = refusal(write(tmp_path, BRICK.replace(old, new, 1)))
    for part in parts:
        assert part in sentence


def test_another_delimiter_than_announced(tmp_path):
    top, body = BRICK.split("\n", 1)
    sentence = refusal(write(tmp_path, top + "\n" + body.replace(";", "\t")))
    assert "should be separated by semicolons but are by tabs" in sentence


def test_a_header_that_is_commented_out_is_none(tmp_path):
    top = BRICK.splitlines()[:4]
    assert "no wavelengths found" in refusal(write(tmp_path, "\n".join([*top[:3], "#" + top[3]])))


def test_no_spectrum_and_no_sample(tmp_path):
    lines = BRICK.splitlines()
    short = "\n".join([*lines[:3], *(";".join(line.split(";")[:33]) for line in lines[3:])])
    assert "export the spectral data" in refusal(write(tmp_path, short))
    assert "holds no sample" in refusal(write(tmp_path, "\n".join(lines[:4])))
