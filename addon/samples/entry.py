# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One sample as a list shows it, without its spectrum."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Entry:
    """One sample as a list shows it.

    Parameters
    ----------
    id
        ``"collection/name-of-sample"``; `load` takes it.
    swatch
        sRGB of the reading under D65 for the 2° observer, 0 to 1; None where the bands do not
        cover the visible range.
    lab
        CIE L*a*b* of the same, unclipped.
    warnings
        Sentences of `quality`.
    path
        The file that holds it.
    is_preset
        Whether it came with the extension.
    readings
        How many of the surface it holds.
    """

    id: str
    name: str
    collection: str
    kind: str
    instrument: str
    condition: str
    device: str
    source: str
    sigma_degrees: float | None
    swatch: tuple[float, float, float] | None
    lab: tuple[float, float, float] | None
    warnings: tuple[str, ...]
    path: Path
    is_preset: bool
    readings: int = 1

    @property
    def title(self) -> str:
        """The name, and of a set how many readings it has."""
        return f"{self.name} ({self.readings} readings)" if self.readings > 1 else self.name
