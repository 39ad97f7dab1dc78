# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of docs/instruments.md are what this code computes, and the instruments there are."""

import csv

import pytest

from tools.manual import instruments_table as table

AGAIN = "The page is out of date: run python3 -m tools.manual.instruments_table"


def test_table_and_data_are_those_of_this_code():
    found = table.rows()
    with table.DATA.open(encoding="utf-8", newline="") as file:
        next(file)
        kept = list(csv.DictReader(file))
    assert len(kept) == len(found), AGAIN
    for before, now in zip(kept, found, strict=True):
        assert before["instrument"] == now["instrument"], AGAIN
        for name in ("mean_lightness", "mean", "maximum"):
            # The last digit may round either way on another machine.
            assert float(before[name]) == pytest.approx(now[name], abs=2e-3), AGAIN
    page = table.PAGE.read_text("utf-8")
    assert table.fill(page, table.markdown(kept_as_numbers(kept))) == page, AGAIN
    assert table.fill(page, table.described(), table.WHICH) == page, AGAIN


def kept_as_numbers(kept):
    numbers = ("mean_lightness", "mean", "maximum")
    return [row | {name: float(row[name]) for name in numbers} for row in kept]
