# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings as CSV: comment lines that say units and geometry, a header, a row a reading."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Literal

from ...support.shown_text import ESCAPED, printable, to_cell
from ...support.version import version
from ..document import (
    GLOSS,
    CyclesReading,
    Predicted,
    Reading,
    Readings,
    SpotRead,
)

NAME = "csv"
PLACE = 10
ENDINGS = r"(?:predicted|measured)\.csv"
CREATOR = rb"# creator: Rough Spectra "


def files(readings: Readings) -> list[tuple[str, Iterator[bytes]]]:
    """Give the endings and tables of what was predicted and of what was measured."""
    found = []
    if any(entry.predicted is not None for entry in readings.entries):
        found.append(("predicted.csv", predicted(readings)))
    if any(entry.measured is not None for entry in readings.entries):
        found.append(("measured.csv", measured(readings)))
    return found


def predicted(readings: Readings) -> Iterator[bytes]:
    """Give the table of predicted spectra; a band that a sample lacks is left empty."""
    rows = [(entry, entry.predicted) for entry in readings.entries if entry.predicted is not None]
    bands = sorted({nm for _, part in rows for nm in part.wavelengths})
    lights = {_viewing(part) for _, part in rows}
    comments = _comments("predicted by the core from the stored spectrum", lights, readings)
    if scaled := sorted({_white(part) for _, part in rows if part.white != _PERFECT}):
        comments.append(f"stored spectra relative to another white: {'; '.join(scaled)}")
    comments.append("albedo min, albedo max: what the sample's reading leaves open at any sigma")
    header = [
        "material",
        "surface",
        "sample",
        "instrument",
        "sigma_deg",
        "model",
        "illuminant",
        "observer",
    ]
    header += ["stored_white", "X", "Y", "Z", "L*", "a*", "b*"]
    header += [f"{nanometers(nm)} nm" for nm in bands]
    header += [f"albedo {end} {nanometers(nm)} nm" for nm in bands for end in ("min", "max")]
    return pieces(comments, header, (_predicted(entry, part, bands) for entry, part in rows))


def _predicted(entry: Reading, part: Predicted, bands: list[float]) -> list[str]:
    """Give the cells of a reading."""
    at = dict(zip(part.wavelengths, part.values, strict=True))
    sides = (part.albedo_lowest, part.albedo_highest)
    # Empty where no roughness fits.
    albedos = dict(zip(part.wavelengths, zip(*sides, strict=True), strict=False))
    return [
        to_cell(entry.material),
        to_cell(entry.surface),
        to_cell(entry.sample),
        entry.instrument,
        f"{part.sigma_degrees:g}",
        part.model,
        part.illuminant,
        str(part.observer),
        part.white if part.white == _PERFECT else _white(part),
        *(f"{value:.4f}" for value in (*part.xyz, *part.lab)),
        *(f"{at[nm]:.6f}" if nm in at else "" for nm in bands),
        *(
            "" if end is None else f"{end:.6f}"
            for nm in bands
            for end in albedos.get(nm, (None, None))
        ),
    ]


