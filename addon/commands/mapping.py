# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which material gets which sample: mapping files, and matching by name."""

from __future__ import annotations

import argparse
import csv
import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, cast

import bpy

from ...core import instruments, limits
from ...core.errors import InputError, MaterialError, RoughSpectraError
from ...core.models import NAMES
from .. import api
from ..blender import shader_nodes
from ..colorimetry import tristimulus
from ..colorimetry.tristimulus import ILLUMINANTS, OBSERVERS
from ..matching import shaders
from ..material import preferences, selection
from ..samples import library, readers, sets, stated_white
from ..samples.readers.parts.document import quote
from ..samples.sample import COLORED, Kind, Sample, in_units_of
from ..samples.stated_sigma import Names, StatedSigma
from ..support import user_files
from . import reader_notes

_SIGMA = Names("sigma_deg")
_OPTIONS = Names("--sigma", "--rdq", "--sdq")
_CHOICES: dict[str, tuple[str, ...]] = {
    "kind": COLORED,
    "read_at": tuple(instruments.REGISTRY),
    "illuminant": tuple(ILLUMINANTS),
    "observer": tuple(map(str, OBSERVERS)),
    "model": ("auto", *NAMES),
    "shader": tuple(name.lower() for name in (shaders.AUTO, *shaders.NAMES)),
    "instrument": tuple(instruments.REGISTRY),
}
"""Columns whose cells are one of these words."""
_FIELDS = (
    *("material", "sample", "file", *_SIGMA, "kind", "white", "white_factor", "read_at"),
    *("illuminant", "observer", "model", "shader", "instrument", "scale"),
)


@dataclass(frozen=True)
class Row:
    """One assignment as asked for, and the file and row that say so, if any do.

    `material` may hold `*` and `?` where a file says so. `said` has what the row says of the
    options `read_at`, `illuminant`, `observer`, `model` and `shader`, and nothing where it doesn't.
    """

    material: str
    sample: Sample
    where: str = ""
    said: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Assignment:
    """A material, what it is to become, the shader, and the file and row that say so, if any."""

    material: Any
    request: api.Request
    shader: str
    where: str


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


def pair(chosen: list[Row], options: argparse.Namespace) -> list[Assignment]:
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
    known = selection.every()
    chosen = _meant(chosen, known)
    requests = [_request(row, sigma, options) for row in chosen]
    missing = [row for row in chosen if row.material not in known]
    if missing and not options.create:
        others = f" nor {len(missing) - 1} others" if len(missing) > 1 else ""
        msg = (
            f"{_place(missing[0])}there is no material {quote(missing[0].material)}{others}; "
            "correct the names, or add --create to make them."
        )
        raise MaterialError(msg[0].upper() + msg[1:])
    for name in dict.fromkeys(row.material for row in missing):
        known[name] = shader_nodes.new_material(name)
        known[name].use_fake_user = True
    return [
        Assignment(
            known[row.material],
            request,
            options.shader or row.said.get("shader") or shaders.AUTO.lower(),
            row.where,
        )
        for row, request in zip(chosen, requests, strict=True)
    ]


def assign(assignments: Sequence[Assignment], gloss: str) -> list[api.Solution]:
    """Assign all of them or none; an error names the file and the row that it is about.

    Raises
    ------
    MaterialError, DomainError
        As `api.assign`.
    """
    pairs = [(each.material, each.request) for each in assignments]
    try:
        return api.assign(pairs, [each.shader for each in assignments], gloss)
    except RoughSpectraError as error:
        where = next((each.where for each in assignments if _refused(each, gloss)), "")
        raise type(error)(f"{where}: {error}" if where else str(error)) from error


def _refused(each: Assignment, gloss: str) -> bool:
    """Whether an assignment fails by itself."""
    try:
        shader_nodes.find(each.material, each.shader.upper(), gloss == "keep")
        tristimulus.weights(each.request.sample.wavelengths, each.request.illuminant)
    except RoughSpectraError:
        return True
    return False


def _meant(chosen: list[Row], known: Mapping[str, Any]) -> list[Row]:
    """Give a row a material, where a file's rows name several by `*` and `?`.

    A row that names a material in full wins over those that name it by a pattern.

    Raises
    ------
    InputError
        If two rows of a file ask for the same material in the same way, or a pattern for none.
    """
    local = [
        name
        for name, material in known.items()
        if material.library is None and not getattr(material, "is_grease_pencil", False)
    ]
    exact: dict[str, Row] = {}
    by_pattern: dict[str, Row] = {}
    for row in chosen:
        pattern = bool(row.where) and selection.is_pattern(row.material)
        names, found = [row.material], exact
        if pattern and row.material not in known:
            names, found = selection.matching(row.material, local), by_pattern
            if not names:
                msg = (
                    f"{row.where}: no material is called like {row.material!r}; correct the name, "
                    "or name the materials one by one to make them."
                )
                raise InputError(msg)
        for name in names:
            if name in found and row.where:
                before = found[name].where.removeprefix(row.where.partition(", ")[0] + ", ")
                msg = (
                    f"{row.where}: material {quote(name)} is named twice, in {before} before; give "
                    "it one spectrum."
                )
                raise InputError(msg)
            found[name] = row
    if not by_pattern:
        return chosen
    settled = by_pattern | exact
    order = {id(row): number for number, row in enumerate(chosen)}
    named = sorted(settled, key=lambda name: order[id(settled[name])])
    return [replace(settled[name], material=name) for name in named]


