# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hold the models against goniometers: how much of real matte materials they explain.

    python -m tools.checks.check_goniometer FOLDER [--write]

FOLDER holds the files that docs/chart.md names, or some of them; they are not part of the project.
Every model gets the albedo and the one σ with which its root mean square relative error over the
material's directions is least, alone and with one GGX lobe of free weight and width. Prints a
table; --write puts it into docs/goniometer-table.md and docs/data/goniometer.csv. Networks need
h5py. Takes two minutes on one core.
"""

from __future__ import annotations

import argparse
import csv
import io
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from core import models
from core.numerics.arrays import Array
from tools.checks.goniometer_data import GoniometerError, Material, load
from tools.run.run_command_line import ROOT

TABLE = ROOT / "docs" / "goniometer-table.md"
DATA = ROOT / "docs" / "data" / "goniometer.csv"
MADE = "<!-- Made by tools/checks/check_goniometer.py -->"

MODELS = ("lambert", "surface", "closure")
CASES = ALL, NEAR, GLOSS = "all azimuths", "the light's side", "all, with one GGX lobe"
DEGREES = np.arange(0.0, 61.0, 3.0)
WIDTHS = np.linspace(0.1, 1.0, 10)
"""GGX's α."""
_F0 = 0.04
"""Of Schlick's Fresnel term, for a refractive index of 1.5; the free weight takes up its scale."""
ALBEDOS = (0.005, 0.999)
_STEPS = 12
_SETTLED = 1e-5
"""Gain of error below which a search ends."""
_NUDGE = 1e-3


@dataclass(frozen=True)
class Fit:
    """The best of one model: root mean square relative error, σ in degrees, and the lobe."""

    error: float
    sigma: float
    weight: float
    width: float


Fits = dict[str, dict[str, Fit]]
"""By case and model."""


def gloss(angles: Array, width: float) -> Array:
    """Reflectance factor of GGX's lobe with Smith's shadowing and Schlick's term, weight 1.

    B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces" (2007).
    """
    light, view, azimuth = angles
    cos_i, cos_r = np.cos(light), np.cos(view)
    between = cos_i * cos_r + np.sin(light) * np.sin(view) * np.cos(azimuth)
    half = np.sqrt(np.maximum((1 + between) / 2, 0))
    upright = np.minimum((cos_i + cos_r) / (2 * half), 1)
    square = width * width
    facets = square / (np.pi * (upright * upright * (square - 1) + 1) ** 2)
    hidden = 1.0 + sum(_shadow(cosine, square) for cosine in (cos_i, cos_r))
    fresnel = _F0 + (1 - _F0) * (1 - half) ** 5
    return np.asarray(np.pi * fresnel * facets / (hidden * 4 * cos_i * cos_r))


def _shadow(cosine: Array, square: float) -> Array:
    """Smith's Λ of GGX."""
    tangent = (1 - cosine * cosine) / (cosine * cosine)
    return np.asarray((np.sqrt(1 + square * tangent) - 1) / 2)


def fit(material: Material, model: str, with_gloss: bool = False) -> Fit:
    """Find albedo, σ and the lobe with which a model comes closest."""
    formula = models.find(model).formulas.reflectance
    light, view, azimuth = material.angles
    lobes = [(0.0, np.zeros_like(material.factor))]
    if with_gloss:
        lobes += [(float(width), gloss(material.angles, float(width))) for width in WIDTHS]
    found = []
    for degrees in DEGREES if model != "lambert" else DEGREES[:1]:

        def reflect(albedo: float, sigma: float = float(np.radians(degrees))) -> Array:
            return formula([albedo], light, view, azimuth, sigma)[:, 0]

        for width, lobe in lobes:
            error, weight = solve(reflect, lobe, material.factor)
            found.append(Fit(error, float(degrees), weight, width if weight else 0.0))
    return min(found, key=lambda one: one.error)


