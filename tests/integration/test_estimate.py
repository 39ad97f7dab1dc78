# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""σ from readings, by the verb and by the dialog."""

import csv
import json
import math

import bpy
import numpy as np
import pytest

from core import estimate, reading
from tests.integration.support import contents, rgb_material
from tests.integration.test_operators import mesh_object, refusal

OPS = bpy.ops.rough_spectra
NM = np.arange(400, 701, 10)
SIGMA = math.radians(25)
ALBEDO = 0.15 + 0.6 * np.exp(-(((NM - 600) / 60) ** 2))
GRAY = np.full(NM.size, 0.3)
ANGLES = ("45as15", "45as45", "45as110")


def read(albedo, instrument="45a:0", seed=None):
    """What an instrument reads of the rough surface, to five digits, with noise where seeded."""
    values = reading.from_albedo(albedo, SIGMA, estimate.MODEL, instrument)
    return values if seed is None else noisy(values, seed)


def noisy(values, seed):
    return values * (1 + 0.001 * np.random.default_rng(seed).standard_normal(values.size))


@pytest.fixture
def measured(tmp_path):
    """A file with what was read of two materials and at three angles."""
    columns = {
        "Paper": noisy(ALBEDO, 1),
        "Paper sanded": read(ALBEDO, seed=2),
        "Gray": noisy(GRAY, 3),
        "Gray sanded": read(GRAY, seed=4),
        "White": np.ones(NM.size),
    } | {name: read(ALBEDO, name, seed=5 + k) for k, name in enumerate(ANGLES)}
    return write(tmp_path / "measured.csv", columns)


def write(path, columns, nm=NM):
    rows = [["nm", *columns], *zip(nm, *(v.round(5) for v in columns.values()), strict=True)]
    path.write_text("".join(",".join(map(str, row)) + "\n" for row in rows), encoding="utf-8")
    return path


def rows_of(path):
    """The table: its rows by column, without the comments."""
    text = path.read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def test_a_pair_by_names(main, measured, tmp_path):
    target = tmp_path / "sigma.csv"
    words = (measured, "--smooth", "Paper", "--rough", "Paper sanded", "--output", target)
    result = main("estimate", *words)
    assert result.status == 0
    assumed, first, last = result.err.splitlines()
    assert assumed.endswith("The file does not say the geometry; 45°a:0° is assumed.")
    assert first.startswith("rough: σ 2")
    assert "by noise (95 %)" in first
    assert f"over the models {', '.join(estimate.SPREAD)}" in first
    assert last == f"wrote {target}"
    smooth, rough = rows_of(target)
    assert (smooth["smooth"], rough["smooth"]) == ("yes", "no")
    assert rough["told"] == "yes"
    low, best, high = (float(rough[name]) for name in ("low_deg", "sigma_deg", "high_deg"))
    assert low < best < high
    assert best == pytest.approx(25, abs=0.3)
    # The models' spread stands apart, and the model's own σ among it.
    assert float(rough[f"sigma_deg {estimate.MODEL}"]) == best
    assert float(rough["spread_low_deg"]) < low
    # A residual is the reading less what the model makes of the albedo that was inferred.
    residuals = [float(rough[f"residual {nm} nm"]) for nm in NM]
    assert float(rough["rms_residual"]) == pytest.approx(
        np.sqrt(np.mean(np.square(residuals))), rel=0.01
    )
    assert max(map(abs, residuals)) < 0.003


