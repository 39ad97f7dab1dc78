# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`compare`: how far two samples are apart, as measured and as the albedos behind."""

from __future__ import annotations

import argparse
import csv
import io
import math
from pathlib import Path
from typing import TYPE_CHECKING

from ...support.shown_text import ESCAPED, inform, out, printable, tell, to_cell

if TYPE_CHECKING:
    from ...matching.compare import Apart, Comparison
    from ...matching.request import Request

NAME = "compare"
SUMMARY = "how far two samples are apart, as measured and as the albedos behind"
DESCRIPTION = (
    "Compare two samples, each with its roughness: what an instrument reads of them, at 45°/0° if "
    "none is named, and the albedos behind, which roughness does not change. Columns are separated "
    "by tabs."
)

_HEADER = ("between", "delta_e_00", "delta_L*", "delta_a*", "delta_b*", "delta_a*b*", "shift")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of `compare`."""
    from ....core.instruments import DEFAULT, REGISTRY
    from ....core.models import NAMES, TARGET
    from ...colorimetry.tristimulus import ILLUMINANTS, OBSERVERS
    from .. import named_samples

    for which in ("first", "second"):
        parser.add_argument(
            which,
            metavar="SAMPLE",
            help=named_samples.HELP,
        )
    parser.add_argument(
        "--sigma",
        type=float,
        nargs=2,
        metavar="DEGREES",
        help="roughness of the first and of the second; without it what the samples say, or 0",
    )
    parser.add_argument(
        "--kind",
        nargs=2,
        choices=("reading", "albedo"),
        help="what the first and the second spectrum are",
    )
    parser.add_argument(
        "--model", choices=NAMES, default=TARGET, help="how light between facets is counted"
    )
    parser.add_argument("--illuminant", choices=ILLUMINANTS, default="D65")
    parser.add_argument("--observer", type=int, choices=OBSERVERS, default=2)
    parser.add_argument(
        "--read-at",
        choices=tuple(REGISTRY),
        default=DEFAULT,
        metavar="INSTRUMENT",
        help=f"virtual instrument that reads both ({DEFAULT}): {', '.join(REGISTRY)}",
    )
    parser.add_argument("--output", type=Path, metavar="FILE", help="write a CSV file, too")


def run(options: argparse.Namespace) -> int:
    """Print the table, and write it if asked; exit status 0."""
    from ... import api
    from ...support import atomic_files
    from ..result import add

    if options.output is not None:
        atomic_files.check_target(options.output)
    pair = [_request(options, place) for place in (0, 1)]
    found = api.compare(*pair)
    for sentence in found.warnings:
        tell(f"warning: {sentence}")
    out(*_HEADER, "interreflection")
    for name, apart, share in _rows(found):
        numbers = (f"{value:.2f}" for value in _numbers(apart))
        out(name, *numbers, "" if share is None else f"{share:.3f}")
    if options.output is not None:
        with atomic_files.publication() as files:
            files.write(options.output, _csv(pair, found))
        add(options, files=[options.output])
        inform(f"wrote {options.output}")
    return 0


def _request(options: argparse.Namespace, place: int) -> Request:
    """Say what to make of one of the two."""
    from ....core import limits
    from ....core.errors import InputError
    from ... import api
    from .. import named_samples

    named = (options.first, options.second)[place]
    sample = named_samples.one(named)
    degrees = sample.sigma_degrees or 0.0 if options.sigma is None else options.sigma[place]
    if fault := limits.sigma_fault(degrees):
        msg = f"Sample {named!r}: {fault}"
        raise InputError(msg)
    return api.request(
        sample,
        math.radians(degrees),
        kind=None if options.kind is None else options.kind[place],
        model=options.model,
        illuminant=options.illuminant,
        observer=options.observer,
        read_at=options.read_at,
    )


def _rows(found: Comparison) -> list[tuple[str, Apart, float | None]]:
    """Name what is compared; the share of interreflection is that of one sample."""
    (rough_1, rough_2), (share_1, share_2) = found.roughness, found.interreflection
    return [
        ("samples as measured", found.measured, None),
        ("their albedos", found.albedos, None),
        ("first: albedo to reading", rough_1, share_1),
        ("second: albedo to reading", rough_2, share_2),
    ]


def _numbers(apart: Apart) -> tuple[float, ...]:
    return (
        *(apart.delta_e_00, apart.delta_l, apart.delta_a, apart.delta_b),
        *(apart.delta_ab, apart.shift),
    )


def _csv(pair: list[Request], found: Comparison) -> bytes:
    from ...support.version import version

    text = io.StringIO()
    comments = [
        f"creator: Rough Spectra {version()}",
        *(
            f"{which}: {request.sample.kind}; sigma {math.degrees(request.sigma):g} deg; "
            f"instrument {request.sample.instrument}"
            for which, request in zip(("first", "second"), pair, strict=True)
        ),
        f"readings: {found.read_at}, model {found.model}",
        f"illuminant/observer: {found.illuminant}/{found.observer}°",
        "shift: distance in a*b* once the second of a row has the luminance of its first",
        "interreflection: share of the reading's luminance that met more than one facet",
        f"cells: {ESCAPED} (names: \\x1b and the like, an apostrophe before = + - @ ')",
    ]
    text.writelines(f"# {printable(line)}\n" for line in comments)
    table = csv.writer(text, lineterminator="\n")
    colors = [f"{axis}_{which}" for which in ("first", "second") for axis in ("L*", "a*", "b*")]
    names = [to_cell(request.sample.name) for request in pair]
    header = [*_HEADER, "interreflection", *colors, "first_sample", "second_sample"]
    table.writerow(header)
    for name, apart, share in _rows(found):
        values = (*_numbers(apart), math.nan if share is None else share)
        values = (*values, *apart.first, *apart.second)
        cells = ("" if math.isnan(value) else f"{value:.6f}" for value in values)
        table.writerow([name, *cells, *names])
    return text.getvalue().encode()