def solve(reflect: Callable[[float], Array], lobe: Array, factor: Array) -> tuple[float, float]:
    """Find the albedo and the weight of a lobe, by Gauss-Newton on the relative error.

    Parameters
    ----------
    reflect
        Albedo to reflectance factor, shape (directions,).
    lobe
        Reflectance factor of the gloss with weight 1, shape (directions,).
    factor
        What was measured, shape (directions,).

    Returns
    -------
    The root mean square relative error, and the weight, which is not negative.
    """
    albedo, weight = float(np.clip(factor.mean(), *ALBEDOS)), 0.0
    shine = lobe / factor
    best = np.inf, 0.0
    for _ in range(_STEPS):
        seen = reflect(albedo)
        missing = 1 - seen / factor - weight * shine
        error = float(np.sqrt(np.mean(missing**2)))
        gain = best[0] - error
        best = min(best, (error, weight))
        if gain < _SETTLED:
            break
        slope = (reflect(albedo - _NUDGE) - seen) / -_NUDGE / factor
        straight, cross = float(slope @ slope), float(slope @ shine)
        left = float(shine @ shine) - cross * cross / straight
        right = float(shine @ missing) - cross * float(slope @ missing) / straight
        move = max(right / left, -weight) if left else 0.0
        albedo += (float(slope @ missing) - cross * move) / straight
        albedo = float(np.clip(albedo, *ALBEDOS))
        weight += move
    return best


def judge(material: Material) -> Fits:
    """Fits by case and model."""
    near = material.toward_light()
    return {
        ALL: {model: fit(material, model) for model in MODELS},
        NEAR: {model: fit(near, model) for model in MODELS},
        GLOSS: {model: fit(material, model, with_gloss=True) for model in MODELS},
    }


def medians(rows: list[tuple[Material, Fits]]) -> dict[str, list[float]]:
    """Median error of each model over the materials, by case."""
    return {
        case: [float(np.median([fits[case][model].error for _, fits in rows])) for model in MODELS]
        for case in CASES
    }


def table(rows: list[tuple[Material, Fits]]) -> str:
    """Write the Markdown table: errors of Lambert / surface / closure, and the σ of "surface"."""
    head = ["material", "from", *CASES]
    lines = [_line(head), _line(["---"] * len(head))]
    for material, fits in rows:
        lines.append(_line([material.name, material.source, *(_cell(fits[c]) for c in CASES)]))
    middle = medians(rows)
    cells = [" / ".join(f"{100 * error:.1f}" for error in middle[case]) for case in CASES]
    lines.append(_line([f"**median of {len(rows)}**", "", *(f"**{cell}**" for cell in cells)]))
    return "\n".join(lines) + "\n"


def _line(cells: list[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _cell(fits: dict[str, Fit]) -> str:
    errors = " / ".join(f"{100 * fits[model].error:.1f}" for model in MODELS)
    return f"{errors} at {fits['surface'].sigma:.0f}°"


def data(rows: list[tuple[Material, Fits]]) -> str:
    """Write one line a material, case and model."""
    out = io.StringIO()
    out.write("# Root mean square relative error with the best albedo, sigma and GGX lobe\n")
    lines = csv.writer(out, lineterminator="\n")
    lines.writerow(
        ["material", "from", "case", "model", "error", "sigma_degrees", "gloss", "gloss_alpha"]
    )
    for material, fits in rows:
        for case, of_case in fits.items():
            for model, one in of_case.items():
                numbers = (f"{n:.7g}" for n in (one.error, one.sigma, one.weight, one.width))
                lines.writerow([material.name, material.source, case, model, *numbers])
    return out.getvalue()


def main(argv: list[str] | None = None) -> int:
    """Fit all and print; returns the exit status."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the goniometers' files are")
    parser.add_argument("--write", action="store_true", help="write the page's table and data")
    options = parser.parse_args(argv)
    try:
        materials = load(options.folder)
    except GoniometerError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    rows = [(material, judge(material)) for material in materials]
    text = table(rows)
    sys.stdout.write(text)
    if options.write:
        TABLE.write_text(f"{MADE}\n\n{text}", encoding="utf-8")
        DATA.write_text(data(rows), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
