# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the everyday presets from the measurement files that they come from.

    python -m tools.tables.make_everyday_presets USGS-FOLDER NIX-FOLDER [FOLDER]

USGS-FOLDER holds the files of splib07a that `MATERIALS` names, with their wavelength file, in any
subfolders: they are in ASCIIdata_splib07a.zip of https://doi.org/10.5066/F7RR1WDJ. NIX-FOLDER holds
the Nix exports that it names; the database has each as data/materials/NAME/nix_export.csv at
https://github.com/AntonPalmqvist/physically-based-api, and `tests/fixtures/nix` has some. Equal
data give equal bytes. Needs numpy, and no Blender.
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

FIRST_NM, LAST_NM, STEP = 380, 780, 5
"""Which channels of a USGS file are taken: color needs no more, and no value is interpolated."""

NIX_SOURCE = "Physically Based database, https://physicallybased.info, Nix export '{file}'"
USGS_SOURCE = (
    "Kokaly, R.F., and others (2017), USGS Spectral Library Version 7, U.S. Geological Survey Data "
    "Series 1035, https://doi.org/10.3133/ds1035, every fifth channel from {first} to {last} nm of "
    "the file '{file}'"
)
SIGMA = {
    10: "Estimate, not measured: 10°, the lowest of three steps (10°, 20°, 30°), because {why}.",
    20: "Estimate, not measured: 20°, the middle of three steps (10°, 20°, 30°), because {why}.",
    30: "Estimate, not measured: 30°, the highest of three steps (10°, 20°, 30°), because {why}.",
}
"""Three steps are all that looking at a material can tell apart; docs/presets.md gives reasons."""

GLOSS = {
    0: "Estimate, not measured: none, the lowest of three steps (none, 5, 12), because {why}.",
    5: "Estimate, not measured: 5 units at 60°, the middle of three steps (none, 5, 12), because "
    "{why}.",
    12: "Estimate, not measured: 12 units at 60°, the highest of three steps (none, 5, 12), "
    "because {why}.",
}
"""Of gloss as well: dull from every side, a sheen toward the light, a soft highlight."""

BRIGHTENER = (
    "It reflects more near 440 nm than at 550 nm, as fabric and paper with optical brightener do: "
    "its look depends on the ultraviolet in the light, which no reflectance can say."
)


DULL = "it looks dull from every side"
FIRED = "fired clay is fine-grained and was not polished"
SHAKE = "split wood shows its fibers, and weather raises them"
BOARD = "chips and fibers are pressed flat, but not sanded"
RIPSTOP = "it is a thin, tight weave"
NYLON = "threads of nylon are smooth"
PILE = "its fibers stand up from the fabric"
GRANULES = "it is covered with grains of stone"
POWDER = "a powder that was brushed out is even but not flat"
PEEL = "a peel has pores, and is smooth between them"
WAXY = "a peel is waxy"
FIBERS = "stalks lie over each other"

PIGMENT = (
    "The sample is the dry powder of the pigment: a binder makes most pigments darker and more "
    "saturated."
)
FIELD = "It is a field spectrum, under the sun."


@dataclass(frozen=True)
class Material:
    """One preset.

    Parameters
    ----------
    slug, name
        File name and what people call it.
    file
        Measurement file; a table of the Nix, or one of the USGS.
    sigma
        Degrees, a key of `SIGMA`.
    why
        Reason for that step.
    notes
        What a user has to know.
    gloss
        Gloss units at 60°, a key of `GLOSS`.
    shine
        Reason for that step.
    """

    slug: str
    name: str
    file: str
    sigma: int
    why: str
    notes: tuple[str, ...] = ()
    gloss: int = 0
    shine: str = DULL


def _usgs(title: str, spectrometer: str = "ASDFRa") -> str:
    return f"splib07a_{title}_{spectrometer}_AREF.txt"


