# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the everyday presets from the measurement files that they come from.

    python -m tools.tables.make_everyday_presets USGS-FOLDER [FOLDER]

The Nix exports are those of ``tests/fixtures/nix``. USGS-FOLDER holds the files of splib07a that
`MATERIALS` names, with their wavelength file, in any subfolders: they are in ASCIIdata_splib07a.zip
of https://doi.org/10.5066/F7RR1WDJ. Equal data give equal bytes. Needs numpy, and no Blender.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tools.run.run_command_line import ROOT, load_extension
from tools.tables import make_presets

FOLDER = ROOT / "presets" / "everyday"
NIX = ROOT / "tests" / "fixtures" / "nix"

FIRST_NM, LAST_NM, STEP = 380, 780, 5
"""Which channels of a USGS file are taken: color needs no more, and no value is interpolated."""

NIX_SOURCE = "Physically Based database, https://physicallybased.info, Nix export '{file}'"
USGS_SOURCE = (
    "Kokaly, R.F., and others (2017), USGS Spectral Library Version 7, U.S. Geological Survey Data "
    "Series 1035, https://doi.org/10.3133/ds1035, file '{file}'"
)
SIGMA = {
    10: "Estimate, not measured: 10°, the lowest of three steps (10°, 20°, 30°), because {why}.",
    20: "Estimate, not measured: 20°, the middle of three steps (10°, 20°, 30°), because {why}.",
    30: "Estimate, not measured: 30°, the highest of three steps (10°, 20°, 30°), because {why}.",
}
"""Three steps are all that looking at a material can tell apart; docs/presets.md gives reasons."""

BRIGHTENER = (
    "It reflects more near 440 nm than at 550 nm, as fabric and paper with optical brightener do: "
    "its look depends on the ultraviolet in the light, which no reflectance can say."
)


@dataclass(frozen=True)
class Material:
    """One preset.

    Parameters
    ----------
    slug, name
        File name and what people call it.
    file
        Measurement file, in `NIX` or in the USGS folder.
    sigma
        Degrees, a key of `SIGMA`.
    why
        Reason for that step.
    notes
        What a user has to know.
    """

    slug: str
    name: str
    file: str
    sigma: int
    why: str
    notes: tuple[str, ...] = ()


def _usgs(title: str, spectrometer: str = "ASDFRa") -> str:
    return f"splib07a_{title}_{spectrometer}_AREF.txt"


MATERIALS = (
    Material("blackboard", "Blackboard", "blackboard.csv", 10, "a writing board is even"),
    Material("brick", "Brick", "brick.csv", 20, "fired clay is fine-grained and was not polished"),
    Material(
        "brick-light-gray",
        "Brick, light gray",
        _usgs("Brick_GDS354_Building_Lt_Gry"),
        20,
        "fired clay is fine-grained and was not polished",
    ),
    Material(
        "brick-medium-red",
        "Brick, medium red",
        _usgs("Brick_GDS353_Building_MedRed"),
        20,
        "fired clay is fine-grained and was not polished",
    ),
    Material(
        "burlap",
        "Burlap",
        _usgs("Burlap_Fabric_GDS430_Brown"),
        30,
        "the library calls it a coarse fabric",
    ),
    Material("cardboard", "Cardboard", "cardboard.csv", 10, "its paper is pressed flat"),
    Material(
        "chalk",
        "Chalk",
        _usgs("Calcite_GDS304_75-150um", "ASDFRb"),
        20,
        "a powder that was pressed to a stick and rubbed off is even but not flat",
        (
            "The sample is Iceland spar, ground and sieved to 75 to 150 µm: chalk is the same "
            "mineral, calcite, but was not measured itself; its grains are finer.",
        ),
    ),
    Material(
        "cinder-block",
        "Cinder block",
        _usgs("Cinder_Block_GDS356_Lg_Grey"),
        30,
        "the library calls its surface moderately rough, and its pores are open",
    ),
    Material(
        "clay",
        "Clay, unglazed white",
        _usgs("Kaolinite_CM9", "ASDNGb"),
        20,
        "unglazed clay is fine-grained and was not polished",
        (
            "The sample is kaolinite powder, the mineral of white clay, before firing: firing "
            "changes the color of any clay that is not pure.",
        ),
    ),
    Material(
        "cloth",
        "Cloth, white cotton",
        _usgs("Cotton_Fabric_GDS437_White"),
        20,
        "the library calls it finely woven, and threads are round",
        (BRIGHTENER,),
    ),
    Material(
        "cloth-terry",
        "Cloth, yellow terry",
        _usgs("Terrycloth_Fabric_GDS537_Yel"),
        30,
        "its loops stand up from the fabric",
    ),
    Material(
        "concrete",
        "Concrete",
        _usgs("Concrete_GDS375_Lt_Gry_Road"),
        30,
        "a fragment of a road shows its grains of sand",
    ),
    Material(
        "egg-shell", "Egg shell, brown", "egg-shell-brown.csv", 10, "a shell feels smooth and dull"
    ),
    Material(
        "mud",
        "Mud, dry",
        _usgs("Stonewall_Playa_Dry_Mud_2001"),
        20,
        "a dry lake bed is fine-grained and level, but cracked",
        ("It is the mean of 174 field spectra of a dry lake bed, under the sun.",),
    ),
    Material(
        "paper",
        "Paper, office",
        "office-paper.csv",
        10,
        "paper is pressed flat",
        (BRIGHTENER,),
    ),
    Material(
        "plaster",
        "Plaster, gypsum",
        _usgs("Gypsum_HS333.3B_(Selenite)"),
        20,
        "a wall that was smoothed by hand is even but not flat",
        (
            "The sample is ground gypsum, 74 to 250 µm: set plaster is the same mineral, but was "
            "not measured itself.",
        ),
    ),
    Material(
        "sand",
        "Sand, dry",
        _usgs("Sand_GrndIsle1_no_oil"),
        30,
        "grains lie beside each other like spheres",
        ("It is a field spectrum of clean dune sand.",),
    ),
    Material(
        "sand-wet",
        "Sand, wet",
        _usgs("Sand_DWO-3-DEL2ar2_wet_noOil"),
        20,
        "water fills the gaps between the grains",
        ("Wet sand also glints, which a diffuse material cannot.",),
    ),
    Material(
        "terracotta",
        "Terracotta",
        "terracotta.csv",
        20,
        "fired clay is fine-grained and was not polished",
    ),
)