def test_several_roughnesses_of_a_table(main, measured, tmp_path):
    table = tmp_path / "which.csv"
    table.write_text(
        "sample,surface,material,file,instrument\n"
        "Paper,smooth,paper,measured.csv,\n"
        "Paper sanded,sanded,paper,measured.csv,\n"
        "Gray,smooth,gray,measured.csv,\n"
        "Gray sanded,sanded,gray,measured.csv,\n"
        + "".join(f"{name},tilted,paper 2,measured.csv,{name}\n" for name in ANGLES)
        + "White,white,,measured.csv,\n",
        encoding="utf-8",
    )
    result = main("estimate", "--mapping", table, "--output", tmp_path / "out.csv")
    assert result.status == 0
    found = rows_of(tmp_path / "out.csv")
    by_surface = {row["surface"]: row for row in found}
    assert [row["surface"] for row in found] == ["sanded"] * 4 + ["tilted"] * 3 + ["white"]
    for name in ("sanded", "tilted"):
        assert by_surface[name]["told"] == "yes"
        assert float(by_surface[name]["sigma_deg"]) == pytest.approx(25, abs=0.3)
    assert [row["instrument"] for row in found[4:7]] == list(ANGLES)
    white = by_surface["white"]
    assert (white["told"], white["sigma_deg"]) == ("no", "")
    assert "can't be told from one reading" in white["reason"]
    assert "white: σ can't be told" in result.err
    as_json = tmp_path / "which.json"
    lines = table.read_text(encoding="utf-8").splitlines()
    as_json.write_text(json.dumps(list(csv.DictReader(lines))), encoding="utf-8")
    assert main("estimate", "--mapping", as_json, "--output", tmp_path / "2.csv").status == 0
    assert (tmp_path / "2.csv").read_bytes() == (tmp_path / "out.csv").read_bytes()


def test_presets_and_pairs_in_order(main, measured, tmp_path):
    names = ("--smooth", "Paper", "--smooth", "Gray", "--rough", "Paper sanded")
    target = tmp_path / "out.csv"
    both = main("estimate", measured, *names, "--rough", "Gray sanded", "--output", target)
    assert both.status == 0
    assert {row["material"] for row in rows_of(target)} == {"Paper", "Gray"}
    same = (measured, "--smooth", "Paper", "--rough", "Paper", "--output", target)
    assert "σ = 0 within noise" in main("estimate", *same).err
    albedo = main("estimate", "--rough", "14 green", "--output", target)
    assert albedo.status == 2
    assert "Green is an albedo, which does not depend on roughness" in albedo.sentence


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ((), "Name the readings of the rough surface, with --rough NAME"),
        (("--rough", "Wood"), "No sample is named 'Wood'; the files have Paper, "),
        (
            ("--smooth", "Paper", "--smooth", "Gray", "--rough", "Gray sanded"),
            "2 smooth readings stand beside 1 rough ones",
        ),
        (("--rough", "Gray", "--repeatability", "-1"), "Surface 'rough': The relative repeat"),
        (("--rough", "Gray", "--repeatability", "nan"), "repeatability is nan; give 0 or more"),
    ],
)
def test_what_cannot_be_used_is_refused_and_nothing_written(
    words, sentence, main, measured, tmp_path
):
    result = main("estimate", measured, *words, "--output", tmp_path / "out.csv")
    assert result.status == 2
    assert sentence in result.sentence
    assert [*contents(tmp_path)] == ["measured.csv"]


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        ("sample\nPaper\n", "of which sample and surface are needed"),
        ("sample,surface,sigma\nPaper,x,3\n", "row 1: 'sigma' is not a column"),
        ("sample,surface\nPaper,\n", "row 1: sample and surface must both be given"),
        ("sample,surface,file\nPaper,smooth,measured.csv\n", "has no row of a rough surface"),
        (
            "sample,surface,file,instrument\nPaper,x,measured.csv,46:0\n",
            "row 1: instrument is '46:0'; make it one of: 45a:0, ",
        ),
        ("sample,surface,file\nWood,x,measured.csv\n", "has no sample 'Wood'"),
    ],
)
def test_a_table_with_a_fault_is_refused(rows, sentence, main, measured, tmp_path):
    table = tmp_path / "which.csv"
    table.write_text(rows, encoding="utf-8")
    result = main("estimate", "--mapping", table, "--output", tmp_path / "out.csv")
    assert result.status == 2
    assert sentence in result.sentence
    assert not (tmp_path / "out.csv").exists()


def test_readings_at_other_wavelengths_are_named(main, measured, tmp_path):
    other = write(tmp_path / "other.csv", {"Sphere": ALBEDO}, NM + 5)
    words = (measured, other, "--smooth", "Paper", "--rough", "Sphere")
    result = main("estimate", *words, "--output", tmp_path / "out.csv")
    assert result.status == 2
    assert "Band 1 is 400 nm in Paper and 405 nm in Sphere; export both" in result.sentence


