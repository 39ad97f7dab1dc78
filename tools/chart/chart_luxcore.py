# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""LuxCore's roughmatte on the chart's work: `python -m tools.chart.chart_luxcore FOLDER`.

pyluxcore evaluates no material by itself, so it renders: flat samples side by side, a light without
width, a camera without perspective, one picture for each geometry. Its colors have three channels,
so a spectrum of 31 bands is eleven samples. The cost is what one more sample a pixel takes; it
holds a ray to the sample and one to the light.

roughmatte is the qualitative model, and takes σ in radians. It gets the color with which it reads
the same as the surface at 45°/0°, up to white, and for each roughness the σ that comes closest;
both by the formula, which is then held against the pictures.
"""

from __future__ import annotations

import contextlib
import importlib
import math
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from tools.chart.chart_methods import qualitative
from tools.chart.chart_timing import spread
from tools.chart.chart_work import BANDS, PEER_TRUTHS, RING, Array, Truth, Work, write_json

PIXELS = 4
"""Width of a sample."""
INNER = slice(1, -1)
"""What is read of it: at its border a neighbor shows."""
CHANNELS = 3
NUDGES = (0.0, 1e-6, 2e-6, 3e-6)
"""Radians."""
TIMED_PIXELS = 300
TIMED_SAMPLES = (4, 36)
TURNS = 5
TRIED = np.radians(np.arange(0.0, 91.0, 1.0))
SAME = 1e-4
"""Relative difference from the formula up to which rounding is to blame."""


def choose(truth: Truth) -> tuple[Array, list[float]]:
    """Colors (sigmas, patches, bands) and LuxCore's σ at each roughness."""
    colors, chosen = [], []
    for factor, read in zip(truth.factor, truth.reading, strict=True):
        tried = []
        for sigma in TRIED:
            color = np.clip(read / formula(np.array(RING)[:, np.newaxis], sigma), 0, 1)
            seen = formula(truth.angles, sigma)[:, np.newaxis, np.newaxis] * color
            tried.append((float(np.abs(seen / factor - 1).mean()), float(sigma), color))
        _, sigma, color = min(tried, key=lambda one: one[0])
        colors.append(color)
        chosen.append(sigma)
    return np.stack(colors), chosen


def formula(angles: Array, sigma: float) -> Array:
    """Shape (geometries,): what a white sample is taken to reflect."""
    return qualitative(np.ones(1), angles, sigma)[:, 0]


def samples(spectra: Array, sigmas: list[float]) -> tuple[Array, Array]:
    """Colors (n, 3) and σ (n,) of every sample: bands in threes, patch by patch, σ by σ."""
    spare = -spectra.shape[-1] % CHANNELS
    colors = np.pad(spectra, ((0, 0), (0, 0), (0, spare)), mode="edge")
    colors = colors.reshape(len(sigmas), -1, CHANNELS)
    return colors.reshape(-1, CHANNELS), np.repeat(sigmas, colors.shape[1])


def properties(luxcore: Any, values: dict[str, Any]) -> Any:
    """Give settings as LuxCore's properties."""
    out = luxcore.Properties()
    for key, value in values.items():
        out.Set(luxcore.Property(key, value))
    return out


def build(luxcore: Any, colors: Array, sigmas: Array) -> tuple[Any, int, int]:
    """Lay the samples on a plane; returns the scene, its columns and its rows."""
    columns = math.ceil(math.sqrt(len(colors)))
    rows = math.ceil(len(colors) / columns)
    scene = luxcore.Scene()
    aim(luxcore, scene, columns, rows, RING)
    for index, (color, sigma) in enumerate(zip(colors.tolist(), sigmas.tolist(), strict=True)):
        x, y = index % columns - columns / 2, index // columns - rows / 2
        corners = [(x, y, 0.0), (x + 1, y, 0.0), (x + 1, y + 1, 0.0), (x, y + 1, 0.0)]
        scene.DefineMesh(f"q{index}", corners, [(0, 1, 2), (0, 2, 3)], None, None, None, None)
        values = {
            f"scene.materials.m{index}.type": "roughmatte",
            f"scene.materials.m{index}.kd": color,
            f"scene.materials.m{index}.sigma": sigma,
            f"scene.objects.o{index}.shape": f"q{index}",
            f"scene.objects.o{index}.material": f"m{index}",
        }
        scene.Parse(properties(luxcore, values))
    return scene, columns, rows


def aim(luxcore: Any, scene: Any, columns: int, rows: int, geometry: Any) -> None:
    """Set light and view; the picture is narrowed by as much as the view foreshortens."""
    light, view, azimuth = (float(angle) for angle in geometry)
    distance, narrow = 10.0 * columns, math.cos(view) / 2
    values: dict[str, Any] = {
        "scene.camera.type": "orthographic",
        "scene.camera.lookat.orig": [distance * math.sin(view), 0.0, distance * math.cos(view)],
        "scene.camera.lookat.target": [0.0, 0.0, 0.0],
        "scene.camera.up": [0.0, 1.0, 0.0],
        "scene.camera.screenwindow": [-columns * narrow, columns * narrow, -rows / 2, rows / 2],
        "scene.camera.autofocus.enable": 0,
        "scene.lights.sun.type": "sharpdistant",
        "scene.lights.sun.direction": [
            -math.sin(light) * math.cos(azimuth),
            -math.sin(light) * math.sin(azimuth),
            -math.cos(light),
        ],
    }
    scene.Parse(properties(luxcore, values))


