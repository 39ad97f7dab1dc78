# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check `core.ladder.choose_model` on random materials and scenes against the V-cavity solver.

    python -m tools.checks.check_ladder [--scenes 1000]

Every scene has a spectrum, a roughness, its own directions and lights and its own tolerance. The
solver tells how far each rung really is from the reference there. Printed are how often the choice
is the cheapest rung that suffices, how far the chosen rungs exceed their tolerance, and what the
choice costs. Takes a few minutes; needs an environment with bpy, whose add-on brings
colour-science.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
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
TOLERANCES = (0.3, 3.0)
SINGLE_CALLS = 100
"""Scenes whose choice is timed one by one."""


@dataclass(frozen=True, eq=False)
class Scene:
    """One material, where it is seen and how accurate it has to be there.

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
    tolerance
        In ΔE00.
    """

    albedo: Array
    sigma: float
    geometries: Array
    illuminants: tuple[str, ...]
    tolerance: float


@dataclass(frozen=True)
class Verdict:
    """What was chosen and what is true.

    Attributes
    ----------
    choice
        What `choose_model` says.
    true_errors
        Largest ΔE00 of each rung against the solver.
    cheapest
        The cheapest rung whose true error is within the tolerance.
    tolerance
        In ΔE00.
    """

    choice: ladder.Choice
    true_errors: dict[str, float]
    cheapest: str
    tolerance: float

    @property
    def excess(self) -> float:
        """True error of the chosen rung over the tolerance."""
        return self.true_errors[self.choice.model] / self.tolerance


def main() -> int:
    """Run the check and print its result."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenes", type=int, default=1000, help="how many (default 1000)")
    parser.add_argument("--seed", type=int, default=1, help="of the random numbers (default 1)")
    arguments = parser.parse_args()
    scenes = random_scenes(arguments.scenes, arguments.seed)
    choose(scenes)
    start = time.process_time()
    choices = choose(scenes)
    batch = (time.process_time() - start) / len(scenes)
    start = time.process_time()
    for scene in scenes[:SINGLE_CALLS]:
        choose([scene])
    single = (time.process_time() - start) / len(scenes[:SINGLE_CALLS])
    shared = _time_shared(scenes)
    report([judge(scene, choice) for scene, choice in zip(scenes, choices, strict=True)])
    sys.stdout.write(
        f"cost a material, ΔE00 by colour-science: {1e3 * batch:.2f} ms with a scene of its own, "
        f"{1e3 * shared:.2f} ms where 16 directions and 1 light are shared, "
        f"{1e3 * single:.2f} ms called one by one\n"
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
                tolerance=float(random.uniform(*TOLERANCES)),
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


def choose(scenes: Sequence[Scene]) -> list[ladder.Choice]:
    """Choose for all scenes, in one call for each set of lights."""
    found: dict[int, ladder.Choice] = {}
    by_lights: dict[tuple[str, ...], list[int]] = {}
    for index, scene in enumerate(scenes):
        by_lights.setdefault(scene.illuminants, []).append(index)
    for illuminants, members in by_lights.items():
        width = max(scenes[i].geometries.shape[1] for i in members)
        geometries = np.full((3, len(members), width), np.nan)
        for row, i in enumerate(members):
            geometries[:, row, : scenes[i].geometries.shape[1]] = scenes[i].geometries
        choices = ladder.choose_model(
            np.stack([scenes[i].albedo for i in members]),
            np.array([scenes[i].sigma for i in members]),
            (geometries[0], geometries[1], geometries[2]),
            [_weights(name) for name in illuminants],
            np.array([scenes[i].tolerance for i in members]),
        )
        found.update(zip(members, choices, strict=True))
    return [found[i] for i in range(len(scenes))]


@lru_cache(maxsize=len(ILLUMINANTS))
def _weights(illuminant: str) -> Array:
    return tristimulus.weights(WAVELENGTHS, illuminant)


def difference(xyz: Array, other: Array, white: Array) -> Array:
    """CIEDE2000 of XYZ under a white."""
    return color_difference.delta_e(
        color_difference.xyz_to_lab(xyz, white), color_difference.xyz_to_lab(other, white)
    )


def judge(scene: Scene, choice: ladder.Choice) -> Verdict:
    """Compare a choice with what the solver says of its scene."""
    light, view, azimuth = scene.geometries
    spectra = {
        rung: ladder.reflectance(rung, scene.albedo, light, view, azimuth, scene.sigma)
        for rung in models.NAMES
    }
    errors = dict.fromkeys(models.NAMES, 0.0)
    for name in scene.illuminants:
        matrix = _weights(name)
        reference = spectra["reference"] @ matrix
        for rung in models.NAMES[:-1]:
            found = difference(spectra[rung] @ matrix, reference, matrix.sum(axis=0))
            errors[rung] = max(errors[rung], float(found.max()))
    cheapest = next(rung for rung in models.NAMES if errors[rung] <= scene.tolerance)
    return Verdict(choice, errors, cheapest, scene.tolerance)


def report(verdicts: Sequence[Verdict]) -> None:
    """Print how good the choices are."""
    right = sum(verdict.choice.model == verdict.cheapest for verdict in verdicts)
    dearer = sum(
        models.NAMES.index(verdict.choice.model) > models.NAMES.index(verdict.cheapest)
        for verdict in verdicts
    )
    excess = np.array([verdict.excess for verdict in verdicts])
    sys.stdout.write(
        f"{len(verdicts)} scenes: cheapest sufficient rung in {right / len(verdicts):.1%}, "
        f"a dearer one in {dearer / len(verdicts):.1%}\n"
        f"chosen rung over its tolerance: {np.count_nonzero(excess > 1)} times, "
        f"by {max(0.0, excess.max() - 1):.1%} at most\n"
    )
    chosen = Counter(verdict.choice.model for verdict in verdicts)
    for rung in models.NAMES:
        true = np.array([verdict.true_errors[rung] for verdict in verdicts])
        gap = np.array([verdict.choice.errors[rung] for verdict in verdicts]) - true
        sys.stdout.write(
            f"{rung:12} chosen {chosen[rung]:4}; largest ΔE00 of a scene: median "
            f"{np.median(true):.2f}, 95 % {np.quantile(true, 0.95):.2f}, worst {true.max():.2f}; "
            f"predicted minus true: {gap.min():+.3f} to {gap.max():+.3f}, mean {gap.mean():+.3f}\n"
        )


def _time_shared(scenes: Sequence[Scene]) -> float:
    geometries = next(s.geometries for s in scenes if s.geometries.shape[1] == DIRECTIONS)
    albedos = np.stack([scene.albedo for scene in scenes])
    sigma = np.array([scene.sigma for scene in scenes])
    light = _weights("D65")
    start = time.process_time()
    ladder.choose_model(albedos, sigma, tuple(geometries), [light])
    return (time.process_time() - start) / len(scenes)


if __name__ == "__main__":
    sys.exit(main())
