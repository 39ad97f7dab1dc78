# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which reading is of which surface, for the verb `estimate`, and the table that it writes."""

from __future__ import annotations

import argparse
import csv
import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...core import instruments
from ...core.errors import InputError
from ...core.estimate import Estimate
from ..matching import roughness
from ..material import preferences
from ..readings.writers.tables import nanometers
from ..samples import library, readers, sets
from ..samples.sample import Sample
from ..support.shown_text import to_cell
from ..support.version import version
from . import mapping, reader_notes

SMOOTH = "smooth"
"""What the column `surface` calls a surface without roughness; all other words are roughnesses."""

FIELDS = ("sample", "surface", "material", "file", "instrument")
"""Columns of its table."""
_NEEDED = ("sample", "surface")


@dataclass(frozen=True)
class Surface:
    """One roughness, and its materials: what was read of each when smooth, and of each so rough."""

    name: str
    materials: list[tuple[list[Sample], list[Sample]]]

    @property
    def samples(self) -> list[tuple[int, bool, Sample]]:
        """Number of material, whether rough, and sample, in the order of an estimate's readings."""
        found = [roughness.used(*pair) for pair in self.materials]
        return [
            (number, rough, sample)
            for number, each in enumerate(found)
            for rough, part in ((False, each.smooth), (True, each.rough))
            for sample in part
        ]


def surfaces(options: argparse.Namespace) -> list[Surface]:
    """Give the surfaces that the options of the verb `estimate` name.

    Raises
    ------
    InputError
        If a file, a row or a name cannot be used.
    """
    if options.mapping is not None:
        if options.files or options.smooth or options.rough:
            msg = f"{options.mapping} names the readings already; leave files and names out."
            raise InputError(msg)
        return read_table(options.mapping)
    return [_by_names(options.files, options.smooth, options.rough)]


def read_table(path: Path) -> list[Surface]:
    """Read which sample is of which surface from a table, CSV or JSON.

    Raises
    ------
    InputError
        Naming file, row and remedy.
    """
    smooth: dict[str, list[Sample]] = {}
    rough: dict[str, dict[str, list[Sample]]] = {}
    for _, cells, sample in rows(path, FIELDS):
        of = smooth if cells["surface"] == SMOOTH else rough.setdefault(cells["surface"], {})
        of.setdefault(cells["material"], []).append(sample)
    if not rough:
        msg = f"{path} has no row of a rough surface; name its roughness in the column surface."
        raise InputError(msg)
    return [
        Surface(name, [(smooth.get(material, []), of[material]) for material in of])
        for name, of in rough.items()
    ]


def rows(path: Path, fields: Sequence[str]) -> Iterator[tuple[str, dict[str, str], Sample]]:
    """Read the rows of a table of readings: place for messages, cells by column, and sample.

    Parameters
    ----------
    path
        CSV or JSON.
    fields
        The columns that it may have, those of the verb `estimate` among them.

    Raises
    ------
    InputError
        Naming file, row and remedy.
    """
    samples = mapping.Samples(path)
    for place, record in mapping.records(path, fields, _NEEDED):
        where = f"{path}, {place}"
        cells = mapping.check_columns(where, record, fields)
        if not cells["sample"] or not cells["surface"]:
            msg = f"{where}: sample and surface must both be given."
            raise InputError(msg)
        sample = samples.find(where, cells["sample"], cells["file"])
        if cells["instrument"]:
            if cells["instrument"] not in instruments.REGISTRY:
                known = ", ".join(instruments.REGISTRY)
                msg = f"{where}: instrument is {cells['instrument']!r}; make it one of: {known}."
                raise InputError(msg)
            sample = reader_notes.read_by(sample, cells["instrument"])
        yield where, cells, sample


