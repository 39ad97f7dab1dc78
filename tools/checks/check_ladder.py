# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far each model is from what materials are matched to, on random materials and scenes.

    python -m tools.checks.check_ladder [--scenes 1000]

Every scene has a spectrum, a roughness, its own directions and lights. Printed are the largest
ΔE00 of a scene by each model and what one spectrum in one direction costs. Takes half a minute, of
which the V-cavity's solver needs most; needs an environment with bpy, whose add-on brings
colour-science.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tools.run.run_command_line import load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.core import ladder, models
from rough_spectra.core.color import color_difference
from rough_spectra.core.numerics.arrays import Array

WAVELENGTHS = np.arange(400.0, 701.0, 10.0)
ILLUMINANTS = ("D65", "A", "F11", "D50", "LED-B3")
STEEPEST_SIGMA, STEEPEST_ANGLE = np.radians(60.0), np.radians(80.0)
DIRECTIONS, LIGHTS = 16, 3
TIMED = 20_000
"""Directions of the timing; of the solver, a thousandth."""


@dataclass(frozen=True, eq=False)
class Scene:
    """One material and where it is seen.

    Attributes
    ----------
    albedo
        ρ(λ), shape (bands,).
    sigma
        Radians.
    geometries
        θi, θr, Δφ in radians, shape (3, directions).
    illuminants
        Names of the lights.
    """

    albedo: Array
    sigma: float
    geometries: Array
    illuminants: tuple[str, ...]


def main() -> int:
    """Run the check and print its result."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenes", type=int, default=1000, help="how many (default 1000)")
    parser.add_argument("--seed", type=int, default=1, help="of the random numbers (default 1)")
    arguments = parser.parse_args()
    scenes = random_scenes(arguments.scenes, arguments.seed)
    found = errors(scenes)
    for model in models.NAMES:
        sys.stdout.write(
            f"| {model} | {cost(model):.2g} µs | {np.median(found[model]):.2f} "
            f"| {np.quantile(found[model], 0.95):.2f} | {found[model].max():.2f} |\n"
        )
    return 0


def random_scenes(count: int, seed: int) -> list[Scene]:
    """Make scenes: half of any color, the others dark, saturated or near-white."""
    random = np.random.default_rng(seed)
    scenes = []
    for index in range(count):
        directions = random.integers(1, DIRECTIONS + 1)
        polar = np.arcsin(np.sqrt(random.random((2, directions))) * np.sin(STEEPEST_ANGLE))
        azimuth = random.uniform(0, 2 * np.pi, (1, directions))
        lights = random.choice(ILLUMINANTS, random.integers(1, LIGHTS + 1), replace=False)
        scenes.append(
            Scene(
                albedo=_spectrum(random, index % 6),
                sigma=float(random.uniform(0, STEEPEST_SIGMA)),
                geometries=np.concatenate((polar, azimuth)),
                illuminants=tuple(sorted(map(str, lights))),
            )
        )
    return scenes


def _spectrum(random: np.random.Generator, kind: int) -> Array:
    """Draw a smooth spectrum: the logistic function, which stays in 0..1, of broad bumps."""
    level, contrast = {
        3: (random.uniform(-4, -2.5), 0.4),  # dark
        4: (random.uniform(-1, 1), 3.0),  # saturated
        5: (random.uniform(2, 3.5), 0.3),  # near-white
    }.get(kind, (random.normal(-0.5, 1.2), random.uniform(0.2, 1.5)))
    centers = random.uniform(380, 720, 4)
    widths = random.uniform(30, 120, 4)
    bumps = np.exp(-(((WAVELENGTHS[:, np.newaxis] - centers) / widths) ** 2))
    return np.asarray(1 / (1 + np.exp(-(level + contrast * bumps @ random.normal(0, 1, 4)))))


def errors(scenes: Sequence[Scene]) -> dict[str, Array]:
    """Largest ΔE00 of each scene from the target, by every model: shape (scenes,)."""
    found = {model: np.zeros(len(scenes)) for model in models.NAMES}
    for index, scene in enumerate(scenes):
        light, view, azimuth = scene.geometries
        spectra = {
            model: ladder.reflectance(model, scene.albedo, light, view, azimuth, scene.sigma)
            for model in models.NAMES
        }
        for name in scene.illuminants:
            matrix = _weights(name)
            target = spectra[models.TARGET] @ matrix
            for model in models.NAMES:
                apart = difference(spectra[model] @ matrix, target, matrix.sum(axis=0))
                found[model][index] = max(found[model][index], float(apart.max()))
    return found


def cost(model: str) -> float:
    """Microseconds for a spectrum of 31 bands in one of many new directions."""
    random = np.random.default_rng(7)
    count = TIMED // 1000 if model == "reference" else TIMED
    light, view = np.arccos(random.uniform(0.2, 1, (2, count)))
    azimuth = random.uniform(0, np.pi, count)
    start = time.perf_counter()
    ladder.reflectance(model, np.full(31, 0.5), light, view, azimuth, 0.5)
    return (time.perf_counter() - start) / count * 1e6


@lru_cache(maxsize=len(ILLUMINANTS))
def _weights(illuminant: str) -> Array:
    return tristimulus.weights(WAVELENGTHS, illuminant)


def difference(xyz: Array, other: Array, white: Array) -> Array:
    """CIEDE2000 of XYZ under a white."""
    return color_difference.delta_e(
        color_difference.xyz_to_lab(xyz, white), color_difference.xyz_to_lab(other, white)
    )


if __name__ == "__main__":
    sys.exit(main())
