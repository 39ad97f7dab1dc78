# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The experiment as files: a page with its pictures, and the numbers as tables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ....core.numerics.arrays import Array
from ...support import atomic_files, png
from ...support.version import version
from . import figures, meshes, results, tables
from .figures import Panel
from .meshes import Grays
from .results import Inferred, Read


@dataclass(frozen=True, eq=False)
class Found:
    """All that a page is made of.

    Attributes
    ----------
    reads, inferred
        What `judge` gave.
    panels
        Readings over albedo.
    grays
        What was measured of meshes; empty where readings were given.
    notes
        Sentences for the page: where the readings are from.
    """

    reads: Sequence[Read]
    inferred: Sequence[Inferred]
    panels: Sequence[Panel]
    grays: Sequence[Grays]
    notes: Sequence[str]

    @property
    def is_known(self) -> bool:
        """Whether σ of a surface is known from elsewhere."""
        return any(of.stated == of.stated for of in self.inferred)

    @property
    def has_albedo(self) -> bool:
        """Whether a material was read smooth, too."""
        return bool(self.panels)


def pictures(found: Found) -> dict[str, Callable[[], Array]]:
    """Give how to draw each picture that there are numbers for, by its name."""
    drawn: dict[str, Callable[[], Array]] = {}
    if found.has_albedo:
        drawn["albedo"] = lambda: figures.over_albedo(found.panels)
        if found.is_known:
            drawn["known"] = lambda: figures.differences(found.reads, "stated")
        drawn["own"] = lambda: figures.differences(found.reads, "own")
    drawn["sigma"] = lambda: figures.sigmas(found.inferred)
    return drawn


def parts(found: Found) -> dict[str, str]:
    """Give the tables that there are numbers for, by their names."""
    given = {}
    if found.grays:
        given["measured"] = tables.measured(found.grays)
    if found.has_albedo:
        if found.is_known:
            given["known"] = tables.differences(found.reads, "stated")
            given["percent"] = tables.percents(found.reads)
        given["own"] = tables.differences(found.reads, "own")
        given["albedo"] = tables.albedos(found.reads)
    given["sigma"] = tables.sigmas(found.inferred)
    return given


def write(found: Found, base: Path) -> list[Path]:
    """Write BASE.md, BASE.csv, BASE.sigma.csv, BASE.measured.csv and pictures: all or none.

    Raises
    ------
    OutputError
        A file cannot be written or replaced; none was touched.
    """
    atomic_files.check_base(base)
    written: list[Path] = []

    def named(ending: str) -> Path:
        written.append(base.with_name(f"{base.name}.{ending}"))
        return written[-1]

    with atomic_files.publication() as files:
        files.write(named("md"), _page(found, base.name).encode())
        files.write(named("csv"), results.reads_csv(found.reads))
        files.write(named("sigma.csv"), results.inferred_csv(found.inferred))
        if found.grays:
            files.write(named("measured.csv"), meshes.to_csv(found.grays))
        for name, draw in pictures(found).items():
            files.write(named(f"{name}.png"), png.encode(draw()))
    return written


_TITLES = {
    "measured": "What was measured",
    "known": "Predicted with the σ that is known",
    "percent": "The same in percent",
    "own": "Predicted with a σ of the model's own",
    "sigma": "σ inferred",
    "albedo": "Albedo inferred",
}

_WORDS = {
    "measured": "Reflectance factors of gray facets; the closed form that is fitted to them tells "
    "all other albedos.",
    "known": "ΔE00 (D65, 2°) between the reading and what the model predicts from the smooth "
    "reading and σ: mean and, in brackets, largest over the readings of a surface.",
    "percent": "By how much the prediction is off, mean over readings and those of their bands "
    "that read 1 % or more.",
    "own": "ΔE00 as before, with the σ that each model finds by itself from the *other* materials "
    "of the surface: what is left is the form of the model, and not what σ means in it.",
    "sigma": "Inferred from smooth and rough readings: by the model surface from all materials of "
    "a surface, with the interval that noise leaves open; from single materials; and by each "
    "model.",
    "albedo": "ΔE00 between the smooth material and the albedo behind its rough reading alone: "
    "with the known σ / with the σ that the model finds from the other materials.",
}

_PICTURED = {
    "measured": ("albedo", "Reading over albedo: points measured, curves by model"),
    "known": ("known", "Mean ΔE00 by model and surface, with the known σ"),
    "own": ("own", "Mean ΔE00 by model and surface, each with its own σ"),
    "sigma": ("sigma", "σ by model and surface; gray: the range from single materials"),
}


def _page(found: Found, name: str) -> str:
    lines = ["# Rough surfaces: measured, predicted, inferred", ""]
    lines += [f"Written by Rough Spectra {version()}.", ""]
    lines += [line for note in found.notes for line in (note, "")]
    given, drawn = parts(found), pictures(found)
    if "measured" not in given and "albedo" in drawn:
        lines += ["## Reading over albedo", "", *_picture(name, "measured")]
    for part, table in given.items():
        lines += [f"## {_TITLES[part]}", "", _WORDS[part], "", table]
        if part in _PICTURED and _PICTURED[part][0] in drawn:
            lines += _picture(name, part)
    lines += [f"- {sentence}" for sentence in tables.remarks(found.inferred)]
    if not found.has_albedo:
        lines += ["", "No material has a smooth reading, so that nothing could be predicted."]
    return "\n".join(lines).rstrip() + "\n"


def _picture(name: str, part: str) -> list[str]:
    which, words = _PICTURED[part]
    return [f"![{words}](<{name}.{which}.png>)", ""]
