# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure our methods, and judge theirs and the peers' answers against the reference.

    python -m tools.chart.chart_measure work FOLDER       makes the work and the reference's answers
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

from core import vcavity
from core.numerics import direction_grid
from core.vcavity import bounce_series
from tools.chart.chart_judge import Judge, all_at_once, one_by_one
from tools.chart.chart_methods import Method, methods
from tools.chart.chart_timing import best_of_turns
from tools.chart.chart_work import (
    GEOMETRIES,
    PANELS,
    RING,
    SIGMAS,
    TIMED_GEOMETRIES,
    TIMED_PATCH,
    TIMED_SIGMA,
    Array,
    Work,
    colorchecker,
    read_json,
    timed_angles,
    write_json,
)

SECONDS = 25.0
"""Given to the timing of each panel."""

DOUBLE = vcavity.Resolution(slopes=12, azimuths=12, panels=128, table=256)
EVERY = 10
"""Of the geometries one in ten is solved again with twice the nodes of every kind, and converted
by sd_to_XYZ."""

SAME_COLOR = 0.05
"""ΔE00 up to which the slow conversion counts as giving the same colors."""


VERSIONS = {"sd-to-xyz": f"colour-science {metadata.version('colour-science')}"}


def ring() -> Array:
    """45°/0° as an array of one geometry, shape (3, 1)."""
    return np.array(RING)[:, np.newaxis]


def solve(albedo: Array, angles: Array, nodes: vcavity.Resolution = vcavity.STANDARD) -> Array:
    """Solve the reference at every roughness, shape (sigmas, geometries, patches, bands)."""
    light, view, azimuth = angles
    rows = vcavity.series(light, view, azimuth, SIGMAS[:, np.newaxis], resolution=nodes)
    return np.stack([bounce_series.evaluate(rows, rho) for rho in albedo], axis=2)


def make_work(folder: Path) -> None:
    """Solve the reference for every patch, roughness and geometry."""
    albedo, angles = colorchecker(), np.stack(direction_grid.hemisphere(GEOMETRIES))
    Work(albedo, angles, solve(albedo, angles), solve(albedo, ring())[:, 0]).save(
        folder / "work.npz"
    )


def answer_angles(method: Method, work: Work, every: int = 1) -> Array:
    """Ask a method at the angles: shape (sigmas, geometries, patches, bands or 3)."""
    assert method.angles is not None
    angles = work.angles[:, ::every]
    return np.stack(
        [
            np.stack([method.angles(rho, angles, sigma) for rho in work.albedo], axis=1)
            for sigma in SIGMAS
        ]
    )


def answer_reading(method: Method, work: Work) -> Array:
    """Ask a method at 45°/0°: shape (sigmas, patches, bands or 3)."""
    assert method.reading is not None
    return np.stack([method.reading(work.albedo, sigma) for sigma in SIGMAS])


def judge_all(judge: Judge, ours: dict[str, Method], work: Work) -> dict[str, dict[str, Any]]:
    """Errors of our methods by key and panel."""
    found: dict[str, dict[str, Any]] = {}
    for key, method in ours.items():
        found[key] = {}
        if key in ("reference", "sd-to-xyz"):
            continue
        if method.angles is not None:
            answer = answer_angles(method, work)
            found[key]["angles"] = judge.errors(answer, work.reference, method.ends_in)
        if method.reading is not None:
            answer = answer_reading(method, work)
            found[key]["reading"] = judge.errors(answer, work.reading, method.ends_in)
    found["reference"] = judge_reference(judge, ours["reference"], work)
    found["sd-to-xyz"] = judge_slow(judge, ours, work, found["two-bounce"])
    return found


def judge_reference(judge: Judge, reference: Method, work: Work) -> dict[str, Any]:
    """How far the reference is from itself with twice the nodes."""
    finer = solve(work.albedo, work.angles[:, ::EVERY], DOUBLE)
    finer_ring = solve(work.albedo, ring(), DOUBLE)[:, 0]
    return {
        "angles": judge.errors(work.reference[:, ::EVERY], finer),
        "reading": judge.errors(answer_reading(reference, work), finer_ring),
    }