def _by_names(files: Sequence[Path], smooth: Sequence[str], rough: Sequence[str]) -> Surface:
    """Pair the names given: each rough one with its smooth one, or all with one, or with none."""
    if not rough:
        msg = "Name the readings of the rough surface, with --rough NAME; or give --mapping FILE."
        raise InputError(msg)
    known = sets.by_name([sample for path in files for sample in readers.read(path)])

    def find(name: str) -> Sample:
        if not files:
            return library.load(name, preferences.user_folder())
        if name not in known:
            shown = ", ".join(list(known)[:5]) + (", …" if len(known) > 5 else "")
            msg = f"No sample is named {name!r}; the files have {shown}."
            raise InputError(msg)
        return known[name]

    smooth_samples, rough_samples = [find(s) for s in smooth], [find(r) for r in rough]
    if len(smooth) <= 1:
        return Surface("rough", [(smooth_samples, rough_samples)])
    if len(smooth) != len(rough):
        msg = (
            f"{len(smooth)} smooth readings stand beside {len(rough)} rough ones; name one for "
            "each, in the same order, or one for all, or give --mapping FILE."
        )
        raise InputError(msg)
    pairs = zip(smooth_samples, rough_samples, strict=True)
    return Surface("rough", [([of_smooth], [of_rough]) for of_smooth, of_rough in pairs])


def table(found: Sequence[tuple[Surface, Estimate]], relative: float, absolute: float) -> bytes:
    """Give the estimates as CSV: a row a reading, with what its surface's σ is."""
    models = list(dict.fromkeys(name for _, estimate in found for name in estimate.by_model))
    bands = sorted(
        {float(nm) for surface, _ in found for *_, of in surface.samples for nm in of.wavelengths}
    )
    header = ["surface", "sigma_deg", "low_deg", "high_deg", "told", "standard_error_deg", "model"]
    header += [f"sigma_deg {name}" for name in models]
    header += ["spread_low_deg", "spread_high_deg", "chi_square", "freedom", "reason"]
    header += ["material", "sample", "smooth", "instrument", "rms_residual"]
    header += [f"residual {nanometers(nm)} nm" for nm in bands]
    text = io.StringIO()
    text.write(
        f"# creator: Rough Spectra {version()}\n"
        "# quantity: roughness sigma estimated from readings; low and high: 95 % by noise\n"
        f"# repeatability: {relative:g} of the reading and {absolute:g}, in quadrature\n"
        "# residual: reading less prediction, fraction; empty where a band was left out\n"
    )
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    for surface, estimate in found:
        about = _about(surface.name, estimate, models)
        for (number, rough, sample), residuals in zip(
            surface.samples, estimate.residuals, strict=True
        ):
            at = dict(zip(sample.wavelengths.tolist(), residuals.tolist(), strict=True))
            kept = residuals[np.isfinite(residuals)]
            rms = math.sqrt(float(np.mean(kept**2))) if kept.size else math.nan
            name = list(estimate.albedo)[number].partition(" ")[2]
            cells = [to_cell(name), to_cell(sample.name), "no" if rough else "yes"]
            cells += [sample.instrument, _number(rms, 6)]
            cells += [_number(at.get(nm, math.nan), 6) for nm in bands]
            writer.writerow(about + cells)
    return text.getvalue().encode()


def _about(name: str, estimate: Estimate, models: Sequence[str]) -> list[str]:
    degrees = [estimate.sigma, *estimate.interval]
    spread = [estimate.by_model.get(model, math.nan) for model in models] + [*estimate.spread]
    angles = [_number(math.degrees(angle), 3) for angle in degrees]
    others = [_number(math.degrees(angle), 3) for angle in spread]
    told = ["yes" if estimate.is_told else "no"]
    error = [_number(math.degrees(estimate.standard_error), 4), estimate.model]
    fit = [_number(estimate.chi_square, 2), str(estimate.freedom), to_cell(estimate.reason)]
    return [to_cell(name), *angles, *told, *error, *others, *fit]


def _number(value: float, digits: int) -> str:
    """Give a number for a cell, which is empty where there is none."""
    return f"{value:.{digits}f}" if math.isfinite(value) else ""
