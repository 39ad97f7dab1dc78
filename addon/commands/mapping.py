# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which material gets which sample: mapping files, and matching by name."""

from __future__ import annotations

import argparse
import csv
import json
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, cast

import bpy

from ...core import instruments, limits
from ...core.errors import InputError, MaterialError
from .. import api
from ..blender import shader_nodes
from ..material import preferences, selection
from ..samples import library, readers, sets, stated_white
from ..samples.sample import COLORED, Kind, Sample
from ..samples.stated_sigma import Names, StatedSigma
from ..support import user_files

_SIGMA = Names("sigma_deg")
_OPTIONS = Names("--sigma", "--rdq", "--sdq")
_FIELDS = ("material", "sample", "file", *_SIGMA, "kind", "white", "white_factor", "read_at")


@dataclass(frozen=True)
class Row:
    """One assignment as asked for, and the file and row that say so, if any do.

    `read_at` is the virtual instrument; empty where nothing is said.
    """

    material: str
    sample: Sample
    where: str = ""
    read_at: str = ""


def rows(options: argparse.Namespace) -> list[Row]:
    """Give the assignments that the options of the verb `assign` ask for.

    Raises
    ------
    InputError
        If a file or a row of it cannot be used.
    """
    if options.mapping is not None:
        if options.material:
            msg = f"{options.mapping} names the materials already; leave --material out."
            raise InputError(msg)
        return read_mapping(options.mapping)
    if options.preset is not None:
        sample = library.load(options.preset, preferences.user_folder())
        if not options.material:
            msg = f"Name the materials that get {sample.name!r}, with --material NAME."
            raise InputError(msg)
        return [Row(name, sample) for name in options.material]
    return _by_name(options)


def _by_name(options: argparse.Namespace) -> list[Row]:
    samples = [sample for path in options.by_name for sample in readers.read(path)]
    names, named = dict.fromkeys(sample.name for sample in samples), sets.by_name(samples)
    shown = ", ".join(list(names)[:5]) + (", …" if len(names) > 5 else "")
    absent = [name for name in options.material if name not in named]
    if absent:
        msg = f"No sample is named {absent[0]!r}; the files have {shown}."
        raise InputError(msg)
    known = {material.name for material in bpy.data.materials}
    wanted = set(options.material or (names if options.create else known))
    chosen = [Row(s.name, s) for s in samples if s.name in wanted]
    chosen += [Row(n, s) for n, s in named.items() if n in wanted and n not in names]
    if not chosen:
        msg = f"No material is named like a sample ({shown}); rename, or use --mapping."
        raise InputError(msg)
    return chosen


def pair(chosen: list[Row], options: argparse.Namespace) -> list[tuple[Any, api.Request]]:
    """Find the materials and settle σ and kind; makes materials only with --create.

    Raises
    ------
    InputError, MaterialError
        If σ is out of range or a material is missing; none was made then.
    """
    sigma = StatedSigma(options.sigma, options.rdq, options.sdq)
    name, fault = sigma.fault(_OPTIONS)
    if fault:
        msg = f"The option {name}: {fault}."
        raise InputError(msg)
    requests = [_request(row, sigma, options) for row in chosen]
    known = selection.every()
    missing = [row.material for row in chosen if row.material not in known]
    if missing and not options.create:
        msg = (
            f"There is no material {missing[0]!r}"
            + (f" nor {len(missing) - 1} others" if len(missing) > 1 else "")
            + "; correct the names, or add --create to make them."
        )
        raise MaterialError(msg)
    for name in dict.fromkeys(missing):
        known[name] = shader_nodes.new_material(name)
        known[name].use_fake_user = True
    return [(known[row.material], request) for row, request in zip(chosen, requests, strict=True)]


def read_mapping(path: Path) -> list[Row]:
    """Read a mapping file, CSV or JSON.

    Raises
    ------
    InputError
        Naming file, row and remedy.
    """
    found = records(path, _FIELDS)
    if not found:
        msg = f"{path} has no rows; give one a material."
        raise InputError(msg)
    samples = Samples(path)
    return [_row(path, place, record, samples) for place, record in found]


def records(
    path: Path, fields: Sequence[str], needed: Sequence[str] = ("material", "sample")
) -> list[tuple[str, dict[str, Any]]]:
    """Read the rows of a table, CSV or JSON, each with its place in the file.

    Parameters
    ----------
    path
        The table.
    fields, needed
        Columns that there may be, and that there must be.

    Raises
    ------
    InputError
        If it is no such table, or a column is missing.
    """
    data = user_files.read(path)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        msg = f"{path} cannot be read ({error}); give a CSV or JSON file in UTF-8."
        raise InputError(msg) from error
    is_json = text.lstrip()[:1] in ("[", "{")
    if is_json:
        return _json_records(path, text, fields)
    return _csv_records(path, text, fields, needed)


def check_columns(where: str, record: dict[str, Any], fields: Sequence[str]) -> dict[str, str]:
    """Give the cells of a row as texts, empty where there is nothing.

    Raises
    ------
    InputError
        If the row has a column that is none of `fields`.
    """
    unknown = [key for key in record if key not in fields]
    if unknown:
        msg = f"{where}: {unknown[0]!r} is not a column; use {', '.join(fields)}."
        raise InputError(msg)
    given = {key: record.get(key) for key in fields}
    return {key: "" if cell is None else str(cell).strip() for key, cell in given.items()}


