# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The chart's own arithmetic: its front, its errors, its page. Nothing here measures time."""

import csv
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import oren_nayar, reading
from tools.chart import (
    chart,
    chart_figures,
    chart_methods,
    chart_tables,
    chart_timing,
    chart_truths,
    chart_work,
)
from tools.tables import traces

SIGMA = float(np.radians(30))


def beats(one, other):
    return one[0] <= other[0] and one[1] <= other[1] and one != other


@given(st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), max_size=30))
def test_the_front_is_all_that_nothing_beats(points):
    front = [points[index] for index in chart_work.pareto_front(points)]
    assert front == sorted({p for p in points if not any(beats(q, p) for q in points)})


def test_costs_within_the_noise_are_not_told_apart():
    points = [(1.0, 3.0), (1.1, 1.0), (2.0, 2.0), (9.0, 1.0)]
    assert chart_work.pareto_front(points) == [0, 1]
    assert chart_work.pareto_front(points, noise=0.15) == [1]


def test_the_first_of_equal_points_is_on_the_front():
    assert chart_work.pareto_front([(2, 2), (1, 1), (1, 1)]) == [1]


def test_summary_is_mean_percentile_and_maximum():
    assert chart_work.summary(np.arange(101.0)) == [50, 95, 100]


def test_relative_error_counts_both_signs():
    found = chart_work.relative_error(np.array([0.9, 1.1]), np.array([1.0, 1.0]))
    assert found == pytest.approx([0.1, 0.1, 0.1])


def test_the_work_survives_its_file(tmp_path):
    rng = np.random.default_rng(0)
    truths = [chart_work.Truth(*(rng.random((2, 3)) for _ in range(4))) for _ in range(2)]
    work = chart_work.Work(rng.random((2, 3)), *truths)
    work.save(tmp_path / "work.npz")
    again = chart_work.Work.load(tmp_path / "work.npz")
    np.testing.assert_array_equal(again.albedo, work.albedo)
    for name in chart_work.PEER_TRUTHS:
        for part, values in vars(getattr(work, name)).items():
            np.testing.assert_array_equal(getattr(getattr(again, name), part), values)


def test_the_albedos_are_the_presets():
    albedo = chart_work.colorchecker()
    assert albedo.shape == (24, chart_work.BANDS.size)
    green = json.loads((chart_work.PRESETS / "14-green.json").read_text(encoding="utf-8"))
    place = green["wavelengths"].index(550)
    assert albedo[chart_work.TIMED_PATCH, 15] == green["values"][place]


def test_slow_works_leave_turns_to_quick_ones(monkeypatch):
    now, calls = [0.0], {"slow": 0, "quick": 0}
    monkeypatch.setattr(chart_timing.time, "perf_counter", lambda: now[0])

    def take(name, seconds):
        calls[name] += 1
        now[0] += seconds

    works = {"slow": lambda: take("slow", 2.0), "quick": lambda: take("quick", 0.01)}
    shortest = chart_timing.best_of_turns(works, seconds=10.0, most=50)
    # Once to warm up, then until its share of 5 s is spent.
    assert calls == {"slow": 4, "quick": 51}
    assert shortest == pytest.approx({"slow": 2.0, "quick": 0.01})


def test_every_turn_runs_everything():
    calls = []
    works = {name: lambda name=name: calls.append(name) for name in "ab"}
    shortest = chart_timing.best_of_turns(works, seconds=0)
    # Once to warm up, then the fewest turns.
    assert calls == ["a", "b"] * 4
    assert all(0 <= seconds < 1 for seconds in shortest.values())


@pytest.fixture(scope="module")
def ours():
    matrix = np.random.default_rng(1).random((chart_work.BANDS.size, 3))
    return chart_methods.methods(matrix, lambda spectra: spectra @ matrix), matrix


def angles():
    return np.array([[0.2, 0.9, 1.2], [0.4, 0.9, 0.3], [0.0, 2.0, 3.0]])


def test_variants_that_only_cost_more_give_the_same_numbers(ours):
    methods, matrix = ours
    rho = chart_work.colorchecker()[13]
    exact = oren_nayar.reflectance(rho, *angles(), SIGMA)
    for key, wanted in (("band-loop", exact), ("two-colors", exact @ matrix)):
        np.testing.assert_allclose(methods[key].angles(rho, angles(), SIGMA), wanted, rtol=1e-12)
    wanted = reading.from_albedo(rho[None], SIGMA)
    for key, ring in (("band-loop", wanted), ("two-colors", wanted @ matrix)):
        np.testing.assert_allclose(methods[key].reading(rho[None], SIGMA), ring, rtol=1e-12)


def test_methods_for_any_angle_agree_with_those_for_45_0(ours):
    methods, _ = ours
    rho = chart_work.colorchecker()
    ring = np.array(chart_work.RING)[:, np.newaxis]
    for key in ("lambert", "first-order", "two-bounce", "two-colors", "rgb-squared", "mixed-57",
                "geometric", "qualitative-57"):  # fmt: skip
        method = methods[key]
        at_ring = np.concatenate([method.angles(one, ring, SIGMA) for one in rho])
        np.testing.assert_allclose(at_ring, method.reading(rho, SIGMA), rtol=1e-12, err_msg=key)