def preset(material: Material, usgs: Path) -> dict[str, Any]:
    """Return the fields of one preset.

    Parameters
    ----------
    material
        What to make.
    usgs
        Folder with the files of splib07a.
    """
    from rough_spectra.addon.samples import readers

    nix = material.file.endswith(".csv")
    missing: list[int] = []
    path = NIX / material.file if nix else next(usgs.rglob(material.file))
    [sample] = readers.read(path)
    pairs = zip(sample.wavelengths, sample.values, strict=True)
    bands = [(round(nm, 2), value) for nm, value in pairs]
    if not nix:
        wanted = range(FIRST_NM, LAST_NM + 1, STEP)
        bands = [(nm, value) for nm, value in bands if nm in wanted]
        missing = sorted(set(wanted) - {nm for nm, _ in bands})
    source = NIX_SOURCE if nix else USGS_SOURCE
    fields = {
        "$schema": "../schema.json",
        "format": "rough-spectra-preset",
        "schema": 1,
        "id": f"everyday/{material.slug}",
        "name": material.name,
        "source": source.format(file=material.file),
        "license": "CC0-1.0" if nix else "public domain (U.S. Geological Survey)",
        "kind": "reading",
        "instrument": sample.instrument,
        "sigma_degrees": material.sigma,
        "sigma_source": SIGMA[material.sigma].format(why=material.why),
        "quantity": sample.quantity,
        "geometry": sample.geometry,
        "device": sample.device,
        "condition": sample.condition,
        "illuminant": sample.illuminant,
        "observer": sample.observer,
        "lab": sample.lab and list(sample.lab),
        "notes": [*material.notes, *(sample.notes if nix else [ASSUMED])],
        "altered": []
        if nix
        else [THINNED, *([DELETED.format(nm=" and ".join(map(str, missing)))] if missing else [])],
        "wavelengths": [int(nm) for nm, _ in bands],
        "values": [float(value) for _, value in bands],
    }
    return {key: value for key, value in fields.items() if value not in ("", None, [])}


ASSUMED = "The library does not say the geometry; 45°a:0° is assumed."
DELETED = "The library has no values at {nm} nm."
THINNED = (
    f"Every fifth channel from {FIRST_NM} to {LAST_NM} nm is here, as the library has it; the "
    "others were left out."
)


def main(arguments: list[str]) -> int:
    """Write the presets and say where."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("usgs", type=Path, metavar="USGS-FOLDER")
    parser.add_argument("folder", type=Path, nargs="?", default=FOLDER)
    options = parser.parse_args(arguments)
    load_extension()
    made = [preset(material, options.usgs) for material in MATERIALS]
    written = make_presets.write_presets(made, options.folder)
    print(f"{len(written)} presets in {options.folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
