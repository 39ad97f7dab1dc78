# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the manual's figures share: inks, and how a figure becomes files."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

# Okabe and Ito's colors, told apart by all common kinds of color vision.
BLACK, ORANGE, SKY, TEAL = "#000000", "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILION, PURPLE = "#0072B2", "#D55E00", "#CC79A7"
GRAY = "#767676"


def save(figure: Any, path: Path, dpi: float | str = "figure") -> None:
    """Write a figure as SVG and PNG beside each other; equal figures give equal bytes.

    Parameters
    ----------
    figure
        Of matplotlib.
    path
        Where, without an ending.
    dpi
        Pixels an inch of the PNG.
    """
    # A date, or the version of matplotlib, would make every run another file.
    for ending, metadata in (("svg", {"Date": None}), ("png", {"Software": None})):
        part = path.with_name(f".{path.name}.{ending}.part")
        figure.savefig(part, format=ending, dpi=dpi, metadata=metadata)
        os.replace(part, path.with_name(f"{path.name}.{ending}"))