def test_a_table_and_names_do_not_go_together(main, measured, tmp_path):
    words = ("--mapping", tmp_path / "x.csv", "--rough", "Gray", "--output", tmp_path / "out.csv")
    assert "leave files and names out" in main("estimate", *words).sentence


@pytest.fixture
def sanded(measured):
    """The material of an object, with the reading of the rough paper."""
    thing = mesh_object("Card", rgb_material("Card"))
    OPS.assign_file("EXEC_DEFAULT", filepath=str(measured), sample="Paper sanded")
    return thing.active_material


def stored(material):
    group = material.rough_spectra
    return group.sigma, group.sigma_source, group.spectrum, group.stamp


def test_the_dialog_writes_sigma_with_its_source(sanded, measured):
    node = next(n for n in sanded.node_tree.nodes if n.type == "BSDF_DIFFUSE")
    before, spectrum = tuple(node.inputs["Color"].default_value), sanded.rough_spectra.spectrum
    words = {"source": "FILE", "filepath": str(measured), "name_in_file": "Paper"}
    assert OPS.estimate_sigma("EXEC_DEFAULT", **words) == {"FINISHED"}
    group = sanded.rough_spectra
    assert math.degrees(group.sigma) == pytest.approx(25, abs=0.3)
    assert group.sigma_source.startswith("Estimated from Paper, Paper sanded by the model ")
    assert "by noise (95 %)" in group.sigma_source
    assert group.spectrum == spectrum  # what was measured stays
    assert tuple(node.inputs["Color"].default_value) != before  # the albedo behind the reading
    from rough_spectra.addon.material import state

    assert state.state(sanded).kind == "fresh"


def test_a_texture_is_scaled_anew_without_looking_again(sanded, measured, monkeypatch):
    """Its colors are known, and the window stood still while a second Blender looked."""
    from rough_spectra.addon import api
    from rough_spectra.addon.blender import texture_colors, texture_scale

    looks = []

    def seen(sockets):
        looks.append(len(sockets))
        return [np.random.default_rng(1).uniform(0.2, 0.5, (100, 3)) for _ in sockets]

    monkeypatch.setattr(texture_colors, "seen", seen)
    tree = sanded.node_tree
    node = next(n for n in tree.nodes if n.type == "BSDF_DIFFUSE")
    tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs["Color"], node.inputs["Color"])
    api.renew([sanded])
    before = texture_scale.factors(texture_scale.node_of(node.inputs["Color"]))
    words = {"source": "FILE", "filepath": str(measured), "name_in_file": "Paper"}
    assert OPS.estimate_sigma("EXEC_DEFAULT", **words) == {"FINISHED"}
    assert looks == [1]
    assert list(texture_scale.factors(texture_scale.node_of(node.inputs["Color"]))) != list(before)


def test_an_albedo_is_the_smooth_reading(measured):
    thing = mesh_object("Card", rgb_material("Card"))
    words = {"filepath": str(measured), "kind": "albedo"}
    OPS.assign_file("EXEC_DEFAULT", sample="Paper", **words)
    rough = {"source": "FILE", "filepath": str(measured), "name_in_file": "Paper sanded"}
    assert OPS.estimate_sigma("EXEC_DEFAULT", **rough) == {"FINISHED"}
    assert math.degrees(thing.active_material.rough_spectra.sigma) == pytest.approx(25, abs=0.3)


def test_what_cannot_be_told_changes_nothing(sanded, measured, tmp_path):
    before = stored(sanded)
    file = {"source": "FILE", "filepath": str(measured)}
    assert refusal(OPS.estimate_sigma).startswith("Name the second reading")
    assert "has 6 samples" in refusal(OPS.estimate_sigma, **file)
    brighter = refusal(OPS.estimate_sigma, **file, name_in_file="Gray sanded")
    assert brighter.startswith("σ can't be told")
    other = write(tmp_path / "other.csv", {"Paper": ALBEDO}, NM + 5)
    at_others = refusal(OPS.estimate_sigma, source="FILE", filepath=str(other))
    assert "export both with the same wavelengths" in at_others
    assert stored(sanded) == before


def test_a_material_without_a_spectrum_has_nothing_to_estimate():
    mesh_object("Card", rgb_material("Card"))
    assert not OPS.estimate_sigma.poll()


