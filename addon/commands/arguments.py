# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Options that several verbs have, declared once."""

from __future__ import annotations

import argparse


def add_materials(parser: argparse.ArgumentParser, of_object: str) -> None:
    """Declare which materials are meant; `of_object` says what an object stands for."""
    parser.add_argument(
        "--material",
        action="append",
        default=[],
        metavar="NAME",
        help="a material, repeatable; without any, all that store a spectrum",
    )
    parser.add_argument("--object", action="append", default=[], metavar="NAME", help=of_object)


def add_sigma(parser: argparse.ArgumentParser) -> None:
    """Declare one roughness for all samples, as σ or as a profilometer's slope."""
    sigma = parser.add_mutually_exclusive_group()
    sigma.add_argument(
        "--sigma",
        type=float,
        metavar="DEGREES",
        help="roughness of all of them, whatever the files say; without it what they say, or 0",
    )
    sigma.add_argument(
        "--rdq", type=float, metavar="SLOPE", help="the same as a profilometer's Rdq = tan σ"
    )
    sigma.add_argument(
        "--sdq", type=float, metavar="SLOPE", help="the same as a profilometer's Sdq = √2 tan σ"
    )


def add_repeatability(parser: argparse.ArgumentParser) -> None:
    """Declare how well readings repeat, in percent."""
    from ...core import estimate

    parser.add_argument(
        "--repeatability",
        type=float,
        default=100 * estimate.RELATIVE,
        metavar="PERCENT",
        help="standard deviation of repeated readings, percent of the reading; "
        f"{100 * estimate.RELATIVE:g} without it, and {100 * estimate.ABSOLUTE:g} of white besides",
    )
