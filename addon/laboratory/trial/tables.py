# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the experiment found, as tables of Markdown. "–" stands where there is no answer."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from ....core import models
from .meshes import Grays
from .results import Inferred, Read

SHOWN_GRAYS = (0.1, 0.35, 0.65, 0.96)
"""Albedos of the table of what was measured; the file has all."""

INVERTED = ("two-bounce", "closure", "reference", "surface")
"""Models that the table of albedos compares."""


def measured(grays: Sequence[Grays]) -> str:
    """Tell what was measured of meshes, and how well the closed form holds it."""
    lines = []
    for of in grays:
        shown = [
            f"{of.reflectance[np.isclose(of.albedo, albedo)][0]:.4f}"
            for albedo in SHOWN_GRAYS
            if np.isclose(of.albedo, albedo).any()
        ]
        noise = 100 * float((of.noise / of.reflectance).max())
        lines.append((of.name, *shown, f"{noise:.3f} %", f"{100 * of.fitted.residual:.3f} %"))
    head = ("surface", *(f"ρ = {albedo:g}" for albedo in SHOWN_GRAYS))
    return _markdown((*head, "standard error, at most", "closed form off by, at most"), lines)


def differences(reads: Sequence[Read], which: str) -> str:
    """Give ΔE00 of each model's predictions by surface: mean and largest over its readings.

    Parameters
    ----------
    reads
        All readings.
    which
        "stated" or "own": see `Read`.
    """
    names = models.NAMES if which == "stated" else models.NAMES[1:]
    lines = [
        (name, *(_mean_and_largest([getattr(r, which)[model] for r in of]) for model in names))
        for name, of in _by_surface(reads)
    ]
    return _markdown(("surface", *names), lines)


def percents(reads: Sequence[Read]) -> str:
    """Give by how many percent each model is off with the known σ: mean over bands and readings."""
    lines = [
        (name, *(_mean([r.stated_percent[model] for r in of], " %") for model in models.NAMES))
        for name, of in _by_surface(reads)
    ]
    return _markdown(("surface", *models.NAMES), lines)


def sigmas(found: Sequence[Inferred]) -> str:
    """Give σ inferred beside the known one."""
    by = list(found[0].by_model) if found else []
    lines = [
        (
            of.surface,
            _degrees(of.stated),
            f"{_degrees(of.sigma)} ({of.low:.2f} to {of.high:.2f})",
            f"{_degrees(of.least)}, {_degrees(of.median)}, {_degrees(of.most)}",
            f"{of.told} of {of.materials}",
            *(_degrees(of.by_model[model]) for model in by),
        )
        for of in found
    ]
    head = ("surface", "known", "from all (by noise)", "from one: least, median, most", "told by")
    return _markdown((*head, *(f"all, {model}" for model in by)), lines)


def remarks(found: Sequence[Inferred]) -> list[str]:
    """Give what to know of surfaces: whose σ can't be told, and what to doubt."""
    untold = [f"{of.surface}: {of.reason}" for of in found if math.isnan(of.sigma)]
    return untold + [f"{of.surface}: {of.notes}" for of in found if of.notes]


def albedos(reads: Sequence[Read]) -> str:
    """Give ΔE00 of the inferred albedo by surface: known σ / σ from other materials, means."""
    lines = []
    for name, of in _by_surface(reads):
        pairs = (
            (_mean([r.albedo_stated[m] for r in of]), _mean([r.albedo_own[m] for r in of]))
            for m in INVERTED
        )
        lines.append((name, _mean([r.raw for r in of]), *(" / ".join(pair) for pair in pairs)))
    return _markdown(("surface", "reading as it is", *INVERTED), lines)


def _by_surface(reads: Iterable[Read]) -> list[tuple[str, list[Read]]]:
    found: dict[str, list[Read]] = {}
    for read in reads:
        found.setdefault(read.surface, []).append(read)
    return list(found.items())


def _known(values: Iterable[float]) -> list[float]:
    return [value for value in values if math.isfinite(value)]


def _mean(values: Iterable[float], unit: str = "") -> str:
    known = _known(values)
    return f"{np.mean(known):.2f}{unit}" if known else "–"


def _mean_and_largest(values: Iterable[float]) -> str:
    known = _known(values)
    return f"{np.mean(known):.2f} ({max(known):.2f})" if known else "–"


def _degrees(value: float) -> str:
    return f"{value:.1f}°" if math.isfinite(value) else "–"


def _markdown(head: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    rule = ["---"] + ["--:"] * (len(head) - 1)
    cells = ([_escaped(cell) for cell in line] for line in (head, rule, *lines))
    return "\n".join("| " + " | ".join(line) + " |" for line in cells) + "\n"


def _escaped(cell: str) -> str:
    return cell.replace("|", "\\|").replace("\n", " ")
