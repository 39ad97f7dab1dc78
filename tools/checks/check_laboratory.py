# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check the virtual laboratory: meshes rendered by Cycles against what is known without it.

    python -m tools.checks.check_laboratory [--rays 1024] [--seeds 8] [--output docs/…]

V-grooves are held to the solver of `core.vcavity`, which shares nothing with a renderer; Gaussian
heights to figures that two other tracers gave; level samples to their albedo. Written is a page's
table, with the noise of each figure beside it. Takes ten minutes on two cores; needs an
environment with bpy.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator, Sequence
from itertools import chain
from math import radians
from pathlib import Path

import numpy as np

from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.laboratory import experiment, kinds
from rough_spectra.core import models, reading, vcavity

ALBEDOS = (0.2, 0.5, 0.8, 0.9, 0.95, 0.99)
BOUNDS = {15: 0.1, 30: 0.1, 45: 0.3}
"""Percent that V-grooves may be off the solver, by σ in degrees."""

TRACED = {0.2: 0.1680, 0.5: 0.4471, 0.8: 0.7676, 0.95: 0.9479}
"""Gaussian heights of Rdq = tan 30° at 45°/0°, by tracers that know nothing of Blender, ± 0.002."""

SURFACES = 4
"""Gaussian surfaces that are measured: what they differ by is more than the noise."""

PAGE = Path(__file__).resolve().parents[2] / "docs" / "laboratory-table.md"


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print, and write the page; exit status 1 where a bound is broken."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rays", type=int, default=1024, help="a pixel and render")
    parser.add_argument("--seeds", type=int, default=8, help="renders")
    parser.add_argument("--output", type=Path, default=PAGE)
    options = parser.parse_args(arguments)
    faults: list[str] = []
    lines = []
    for line in chain(
        grooves(options.rays, options.seeds, faults),
        gaussian(options.rays // 4, faults),
        of_every_kind(options.rays // 4),
        level(faults),
    ):
        print(line, flush=True)
        lines.append(line)
    lines.insert(0, "<!-- Made by tools/checks/check_laboratory.py -->\n")
    options.output.write_text("\n".join(lines) + "\n", encoding="utf-8")
    for fault in faults:
        print(f"OFF: {fault}", file=sys.stderr)
    return 1 if faults else 0


def grooves(rays: int, seeds: int, faults: list[str]) -> Iterator[str]:
    """Hold V-grooves of both laws to the solver."""
    yield "| V-grooves | σ | " + " | ".join(f"ρ = {rho:g}" for rho in ALBEDOS) + " | seconds |"
    yield "|---|---|" + "---|" * (len(ALBEDOS) + 1)
    for kind in ("grooves", "grooves-oren-nayar"):
        for degrees, bound in BOUNDS.items():
            rough = kinds.make(kind, radians(degrees))
            start = time.perf_counter()
            found = experiment.measure(rough.mesh, ALBEDOS, seeds=seeds, samples=rays)
            seconds = time.perf_counter() - start
            law = str(rough.law)
            expected = vcavity.reading_from_albedo(np.array(ALBEDOS), radians(degrees), slopes=law)
            off = 100 * (found.reflectance / expected - 1)
            noise = 100 * found.noise / expected
            cells = [f"{a:+.3f} ± {b:.3f} %" for a, b in zip(off, noise, strict=True)]
            yield f"| {law} | {degrees}° | {' | '.join(cells)} | {seconds:.0f} |"
            if np.abs(off).max() > bound:
                faults.append(f"{kind} at {degrees}° by {np.abs(off).max():.3f} %, over {bound} %")


def gaussian(rays: int, faults: list[str]) -> Iterator[str]:
    """Hold Gaussian heights to what others traced."""
    yield ""
    yield (
        "| Gaussian heights, Rdq = tan 30° | " + " | ".join(f"ρ = {rho:g}" for rho in TRACED) + " |"
    )
    yield "|---|" + "---|" * len(TRACED)
    albedos = list(TRACED)
    rows = np.array(
        [
            experiment.measure(
                kinds.make("gaussian", radians(30), seed=seed).mesh, albedos, samples=rays
            ).reflectance
            for seed in range(SURFACES)
        ]
    )
    mean, apart = rows.mean(axis=0), rows.std(axis=0, ddof=1)
    yield "| traced elsewhere | " + " | ".join(f"{value:.4f}" for value in TRACED.values()) + " |"
    yield "| Cycles, mean of four surfaces | " + " | ".join(f"{v:.4f}" for v in mean) + " |"
    yield "| standard deviation of the four | " + " | ".join(f"{v:.4f}" for v in apart) + " |"
    off = np.abs(mean - list(TRACED.values())).max()
    if off > 0.002:
        faults.append(f"Gaussian heights by {off:.4f}")


def of_every_kind(rays: int) -> Iterator[str]:
    """Measure one sample of each kind and of σ = 30°, beside what the model predicts."""
    albedos = np.array(list(TRACED))
    yield ""
    yield "| σ = 30° | " + " | ".join(f"ρ = {rho:g}" for rho in albedos) + " | spot | spread |"
    yield "|---|" + "---|" * (len(albedos) + 2)
    predicted = reading.from_albedo(albedos, radians(30), models.TARGET, "45a:0")
    cells = " | ".join(f"{value:.4f}" for value in predicted)
    yield f"| predicted by the model {models.TARGET} | {cells} | | |"
    for kind in kinds.KINDS:
        if kind == "map":
            continue
        rough = kinds.make(kind, radians(30))
        spot = min(rough.mesh.period) / 8
        found = experiment.measure(rough.mesh, albedos, spot, samples=rays)
        cells = " | ".join(
            f"{a:.4f} ± {b:.4f}" for a, b in zip(found.reflectance, found.noise, strict=True)
        )
        title = kinds.KINDS[kind].title
        width = f"{found.spot / rough.length:g} × {kinds.KINDS[kind].length}"
        yield f"| {title} | {cells} | {width} | {found.spread[1]:.4f} |"


def level(faults: list[str]) -> Iterator[str]:
    """Hold level samples to their albedo."""
    worst = 0.0
    for kind in ("gaussian", "grooves"):
        found = experiment.measure(kinds.make(kind, 0.0).mesh, ALBEDOS, seeds=2, samples=4)
        worst = max(worst, float(np.abs(found.reflectance / found.albedos - 1).max()))
    yield ""
    yield f"Level samples read their albedo to {worst:.0e}, relative."
    if worst > 1e-5:
        faults.append(f"level samples by {worst:.1e}")


if __name__ == "__main__":
    sys.exit(main())