def render(luxcore: Any, scene: Any, width: int, height: int, count: int) -> tuple[Array, float]:
    """Picture (height, width, 3) from the lowest row up, and the seconds it took on one thread."""
    settings = {
        "renderengine.type": "PATHCPU",
        "sampler.type": "SOBOL",
        "path.pathdepth.total": 1,
        "film.width": width,
        "film.height": height,
        "film.filter.type": "NONE",
        "film.hw.enable": 0,
        "film.outputs.0.type": "RGB",
        "film.outputs.0.filename": "unused.exr",
        "native.threads.count": 1,
        "batch.haltspp": count,
    }
    session = luxcore.RenderSession(luxcore.RenderConfig(properties(luxcore, settings), scene))
    start = time.perf_counter()
    session.Start()
    while not session.HasDone():
        time.sleep(0.001)
        session.UpdateStats()
    seconds = time.perf_counter() - start
    session.Stop()
    pixels = np.zeros(height * width * 3, np.float32)
    session.GetFilm().GetOutputFloat(luxcore.FilmOutputType.RGB, pixels)
    return pixels.reshape(height, width, 3), seconds


def read(luxcore: Any, scene: Any, columns: int, rows: int, geometry: Any) -> Array:
    """Measure all samples in one geometry: reflectance factors, shape (rows * columns, 3)."""
    found = np.zeros((rows, columns, CHANNELS))
    # A ray to the light may meet its own sample again by rounding, which leaves a pixel black; no
    # sample is. Another direction, equal for all purposes, rounds otherwise.
    for nudge in NUDGES:
        aim(luxcore, scene, columns, rows, np.asarray(geometry) + nudge)
        picture, _ = render(luxcore, scene, columns * PIXELS, rows * PIXELS, 1)
        tiles = picture.reshape(rows, PIXELS, columns, PIXELS, CHANNELS)
        np.maximum(found, tiles[:, INNER, :, INNER].max(axis=(1, 3)), out=found)
        if found.reshape(-1, CHANNELS)[: scene.GetObjectCount()].all():
            break
    # The light has a radiance of 1 a steradian; a white diffuser sends back cos θi / π.
    return found.reshape(-1, CHANNELS) * (np.pi / math.cos(geometry[0]))


def answer(luxcore: Any, truth: Truth) -> tuple[Array, list[float]]:
    """Render roughmatte at all angles, shape of `truth.factor`; and the σ it got.

    Raises
    ------
    RuntimeError
        If the pictures are not what the formula says that was matched.
    """
    spectra, chosen = choose(truth)
    colors, sigmas = samples(spectra, chosen)
    scene, columns, rows = build(luxcore, colors, sigmas)
    seen = np.stack([read(luxcore, scene, columns, rows, one) for one in truth.angles.T])
    shape = (truth.angles.shape[1], len(chosen), spectra.shape[1], -1)
    found = np.moveaxis(seen[:, : len(colors)].reshape(shape)[..., : BANDS.size], 0, 1)
    white = np.stack([formula(truth.angles, sigma) for sigma in chosen])
    apart = np.abs(found / (white[..., np.newaxis, np.newaxis] * spectra[:, np.newaxis]) - 1)
    if apart.max() > SAME:
        raise RuntimeError(f"LuxCore is off its formula by up to {apart.max():.1e}.")
    return found, chosen


def sample_seconds(luxcore: Any, work: Work) -> list[float]:
    """Seconds that one more sample of one pixel takes: shortest, median and upper quartile."""
    colors, sigmas = samples(*choose(work.traced))
    few = slice(0, 16)
    scene, columns, rows = build(luxcore, colors[few], sigmas[few])
    aim(luxcore, scene, columns, rows, (np.radians(60), np.radians(30), 1.0))
    less, more = TIMED_SAMPLES
    times: dict[int, list[float]] = {count: [] for count in TIMED_SAMPLES}
    for _ in range(TURNS):
        for count, of_count in times.items():
            of_count.append(render(luxcore, scene, TIMED_PIXELS, TIMED_PIXELS, count)[1])
    added = (more - less) * TIMED_PIXELS**2
    return [(many - min(times[less])) / added for many in spread(times[more])]


@contextlib.contextmanager
def silence() -> Iterator[None]:
    """Send what LuxCore prints from below Python to nowhere."""
    sys.stdout.flush()
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(nowhere)
        os.close(kept)


def main(folder: Path) -> None:
    """Answer, time and write both files."""
    work = Work.load(folder / "work.npz")
    answers: dict[str, Any] = {}
    chosen: dict[str, list[float]] = {}
    with silence():
        luxcore = importlib.import_module("pyluxcore")
        luxcore.Init()
        luxcore.SetLogHandler(lambda _message: None)
        for name in PEER_TRUTHS:
            answers[name], chosen[name] = answer(luxcore, getattr(work, name))
        cost = [value * BANDS.size / CHANNELS * 1e9 for value in sample_seconds(luxcore, work)]
    np.savez(folder / "peer-luxcore-roughmatte.npz", **answers)
    pairs = zip(np.degrees(work.traced.sigmas), np.degrees(chosen["traced"]), strict=True)
    sliders = ", ".join(f"{slider:.0f}° at {sigma:.0f}°" for sigma, slider in pairs)
    write_json(
        folder / "peer-luxcore-roughmatte.json",
        {
            "key": "luxcore-roughmatte",
            "label": "LuxCore roughmatte",
            "group": "peer",
            "about": f"the qualitative model, rendered, two rays a sample; its σ {sliders}",
            "ends_in": "bands",
            "version": f"LuxCore {luxcore.Version()} PATHCPU",
            "threads": 1,
            "overhead": "a traced ray",
            "cost": {"angles": cost},
        },
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
    # All is written; LuxCore's own clearing up at the end of Python crashes.
    os._exit(0)