def judge_slow(
    judge: Judge, ours: dict[str, Method], work: Work, same: dict[str, Any]
) -> dict[str, Any]:
    """Errors of sd_to_XYZ: those of two-bounce, once a part has shown that the colors are equal."""
    apart = judge.delta_e(
        answer_angles(ours["sd-to-xyz"], work, 4 * EVERY),
        answer_angles(ours["two-bounce"], work, 4 * EVERY),
        "XYZ",
    )
    if apart.max() > SAME_COLOR:
        raise AssertionError(f"sd_to_XYZ gives other colors, by up to ΔE00 {apart.max():.3f}.")
    return {panel: {**errors, "relative": None} for panel, errors in same.items()}


def time_all(ours: dict[str, Method], work: Work) -> tuple[dict[str, dict[str, Any]], float]:
    """Nanoseconds a spectrum and geometry, float32, by key and panel, and those of a copy."""
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
    found: dict[str, dict[str, Any]] = {key: {} for key in ours}
    copies = []
    for panel, of_panel in runs.items():
        works = {key: run for key, (_, run) in of_panel.items()}
        seconds = best_of_turns({**works, "copy": copied.copy}, SECONDS)
        copies.append(seconds["copy"] / TIMED_GEOMETRIES * 1e9)
        for key, (count, _) in of_panel.items():
            found[key][panel] = {"ns": seconds[key] / count * 1e9}
    return found, min(copies)


def time_conversions(judge: Judge, work: Work) -> list[dict[str, Any]]:
    """Spectra to XYZ, three ways: nanoseconds a spectrum, and how far from the matrix."""
    spectra = np.tile(work.albedo, (TIMED_GEOMETRIES // 24 + 1, 1))[:TIMED_GEOMETRIES]
    matrix = judge.to_xyz
    few = {"sd_to_XYZ": 24, "msds_to_XYZ": 240}
    seconds = best_of_turns(
        {
            "matrix": lambda: spectra @ matrix,
            "msds_to_XYZ": lambda: all_at_once(spectra[: few["msds_to_XYZ"]]),
            "sd_to_XYZ": lambda: one_by_one(spectra[: few["sd_to_XYZ"]]),
            "copy": spectra.copy,
        },
        SECONDS / 5,
    )
    plain = work.albedo @ matrix
    apart = {
        "matrix": 0.0,
        "msds_to_XYZ": float(np.abs(all_at_once(work.albedo) - plain).max()),
        "sd_to_XYZ": float(np.abs(one_by_one(work.albedo) - plain).max()),
    }
    copy = seconds["copy"] / TIMED_GEOMETRIES
    rows = []
    for key, difference in apart.items():
        cost = seconds[key] / few.get(key, TIMED_GEOMETRIES)
        rows.append({"key": key, "ns": cost * 1e9, "ratio": cost / copy, "apart": difference})
    return rows


def measure(folder: Path) -> None:
    """Time and judge everything that has answered, into measured.json."""
    work, judge = Work.load(folder / "work.npz"), Judge()
    ours = methods(judge.to_rgb, one_by_one)
    errors = judge_all(judge, ours, work)
    times, copy = time_all(ours, work)
    rows: list[dict[str, Any]] = []
    for key, method in ours.items():
        row: dict[str, Any] = {
            "key": key,
            "label": method.label,
            "group": method.group,
            "about": method.about,
        }
        row |= {
            "ends_in": method.ends_in,
            "version": VERSIONS.get(key, f"numpy {np.__version__}"),
            "threads": 1,
        }
        for panel in errors[key]:
            row[panel] = errors[key][panel] | times[key][panel]
        rows.append(row)
    for path in sorted(folder.glob("peer-*.json")):
        row = read_json(path)
        if "missing" not in row:
            with np.load(path.with_suffix(".npz")) as stored:
                row["angles"] |= judge.errors(stored["angles"], work.reference)
                row["reading"] |= judge.errors(stored["reading"], work.reading)
        rows.append(row)
    for row in rows:
        for panel in PANELS:
            if panel in row:
                row[panel]["ratio"] = row[panel]["ns"] / copy
    write_json(folder / "measured.json", rows)
    write_json(folder / "conversions.json", time_conversions(judge, work))


if __name__ == "__main__":
    {"work": make_work, "methods": measure}[sys.argv[1]](Path(sys.argv[2]))