def measured(readings: Readings) -> Iterator[bytes]:
    """Give the table of measured colors, with the ΔE00 to the prediction where there is one."""
    rows = [(entry, entry.measured) for entry in readings.entries if entry.measured is not None]
    lights = {_viewing(part) for _, part in rows}
    quantity = f"measured in a Cycles render, Blender {readings.blender}"
    comments = _comments(quantity, lights, readings)
    comments.append(f"rgb: scene-linear, {readings.working_space}; sd: over the sample's area")
    header = [
        "material",
        "surface",
        "sample",
        "instrument",
        "illuminant",
        "R",
        "G",
        "B",
        "sd R",
        "sd G",
        "sd B",
    ]
    header += ["X", "Y", "Z", "L*", "a*", "b*", "delta_e_00"]
    shiny = any(entry.gloss for entry, _ in rows)
    if shiny:
        comments.append("gloss: GU of ISO 2813, 100 = black glass of the index 1.567")
        header += [f"gloss_{angle}" for angle in GLOSS]
    on_spots = any(entry.spot is not None for entry, _ in rows)
    if on_spots:
        comments.append("spread: ΔE00 from the reading over the spot, mean and 95th percentile")
        header += ["spot_mm", "spot_filled", "spread_mean", "spread_95"]
    lines = (
        [
            to_cell(entry.material),
            to_cell(entry.surface),
            to_cell(entry.sample),
            entry.instrument,
            part.illuminant,
            *(f"{value:.6f}" for value in (*part.rgb, *part.spread)),
            *(f"{value:.4f}" for value in (*part.xyz, *part.lab)),
            "" if entry.delta_e_00 is None else f"{entry.delta_e_00:.4f}",
            *(f"{value:.2f}" for value in entry.gloss),
            *(_of_spot(entry.spot) if on_spots else ()),
        ]
        for entry, part in rows
    )
    return pieces(comments, header, lines)


def _of_spot(spot: SpotRead | None) -> list[str]:
    """Give the cells of a spot, which a flat sample leaves empty."""
    if spot is None:
        return [""] * 4
    spreads = (spot.spread_mean, spot.spread_95)
    told = ("" if value is None else f"{value:.4f}" for value in spreads)
    return [f"{spot.diameter:g}", f"{spot.covered:.4f}", *told]


def nanometers(wavelength: float) -> str:
    """Give a wavelength with all its digits, and none after a point where they are zero.

    Fewer digits would let two bands of a fine grid share a name.
    """
    return repr(float(wavelength)).removesuffix(".0")


_PERFECT = "perfect diffuser"


def _white(part: Predicted) -> str:
    """Say what a stored spectrum is relative to, and what made it relative to the diffuser."""
    return f"{part.white}, times {part.white_factor:g}"


def _viewing(part: Predicted | CyclesReading) -> str:
    observer = part.observer if isinstance(part, Predicted) else 2
    return f"{part.illuminant}/{observer}°"


_AND = ", "


def _comments(quantity: str, lights: set[str], readings: Readings) -> list[str]:
    return [
        f"creator: Rough Spectra {version()}",
        f"quantity: {quantity}",
        "kind: reading",
        "white: perfect diffuser",
        "units: fraction (reflectance factor, 1 = perfect white diffuser); XYZ with Y = 100",
        "wavelength_unit: nm",
        f"illuminant/observer: {', '.join(sorted(lights)) or 'none'}",
        f"instrument: {_AND.join(readings.instruments)}",
        f"aperture: {readings.aperture}",
        f"cells: {ESCAPED} (names: \\x1b and the like, an apostrophe before = + - @ ')",
    ]


_DELIMITED = re.compile(r"([,;]\s*)([=+\-@])")


def _guarded(found: re.Match[str]) -> str:
    """Keep a name in a comment from being a cell that is a formula."""
    return f"{found[1]}'{found[2]}"


def csv_of(comments: Sequence[str], header: list[str], lines: list[list[str]]) -> bytes:
    """Give a table: comments, the names of its columns, and its rows, cells as `to_cell` gives."""
    return b"".join(pieces(comments, header, lines))


def pieces(
    comments: Sequence[str], header: list[str], lines: Iterable[list[str]]
) -> Iterator[bytes]:
    """Give the same table a line after the other."""
    for line in comments:
        yield f"# {_DELIMITED.sub(_guarded, printable(line))}\n".encode()
    yield _line(header, csv.QUOTE_MINIMAL)
    for cells in lines:
        # Without quotation marks a material called "#1" would read as a comment.
        like_comment = cells[0].lstrip().startswith("#")
        yield _line(cells, csv.QUOTE_ALL if like_comment else csv.QUOTE_MINIMAL)


def _line(cells: list[str], quoting: Literal[0, 1, 2, 3]) -> bytes:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n", quoting=quoting).writerow(cells)
    return text.getvalue().encode()
