# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the table of what random surfaces reflect into the whole hemisphere.

    python3 dev.py tables make_emission_table FOLDER [--fields 36] [--walks 40000]
    python3 dev.py tables make_emission_table FOLDER --write

Every σ and field is a file of its own in the folder, so that an interrupted run goes on where it
was. Random numbers start from fixed seeds: the same files come out again. The fields are those of
`trace_surfaces`, the table is `core/emissivity/random_surface_data.py`.
"""

from __future__ import annotations

import argparse
import sys
import textwrap
from pathlib import Path

import numpy as np

from core.closure import packing
from core.emissivity import random_surface
from core.numerics.arrays import Array

from . import height_fields
from .surface_nodes import SIGMA

TARGET = Path(__file__).parents[2] / "core" / "emissivity" / "random_surface_data.py"
POLAR = (0, 10, 20, 30, 40, 50, 60, 68, 75, 80, 84, 87, 89)
"""Nodes of the polar angle, degrees."""
STEEP = 80
"""Where the noise is told apart."""
POINTS = 2048
CORRELATION = 10.0
ORDERS = 128
STEP = 1e-4
"""Of the packed logarithms: rounding moves an emissivity by half of that, relatively."""
ALBEDOS = np.array((0.05, 0.2, 0.5, 0.75, 0.9, 0.98, 0.995))
"""Albedos at which the table is judged, between its own."""


def main() -> int:
    """Trace what is not in the folder yet, and say what the table misses."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--fields", type=int, default=36)
    parser.add_argument("--walks", type=int, default=40_000, help="a field; a square is best")
    parser.add_argument("--write", action="store_true", help=f"write {TARGET.name}, trace nothing")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    if not options.write:
        for field in range(options.fields):
            for sigma in SIGMA:
                target = options.folder / f"{sigma:g}-{field}.npy"
                if not target.exists():
                    np.save(target, trace(sigma, field, options.walks))
    found = [load(options.folder, sigma) for sigma in SIGMA]
    judge(found)
    if options.write:
        TARGET.write_text(rendered(found), encoding="utf-8")
    return 0


def trace(sigma: float, field: int, walks: int) -> Array:
    """Give the sums of one field at roughness σ, degrees: (polar, orders)."""
    from . import emission_tracer, height_field_tracer

    rng = np.random.default_rng([20261130, round(sigma * 10), field])
    heights = height_fields.gaussian(POINTS, CORRELATION, np.tan(np.radians(sigma)), rng)
    highest = height_field_tracer.tiles(heights)
    start = int(rng.integers(2**31))
    polar = np.radians(POLAR)
    return emission_tracer.arrivals(heights, highest, polar, walks, start, ORDERS) / walks


def load(folder: Path, sigma: float) -> Array:
    """P_k at roughness σ, degrees, of each field there is: (fields, polar, orders).

    The light that is absorbed is measured against the light that falls on the field, seen by the
    same walks.
    """
    total = np.stack([np.load(file) for file in sorted(folder.glob(f"{sigma:g}-*.npy"))])
    return np.asarray(total / total.mean(axis=0)[:, :1])


def gains(met: Array, albedo: Array) -> Array:
    """ε / (1 - ρ) of P_k (..., orders) at albedos (n,): (..., n)."""
    return np.asarray(met @ albedo ** np.arange(met.shape[-1])[:, np.newaxis])


def judge(found: list[Array]) -> None:
    """Say what the polynomial over ρ misses, and how large the noise of the traces is."""
    for sigma, fields in zip(SIGMA, found, strict=True):
        met = fields.mean(axis=0)
        logs = np.log(gains(met, random_surface.ALBEDOS))
        fit = np.exp(random_surface.polynomial(logs) @ random_surface.powers(ALBEDOS))
        missed = np.abs(fit / gains(met, ALBEDOS) - 1)
        of_each = gains(fields / fields[..., :1], ALBEDOS)
        noise = of_each.std(axis=0) / np.sqrt(len(fields)) / gains(met, ALBEDOS)
        below = np.array(POLAR) <= STEEP
        sys.stdout.write(
            f"σ {sigma:4g}°, {len(fields)} fields: the form misses ε by {missed.max():.3%} "
            f"of it at worst, noise {noise[below].max():.3%} to {STEEP}°, {noise.max():.3%} above\n"
        )


def rendered(found: list[Array]) -> str:
    """Text of the module that holds the table."""
    logs = np.log([gains(met.mean(axis=0), random_surface.ALBEDOS[1:]) for met in found])
    rows = logs.reshape(-1, logs.shape[-1])
    packed = packing.pack(rows, np.full(rows.shape[1], STEP))
    lines = [_HEAD, f"SIGMA = (0, {', '.join(f'{at:g}' for at in SIGMA)})"]
    lines.append(f"POLAR = ({', '.join(f'{at:g}' for at in POLAR)})\nSTEP = {STEP:g}")
    quoted = "\n".join(f'    "{row}"' for row in textwrap.wrap(packed, 94, break_on_hyphens=False))
    return "\n".join(lines) + f"\nPACKED = (\n{quoted}\n)\n"


_HEAD = '''# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Table of `core.emissivity.random_surface`, by tools/tables/make_emission_table.py."""
'''

if __name__ == "__main__":
    raise SystemExit(main())
