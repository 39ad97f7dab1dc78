# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the table of the model "surface" from what `trace_surfaces` found.

python3 dev.py tables make_surface_table FOLDER            print what the form misses
python3 dev.py tables make_surface_table FOLDER --write    write core/surface/data.py too
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from core.closure import table
from core.numerics.arrays import Array

from . import surface_nodes
from .table_file import render

TARGET = Path(__file__).parents[2] / "core" / "surface" / "data.py"
MEETING = np.linspace(0.6, 0.9, 7)
"""Albedos tried as the one between."""
ALBEDOS = np.concatenate((np.linspace(0.05, 0.9, 18), [0.93, 0.95, 0.97, 0.985, 1.0]))
DARKEST = -8.0
"""Least logarithm of r/ρ that is kept: 0.03 %."""
AZIMUTH = (0, 7.5, 15, 22.5, 30, 45, 60, 75, 90, 105, 120, 135, 150, 165, 180)
"""Nodes of the table, degrees; the traces have every 7.5°."""


def main() -> int:
    """Make the table and say what it misses."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--write", action="store_true", help=f"write {TARGET.name}")
    options = parser.parse_args()
    fields = min(len(files(options.folder, sigma)) for sigma in surface_nodes.SIGMA)
    found = np.stack([load(options.folder, sigma, fields) for sigma in surface_nodes.SIGMA])
    ratios = np.mean(found, axis=1)
    say = sys.stdout.write
    missed = [misfit(ratios, meeting) for meeting in MEETING]
    for meeting, worst in zip(MEETING, missed, strict=True):
        inside = worst[:, polar_below(80)]
        say(
            f"meeting at {meeting:.2f}: the form misses by "
            f"{np.median(inside):.2%} in the median, {np.quantile(inside, 0.95):.2%} at 95 %, "
            f"{inside.max():.2%} at worst below 80°\n"
        )
    meeting = float(MEETING[int(np.argmin([np.quantile(worst, 0.95) for worst in missed]))])
    noise = found.std(axis=1) / np.sqrt(found.shape[1]) / ratios
    for row, sigma in enumerate(surface_nodes.SIGMA):
        at_half = noise[row][polar_below(80)][..., index(0.5)]
        say(
            f"σ {sigma:4g}°, {found.shape[1]} fields: noise {np.median(at_half):.2%} in the "
            f"median, {np.quantile(at_half, 0.95):.2%} at 95 % below 80°\n"
        )
    if options.write:
        TARGET.write_text(rendered(ratios, meeting), encoding="utf-8")
        say(f"{TARGET} written\n")
    return 0


def index(albedo: float) -> int:
    """Place of an albedo in `ALBEDOS`."""
    return int(np.argmin(np.abs(ALBEDOS - albedo)))


def polar_below(limit: float) -> Array:
    """Give those nodes of the larger polar angle that lie below a limit, degrees."""
    return np.array(surface_nodes.POLAR) < limit


def files(folder: Path, sigma: float) -> list[Path]:
    """Give the traces at one σ, degrees, a file for each field."""
    return sorted(folder.glob(f"{sigma:g}-*[0-9].npy"))


def load(folder: Path, sigma: float, fields: int) -> Array:
    """a_1 and r/ρ over `ALBEDOS` of the first fields: (fields, polar, ratio, azimuth, 1 + n)."""
    powers = ALBEDOS ** np.arange(surface_nodes.ORDERS)[:, np.newaxis]
    weights = np.concatenate((np.eye(surface_nodes.ORDERS)[:, :1], powers), axis=1)
    kept = np.rint(np.array(AZIMUTH) / 7.5).astype(int)
    found = []
    for field in files(folder, sigma)[:fields]:
        series = np.load(field).astype(np.float64)
        # Orders, polar, azimuth, ratio: where azimuth has no meaning, all of it is averaged.
        ends = np.array([1.0] + [2.0] * (series.shape[2] - 2) + [1.0])
        mean = np.tensordot(series, ends / ends.sum(), axes=(2, 0))
        series[..., 0] = mean[:, :, np.newaxis, 0]
        series[:, 0] = mean[:, 0, np.newaxis, :].mean(axis=-1, keepdims=True)
        found.append(np.moveaxis(series[:, :, kept], 0, -1).swapaxes(1, 2) @ weights)
    return np.stack(found)


def logs(ratios: Array, meeting: float) -> Array:
    """Anchors of r/ρ as `load` gives them."""
    whole = [np.interp(meeting, ALBEDOS, np.arange(ALBEDOS.size))]
    low = int(whole[0])
    share = whole[0] - low
    between = ratios[..., 1 + low] * (1 - share) + ratios[..., 2 + low] * share
    return np.log(np.stack((ratios[..., 0], between, ratios[..., -1]), axis=-1))


def misfit(ratios: Array, meeting: float) -> Array:
    """Largest relative error of the closed form over the albedos."""
    b, a, g = (x[..., np.newaxis] for x in table.through(logs(ratios, meeting), meeting))
    found = b + a / (1 + np.sqrt(1 - g * ALBEDOS))
    return np.asarray(np.abs(found / ratios[..., 1:] - 1).max(axis=-1))


def rendered(ratios: Array, meeting: float) -> str:
    """Text of the module that holds the table."""
    # Steep surfaces send less than 0.03 % to the far side by one bounce, and much by later ones.
    values = np.maximum(np.moveaxis(logs(ratios, meeting), 0, -2), DARKEST)
    rows = table.packable(values)
    nodes: dict[str, Sequence[float]] = {
        "SIGMA": (0, *surface_nodes.SIGMA),
        "POLAR": surface_nodes.POLAR,
        "RATIO": surface_nodes.RATIO,
        "AZIMUTH": AZIMUTH,
    }
    return render("surface", "tools/tables/make_surface_table.py", nodes, meeting, rows)


if __name__ == "__main__":
    raise SystemExit(main())
