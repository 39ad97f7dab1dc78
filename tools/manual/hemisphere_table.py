# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How close Cycles comes to its target away from 45°/0°, measured.

Assigns the 24 ColorChecker presets at three roughnesses, once for the published two-bounce model
and once with the model left to choose; renders them in 500 geometries of light and view; and
compares with the spectral truth there: the two-bounce model itself, and "surface".
Beside each stands a Lambertian material with the same reading at 45°/0°, which is what a color
picked from a chart amounts to. Writes docs/data/hemisphere.csv and docs/hemisphere-table.md. Needs
an environment with bpy:

    python -m tools.manual.hemisphere_table
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.blender import shader_nodes, working_space
from rough_spectra.addon.colorimetry import tristimulus
from rough_spectra.addon.instrument.measure import Geometry, measure
from rough_spectra.addon.matching import solve
from rough_spectra.addon.material import derive
from rough_spectra.addon.samples import presets
from rough_spectra.addon.support import atomic_files
from rough_spectra.core import cycles, ladder, reading
from rough_spectra.core.color import color_difference
from rough_spectra.core.numerics import direction_grid
from rough_spectra.core.numerics.arrays import Array

SIGMAS = (15, 30, 45)
"""Degrees. At 0° both materials are Lambertian and exact."""
GEOMETRIES = 500
TARGETS = {"two-bounce": "two-bounce", solve.AUTO: "surface"}
"""What a material was assigned with, and the model of `core.ladder` it is compared with."""

DOCS = ROOT / "docs"
TABLE = DOCS / "hemisphere-table.md"
DATA = DOCS / "data" / "hemisphere.csv"


@dataclass(frozen=True)
class Row:
    """ΔE00 over patches and geometries at one roughness.

    Attributes
    ----------
    sigma_degrees
        Roughness σ.
    truth
        The model it was compared with.
    material
        Which Blender material was compared.
    mean, percentile_95, maximum
        Of ΔE00 over all patches within gamut and all geometries.
    patches, geometries
        How many.
    """

    sigma_degrees: int
    truth: str
    material: str
    mean: float
    percentile_95: float
    maximum: float
    patches: int
    geometries: int


Directions = tuple[Array, Array, Array]
"""θi, θr and Δφ, radians, each of shape (geometries,)."""


@dataclass(frozen=True)
class Assigned:
    """The materials, and what they were assigned with: all patches at one σ, then at the next.

    Attributes
    ----------
    materials, requests
        One a patch, roughness and model.
    within_gamut
        Whether the color could be met.
    patches
        How many follow each other with the same roughness and model.
    """

    materials: list[Any]
    requests: list[solve.Request]
    within_gamut: list[bool]
    patches: int


def prepare() -> Assigned:
    """Assign every preset at every roughness; the extension has to be registered."""
    samples = presets.load_all("colorchecker")
    requests = [
        solve.Request(sample, float(np.radians(degrees)), model)
        for model in TARGETS
        for degrees in SIGMAS
        for sample in samples
    ]
    materials = [bpy.data.materials.new(request.sample.name) for request in requests]
    solutions = derive.assign(list(zip(materials, requests, strict=True)))
    within = [not any("gamut" in warning for warning in s.warnings) for s in solutions]
    return Assigned(materials, requests, within, len(samples))


def rendered(materials: list[Any], directions: Directions) -> Array:
    """RGB that Cycles shows, shape (geometries, materials, 3): a render each geometry."""
    return measure(materials, to_measure(*directions), samples=1)[:, :, 0]


def computed(materials: list[Any], directions: Directions) -> Array:
    """RGB of the same by the core's formula of Cycles, from what the nodes hold."""
    found = [shader_nodes.surface(material) for material in materials]
    colors = np.array([surface.color for surface in found if surface is not None], np.float64)
    roughness = np.array([surface.roughness for surface in found if surface is not None])
    return cycles.reflectance(colors, roughness, *(angle[:, np.newaxis] for angle in directions))