def _place(row: Row) -> str:
    return f"{row.where}: " if row.where else ""


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
        msg = f"{where}: {quote(unknown[0])} is not a column; use {', '.join(fields)}."
        raise InputError(msg)
    given = {key: record.get(key) for key in fields}
    return {key: "" if cell is None else str(cell).strip() for key, cell in given.items()}


class Samples:
    """The samples that a table names, each looked up once."""

    def __init__(self, mapping: Path) -> None:
        self._folder = mapping.parent
        self._library = preferences.user_folder()
        self._files: dict[tuple[Path, float], dict[str, Sample]] = {}
        self._named: dict[str, Sample] = {}

    def find(self, where: str, name: str, file: str, scale: float = 1.0) -> Sample:
        """Give the sample of a file beside the table, or of library and presets.

        `scale` is what stands for a reflectance of 1 in the file.
        """
        if not file:
            return self._of_library(where, name)
        source = self._folder / file
        if (source, scale) not in self._files:
            try:
                with in_units_of(scale):
                    samples = readers.read(source)
            except InputError as error:
                raise InputError(f"{where}: {error}") from error
            self._files[source, scale] = sets.by_name(samples)
        found = self._files[source, scale]
        if name not in found:
            names = ", ".join(list(found)[:5])
            msg = f"{where}: {source} has no sample {quote(name)}; it has {names}."
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
        found = quote(", ".join(names)) if names else "nothing"
        msg = (
            f"{path}, header: found {found}; the columns are {', '.join(fields)}, of which "
            f"{' and '.join(needed)} are needed."
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
    for name, words in _CHOICES.items():
        if cells[name] and cells[name] not in words:
            msg = f"{where}: {name} is {quote(cells[name])}; make it one of {', '.join(words)}."
            raise InputError(msg)
    scale = _number(where, "scale", cells["scale"])
    sample = samples.find(where, cells["sample"], cells["file"], scale or 1.0)
    try:
        if scale is not None:
            sample = sample.divided_by(scale, f"as stated in {path.name}, {place}")
        if cells["kind"]:
            sample = sample.taken_as(cast(Kind, cells["kind"]))
        if cells["instrument"]:
            sample = reader_notes.read_by(sample, cells["instrument"])
        sample = stated_white.given(sample, cells["white"], cells["white_factor"])
    except InputError as error:
        raise InputError(f"{where}: {error}") from error
    sigma = StatedSigma(*(_number(where, name, cells[name]) for name in _SIGMA))
    _, fault = sigma.fault(_SIGMA)
    if fault:
        raise InputError(f"{where}: {fault}.")
    sample = _with_sigma(sample, sigma, f"Stated in {path.name}, {place}.")
    said = {name: cells[name] for name in _OF_OPTIONS if cells[name]}
    return Row(cells["material"], sample, where, said)


_OF_OPTIONS = ("read_at", "illuminant", "observer", "model", "shader")
"""Columns that say for a row what an option says for all; the option wins."""
_NUMBERS = {
    _SIGMA.degrees: "degrees as a number",
    "scale": "what stands for a reflectance of 1, a number above 0 such as 100",
}


def _number(where: str, name: str, cell: str) -> float | None:
    if not cell:
        return None
    try:
        number = float(cell)
    except ValueError:
        number = math.nan
    if not math.isfinite(number) or (name == "scale" and number <= 0):
        what = _NUMBERS.get(name, "a slope as a number")
        raise InputError(f"{where}: {name} is {quote(cell)}; give {what}.")
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
    said = row.said
    try:
        sample = stated_white.given(row.sample, options.white, options.white_factor)
        return api.request(
            _with_sigma(sample, sigma, "Stated as an option."),
            math.radians(degrees or 0.0),
            kind=options.kind,
            model=options.model or said.get("model") or "auto",
            illuminant=options.illuminant or said.get("illuminant") or "D65",
            observer=options.observer or int(said.get("observer") or 2),
            read_at=options.read_at or said.get("read_at") or instruments.DEFAULT,
        )
    except RoughSpectraError as error:
        if not row.where:
            raise
        raise type(error)(f"{row.where}: {error}") from error
