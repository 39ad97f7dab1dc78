# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""JCAMP-DX 4.24 and 5: one spectrum, or several blocks in one file.

Records ``##LABEL= value``, comments from ``$$`` on; spaces, dashes, slashes and underscores in
labels do not count. YUNITS= REFLECTANCE is a fraction unless it says percent. Ordinates in all
forms of the standard (`jcamp_ordinates`); what its checkpoints find is refused.
"""

from __future__ import annotations

import bisect
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...sample import Sample
from ..parts import label_words, series, statements, tables
from ..parts.document import Document, quote
from ..parts.geometry_words import instrument_of, is_geometry, specular_of
from ..parts.jcamp_ordinates import Ordinates, Pairs

NAME = "JCAMP-DX"
ENDINGS = ("jdx", "dx", "jcamp")
PRIORITY = 95

_WAVENUMBERS = re.compile(r"1/cm|cm *\^?-1|wave *numbers?", re.IGNORECASE)
_NM_CM = 1e7  # nanometers in a centimeter
_NO_LIGHT = re.compile(r"\bnmr\b|\bmass\b|\bms\b|chromatogra|raman", re.IGNORECASE)
_PERCENT = re.compile(r"%|percent|pct", re.IGNORECASE)
_LETTER = re.compile(r"%?\s*R\s*[\[(]?%?[\])]?", re.IGNORECASE)
_LABEL = re.compile(r"##([^=]{1,80})=(.*)")
_TABLES = {"XYDATA", "XYPOINTS"}
_UNREAD = {"NTUPLES", "RADATA", "PEAKTABLE", "PEAKASSIGNMENTS"}


@dataclass
class _Block:
    line: int
    texts: dict[str, str] = field(default_factory=dict)
    lines: dict[str, int] = field(default_factory=dict)
    table: Ordinates | Pairs | None = None


def sniff(document: Document) -> bool:
    """Return whether the file begins with a record and has that of the version or of a table."""
    head = document.head_text.lstrip()
    return head.startswith("##") and bool(
        re.search(r"^##\s*(?:JCAMP.?DX|XYDATA|NTUPLES|PEAK TABLE)\s*=", head, re.I | re.M)
    )


def read(document: Document) -> list[Sample]:
    """Return one sample a block of reflectance.

    Raises
    ------
    InputError
        No block holds reflectance, a checkpoint fails, units are missing or unknown, or a spectrum
        is not one.
    """
    blocks = [block for block in _blocks(document) if block.table is not None]
    if not blocks:
        raise document.error("", "there is no table of a spectrum (##XYDATA=); export it with one")
    fit = [block for block in blocks if _reflects(block.texts.get("YUNITS", ""))]
    if not fit:
        raise _other(document, blocks[0])
    left = [block for block in blocks if block not in fit]
    notes = []
    if left:
        names = ", ".join(quote(block.texts.get("TITLE", "")) for block in left[:4])
        notes = [f"Blocks that are not reflectance were not read: {names}."]
    return [_sample(document, block, notes) for block in fit]


def _reflects(units: str) -> bool:
    """Return whether ordinates are reflectance; Agilent and JASCO write ``%R``."""
    if _LETTER.fullmatch(units.strip()):
        return True
    return series.says_reflectance(units) and not series.other_quantity(units)


def _blocks(document: Document) -> Iterator[_Block]:
    """Return the blocks in the order in which they begin, with their tables decoded."""
    block = _Block(1)
    table: Ordinates | Pairs | None = None
    label = ""
    for number, line in enumerate(tables.lines(document), start=1):
        text, _, remark = line.partition("$$")
        if remark and len(remark) < 1000 and block.texts:
            block.texts["$$"] = f"{block.texts.get('$$', '')} {remark.strip()}"[:1000]
        record = _LABEL.match(text.lstrip()) if "##" in text else None
        if record is None:
            if table is not None:
                table.feed(number, text)
            elif label and text.strip() and len(block.texts[label]) < 1000:
                block.texts[label] += " " + text.strip()
            continue
        label, value = re.sub(r"[\s/_-]", "", record[1]).upper(), record[2].strip()
        table = None
        if label in ("TITLE", "END") and (block.texts or label == "END"):
            if block.texts:
                yield block
            block = _Block(number)
        if label == "END":
            label = ""
            continue
        block.texts[label] = value
        block.lines[label] = number
        if label in _TABLES:
            table = block.table = _new_table(document, number, label, value)
        elif label in _UNREAD:
            kind = block.texts.get("DATATYPE", "")
            if _NO_LIGHT.search(kind):
                raise document.not_reflectance(
                    f"line {block.lines['DATATYPE']}, ##DATA TYPE=", quote(kind)
                )
            raise document.error(
                f"line {number}", f"##{record[1].strip()}= is not read; export it as ##XYDATA="
            )
    if block.texts:
        yield block


def _new_table(document: Document, line: int, label: str, form: str) -> Ordinates | Pairs:
    plain = re.sub(r"\s", "", form).upper()
    if plain.startswith("(X++(Y..Y)"):
        return Ordinates(document)
    if plain.startswith("(XY..XY)"):
        return Pairs(document)
    raise document.error(
        f"line {line}",
        f"##{label}= {quote(form)} is not known; export it as (X++(Y..Y)) or (XY..XY)",
    )


def _other(document: Document, block: _Block) -> Exception:
    """Return the refusal of a block by the name of its quantity."""
    stated = block.texts.get("YUNITS", "")
    if not stated:
        return document.error(
            f"line {block.line}", "##YUNITS= is missing; export it with YUNITS= REFLECTANCE"
        )
    other = series.other_quantity(stated) or f"in units of {quote(stated)}"
    return document.not_reflectance(f"line {block.lines['YUNITS']}, ##YUNITS=", other)


def _sample(document: Document, block: _Block, notes: list[str]) -> Sample:
    x, y, at = _points(document, block)
    units = block.texts.get("XUNITS", "")
    unit = label_words.unit_of_wavelengths(units)
    if _WAVENUMBERS.search(units):
        if not (x > 0.0).all():
            raise document.error(f"line {at(0)}", "a wavenumber is not above 0; export it again")
        nm = _NM_CM / x
        notes = [*notes, "Wavenumbers were converted to wavelengths."]
    elif unit:
        nm = label_words.to_nanometers(x, unit)
    else:
        raise document.error(
            f"line {block.lines.get('XUNITS', block.line)}, ##XUNITS=",
            f"{quote(units)} is no known unit; make it NANOMETERS, MICROMETERS or 1/CM",
        )
    if _PERCENT.search(block.texts["YUNITS"]):
        y = y / 100.0
    where = f"{document.path}, line {block.line}"
    found = series.bands(nm, y, where, lambda band: f"line {at(band)}")
    geometry = block.texts.get("SAMPLINGPROCEDURE", "")
    specular = specular_of(geometry)
    device = block.texts.get("SPECTROMETER", "") or block.texts.get("SPECTROMETERDATASYSTEM", "")
    said: dict[str, Any] = {}
    if not is_geometry(geometry):  # other labels, remarks and the device's name may say it
        texts = {key: text for key, text in block.texts.items() if key not in _TABLES}
        said = statements.measured_by(((key.lstrip("$"), text) for key, text in texts.items()))
    if said.keys() & statements.GEOMETRIES or (said.get("device") and not geometry):
        known = statements.finish({"device": device, **said})
        geometry, specular = known.get("geometry", geometry), known.get("specular", specular)
        instrument, note = known["instrument"], " ".join(known.get("notes", ()))
    else:
        instrument, note = instrument_of(geometry)
    return Sample(
        name=block.texts.get("TITLE", "") or document.path.stem,
        wavelengths=found.wavelengths,
        values=found.values,
        kind="reading",
        instrument=instrument,
        geometry=geometry,
        specular=specular,
        source=str(document.path),
        position=f"line {block.line}",
        device=device,
        notes=tuple([*notes, note] if note else notes),
        altered=found.altered,
    )


def _points(
    document: Document, block: _Block
) -> tuple[NDArray[np.float64], NDArray[np.float64], Callable[[int], int]]:
    """Return x and y in their units, shape (points,), and what gives the line of a point."""
    table = block.table
    if isinstance(table, Pairs):
        lines = table.lines
        x = np.frombuffer(table.x) * _factor(document, block, "XFACTOR") if table.x else np.empty(0)
        y = np.frombuffer(table.y) * _factor(document, block, "YFACTOR") if table.y else np.empty(0)
        return x, y, lambda point: lines[point]
    assert table is not None
    count = len(table.values)
    if "NPOINTS" in block.texts and _number(document, block, "NPOINTS") != count:
        raise document.error(
            f"line {block.lines['NPOINTS']}, ##NPOINTS=",
            f"{block.texts['NPOINTS']} points are announced but {count} found; export it again",
        )
    first = _number(document, block, "FIRSTX")
    if "LASTX" in block.texts:
        step = (_number(document, block, "LASTX") - first) / max(count - 1, 1)
    else:
        step = _number(document, block, "DELTAX")
    _check_abscissas(document, table, first, step, _factor(document, block, "XFACTOR"))
    starts = [start for _, _, start in table.abscissas]
    # In place: a compressed table has few bytes a point.
    x = np.arange(count, dtype=np.float64)
    x *= step
    x += first
    y = np.frombuffer(table.values) if count else np.empty(0)
    y *= _factor(document, block, "YFACTOR")
    y.flags.writeable = False
    return x, y, lambda point: table.abscissas[bisect.bisect_right(starts, point) - 1][0]


def _check_abscissas(
    document: Document, table: Ordinates, first: float, step: float, factor: float
) -> None:
    """Refuse lines whose X is not where their ordinates are: points are missing or doubled."""
    for line, text, index in table.abscissas:
        decimals = len(text.partition(".")[2]) if "." in text and "e" not in text.lower() else 0
        rounding = abs(factor) * 10.0**-decimals
        stated, counted = float(text) * factor, first + step * index
        if not abs(stated - counted) <= abs(step) + rounding:
            raise document.error(
                f"line {line}",
                f"the line begins at {stated:.10g} where {counted:.10g} is due; points are missing "
                "or doubled, so export the file again",
            )


def _factor(document: Document, block: _Block, label: str) -> float:
    return _number(document, block, label) if label in block.texts else 1.0


def _number(document: Document, block: _Block, label: str) -> float:
    text = block.texts.get(label, "")
    if not text:
        raise document.error(
            f"line {block.line}", f"##{label}= is missing; export the file with it"
        )
    found = series.number(document, f"line {block.lines[label]}, ##{label}=", text)
    if not math.isfinite(found):
        raise document.error(f"line {block.lines[label]}", f"##{label}= is not a finite number")
    return found