def compare(assigned: Assigned, directions: Directions, rgb: Array) -> list[Row]:
    """Compare what materials show with the spectral truth.

    Parameters
    ----------
    assigned
        The materials.
    directions
        Where they were looked at.
    rgb
        What they showed there, shape (geometries, materials, 3).

    Returns
    -------
    Two rows a model and roughness: the matched material as it showed, and the Lambertian one.
    """
    requests = assigned.requests
    seen = working_space.current().to_lab(rgb, "D65")
    # All σ of a model at once: the reference then solves each geometry once.
    models = [[request for request in requests if request.model == model] for model in TARGETS]
    truth = np.concatenate([model_lab(each, directions) for each in models])
    rows = []
    for start in range(0, len(requests), assigned.patches):
        alike = range(start, start + assigned.patches)
        members = [i for i in alike if assigned.within_gamut[i]]
        first = requests[start]
        wanted = np.swapaxes(truth[members], 0, 1)
        flat = np.stack([lambert_lab(requests[i]) for i in members])
        for material, lab in (
            ("Diffuse BSDF, matched", seen[:, members]),
            ("Lambertian, same 45°/0° reading", np.broadcast_to(flat, wanted.shape)),
        ):
            apart = color_difference.delta_e(lab, wanted)
            rows.append(
                Row(
                    round(float(np.degrees(first.sigma))),
                    TARGETS[first.model],
                    material,
                    float(apart.mean()),
                    float(np.percentile(apart, 95)),
                    float(apart.max()),
                    len(members),
                    len(directions[0]),
                )
            )
    return rows


def model_lab(requests: list[solve.Request], directions: Directions) -> Array:
    """L*a*b* of the spectral model of requests for one model, on one wavelength grid.

    Returns
    -------
    Shape (requests, geometries, 3). At grazing opposite directions the published model turns
    negative, which counts as black.
    """
    albedos = np.stack([request.sample.values for request in requests])[:, np.newaxis]
    sigmas = np.array([[request.sigma] for request in requests])
    spectra = ladder.reflectance(TARGETS[requests[0].model], albedos, *directions, sigmas)
    return tristimulus.spectrum_to_lab(np.maximum(spectra, 0), requests[0].sample.wavelengths)


def lambert_lab(request: solve.Request) -> Array:
    """L*a*b* of a material that shows its 45°/0° reading in every geometry, shape (3,)."""
    sample = request.sample
    flat = reading.from_albedo(sample.values, request.sigma, TARGETS[request.model])
    return tristimulus.spectrum_to_lab(flat, sample.wavelengths)


def to_measure(theta_i: Array, theta_r: Array, delta_phi: Array) -> list[Geometry]:
    """Give geometries of one light each to the virtual spectrophotometer."""
    return [
        Geometry(((float(light), float(phi)),), float(view))
        for light, view, phi in zip(theta_i, theta_r, delta_phi, strict=True)
    ]


def csv_text(rows: list[Row]) -> str:
    """Give the rows as CSV with a comment line that says what they are."""
    return "\n".join(
        [
            "# CIEDE2000 between Cycles and the spectral model named under truth, ColorChecker N "
            f"Ohta as the albedo, D65, CIE 1931 2 deg; {rows[0].geometries} cosine-weighted "
            "geometries of light and view below 80 deg; patches within Rec.709",
            "sigma_degrees,truth,material,mean,percentile_95,maximum,patches,geometries",
            *(
                f'{row.sigma_degrees},{row.truth},"{row.material}",{row.mean:.4f},{row.percentile_95:.4f},'
                f"{row.maximum:.4f},{row.patches},{row.geometries}"
                for row in rows
            ),
            "",
        ]
    )


def _two(value: float) -> str:
    """Give two digits of the four that the data have."""
    return f"{round(value, 4):.2f}"


def markdown(rows: list[Row]) -> str:
    """Give the rows as a Markdown table."""
    return "\n".join(
        [
            "<!-- Made by tools/manual/hemisphere_table.py -->",
            "",
            "| σ | truth | material | mean ΔE00 | 95th percentile | maximum |",
            "|---|---|---|---|---|---|",
            *(
                f"| {row.sigma_degrees}° | {row.truth} | {row.material} | {_two(row.mean)} | "
                f"{_two(row.percentile_95)} | {_two(row.maximum)} |"
                for row in rows
            ),
            "",
            f"{rows[0].patches} ColorChecker patches within Rec.709, {rows[0].geometries} "
            "cosine-weighted geometries of light and view below 80°, D65, 2° observer. Each is a "
            "Cycles render. Materials assigned with the two-bounce model are compared with it, "
            'spectrally; all others with "surface". '
            "The Lambertian material shows its 45°/0° reading everywhere.",
            "",
        ]
    )


def main() -> int:
    """Write both files; returns the exit status."""
    extension: Any = sys.modules["rough_spectra"]
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    extension.register()
    try:
        assigned, directions = prepare(), direction_grid.hemisphere(GEOMETRIES)
        rows = compare(assigned, directions, rendered(assigned.materials, directions))
    finally:
        # Blender trips over classes that are still registered when it ends.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        extension.unregister()
    with atomic_files.publication() as files:
        files.write(DATA, csv_text(rows).encode())
        files.write(TABLE, markdown(rows).encode())
    print(markdown(rows), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