def test_every_method_keeps_a_level_surface_as_it_is(ours):
    methods, _ = ours
    rho = chart_work.colorchecker()[13]
    for key, method in methods.items():
        if method.ends_in == "bands" and method.angles is not None:
            np.testing.assert_allclose(
                method.angles(rho, angles(), 0.0), np.tile(rho, (3, 1)), rtol=1e-12, err_msg=key
            )


def test_only_the_part_between_the_markers_is_replaced():
    page = f"before\n{chart_tables.BEGIN}\nold\n{chart_tables.END}\nafter\n"
    new = chart_tables.between_markers(page, "new")
    assert new == f"before\n{chart_tables.BEGIN}\n\nnew\n\n{chart_tables.END}\nafter\n"
    with pytest.raises(ValueError, match="needs the lines"):
        chart_tables.between_markers("no markers", "new")


def test_the_page_has_its_markers_and_its_figures():
    page = chart_tables.PAGE.read_text(encoding="utf-8")
    assert chart_tables.between_markers(page, "new") != page
    for name in (*(figure.name for figure in chart_figures.FIGURES), "blender"):
        assert f"images/chart-{name}.svg" in page
        assert (chart_tables.PAGE.parent / "images" / f"chart-{name}.svg").is_file()


@pytest.mark.parametrize("figure", chart_figures.FIGURES, ids=lambda figure: figure.name)
def test_a_figure_has_few_labels_and_all_its_methods_were_measured(figure):
    assert len(figure.keys) == len(set(figure.keys)) <= chart_figures.MOST
    known = {row["key"] for name in ("peers", figure.panel) for row in table(name)}
    assert set(figure.keys) <= known


def table(name):
    """Rows of one of the chart's files of data."""
    text = (chart_tables.DATA / f"chart-{name}.csv").read_text(encoding="utf-8")
    return list(csv.DictReader(text.splitlines()[1:]))


def cells(heading):
    """Rows of the page's table under a heading, without its head."""
    page = chart_tables.PAGE.read_text(encoding="utf-8")
    part = page.split(f"\n### {heading}\n")[1].split("\n#")[0]
    lines = [line for line in part.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


@pytest.mark.parametrize("panel", chart_work.PANELS)
def test_tables_of_the_page_say_what_the_data_says(panel):
    rows = cells(chart_tables.HEADINGS[panel])
    data = table(panel)
    assert len(rows) == len(data) >= 7
    for row, known in zip(rows, data, strict=True):
        assert row[0].strip("*").startswith(known["label"])
        wanted = [chart_tables._small(float(known[f"delta_e_{x}"])) for x in ("mean", "95", "max")]
        assert row[4:7] == wanted
        assert row[1] == chart_tables._rounded(float(known["ratio_to_copy"]))


def test_every_model_stands_beside_every_surface_as_in_the_data():
    data = table("truths")
    rows = cells("Every model, every surface")
    found = {row[0].strip("*"): row[1:] for row in rows}
    for model, pairs in found.items():
        known = [row for row in data if row["model"] == model]
        wanted = [
            " / ".join(
                chart_tables._small(float(row[f"delta_e_{what}"])) for what in ("any_angle", "45_0")
            )
            for row in known
        ]
        assert pairs == wanted
    assert {"lambert", "two-bounce", "closure", "reference", "surface"} < set(found)


def test_each_truth_is_closest_to_what_was_made_from_its_kind():
    mean = {}
    for row in table("truths"):
        of_kind = mean.setdefault(row["surface"], {})
        of_kind.setdefault(row["model"], []).append(float(row["delta_e_any_angle"]))
    assert max(mean["gaussian"]["surface"]) < 0.15 < min(mean["gaussian"]["closure"][1:])
    assert max(mean["V-cavity"]["closure"]) < 0.05 < max(mean["V-cavity"]["surface"])


def test_traces_are_a_truth_of_their_own():
    albedo = np.array([[0.2, 0.5, 0.95]])
    truth = chart_truths.traced(albedo, "gaussian")
    known = traces.load("gaussian", 30)
    at = [list(traces.ALBEDOS).index(rho) for rho in albedo[0]]
    np.testing.assert_allclose(truth.factor[1, :, 0], known.reflectance[1:, at], rtol=1e-6)
    np.testing.assert_allclose(truth.reading[1, 0], known.reflectance[0, at], rtol=1e-6)
    assert np.degrees(truth.sigmas).tolist() == pytest.approx([15, 30, 45])
    raised = chart_truths.traced(albedo, "gaussian", raised=1.0)
    added = raised.factor[1, :, 0] - truth.factor[1, :, 0]
    np.testing.assert_allclose(added, known.error[1:, at], rtol=1e-4)


def test_costs_come_with_their_spread():
    assert chart_timing.spread([3.0, 1.0, 2.0, 5.0, 4.0]) == [1.0, 3.0, 4.0]


def test_a_peer_without_environment_is_reported_and_not_invented(tmp_path, monkeypatch):
    monkeypatch.setattr(chart, "FOLDER", tmp_path)
    chart.run_peer("luxcore-roughmatte", None)
    row = chart_work.read_json(tmp_path / "peer-luxcore-roughmatte.json")
    assert "could not be set up" in row["missing"]
    assert "angles" not in row


def test_numbers_are_written_with_two_digits_and_no_exponent():
    assert [chart_tables._rounded(x) for x in (0.0123, 1.04, 45.6, 1234567)] == [
        "0.012",
        "1.0",
        "46",
        "1,200,000",
    ]
