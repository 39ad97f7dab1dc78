# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The core against plain numpy on the same bytes: `python -m tools.chart.chart_speed FOLDER`.

Ratios of times within one run, memory against the size of the output, and what each computation
gives away for it: its error. A million geometries and spectra of 31 bands, float32, one thread.
"""

from __future__ import annotations

import sys
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from core import oren_nayar, reading
from tools.chart.chart_timing import best_of_turns
from tools.chart.chart_work import BANDS, Array, write_json
from tools.tables import traces

COUNT = 10**6
SIGMA = float(np.radians(30))
"""At which surfaces were traced."""
SECONDS = 40.0

EVALUATE_BOUND = 1.5
INVERT_BOUND = 4.0
MEMORY_BOUND = 2.0
CLOSED_BOUND = 3.0
CLOSED = "surface"
"""The closed form that materials are matched to; "closure" takes the same steps."""


def evaluate(albedo: Array, geometry: Array) -> Array:
    """Two-bounce at geometries (3, n)."""
    light, view, azimuth = geometry
    return oren_nayar.reflectance(albedo, light, view, azimuth, SIGMA)


def peak_over_output(work: Callable[[], Array]) -> float:
    """Most memory held at a time during `work`, its output included, over that output."""
    tracemalloc.start()
    try:
        size = work().nbytes
        return tracemalloc.get_traced_memory()[1] / size
    finally:
        tracemalloc.stop()


def worst(found: Array, truth: Array) -> float:
    """Largest relative difference."""
    return float(np.max(np.abs(found / truth - 1)))


def measure() -> list[dict[str, Any]]:
    """Rows of the table: what, ratio, bound, accuracy."""
    rng = np.random.default_rng(0)
    # Below 80°, like every geometry of the chart.
    light, view = np.arcsin(np.sqrt(rng.random((2, COUNT))) * np.sin(np.radians(80)))
    geometry = np.stack((light, view, np.pi * rng.random(COUNT))).astype(np.float32)
    albedo = (0.05 + 0.9 * rng.random(BANDS.size)).astype(np.float32)
    spectra = (0.02 + 0.7 * rng.random((COUNT, BANDS.size))).astype(np.float32)
    pairs = rng.random((COUNT, 2)).astype(np.float32)
    basis = np.stack((albedo, albedo * albedo))

    def trigonometry() -> None:
        """Functions of angle that the formula names, each once."""
        first, second, azimuth = geometry
        high, low = np.maximum(first, second), np.minimum(first, second)
        np.cos(azimuth), np.sin(high), np.tan(low), np.tan((high + low) / 2)

    works: dict[str, Callable[[], Any]] = {
        "evaluate": lambda: evaluate(albedo, geometry),
        "matmul": lambda: pairs @ basis,
        "trigonometry": trigonometry,
        "invert": lambda: reading.to_albedo(spectra, SIGMA),
        "invert closed": lambda: reading.to_albedo(spectra, SIGMA, CLOSED),
        "copy": spectra.copy,
        "two-bounce": lambda: reading.from_albedo(spectra, SIGMA),
        "closed": lambda: reading.from_albedo(spectra, SIGMA, CLOSED),
    }
    seconds = best_of_turns(works, SECONDS, most=15)
    plain = seconds["matmul"] + seconds["trigonometry"]

    few = slice(0, 20_000)
    single = evaluate(albedo, geometry[:, few])
    double = evaluate(albedo.astype(np.float64), geometry[:, few].astype(np.float64))
    some = spectra[few]
    traced = traces.load("gaussian", round(np.degrees(SIGMA)))
    # Of the traces the first direction is 45°/0°.
    known = traces.ALBEDOS[np.newaxis], traced.reflectance[:1]
    rows = []

    def add(what: str, ratio: float, bound: float, accuracy: str) -> None:
        rows.append({"what": what, "ratio": ratio, "bound": bound, "accuracy": accuracy})

    add(
        "two-bounce at 10⁶ geometries × 31 bands / (matmul + trigonometry)",
        seconds["evaluate"] / plain,
        EVALUATE_BOUND,
        f"float32 within {worst(single, double):.0e} of float64",
    )
    for model, key in (("two-bounce", "invert"), (CLOSED, "invert closed")):
        back = worst(reading.from_albedo(reading.to_albedo(some, SIGMA, model), SIGMA, model), some)
        add(
            f"inverting 10⁶ readings, {model} / copy",
            seconds[key] / seconds["copy"],
            INVERT_BOUND,
            f"gives the reading back within {back:.0e}",
        )
    add(
        f"{CLOSED} / two-bounce, 10⁶ readings at 45°a:0°",
        seconds["closed"] / seconds["two-bounce"],
        CLOSED_BOUND,
        f"at σ = {np.degrees(SIGMA):.0f}°, within "
        f"{worst(reading.from_albedo(known[0], SIGMA, CLOSED), known[1]):.2%} of traced surfaces; "
        f"two-bounce within {worst(reading.from_albedo(known[0], SIGMA), known[1]):.1%}",
    )
    for key, what in (
        ("evaluate", "two-bounce at 10⁶ geometries"),
        ("two-bounce", "two-bounce, 10⁶ readings"),
        ("closed", f"{CLOSED}, 10⁶ readings"),
        ("invert", "inverting, two-bounce"),
        ("invert closed", f"inverting, {CLOSED}"),
    ):
        add(f"memory: {what} / output", peak_over_output(works[key]), MEMORY_BOUND, "")
    return rows


if __name__ == "__main__":
    write_json(Path(sys.argv[1]) / "speed.json", measure())
