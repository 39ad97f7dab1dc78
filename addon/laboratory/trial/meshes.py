# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces of the laboratory: rough meshes, measured in grays, and colored by what those tell.

How light goes from facet to facet does not depend on their albedo. So the readings of nine grays
tell those of all albedos: the closed form is fitted to them, and how far it misses them is kept.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ....core.closure.fitting import Fitted, fit
from ....core.errors import InputError
from ....core.numerics.arrays import Array
from ...samples.sample import Sample
from ...support import user_files
from .. import experiment, kinds
from .surfaces import Material, Surface

GRAYS = (0.03, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.96)
"""Albedos that are measured: from black to white of a chart."""

PLAN = (
    *((kind, sigma) for kind in ("gaussian", "multiscale", "grooves") for sigma in (15, 30, 45)),
    ("grooves-oren-nayar", 30),
    ("grains", 30),
)
"""Kinds of surfaces and σ, degrees."""

_HEADER = ("kind", "sigma_deg", "rdq", "albedo", "reflectance", "noise")


@dataclass(frozen=True, eq=False)
class Grays:
    """What was measured of one mesh.

    Attributes
    ----------
    kind, degrees
        One of `kinds.KINDS`, and the σ that it was made with.
    rdq
        Of its facets, averaged over azimuth.
    albedo, reflectance, noise
        Of the facets, what was read, and its standard error; shape (n,).
    """

    kind: str
    degrees: float
    rdq: float
    albedo: Array
    reflectance: Array
    noise: Array

    @property
    def name(self) -> str:
        """What tables call the surface."""
        return f"{kinds.KINDS[self.kind].title}, {self.degrees:g}°"

    @property
    def fitted(self) -> Fitted:
        """The closed form nearest to the readings."""
        return fit(self.albedo, self.reflectance)


def measure(
    plan: Sequence[tuple[str, float]] = PLAN,
    *,
    grays: Sequence[float] = GRAYS,
    cells: int = kinds.CELLS,
    seeds: int = experiment.SEEDS,
    samples: int = experiment.SAMPLES,
    progress: Callable[[int, int], None] | None = None,
) -> list[Grays]:
    """Make and measure the meshes.

    Parameters
    ----------
    plan
        Kind and σ in degrees, of each.
    grays
        Albedos of the facets.
    cells, seeds, samples
        As of `kinds.make` and `experiment.measure`.
    progress
        Called with renders done and renders in all.

    Raises
    ------
    OutputError
        If the second Blender failed.
    CancelledError
        On an interrupt from the keyboard.
    """
    renders = math.ceil(len(grays) / experiment.GROUP) * seeds
    found = []
    for number, (kind, degrees) in enumerate(plan):
        mesh = kinds.make(kind, math.radians(degrees), cells=cells).mesh

        def told(done: int, _: int, before: int = number * renders) -> None:
            if progress is not None:
                progress(before + done, renders * len(plan))

        of = experiment.measure(mesh, grays, seeds=seeds, samples=samples, progress=told)
        found.append(Grays(kind, degrees, mesh.rdq, of.albedos, of.reflectance, of.noise))
    return found


def surfaces(measured: Sequence[Grays], chart: Sequence[Sample]) -> list[Surface]:
    """Color the meshes: give what would be read of each with the facets' albedo of each sample.

    Parameters
    ----------
    measured
        The meshes.
    chart
        Albedos. Level meshes read their albedo, so that these are the smooth readings, too.
    """
    return [
        Surface(
            grays.name,
            math.radians(grays.degrees),
            tuple(_colored(grays.fitted, sample) for sample in chart),
        )
        for grays in measured
    ]


def _colored(fitted: Fitted, sample: Sample) -> Material:
    read = fitted.reading(sample.reflectance)
    rough = replace(sample, kind="reading", values=read, instrument="45a:0", lab=None, xyz=None)
    return Material(sample.name, (sample,), (rough,))


def to_csv(measured: Sequence[Grays]) -> bytes:
    """Give what was measured as a table, which `from_csv` reads."""
    text = io.StringIO()
    text.write(
        "# rough meshes of Lambertian facets, rendered by Cycles at 45a:0 with all bounces; noise "
        "is the standard error\n"
    )
    table = csv.writer(text, lineterminator="\n")
    table.writerow(_HEADER)
    for of in measured:
        for row in zip(of.albedo, of.reflectance, of.noise, strict=True):
            numbers = [f"{value:.7f}" for value in row]
            table.writerow([of.kind, f"{of.degrees:g}", f"{of.rdq:.6f}", *numbers])
    return text.getvalue().encode()


def from_csv(path: Path) -> list[Grays]:
    """Read what `to_csv` wrote.

    Raises
    ------
    InputError
        If it is no such table; the sentence names file and line.
    """
    lines = user_files.read(path).decode("utf-8", "replace").splitlines()
    found: dict[tuple[str, float], list[list[float]]] = {}
    for number, line in enumerate(lines, 1):
        if line.startswith("#") or line == ",".join(_HEADER):
            continue
        kind, *cells = line.split(",")
        try:
            degrees, *row = (float(cell) for cell in cells)
        except ValueError:
            row = []
        if kind not in kinds.KINDS or len(row) != len(_HEADER) - 2:
            msg = f"{path}, line {number}: this is no measured gray; have it written again."
            raise InputError(msg)
        found.setdefault((kind, degrees), []).append(row)
    return [
        Grays(kind, degrees, rows[0][0], *np.array(rows).T[1:])
        for (kind, degrees), rows in found.items()
    ]
