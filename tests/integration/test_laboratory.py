# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The laboratory from the command line and from the menu."""

import csv
from math import radians

import bpy
import numpy as np
import pytest
from rough_spectra.addon.laboratory import kinds

from tests.integration.test_operators import refusal

OPS = bpy.ops.rough_spectra
QUICK = ("--cells", "32", "--seeds", "2", "--rays", "4")


def everything():
    """Names of all that a sample could leave in a file."""
    return {
        kind: sorted(thing.name for thing in getattr(bpy.data, kind))
        for kind in ("objects", "meshes", "materials", "lights", "cameras")
    }


def rows(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def test_albedos_are_measured_into_a_table(main, tmp_path):
    target = tmp_path / "lab.csv"
    result = main("lab", "--sigma", "30", "--albedo", ".2", ".8", *QUICK, "--output", str(target))
    assert result.status == 0, result.err
    assert "2048 facets, Rdq 0.5774, Sdq 0.8165; 2 readings, noise at most" in result.err
    found = rows(target)
    assert [row["albedo"] for row in found] == ["0.200000", "0.800000"]
    for row in found:
        assert float(row["reflectance"]) == pytest.approx(float(row["predicted"]), rel=0.1)


def test_rdq_and_sdq_stand_for_sigma(main, tmp_path):
    tables = []
    for number, slope in enumerate((("--rdq", "0.5"), ("--sdq", "0.70710678"))):
        target = tmp_path / f"{number}.csv"
        result = main("lab", *slope, "--albedo", "0.5", *QUICK, "--output", str(target))
        assert "Rdq 0.5000" in result.err
        tables.append(rows(target))
    assert tables[0][0]["predicted"] == tables[1][0]["predicted"]


def test_a_presets_spectrum_is_measured_band_by_band(main, tmp_path):
    target = tmp_path / "green.csv"
    sample = ("--sample", "14 green", "--kind", "grooves", "--sigma", "20")
    assert main("lab", *sample, *QUICK, "--output", str(target)).status == 0
    found = rows(target)
    assert found[0]["wavelength_nm"] == "380"
    ratio = [float(row["reflectance"]) / float(row["albedo"]) for row in found]
    assert 0.8 < min(ratio) < max(ratio) < 1.01


def test_a_map_of_heights_is_measured(main, tmp_path):
    heights = tmp_path / "wave.csv"
    x = np.arange(16)
    np.savetxt(heights, np.sin(2 * np.pi * x / 16) + 0 * x[:, np.newaxis], delimiter=",")
    target = tmp_path / "wave-lab.csv"
    asked = ("lab", "--map", str(heights), "--albedo", "0.5", *QUICK, "--output", str(target))
    refused = main(*asked)
    assert refused.status == 2
    assert "does not say how far apart its heights are" in refused.sentence
    assert not target.exists()
    assert main(*asked, "--length", "1").status == 0
    assert "sigma: as it came; Rdq" in target.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("--sigma", "30"), "Give either --albedo, or a spectrum with --sample or --file."),
        (("--albedo", "0.5"), "A sample of the kind 'gaussian' needs a roughness; give σ."),
        (("--albedo", "1.5", "--sigma", "30"), "An albedo is 1.5; give 0 to 1."),
        (("--albedo", "0.5", "--sigma", "95"), "σ is 95°; give 0 to below 90 degrees"),
        (
            ("--albedo", "0.5", "--rdq", "-1"),
            "Rdq is an rms slope, rise over run: it has to be 0 or larger",
        ),
        (("--albedo", "0.5", "--sigma", "30", "--spot", "99"), "The spot is 99 wide"),
        (("--sample", "no such thing", "--sigma", "30"), "no such thing"),
        (("--albedo", "0.5", "--map", "none.xyz"), "none.xyz cannot be read"),
    ],
)
def test_what_cannot_be_measured_leaves_no_file(main, tmp_path, words, sentence):
    result = main("lab", *words, "--output", str(tmp_path / "lab.csv"))
    assert result.status == 2
    assert sentence in result.sentence
    assert list(tmp_path.glob("lab*")) == []


def test_a_rough_sample_is_put_into_the_scene():
    before = len(bpy.data.objects)
    assert OPS.add_rough_sample("EXEC_DEFAULT", sigma=radians(30), cells=32) == {"FINISHED"}
    thing = bpy.context.active_object
    assert len(bpy.data.objects) == before + 1
    assert thing.select_get()
    assert thing.dimensions[:2] == pytest.approx((2.0, 2.0))
    assert not thing.data.materials
    normals = np.array([polygon.normal[:] for polygon in thing.data.polygons])
    slopes = normals[:, :2] / normals[:, 2:]
    assert np.sqrt(np.mean(slopes**2)) == pytest.approx(np.tan(radians(30)), rel=1e-4)
    assert not any(polygon.use_smooth for polygon in thing.data.polygons)


@pytest.mark.parametrize("kind", [kind for kind in kinds.KINDS if kind != "map"])
def test_every_kind_can_be_put(kind):
    assert OPS.add_rough_sample("EXEC_DEFAULT", kind=kind.upper(), cells=32) == {"FINISHED"}
    thing = bpy.context.active_object
    assert thing.dimensions[:2] == pytest.approx((2.0, 2.0), rel=1e-5)


def test_facets_get_a_material_and_the_instrument_its_lights():
    assert OPS.add_rough_sample(
        "EXEC_DEFAULT", cells=32, sample="colorchecker/14-green", with_instrument=True
    ) == {"FINISHED"}
    [material] = bpy.context.active_object.data.materials
    assert material.rough_spectra.kind.lower() == "albedo"
    assert material.rough_spectra.sigma == 0
    suns = [thing for thing in bpy.context.scene.objects if thing.type == "LIGHT"]
    assert len(suns) == 8
    assert bpy.context.scene.camera.data.type == "ORTHO"


def test_an_undo_takes_everything_away():
    bpy.ops.ed.undo_push(message="before")
    before = everything()
    OPS.add_rough_sample(
        "EXEC_DEFAULT", True, cells=32, sample="colorchecker/14-green", with_instrument=True
    )
    assert everything() != before
    bpy.ops.ed.undo()
    assert everything() == before


def test_bad_input_adds_nothing(tmp_path):
    before = everything()
    assert "needs a file" in refusal(OPS.add_rough_sample, kind="MAP")
    missing = str(tmp_path / "none.xyz")
    assert missing in refusal(OPS.add_rough_sample, kind="MAP", filepath=missing)
    assert "no such" in refusal(OPS.add_rough_sample, sample="no such", cells=32)
    assert everything() == before
