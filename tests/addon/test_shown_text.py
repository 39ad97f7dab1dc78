# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of users and of files are shown by terminals and spreadsheets, and never carried out."""

import csv
import re
import unicodedata
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rough_spectra.addon.readings.document import (
    Predicted,
    Reading,
    Readings,
)
from rough_spectra.addon.readings.json_document import from_json, to_json
from rough_spectra.addon.readings.writers import cgats, tables
from rough_spectra.addon.samples import readers
from rough_spectra.addon.support import shown_text

ADDON = Path(__file__).resolve().parents[2] / "addon"
NAMES = [
    *("=1+1", "+1", "-1", "@SUM(A1)", "'quoted'", "'=1", " =1", "\t=1", "\uff1d1", "a=1"),
    *("\x1b[31mred\x1b[0m", "\x9b2J", "a\x7fb", "a\x85b", "line\nline", "cr\rcr", "a\u2028b"),
    *("a\u202eb", "C:\\x41\\n", "\\", "\\x1b", " # 2", "#1", 'say "so"', "a, b; c\td", "a  b "),
    *("\ud800", "Gr\u00fcn \u6f06 \U0001f9f1", "5.5"),
]


def readings(names):
    part = Predicted(
        *("reading", "closure", "", 0.0, "D65", 2, (400.0, 500.0, 600.0, 700.0)),
        *((0.1, 0.2, 0.3, 0.4), (1.0, 2.0, 3.0), (4.0, 5.0, -6.0), (0.1, 0.2, 0.3)),
    )
    entries = tuple(Reading(name, name, name, "", part, None, None, "", ()) for name in names)
    return Readings("a,=cmd()", "5.2", entries)


@settings(deadline=None)
@given(st.text() | st.sampled_from(NAMES))
def test_a_cell_gives_its_text_back_and_no_spreadsheet_takes_it_for_a_formula(text):
    cell = shown_text.to_cell(text)
    assert shown_text.from_cell(cell) == text
    assert cell.lstrip()[:1] not in {*"=+-@\t\r"}
    assert all(unicodedata.category(letter) not in ("Cc", "Cs", "Zl", "Zp") for letter in cell)


@pytest.mark.parametrize(
    "text", ["plain", "ColorChecker 20 Neutral 8 (.23 D)", "Gr\u00fcn \u6f06", ""]
)
def test_plain_names_stay_as_they_are(text):
    assert shown_text.to_cell(text) == text
    assert shown_text.printable(text) == text


@pytest.mark.parametrize("form", ["csv", "cgats"])
def test_names_in_tables_read_back(form, tmp_path):
    path = tmp_path / f"x.{form}"
    pieces = (tables if form == "csv" else cgats).predicted(readings(NAMES))
    path.write_bytes(b"".join(pieces))
    assert [sample.name for sample in readers.read(path)] == NAMES


def test_no_cell_of_a_table_is_a_formula(tmp_path):
    path = tmp_path / "x.csv"
    path.write_bytes(b"".join(tables.predicted(readings(NAMES))))
    with path.open(encoding="utf-8", newline="") as file:
        cells = [cell for row in csv.reader(file) for cell in row]
    assert len(cells) > 20 * len(NAMES) // 2
    for cell in cells:
        assert cell.lstrip()[:1] not in {*"=+@"}, cell
        assert not cell.startswith("-") or float(cell) < 0


def test_other_tables_keep_what_looks_like_an_escape(tmp_path):
    path = tmp_path / "x.csv"
    path.write_text("name,400,500,600,700\n'a\\x41,0.1,0.2,0.3,0.4\n", encoding="utf-8")
    assert readers.read(path)[0].name == "'a\\x41"


def test_names_in_the_document_read_back(tmp_path):
    path = tmp_path / "x.json"
    path.write_bytes(to_json(readings(NAMES)))
    assert from_json(path) == readings(NAMES)


def test_a_terminal_is_told_nothing_that_it_would_carry_out(capsys):
    shown_text.out("a\x1b]0;x\x07", "b\tc\u202e")
    shown_text.tell("one\r\x9b2Jtwo\n")
    told = capsys.readouterr()
    assert told.out == "a\\x1b]0;x\\x07\tb\\x09c\\u202e\n"
    assert told.err == "one\\x0d\\x9b2Jtwo\\x0a\n"


def test_nothing_else_prints():
    for path in ADDON.rglob("*.py"):
        if path.name != "shown_text.py":
            assert not re.search(r"(?<![\w.])print\(", path.read_text(encoding="utf-8")), path
