# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `judge` found, as tables that can be read again: all that pages and figures are made of."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ....core import models
from ....core.errors import InputError
from ...support import user_files
from ...support.shown_text import from_cell, to_cell

_PER_MODEL = ("stated", "stated_percent", "own", "albedo_stated", "albedo_own")


@dataclass(frozen=True)
class Read:
    """One reading of a rough surface against the models; NaN where there is no answer.

    Attributes
    ----------
    surface, material, sample, instrument
        Of what, and what it was read with.
    raw
        ΔE00 between the reading and the smooth material: what roughness did to the color.
    stated
        By model: ΔE00 between the reading and its prediction with the σ that is known.
    stated_percent
        Mean over bands of what the prediction is off by, percent of the reading.
    own
        By model: ΔE00 with the σ that this model finds from the surface's other materials.
    albedo_stated, albedo_own
        By model: ΔE00 between the smooth material and the albedo inferred from the rough reading
        alone, with these two σ.
    """

    surface: str
    material: str
    sample: str
    instrument: str
    raw: float
    stated: dict[str, float]
    stated_percent: dict[str, float]
    own: dict[str, float]
    albedo_stated: dict[str, float]
    albedo_own: dict[str, float]


@dataclass(frozen=True)
class Inferred:
    """σ of a surface, degrees; NaN where there is none.

    Attributes
    ----------
    surface
        Its name.
    stated
        As known from elsewhere.
    sigma, low, high
        From all its materials, and what noise leaves open.
    reason
        What limits it, or why it can't be told.
    notes
        Sentences on what was left out, and what to doubt.
    materials, told, least, median, most
        How many there are with a smooth reading; of how many the pair alone tells σ; and these.
    by_model
        From all its materials, by each model.
    """

    surface: str
    stated: float
    sigma: float
    low: float
    high: float
    reason: str
    notes: str
    materials: int
    told: int
    least: float
    median: float
    most: float
    by_model: dict[str, float]


def reads_csv(reads: Sequence[Read]) -> bytes:
    """Give a table of readings, which `reads_from_csv` reads."""
    names = [f"{field} {model}" for field in _PER_MODEL for model in models.NAMES]
    rows = [
        [
            *map(to_cell, (of.surface, of.material, of.sample)),
            of.instrument,
            _number(of.raw),
            *(_number(getattr(of, field)[m]) for field in _PER_MODEL for m in models.NAMES),
        ]
        for of in reads
    ]
    header = ["surface", "material", "sample", "instrument", "raw", *names]
    about = (
        "CIEDE2000, D65, 2 deg observer; stated: with the sigma that is known; own: with that found"
        " by the model from other materials of the surface; percent: mean over bands"
    )
    return _csv(about, header, rows)


def reads_from_csv(path: Path) -> list[Read]:
    """Read what `reads_csv` wrote.

    Raises
    ------
    InputError
        If it is no such table.
    """
    found = []
    for row in _rows(path, "raw"):
        by_field = [
            {model: _value(row[f"{field} {model}"]) for model in models.NAMES}
            for field in _PER_MODEL
        ]
        stated, percent, own, albedo_stated, albedo_own = by_field
        surface, material, sample = (
            from_cell(row[name]) for name in ("surface", "material", "sample")
        )
        found.append(
            Read(
                *(surface, material, sample, row["instrument"], _value(row["raw"])),
                stated=stated,
                stated_percent=percent,
                own=own,
                albedo_stated=albedo_stated,
                albedo_own=albedo_own,
            )
        )
    return found


_NUMBERS = ("stated", "sigma", "low", "high", "least", "median", "most")
_COUNTS = ("materials", "told")
_WORDS = ("reason", "notes")


def inferred_csv(found: Sequence[Inferred]) -> bytes:
    """Give a table of surfaces, which `inferred_from_csv` reads."""
    by = list(found[0].by_model) if found else []
    rows = [
        [
            to_cell(of.surface),
            *(_number(getattr(of, name)) for name in _NUMBERS),
            *(str(getattr(of, name)) for name in _COUNTS),
            *(to_cell(getattr(of, name)) for name in _WORDS),
            *(_number(of.by_model[model]) for model in by),
        ]
        for of in found
    ]
    header = ["surface", *_NUMBERS, *_COUNTS, *_WORDS, *(f"by {model}" for model in by)]
    return _csv("sigma of surfaces, degrees", header, rows)


def inferred_from_csv(path: Path) -> list[Inferred]:
    """Read what `inferred_csv` wrote.

    Raises
    ------
    InputError
        If it is no such table.
    """
    found = []
    for row in _rows(path, "sigma"):
        stated, sigma, low, high, least, median, most = (_value(row[name]) for name in _NUMBERS)
        materials, told = (int(row[name]) for name in _COUNTS)
        reason, notes = (from_cell(row[name]) for name in _WORDS)
        by = {key[3:]: _value(cell) for key, cell in row.items() if key.startswith("by ")}
        found.append(
            Inferred(
                surface=from_cell(row["surface"]),
                stated=stated,
                sigma=sigma,
                low=low,
                high=high,
                reason=reason,
                notes=notes,
                materials=materials,
                told=told,
                least=least,
                median=median,
                most=most,
                by_model=by,
            )
        )
    return found


def _csv(about: str, header: Sequence[str], rows: Sequence[Sequence[str]]) -> bytes:
    text = io.StringIO()
    text.write(f"# {about}\n")
    table = csv.writer(text, lineterminator="\n")
    table.writerow(header)
    table.writerows(rows)
    return text.getvalue().encode()


def _rows(path: Path, needed: str) -> list[dict[str, str]]:
    text = user_files.read(path).decode("utf-8", "replace")
    table = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    if needed not in (table.fieldnames or ()):
        msg = f"{path} has no column {needed!r} in its header; have it written again."
        raise InputError(msg)
    return list(table)


def _number(value: float) -> str:
    return f"{value:.4f}" if math.isfinite(value) else ""


def _value(cell: str) -> float:
    return float(cell) if cell else math.nan
