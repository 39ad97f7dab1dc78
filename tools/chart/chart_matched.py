# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All who start from the same: what an instrument read at 45°/0°, and how rough the surface is.

Models take the albedo behind the reading. Lobes of renderers take the RGB color with which they
read the same, and the slider that comes closest, one for each roughness (`chart_lobes`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from core import ladder, reading
from tools.chart import chart_lobes
from tools.chart.chart_judge import Judge
from tools.chart.chart_methods import PEER, RUNG, ForAnyAngle
from tools.chart.chart_work import Array, Truth

MODELS = ("two-bounce", "closure", "surface")


@dataclass(frozen=True)
class Answer:
    """What one gave for one truth.

    Attributes
    ----------
    factor
        Shape (sigmas, geometries, patches, bands or 3).
    ends_in
        "bands" or "RGB".
    sliders
        Of a lobe, at each roughness.
    """

    factor: Array
    ends_in: str
    sliders: tuple[float, ...] = ()


def answers(judge: Judge, truth: Truth) -> dict[str, Answer]:
    """Ask everyone, by key."""
    geometries = truth.angles.shape[1]
    shown = np.repeat(truth.reading[:, np.newaxis], geometries, axis=1)
    found = {"lambert-as-read": Answer(shown, "bands")}
    for model in MODELS:
        found[f"{model}-matched"] = Answer(_model(model, truth), "bands")
    for key, of in chart_lobes.LOBES.items():
        found[f"{key}-matched"] = _lobe(judge, of, truth)
    return found


def _model(model: str, truth: Truth) -> Array:
    light, view, azimuth = truth.angles[:, :, np.newaxis]
    rows = []
    for sigma, readings in zip(truth.sigmas, truth.reading, strict=True):
        albedo = reading.to_albedo(readings, sigma, model)
        rows.append(ladder.reflectance(model, albedo[np.newaxis], light, view, azimuth, sigma))
    return np.stack(rows)


def _lobe(judge: Judge, of: chart_lobes.Lobe, truth: Truth) -> Answer:
    rows, sliders = [], []
    for wanted, readings in zip(truth.factor, truth.reading, strict=True):
        lab = judge.lab(wanted)

        def error(answer: Array, lab: Array = lab) -> float:
            return float(judge.from_lab(answer, lab, "RGB").mean())

        answer, slider = chart_lobes.match(of, readings @ judge.to_rgb, truth.angles, error)
        rows.append(answer)
        sliders.append(slider)
    return Answer(np.stack(rows), "RGB", tuple(sliders))


def timed(key: str) -> ForAnyAngle:
    """Give what the chart times of a lobe: many angles, the slider at a half."""
    of = chart_lobes.LOBES[key.removesuffix("-matched")]

    def angles(albedo: Array, directions: Array, _sigma: Any) -> Array:
        return of.reflectance(np.ascontiguousarray(albedo[:3]), 0.5, directions)

    return angles


def about(key: str, found: dict[str, Answer], degrees: list[int]) -> dict[str, Any]:
    """Label and words of one, without its numbers."""
    name = key.removesuffix("-matched")
    if name in MODELS:
        words = "the albedo behind the reading, then the model"
        return {"label": name, "group": RUNG, "about": words}
    if name == "lambert-as-read":
        words = "the reading, shown at every angle"
        return {"label": "Lambert, 45°/0° color", "group": RUNG, "about": words}
    of = chart_lobes.LOBES[name]
    pairs = zip(degrees, found[key].sliders, strict=True)
    words = f"{of.about}; slider {', '.join(f'{slider:.2f} at {s}°' for s, slider in pairs)}"
    return {"label": of.label, "group": PEER, "about": words}
