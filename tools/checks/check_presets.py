# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hold the everyday presets to the files that they come from.

    python -m tools.checks.check_presets USGS-FOLDER NIX-FOLDER

Both folders as `tools.tables.make_everyday_presets` takes them. Each file has to have the SHA-256
that ``presets/everyday/README.md`` states, and a material made from the preset, with its own σ and
gloss, has to read within `LARGEST` of all that the file holds of the spectrum. Exit status 1 if one
does not. Needs the packages that the extension bundles, and no Blender.
"""

from __future__ import annotations

import argparse
import hashlib
import re
import sys
from math import radians
from pathlib import Path

import numpy as np

from tools.run.run_command_line import ROOT, load_extension
from tools.tables.make_everyday_presets import MATERIALS, Material

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.colorimetry import srgb, tristimulus
from rough_spectra.addon.colorimetry.rgb_space import WorkingSpace
from rough_spectra.addon.matching import own_gloss, solve
from rough_spectra.addon.matching.request import Request
from rough_spectra.addon.samples import presets, readers
from rough_spectra.core.color import color_difference
from rough_spectra.core.cycles import gloss_reading, instrument_lobe

README = ROOT / "presets" / "everyday" / "README.md"
LARGEST = 0.02
"""ΔE00 under D65 for the 2° observer."""


def difference(preset: str, path: Path, space: WorkingSpace) -> float:
    """Return the ΔE00 of a preset's material to its source, as both read at the instrument.

    Parameters
    ----------
    preset
        Its id.
    path
        The file that it comes from; all of its bands count.
    space
        Working space of the material.
    """
    sample = presets.load(preset)
    gloss = own_gloss.of_sample(sample)
    request = Request(sample, radians(sample.sigma_degrees or 0.0), gloss=gloss)
    [solution] = solve.solve([request], space)
    lobe = instrument_lobe.reflectance(
        np.asarray(solution.color), solution.roughness, request.read_at
    )
    shown = space.to_lab(gloss_reading.reading(lobe, gloss, request.read_at), "D65")
    [source] = readers.read(path)
    weights = tristimulus.weights(source.wavelengths, "D65", 2)
    wanted = color_difference.xyz_to_lab(source.reflectance @ weights, weights.sum(axis=0))
    return float(color_difference.delta_e(shown, wanted))


def file_of(material: Material, usgs: Path, nix: Path) -> Path:
    """Return the path of a material's measurement."""
    return next((nix if material.file.endswith(".csv") else usgs).rglob(material.file))


def main(arguments: list[str]) -> int:
    """Check all of them and say what was found."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("usgs", type=Path, metavar="USGS-FOLDER")
    parser.add_argument("nix", type=Path, metavar="NIX-FOLDER")
    options = parser.parse_args(arguments)
    stated = dict(re.findall(r"\| `([^`]+)` \| `([0-9a-f]{64})` \|", README.read_text("utf-8")))
    space = WorkingSpace("Linear Rec.709", srgb.FROM_XYZ)
    found: dict[str, float] = {}
    faults = []
    for material in MATERIALS:
        path = file_of(material, options.usgs, options.nix)
        if hashlib.sha256(path.read_bytes()).hexdigest() != stated.get(material.file):
            faults.append(f"{material.file} is not the file that {README.name} lists")
        found[material.slug] = difference(f"everyday/{material.slug}", path, space)
        if found[material.slug] > LARGEST:
            faults.append(f"{material.slug} reads ΔE00 {found[material.slug]:.4f} off its source")
    worst = max(found, key=found.__getitem__)
    print(f"{len(found)} presets; the worst, {worst}, is ΔE00 {found[worst]:.4f} off its source")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
