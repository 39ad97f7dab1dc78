# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure our methods, and judge theirs and the peers' answers against what is true.

    python -m tools.chart.chart_measure work FOLDER       makes the work and what is true of it
    python -m tools.chart.chart_measure methods FOLDER    times our methods, judges all

Runs where colour-science is. Peers answer in between, each in an environment of its own.
"""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np

from tools.chart import chart_lobes, chart_matched, chart_truths
from tools.chart.chart_judge import Judge, all_at_once, integrated, one_by_one
from tools.chart.chart_methods import Method, methods
from tools.chart.chart_timing import in_turns, spread
from tools.chart.chart_work import (
    PEER_TRUTHS,
    SIGMAS,
    TIMED_GEOMETRIES,
    TIMED_PATCH,
    TIMED_SIGMA,
    Array,
    Truth,
    Work,
    read_json,
    summary,
    timed_angles,
    write_json,
)

SECONDS = 25.0
"""Given to the timing of each panel."""

EVERY = 10
"""Of the geometries one in ten is solved again with twice the nodes of every kind, and converted
by sd_to_XYZ."""

SAME_COLOR = 0.05
"""ΔE00 up to which the slow conversion counts as giving the same colors."""

LADDER = ("lambert", "first-order", "two-bounce", "closure", "reference", "surface")
"""Of these the table holds errors against every surface."""

HALF_NORMAL = float(np.sqrt(2 / np.pi))
"""Mean of |x| over that of x² under the root, for noise."""

VERSIONS = {"sd-to-xyz": f"colour-science {metadata.version('colour-science')}"}


def answer_angles(method: Method, albedo: Array, truth: Truth, every: int = 1) -> Array:
    """Ask a method at the angles: shape (sigmas, geometries, patches, bands or 3)."""
    assert method.angles is not None
    angles = truth.angles[:, ::every]
    return np.stack(
        [
            np.stack([method.angles(rho, angles, sigma) for rho in albedo], axis=1)
            for sigma in truth.sigmas
        ]
    )


def answer_reading(method: Method, albedo: Array, sigmas: Array) -> Array:
    """Ask a method at 45°/0°: shape (sigmas, patches, bands or 3)."""
    assert method.reading is not None
    return np.stack([method.reading(albedo, sigma) for sigma in sigmas])


def judge_all(judge: Judge, ours: dict[str, Method], work: Work) -> dict[str, dict[str, Any]]:
    """Errors of our methods by key and panel."""
    found: dict[str, dict[str, Any]] = {}
    for key, method in ours.items():
        found[key] = {}
        if key in ("reference", "sd-to-xyz", "lambert-as-read"):
            continue
        if method.angles is not None:
            for panel, truth in (("angles", work.cavity), ("traced", work.traced)):
                answer = answer_angles(method, work.albedo, truth)
                found[key][panel] = judge.errors(answer, truth.factor, method.ends_in)
        if method.reading is not None:
            answer = answer_reading(method, work.albedo, work.cavity.sigmas)
            found[key]["reading"] = judge.errors(answer, work.cavity.reading, method.ends_in)
    found["reference"] = judge_reference(judge, work)
    found["sd-to-xyz"] = judge_slow(judge, ours, work, found["two-bounce"])
    return found


def judge_reference(judge: Judge, work: Work) -> dict[str, Any]:
    """How far the reference is from itself with twice the nodes, and from the traces."""
    truth = work.cavity
    finer = chart_truths.cavity(
        work.albedo, truth.angles[:, ::EVERY], truth.sigmas, chart_truths.DOUBLE
    )
    solved = chart_truths.solve(work.albedo, work.traced.angles, work.traced.sigmas)
    return {
        "angles": judge.errors(truth.factor[:, ::EVERY], finer.factor),
        "traced": judge.errors(solved, work.traced.factor),
        "reading": judge.errors(truth.reading, finer.reading),
    }


def judge_slow(
    judge: Judge, ours: dict[str, Method], work: Work, same: dict[str, Any]
) -> dict[str, Any]:
    """Errors of sd_to_XYZ: those of two-bounce, once a part has shown that the colors are equal."""
    apart = judge.delta_e(
        answer_angles(ours["sd-to-xyz"], work.albedo, work.cavity, 4 * EVERY),
        answer_angles(ours["two-bounce"], work.albedo, work.cavity, 4 * EVERY),
        "XYZ",
    )
    if apart.max() > SAME_COLOR:
        raise AssertionError(f"sd_to_XYZ gives other colors, by up to ΔE00 {apart.max():.3f}.")
    return {panel: {**errors, "relative": None} for panel, errors in same.items()}


def judge_truths(judge: Judge, ours: dict[str, Method], work: Work) -> dict[str, Any]:
    """Mean ΔE00 of every model against every surface, by σ, and the traces' own noise.

    Returns
    -------
    "surfaces" with kind and σ of each column; "models" with a row each, one pair a column: over all
    angles, and at 45°/0°; "noise" with the same of what the traces are uncertain by.
    """
    kinds = {
        "V-cavity": work.cavity,
        **{kind: chart_truths.traced(work.albedo, kind) for kind in chart_truths.TRACED},
    }
    columns = [(kind, s, truth) for kind, truth in kinds.items() for s in range(truth.sigmas.size)]

    def means(angles: Array, ring: Array, truth: Truth) -> list[float]:
        return [
            float(judge.delta_e(angles, truth.factor[0]).mean()),
            float(judge.delta_e(ring, truth.reading[0]).mean()),
        ]

    rows: dict[str, list[list[float]]] = {key: [] for key in LADDER}
    noise = []
    for kind, s, whole in columns:
        truth = Truth(whole.sigmas[[s]], whole.angles, whole.factor[[s]], whole.reading[[s]])
        for key in LADDER:
            if key == "reference":
                solved = chart_truths.cavity(work.albedo, truth.angles, truth.sigmas)
                angles, ring = solved.factor[0], solved.reading[0]
            else:
                angles = answer_angles(ours[key], work.albedo, truth)[0]
                ring = answer_reading(ours[key], work.albedo, truth.sigmas)[0]
            rows[key].append(means(angles, ring, truth))
        if kind == "V-cavity":
            noise.append([0.0, 0.0])
            continue
        raised = chart_truths.traced(work.albedo, kind, raised=1.0)
        found = means(raised.factor[s], raised.reading[s], truth)
        noise.append([HALF_NORMAL * value for value in found])
    surfaces = [[kind, round(float(np.degrees(truth.sigmas[s])))] for kind, s, truth in columns]
    return {"surfaces": surfaces, "models": rows, "noise": noise}


def time_all(ours: dict[str, Method], work: Work) -> tuple[dict[str, dict[str, Any]], float]:
    """Nanoseconds a spectrum and geometry, float32, by key and kind of cost, and of a copy.

    Of each the shortest, the median and the upper quartile of its turns.
    """
    sigma = float(SIGMAS[TIMED_SIGMA])
    albedo = work.albedo.astype(np.float32)
    angles = timed_angles()
    many = np.tile(albedo, (TIMED_GEOMETRIES // len(albedo) + 1, 1))[:TIMED_GEOMETRIES]
    copied = np.copy(many)
    runs: dict[str, dict[str, tuple[int, Callable[[], object]]]] = {"angles": {}, "reading": {}}
    for key, method in ours.items():
        count = method.timed or TIMED_GEOMETRIES
        if method.angles is not None:
            part = np.ascontiguousarray(angles[:, :count])
            work_item = functools.partial(method.angles, albedo[TIMED_PATCH], part, sigma)
            runs["angles"][key] = (count, work_item)
        if method.reading is not None:
            count = TIMED_GEOMETRIES if key == "reference" else count
            runs["reading"][key] = (count, functools.partial(method.reading, many[:count], sigma))
    for key in chart_lobes.LOBES:
        evaluate = functools.partial(chart_matched.timed(key), albedo[TIMED_PATCH], angles, sigma)
        runs["angles"][f"{key}-matched"] = (TIMED_GEOMETRIES, evaluate)
    found: dict[str, dict[str, Any]] = {}
    copies = []
    for panel, of_panel in runs.items():
        works = {key: run for key, (_, run) in of_panel.items()}
        times = in_turns({**works, "copy": copied.copy}, SECONDS)
        copies.append(min(times["copy"]) / TIMED_GEOMETRIES * 1e9)
        for key, (count, _) in of_panel.items():
            found.setdefault(key, {})[panel] = [
                seconds / count * 1e9 for seconds in spread(times[key])
            ]
    return found, min(copies)


def time_conversions(judge: Judge, work: Work) -> list[dict[str, Any]]:
    """Spectra to XYZ, four ways: nanoseconds a spectrum, and how far from the matrix."""
    spectra = np.tile(work.albedo, (TIMED_GEOMETRIES // 24 + 1, 1))[:TIMED_GEOMETRIES]
    matrix = judge.to_xyz
    ways: dict[str, tuple[int, Callable[[Array], Array]]] = {
        "matrix": (TIMED_GEOMETRIES, lambda some: some @ matrix),
        "msds_to_XYZ, integration": (4096, integrated),
        "msds_to_XYZ, ASTM E308": (240, all_at_once),
        "sd_to_XYZ": (24, one_by_one),
    }
    works: dict[str, Callable[[], object]] = {
        key: functools.partial(way, spectra[:count]) for key, (count, way) in ways.items()
    }
    times = in_turns({**works, "copy": spectra.copy}, SECONDS / 5)
    copy = min(times["copy"]) / TIMED_GEOMETRIES
    rows = []
    for key, (count, way) in ways.items():
        found, plain = way(work.albedo), work.albedo @ matrix
        cost = min(times[key]) / count
        row = {"key": key, "ns": cost * 1e9, "ratio": cost / copy}
        row["apart"] = float(np.abs(found - plain).max())
        row["delta_e"] = summary(judge.delta_e(found, work.albedo, "XYZ"))
        rows.append(row)
    return rows


def own_rows(
    ours: dict[str, Method], errors: dict[str, dict[str, Any]], costs: dict[str, dict[str, Any]]
) -> list[dict[str, Any]]:
    """Rows of the methods that get albedo and roughness."""
    rows = []
    for key, method in ours.items():
        row: dict[str, Any] = {"key": key, "label": method.label, "group": method.group}
        row |= {"about": method.about, "ends_in": method.ends_in, "overhead": method.overhead}
        row |= {"version": VERSIONS.get(key, f"numpy {np.__version__}"), "threads": 1}
        rows.append(row | {"errors": errors[key], "cost": costs[key]})
    return rows


def matched_rows(
    judge: Judge, work: Work, costs: dict[str, dict[str, Any]], peers: list[dict[str, Any]]
) -> list[dict[str, Any]]:
    """Rows of those that get a reading: models, lobes, and the peers that have answered."""
    truths = {panel: getattr(work, name) for name, panel in PEER_TRUTHS.items()}
    found = {panel: chart_matched.answers(judge, truth) for panel, truth in truths.items()}
    rows = []
    for key in found["traced"]:
        degrees = [round(float(sigma)) for sigma in np.degrees(work.traced.sigmas)]
        row: dict[str, Any] = {"key": key, "overhead": "", "matched": True, "threads": 1}
        row |= {"version": f"numpy {np.__version__}", "ends_in": found["traced"][key].ends_in}
        row |= chart_matched.about(key, found["traced"], degrees)
        timed = key if key in costs else key.removesuffix("-matched")
        row["cost"] = {"angles": costs[timed]["angles"]}
        row["errors"] = {
            panel: judge.errors(of[key].factor, truths[panel].factor, of[key].ends_in)
            for panel, of in found.items()
        }
        rows.append(row)
    for peer in peers:
        if "missing" not in peer:
            with np.load(peer.pop("answers")) as stored:
                peer["errors"] = {
                    panel: judge.errors(stored[name], truths[panel].factor)
                    for name, panel in PEER_TRUTHS.items()
                }
        rows.append(peer)
    return rows


def measure(folder: Path) -> None:
    """Time and judge everything that has answered, into measured.json."""
    work, judge = Work.load(folder / "work.npz"), Judge()
    ours = methods(judge.to_rgb, one_by_one)
    costs, copy = time_all(ours, work)
    peers: list[dict[str, Any]] = []
    for path in sorted(folder.glob("peer-*.json")):
        peers.append(read_json(path) | {"answers": path.with_suffix(".npz"), "matched": True})
    as_read = ours.pop("lambert-as-read")
    assert as_read.angles is not None
    rows = own_rows(ours, judge_all(judge, ours, work), costs)
    rows += matched_rows(judge, work, costs, peers)
    for row in rows:
        row.pop("answers", None)
        row["ratio"] = {
            kind: [value / copy for value in values] for kind, values in row.get("cost", {}).items()
        }
    write_json(folder / "measured.json", rows)
    write_json(folder / "truths.json", judge_truths(judge, ours, work))
    write_json(folder / "conversions.json", time_conversions(judge, work))


def make_work(folder: Path) -> None:
    """Find out what is true."""
    chart_truths.make_work().save(folder / "work.npz")


if __name__ == "__main__":
    {"work": make_work, "methods": measure}[sys.argv[1]](Path(sys.argv[2]))