def test_the_dialog_says_what_it_found_before_anything_is_written(sanded, measured):
    """A field that changes estimates anew, as in the window; only OK writes."""
    from rough_spectra.addon.interface.operators import estimate_sigma

    class Fields:  # what Blender hands over has no methods
        source, filepath, sample = "FILE", str(measured), ""
        name_in_file, repeatability, found = "Paper", 0.1, ""

    before, dialog = stored(sanded), Fields()
    estimate_sigma._show(dialog, bpy.context)
    assert dialog.found.startswith("σ 2")
    dialog.name_in_file = "Wood"
    estimate_sigma._show(dialog, bpy.context)
    assert dialog.found.endswith("has no sample 'Wood'; check the name.")
    assert stored(sanded) == before


def with_angles(path, names=None):
    """A rough surface at six angles, SCI, and at 45as20, which no instrument has."""
    geometries = [
        *("45as-15", "45as15", "45as25", "45as45", "45as75", "45as110"),
        "d/8 SCI",
        "45as20",
    ]
    lines = ["name,geometry," + ",".join(f"{nm} nm" for nm in NM)]
    for k, geometry in enumerate(geometries):
        known = "di:8" if "/" in geometry else geometry if geometry != "45as20" else "45as15"
        level = 0.5 if known == "di:8" else 1.0  # what is left out may read anything
        values = level * read(ALBEDO, known, seed=k)
        lines.append(f"Wall,{geometry}," + ",".join(f"{value:.6f}" for value in values))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_set_of_angles_tells_sigma_by_itself(main, tmp_path):
    """By name, by a table, by a script, and in the dialog."""
    from rough_spectra.addon import api

    path, target = with_angles(tmp_path / "wall.csv"), tmp_path / "sigma.csv"
    told = main("estimate", path, "--rough", "Wall", "--output", target)
    assert told.status == 0
    assert "Wall at di:8° was left out of the estimate: specular light is in it" in told.err
    assert "not among the instruments" in told.err
    rows = rows_of(target)
    assert [row["instrument"] for row in rows] == [
        *("45as45", "45as-15", "45as15", "45as25", "45as75", "45as110")
    ]
    for row in rows:
        assert float(row["sigma_deg"]) == pytest.approx(25, abs=0.3)
        assert float(row["rms_residual"]) < 0.001
    table = tmp_path / "which.csv"
    table.write_text("sample,surface,file\nWall,wall,wall.csv\n")
    assert main("estimate", "--mapping", table, "--output", target).status == 0
    assert rows_of(target)[0]["sigma_deg"] == rows[0]["sigma_deg"]
    [sample] = api.read(path)
    assert math.degrees(api.estimate([(None, sample)]).sigma) == pytest.approx(25, abs=0.3)

    thing = mesh_object("Wall", rgb_material("Wall"))
    OPS.assign_file("EXEC_DEFAULT", filepath=str(path))
    assert OPS.estimate_sigma("EXEC_DEFAULT", source="SET") == {"FINISHED"}
    group = thing.active_material.rough_spectra
    assert math.degrees(group.sigma) == pytest.approx(25, abs=0.3)
    assert group.sigma_source.startswith("Estimated from Wall at 45°:as45°, Wall at 45°:as-15°")
    assert '"others"' in group.details


def test_smooth_and_rough_of_a_set_tell_sigma(tmp_path):
    from rough_spectra.addon import api

    lines = ["name,surface," + ",".join(f"{nm} nm" for nm in NM)]
    for surface, values in (("smooth", noisy(ALBEDO, 1)), ("rough", read(ALBEDO, seed=2))):
        lines.append(f"Card,{surface}," + ",".join(f"{value:.6f}" for value in values))
    path = tmp_path / "card.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    [card] = api.read(path)
    found = api.estimate([(None, card)])
    assert math.degrees(found.sigma) == pytest.approx(25, abs=0.3)
    alone = api.estimate([(None, card.others[0])])
    assert not alone.is_told


def test_the_dialog_begins_with_the_set_where_there_is_one(sanded, tmp_path):
    from rough_spectra.addon.interface.operators import estimate_sigma

    assert not estimate_sigma._has_set(bpy.context)
    OPS.assign_file("EXEC_DEFAULT", filepath=str(with_angles(tmp_path / "wall.csv")))
    assert estimate_sigma._has_set(bpy.context)
