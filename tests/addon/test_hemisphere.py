# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Away from 45°/0°: 500 rendered geometries, and the table of them that the manual shows."""

import csv
from dataclasses import replace

import pytest

from tools import hemisphere_table

LIMIT = 0.6
"""Mean ΔE00 that the project promises for each σ up to 45°."""


@pytest.fixture(scope="module")
def rows(extension):
    return hemisphere_table.compute()


def test_mean_color_difference_stays_within_the_promise(rows):
    rough = [row for row in rows if row.material.startswith("Diffuse")]
    assert [row.sigma_degrees for row in rough] == [15, 30, 45] * 2
    assert [row.truth for row in rough] == ["two-bounce"] * 3 + ["reference"] * 3
    for row in rough:
        # Cyan lies outside Rec.709; so does yellow where all bounces count.
        assert row.patches >= 22
        assert row.geometries == 500
        assert row.mean <= LIMIT


def test_matched_material_beats_the_lambertian_one_by_far(rows):
    by_sigma = {}
    for row in rows:
        by_sigma.setdefault((row.sigma_degrees, row.truth), []).append(row)
    for rough, lambert in by_sigma.values():
        # 2.8 to 9 times in the mean, and better in the worst case too.
        assert rough.mean < lambert.mean / 2
        assert rough.percentile_95 < lambert.percentile_95 / 2
        assert rough.maximum < lambert.maximum


def test_the_manual_shows_these_numbers(rows):
    lines = hemisphere_table.DATA.read_text(encoding="utf-8").splitlines()
    printed = list(csv.DictReader(line for line in lines if line[0] != "#"))
    recorded = []
    for row, shown in zip(rows, printed, strict=True):
        assert shown["material"] == row.material
        for column in ("mean", "percentile_95", "maximum"):
            # Both LTS versions agree to 1e-4; the table prints two digits.
            assert float(shown[column]) == pytest.approx(getattr(row, column), abs=5e-3)
        columns = ("mean", "percentile_95", "maximum")
        recorded.append(replace(row, **{column: float(shown[column]) for column in columns}))
    assert hemisphere_table.TABLE.read_text(encoding="utf-8") == hemisphere_table.markdown(recorded)