class Samples:
    """The samples that a table names, each looked up once."""

    def __init__(self, mapping: Path) -> None:
        self._folder = mapping.parent
        self._library = preferences.user_folder()
        self._files: dict[Path, dict[str, Sample]] = {}
        self._named: dict[str, Sample] = {}

    def find(self, where: str, name: str, file: str) -> Sample:
        """Give the sample of a file beside the table, or of library and presets."""
        if not file:
            return self._of_library(where, name)
        source = self._folder / file
        if source not in self._files:
            self._files[source] = sets.by_name(readers.read(source))
        found = self._files[source]
        if name not in found:
            names = ", ".join(list(found)[:5])
            msg = f"{where}: {source} has no sample {name!r}; it has {names}."
            raise InputError(msg)
        return found[name]

    def _of_library(self, where: str, name: str) -> Sample:
        if name not in self._named:
            try:
                self._named[name] = library.load(name, self._library)
            except InputError as error:
                msg = f"{where}: {error}"
                raise InputError(msg) from error
        return self._named[name]


def _json_records(path: Path, text: str, fields: Sequence[str]) -> list[tuple[str, dict[str, Any]]]:
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        msg = f"{path} is not valid JSON ({error}); correct it."
        raise InputError(msg) from error
    if not isinstance(data, list) or not all(isinstance(record, dict) for record in data):
        msg = f"{path} must be a list of objects with the keys {', '.join(fields)}."
        raise InputError(msg)
    return [(f"entry {number}", record) for number, record in enumerate(data, 1)]


def _csv_records(
    path: Path, text: str, fields: Sequence[str], needed: Sequence[str]
) -> list[tuple[str, dict[str, Any]]]:
    # Not `splitlines`, which would break names at U+0085 and the like.
    lines = [line for line in re.split("\r\n|[\r\n]", text) if not line.startswith("#")]
    header = lines[0] if lines else ""
    delimiter = max(",;\t", key=header.count)
    table = csv.reader(lines, delimiter=delimiter)
    try:
        names, *rows = [[cell.strip() for cell in row] for row in table if any(row)] or [[]]
    except csv.Error as error:
        msg = f"{path}: a quotation mark is not closed ({error}); close or remove it."
        raise InputError(msg) from error
    if not set(needed) <= set(names):
        msg = (
            f"{path}, header: found {', '.join(names) or 'nothing'}; the columns are "
            f"{', '.join(fields)}, of which {' and '.join(needed)} are needed."
        )
        raise InputError(msg)
    records = []
    for number, cells in enumerate(rows, 1):
        if len(cells) > len(names) and any(cells[len(names) :]):
            msg = (
                f"{path}, row {number}: {len(cells)} cells stand under {len(names)} columns; put "
                "names that hold the delimiter in quotation marks."
            )
            raise InputError(msg)
        records.append((f"row {number}", dict(zip(names, cells, strict=False))))
    return records


def _row(path: Path, place: str, record: dict[str, Any], samples: Samples) -> Row:
    where = f"{path}, {place}"
    cells = check_columns(where, record, _FIELDS)
    if not cells["material"] or not cells["sample"]:
        msg = f"{where}: material and sample must both be given."
        raise InputError(msg)
    sample = samples.find(where, cells["sample"], cells["file"])
    if cells["kind"] and cells["kind"] not in COLORED:
        msg = f"{where}: kind is {cells['kind']!r}; it is 'reading' or 'albedo'."
        raise InputError(msg)
    if cells["kind"]:
        sample = sample.taken_as(cast(Kind, cells["kind"]))
    try:
        sample = stated_white.given(sample, cells["white"], cells["white_factor"])
    except InputError as error:
        raise InputError(f"{where}: {error}") from error
    sigma = StatedSigma(*(_number(where, name, cells[name]) for name in _SIGMA))
    _, fault = sigma.fault(_SIGMA)
    if fault:
        raise InputError(f"{where}: {fault}.")
    sample = _with_sigma(sample, sigma, f"Stated in {path.name}, {place}.")
    read_at = cells["read_at"]
    if read_at and read_at not in instruments.REGISTRY:
        names = ", ".join(instruments.REGISTRY)
        raise InputError(f"{where}: read_at is {read_at!r}; make it one of {names}.")
    return Row(cells["material"], sample, where, read_at)


def _number(where: str, name: str, cell: str) -> float | None:
    if not cell:
        return None
    try:
        number = float(cell)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        what = "degrees as a number" if name == _SIGMA.degrees else "a slope as a number"
        raise InputError(f"{where}: {name} is {cell!r}; give {what}.")
    return number


def _with_sigma(sample: Sample, sigma: StatedSigma, about: str) -> Sample:
    """Give a sample with the σ that was stated for it, and where that comes from."""
    degrees = sigma.settled
    if degrees is None or (degrees == sample.sigma_degrees and not sigma.slope):
        return sample
    return replace(sample, sigma_degrees=degrees, sigma_source=sigma.source(about))


def _request(row: Row, sigma: StatedSigma, options: argparse.Namespace) -> api.Request:
    where, degrees = row.where or f"Material {row.material!r}", row.sample.sigma_degrees
    if sigma.settled is not None:  # the option counts, whatever the row says
        where, degrees = f"Material {row.material!r}", sigma.settled
    if fault := limits.sigma_fault(degrees or 0.0):
        raise InputError(f"{where}: {fault}")
    sample = stated_white.given(row.sample, options.white, options.white_factor)
    return api.request(
        _with_sigma(sample, sigma, "Stated as an option."),
        math.radians(degrees or 0.0),
        kind=options.kind,
        model=options.model,
        illuminant=options.illuminant,
        observer=options.observer,
        read_at=options.read_at or row.read_at or instruments.DEFAULT,
    )