MATERIALS = (
    Material(
        "blackboard",
        "Blackboard",
        "blackboard.csv",
        10,
        "a writing board is even",
        gloss=5,
        shine="its paint has a sheen toward the light",
    ),
    Material("brick", "Brick", "brick.csv", 20, FIRED),
    Material(
        "brick-light-gray",
        "Brick, light gray",
        _usgs("Brick_GDS354_Building_Lt_Gry"),
        20,
        FIRED,
    ),
    Material(
        "brick-medium-red",
        "Brick, medium red",
        _usgs("Brick_GDS353_Building_MedRed"),
        20,
        FIRED,
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
        "egg-shell",
        "Egg shell, brown",
        "egg-shell-brown.csv",
        10,
        "a shell feels smooth and dull",
        gloss=5,
        shine="a shell has a sheen toward the light",
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
        gloss=5,
        shine="sized paper has a sheen toward the light",
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
        FIRED,
    ),
    Material(
        "asphalt",
        "Asphalt, old road",
        _usgs("Asphalt_GDS376_Blck_Road_old"),
        30,
        "a worn road shows its stones",
    ),
    Material("basalt", "Basalt", _usgs("Pyroxene_Basalt_CU01-20A"), 30, "broken rock is coarse"),
    Material("brick-dark-red", "Brick, dark red", _usgs("Brick_GDS350_Dk_Red_Building"), 20, FIRED),
    Material(
        "cardboard-corrugated",
        "Cardboard, corrugated",
        _usgs("Cardboard_GDS371_Brn_Corgted"),
        20,
        "its paper follows the flutes below it",
    ),
    Material("carpet-brown", "Carpet, light brown", _usgs("Nylon_Carpet_GDS535_LtBrown"), 30, PILE),
    Material("carpet-gray", "Carpet, gray", _usgs("Nylon_Carpet_GDS536_Gry_Pile"), 30, PILE),
    Material(
        "cedar",
        "Cedar shake, fresh",
        _usgs("Cedar_Shake_GDS357_Fresh"),
        20,
        "split wood shows its fibers",
    ),
    Material("cedar-gray", "Cedar shake, gray", _usgs("Cedar_Shake_GDS361_HiWeather"), 30, SHAKE),
    Material(
        "cedar-mossy",
        "Cedar shake, mossy",
        _usgs("Cedar_Shake_GDS360_H_Weamoss"),
        30,
        "moss grows on it",
    ),
    Material(
        "cedar-weathered",
        "Cedar shake, weathered",
        _usgs("Cedar_Shake_GDS359_MedWeathr"),
        30,
        SHAKE,
    ),
    Material(
        "chocolate",
        "Chocolate",
        "chocolate.csv",
        10,
        "it was poured into a smooth mold",
        gloss=12,
        shine="cocoa butter shines softly",
    ),
    Material(
        "egg-shell-white",
        "Egg shell, white",
        "egg-shell-white.csv",
        10,
        "a shell feels smooth and dull",
        gloss=5,
        shine="a shell has a sheen toward the light",
    ),
    Material("fleece-black", "Fleece, black", _usgs("Polyester_Pile_GDS434_Blk"), 30, PILE),
    Material("fleece-green", "Fleece, dark green", _usgs("Polyester_Pile_GDS435_DkGrn"), 30, PILE),
    Material("grass-dry", "Grass, dry", _usgs("Grass_Golden_Dry_GDS480"), 30, FIBERS),
    Material("lemon-peel", "Lemon peel", "lemon.csv", 20, PEEL, gloss=12, shine=WAXY),
    Material(
        "limestone",
        "Limestone",
        _usgs("Limestone_CU02-11A"),
        20,
        "it is fine-grained, and was broken",
    ),
    Material("musou-black", "Musou Black paint", "musou-black.csv", 30, "its pores swallow light"),
    Material(
        "nylon-blue",
        "Nylon, blue ripstop",
        _usgs("Nylon_Fabric_GDS433_Blu_RpSt"),
        10,
        RIPSTOP,
        gloss=5,
        shine=NYLON,
    ),
    Material(
        "nylon-green",
        "Nylon, green ripstop",
        _usgs("Nylon_Fabric_GDS432_Grn_RpSt"),
        10,
        RIPSTOP,
        gloss=5,
        shine=NYLON,
    ),
    Material(
        "nylon-red",
        "Nylon, red ripstop",
        _usgs("Nylon_Fabric_GDS431_Red_RpSt"),
        10,
        RIPSTOP,
        gloss=5,
        shine=NYLON,
    ),
    Material("orange-peel", "Orange peel", "orange.csv", 20, PEEL, gloss=12, shine=WAXY),
    Material("particle-board", "Particle board", _usgs("Particle_Board_GDS364_Fn_Gr"), 10, BOARD),
    Material(
        "paving-dark-gray",
        "Paving brick, dark gray",
        _usgs("Brick_GDS355_Paving_Dk_Gry"),
        20,
        FIRED,
    ),
    Material("paving-red", "Paving brick, red", _usgs("Brick_GDS349_Paving_Red"), 20, FIRED),
    Material("paving-tan", "Paving brick, tan", _usgs("Brick_GDS347_Paving_Tan"), 20, FIRED),
    Material(
        "pigment-alizarin",
        "Pigment, alizarin crimson",
        _usgs("Alizarin_crimson_(dk)_GDS780"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-burnt-sienna",
        "Pigment, burnt sienna",
        _usgs("Italian_burnt_sienna_GDS812"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-burnt-umber",
        "Pigment, burnt umber",
        _usgs("Burnt_umber_GDS811"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-cerulean",
        "Pigment, cerulean blue",
        _usgs("Cerulean_blue_GDS797"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-chromium-green",
        "Pigment, chromium oxide green",
        _usgs("Oxide_of_chromium_GDS795"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-cobalt-green",
        "Pigment, cobalt green",
        _usgs("Cobalt_green_GDS816"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-cobalt-violet",
        "Pigment, cobalt violet",
        _usgs("Cobalt_violet_GDS803"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-iron-oxide",
        "Pigment, iron oxide red",
        _usgs("Iron_oxide_#4820_GDS782"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-lapis",
        "Pigment, lapis lazuli",
        _usgs("Lazurite_GDS792_RussianPrem"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-lead-tin-yellow",
        "Pigment, lead-tin yellow",
        _usgs("Lead-tin_yellow_GDS793"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-lead-white",
        "Pigment, lead white",
        _usgs("Lead_White_GDS796"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-malachite",
        "Pigment, malachite",
        _usgs("Malachite_GDS801_synthetic"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-naples-yellow",
        "Pigment, Naples yellow",
        _usgs("Naples_yellow_GDS787"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-ochre",
        "Pigment, yellow ochre",
        _usgs("Yellow_ochre_GDS794_Germany"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-pozzuoli",
        "Pigment, Pozzuoli red earth",
        _usgs("Terra_Pozzuoli_GDS806"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-raw-umber",
        "Pigment, raw umber",
        _usgs("Natural_umber_GDS809_(raw)"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-sienna",
        "Pigment, raw sienna",
        _usgs("Italian_nat_sienna_GDS805"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-ultramarine",
        "Pigment, ultramarine",
        _usgs("Ultramarine_GDS791_sy_vdark"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-venetian-red",
        "Pigment, Venetian red",
        _usgs("Venetian_red_GDS783"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-vermilion",
        "Pigment, vermilion",
        _usgs("Vermillion_GDS779"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pigment-zinc-white",
        "Pigment, zinc white",
        _usgs("Zinc_oxide_GDS807_(ZnO)"),
        20,
        POWDER,
        (PIGMENT,),
    ),
    Material(
        "pine",
        "Pine, planed",
        _usgs("Wood_Beam_GDS363_Nw_Pine_2X4"),
        10,
        "it was planed, and never sanded",
    ),
    Material(
        "pine-needles",
        "Pine needles, dry",
        _usgs("Lodgepole-Pine_LP-Needles-2"),
        30,
        "needles lie over each other",
    ),
    Material(
        "plywood",
        "Plywood, pine",
        _usgs("Plywood_GDS365_Fresh_Pine"),
        10,
        "its veneer was peeled and pressed flat",
    ),
    Material("polystyrene", "Polystyrene foam", "polystyrene.csv", 20, "its beads bulge"),
    Material(
        "polystyrene-blue",
        "Polystyrene foam, blue",
        _usgs("Polystyrene_GDS345_BluInsul"),
        10,
        "an extruded board has a skin",
    ),
    Material(
        "printed-black",
        "Paper, printed black",
        "toner-black.csv",
        10,
        "paper is pressed flat",
        gloss=5,
        shine="toner melts to a film",
    ),
    Material("reed", "Reed, dry", _usgs("P.aus._DWO-3-DEL-2d_dryNPV.a"), 30, FIBERS, (FIELD,)),
    Material(
        "roofing-felt",
        "Roofing felt",
        _usgs("Roofing_Felt_GDS377_Black"),
        20,
        "felt was soaked with tar and rolled",
    ),
    Material("rust", "Rust", _usgs("Rusted_Tin_Can_GDS378_MV99-6"), 30, "rust grows in scales"),
    Material(
        "sage-leaves",
        "Sage leaves, dry",
        _usgs("Sagebrush_Sage-Leaves-1_dry"),
        30,
        "leaves have fine hairs, and lie over each other",
    ),
    Material(
        "sand-beach",
        "Sand, beach",
        _usgs("Sand_DWO-3-DEL2ar1_no_oil"),
        30,
        "grains lie beside each other like spheres",
        ("It is a field spectrum of a beach.",),
    ),
    Material(
        "shingle-dark-gray",
        "Roof shingle, dark gray",
        _usgs("Asphalt_Shingle_GDS367_DkGry"),
        30,
        GRANULES,
    ),
    Material(
        "shingle-light-gray",
        "Roof shingle, light gray",
        _usgs("Asphalt_Shingle_GDS368_Lgray"),
        30,
        GRANULES,
    ),
    Material("shingle-tan", "Roof shingle, tan", _usgs("Asphalt_Shingle_GDS366_Tan"), 30, GRANULES),
    Material(
        "siding",
        "Siding, painted light gray",
        _usgs("Painted_Aluminum_GDS333_LgGr"),
        10,
        "paint levels itself on sheet metal",
        gloss=12,
        shine="house paint has a soft highlight",
    ),
    Material(
        "soil-burnt",
        "Soil, burnt",
        _usgs("BurnArea_Traverse_WRF00-01", "ASDFRb"),
        30,
        "ash and soil lie loose",
        (FIELD,),
    ),
    Material("strand-board", "Strand board", _usgs("Strand_Board_GDS362_Oriented"), 20, BOARD),
    Material(
        "tar-paper",
        "Tar paper, weathered",
        _usgs("Tar_Paper_GDS285B_Weath_Blk"),
        20,
        "felt was soaked with tar and rolled",
    ),
    Material(
        "tarp-blue",
        "Tarpaulin, blue",
        _usgs("Plastic_Tarp_GDS340_Blu_Wovn"),
        10,
        "it is a tight weave of flat bands",
        gloss=12,
        shine="its plastic has a soft highlight",
    ),
    Material(
        "tire",
        "Tire rubber",
        "tire.csv",
        20,
        "rubber keeps the grain of its mold",
        gloss=5,
        shine="rubber has a sheen toward the light",
    ),
    Material(
        "toilet-paper",
        "Toilet paper",
        "toilet-paper.csv",
        20,
        "it is creped and soft",
        (BRIGHTENER,),
    ),
    Material(
        "toothpaste",
        "Toothpaste",
        "toothpaste.csv",
        10,
        "a paste levels itself",
        gloss=12,
        shine="it is moist",
    ),
    Material(
        "tuff-red",
        "Tuff, red",
        _usgs("Hematitic_Alt._Tuff_CU91-223", "ASDFRb"),
        30,
        "broken rock is coarse",
    ),
    Material(
        "tyvek",
        "Tyvek sheet",
        _usgs("Plastic_Tyvek_GDS369_White"),
        10,
        "its fibers are pressed flat",
        gloss=5,
        shine="its fibers are smooth",
    ),
    Material(
        "webbing-black",
        "Webbing, black",
        _usgs("Polyester_Webbing_GDS429_Blk"),
        20,
        "it is a coarse, tight weave",
    ),
    Material(
        "webbing-olive",
        "Webbing, olive drab",
        _usgs("Nylon_Webbing_GDS428_OlvDrab"),
        20,
        "it is a coarse, tight weave",
    ),
    Material(
        "willow-dead",
        "Willow, dead",
        _usgs("Willow_Dead_FluvTailSite_A"),
        30,
        "twigs and bark are furrowed",
        (FIELD,),
    ),
)


def preset(material: Material, usgs: Path, nix: Path) -> dict[str, Any]:
    """Return the fields of one preset.

    Parameters
    ----------
    material
        What to make.
    usgs
        Folder with the files of splib07a.
    nix
        Folder with the Nix exports.
    """
    from rough_spectra.addon.samples import readers

    of_nix = material.file.endswith(".csv")
    missing: list[int] = []
    found = [*(nix if of_nix else usgs).rglob(material.file)]
    if not found:
        raise SystemExit(f"{material.file} is not in {nix if of_nix else usgs}.")
    path = found[0]
    [sample] = readers.read(path)
    pairs = zip(sample.wavelengths, sample.values, strict=True)
    bands = [(round(nm, 2), value) for nm, value in pairs]
    if not of_nix:
        wanted = range(FIRST_NM, LAST_NM + 1, STEP)
        bands = [(nm, value) for nm, value in bands if nm in wanted]
        missing = sorted(set(wanted) - {nm for nm, _ in bands})
    told = [ASSUMED, *([DELETED.format(nm=" and ".join(map(str, missing)))] if missing else [])]
    source = NIX_SOURCE if of_nix else USGS_SOURCE
    fields = {
        "$schema": "../schema.json",
        "format": "rough-spectra-preset",
        "schema": 1,
        "id": f"everyday/{material.slug}",
        "name": material.name,
        "source": source.format(file=material.file, first=FIRST_NM, last=LAST_NM),
        "license": "CC0-1.0" if of_nix else "public domain (U.S. Geological Survey)",
        "kind": "reading",
        "instrument": sample.instrument,
        "sigma_degrees": material.sigma,
        "sigma_source": SIGMA[material.sigma].format(why=material.why),
        "gloss": {"60": material.gloss} if material.gloss else {},
        "gloss_source": GLOSS[material.gloss].format(why=material.shine),
        "quantity": sample.quantity,
        "geometry": sample.geometry,
        "device": sample.device,
        "condition": sample.condition,
        "illuminant": sample.illuminant,
        "observer": sample.observer,
        "lab": sample.lab and list(sample.lab),
        "notes": [*material.notes, *(sample.notes if of_nix else told)],
        "wavelengths": [int(nm) for nm, _ in bands],
        "values": [float(value) for _, value in bands],
    }
    return {key: value for key, value in fields.items() if value not in ("", None, [])}


ASSUMED = "The library does not say the geometry; 45°a:0° is assumed."
DELETED = "The library has no values at {nm} nm."


def main(arguments: list[str]) -> int:
    """Write the presets and say where."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("usgs", type=Path, metavar="USGS-FOLDER")
    parser.add_argument("nix", type=Path, metavar="NIX-FOLDER")
    parser.add_argument("folder", type=Path, nargs="?", default=FOLDER)
    options = parser.parse_args(arguments)
    load_extension()
    made = [preset(material, options.usgs, options.nix) for material in MATERIALS]
    written = make_presets.write_presets(made, options.folder)
    print(f"{len(written)} presets in {options.folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
