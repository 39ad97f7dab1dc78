# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The report's planned experiment: what comes back of what was put in, and the manual's numbers."""

import csv
import math
import re

import numpy as np
import pytest
from rough_spectra.addon.laboratory.trial import colored, figures, judge, meshes, page, results
from rough_spectra.addon.laboratory.trial.surfaces import Material, Surface
from rough_spectra.addon.preview.drawing import looks
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.core import models, reading
from rough_spectra.core.errors import DomainError, InputError

from tools.manual import experiment

AGAIN = "Out of date: run .venv/bpy-5.2/bin/python -m tools.manual.experiment"
NM = np.arange(400.0, 701.0, 20.0)
SIGMA = math.radians(25)
ALBEDOS = {
    "green": 0.08 + 0.3 * np.exp(-(((NM - 540) / 50) ** 2)),
    "red": 0.05 + 0.5 / (1 + np.exp((600 - NM) / 15)),
    "gray": np.full(NM.size, 0.2),
    "beige": 0.4 + 0.3 * (NM - 400) / 300,
}


def sample(name, values, kind="reading"):
    return Sample(name=name, wavelengths=NM, values=values, kind=kind)


def surface(model="surface", sigma=SIGMA, known=True, names=tuple(ALBEDOS)):
    """A surface that is exactly as a model says."""
    materials = tuple(
        Material(
            name,
            (sample(name, ALBEDOS[name]),),
            (sample(f"{name} rough", reading.from_albedo(ALBEDOS[name], sigma, model)),),
        )
        for name in names
    )
    return Surface("sanded", sigma if known else None, materials)


@pytest.fixture(scope="module")
def judged():
    return judge.judge([surface()])


@pytest.fixture(scope="module")
def stored():
    return experiment.stored()


def test_what_was_put_in_comes_back(judged):
    reads, [of] = judged
    assert of.sigma == pytest.approx(25, abs=0.01)
    assert (of.least, of.most) == pytest.approx((25, 25), abs=0.05)
    assert (of.told, of.materials) == (4, 4)
    for read in reads:
        found = (read.stated, read.own, read.albedo_stated, read.albedo_own)
        assert [each["surface"] for each in found] == pytest.approx([0] * 4, abs=1e-3)
        assert read.stated["lambert"] == read.raw > 0.5
        assert read.stated["two-bounce"] > 0.3


def test_a_model_finds_a_sigma_of_its_own():
    """Readings made by two bounces: that model finds its σ, and the others another one."""
    reads, [of] = judge.judge([surface("two-bounce")])
    assert of.by_model["two-bounce"] == pytest.approx(25, abs=0.01)
    assert of.sigma > 30
    assert max(read.own["two-bounce"] for read in reads) < 1e-3
    assert min(read.own["surface"] for read in reads) > 1e-3


def test_a_sigma_never_helps_to_find_itself(judged):
    """One material's rough reading is falsified: σ is another for the others, and not for it."""
    first, *others = surface().materials
    dark = sample("dark", 0.96 * first.rough[0].values)
    false = Surface("sanded", SIGMA, (Material(first.name, first.smooth, (dark,)), *others))
    after, _ = judge.judge([false])
    assert after[0].own["surface"] == pytest.approx(after[0].stated["surface"], abs=1e-3)
    assert after[0].own["surface"] > 0.3
    assert judged[0][1].own["surface"] < 0.01 < after[1].own["surface"]


def test_without_a_known_sigma_only_the_models_own_is_used():
    reads, [of] = judge.judge([surface(known=False, names=("green", "gray"))])
    assert math.isnan(of.stated)
    assert of.sigma == pytest.approx(25, abs=0.01)
    assert all(math.isnan(value) for value in reads[0].stated.values())
    assert reads[0].own["surface"] == pytest.approx(0, abs=1e-3)


def test_one_material_has_no_others_to_take_sigma_from():
    [read], [of] = judge.judge([surface(names=("green",))])
    assert of.sigma == pytest.approx(25, abs=0.01)
    assert math.isnan(read.own["surface"])
    assert read.stated["surface"] == pytest.approx(0, abs=1e-3)


def test_a_rough_reading_alone_tells_nothing():
    alone = Surface("sanded", None, (Material("x", (), surface().materials[0].rough),))
    [read], [of] = judge.judge([alone])
    assert math.isnan(of.sigma)
    assert "one reading" in of.reason
    assert math.isnan(read.raw)
    found = page.Found([read], [of], figures.panels_of_readings([alone], [of]), (), ())
    text = page._page(found, "x")
    assert of.reason in text
    assert "nothing could be predicted" in text
    assert set(page.pictures(found)) == {"sigma"}


def test_readings_at_other_wavelengths_are_refused():
    short = Sample(name="short", wavelengths=NM[:-1], values=ALBEDOS["gray"][:-1], kind="reading")
    pair = Material("x", (sample("long", ALBEDOS["gray"]),), (short,))
    with pytest.raises(DomainError, match=r"'long' and 'short'.*export both alike"):
        judge.judge([Surface("s", None, (pair,))])


def test_an_albedo_is_no_reading_of_a_rough_surface():
    wrong = Material("x", (), (sample("facets", ALBEDOS["gray"], "albedo"),))
    with pytest.raises(DomainError, match=r"'facets'.*give what an instrument read"):
        judge.judge([Surface("s", None, (wrong,))])


def test_tables_of_numbers_are_read_as_they_were_written(judged, tmp_path):
    reads, inferred = judged
    (tmp_path / "reads.csv").write_bytes(results.reads_csv(reads))
    (tmp_path / "sigma.csv").write_bytes(results.inferred_csv(inferred))
    again = results.reads_from_csv(tmp_path / "reads.csv")
    assert results.reads_csv(again) == results.reads_csv(reads)
    assert again[1].material == "red"
    [of] = results.inferred_from_csv(tmp_path / "sigma.csv")
    assert results.inferred_csv([of]) == results.inferred_csv(inferred)
    assert list(of.by_model) == list(inferred[0].by_model)
    with pytest.raises(InputError, match=r"sigma\.csv has no column 'raw'"):
        results.reads_from_csv(tmp_path / "sigma.csv")


def test_curves_and_points_are_drawn_where_they_belong():
    """At a right σ the curve of the model runs through the points; a canvas in parts was blank."""
    albedo = np.array([0.5])
    for degrees in (15.0, 45.0):
        read = reading.from_albedo(albedo, math.radians(degrees), "surface")
        panel = figures.Panel("x", math.radians(degrees), "45a:0", albedo, read)
        picture = figures.over_albedo([panel]).astype(int)
        ink = np.round(255 * np.array(figures._color("surface")))
        head = picture.shape[0] // 4
        blue = np.abs(picture[head:] - ink).sum(axis=-1) < 12
        black = picture[head:].sum(axis=-1) < 120
        at_x = round(float(np.mean(np.nonzero(black)[1])))
        assert black.any()
        rows = np.nonzero(blue[:, at_x - 8])[0], np.nonzero(black)[0]
        assert np.mean(rows[0]) == pytest.approx(np.mean(rows[1]), abs=6)


def test_meshes_are_measured_and_kept(tmp_path):
    """A level mesh reads its albedo; what is written is read again."""
    done = []
    found = meshes.measure(
        (("gaussian", 0.0), ("grooves", 0.0)),
        grays=(0.1, 0.3, 0.6, 0.9),
        cells=32,
        seeds=2,
        samples=4,
        progress=lambda *counts: done.append(counts),
    )
    assert np.array([of.reflectance for of in found]) == pytest.approx(
        np.array([found[0].albedo] * 2), abs=1e-5
    )
    assert {total for _, total in done} == {8}
    assert [now for now, _ in done] == sorted(now for now, _ in done)
    (tmp_path / "grays.csv").write_bytes(meshes.to_csv(found))
    again = meshes.from_csv(tmp_path / "grays.csv")
    assert meshes.to_csv(again) == meshes.to_csv(found)
    [smooth, _] = meshes.surfaces(again, colored.chart()[:1])
    [patch] = smooth.materials
    assert patch.rough[0].values == pytest.approx(patch.smooth[0].values, rel=1e-4)


def test_a_damaged_table_of_grays_is_refused(tmp_path):
    path = tmp_path / "grays.csv"
    path.write_text("# x\ngaussian,30,0.57,0.1,oops,0\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"grays\.csv, line 2"):
        meshes.from_csv(path)


# The manual ---------------------------------------------------------------------------------------


def test_the_manuals_tables_are_of_the_data(stored):
    for name, table in page.parts(stored).items():
        path = experiment.DOCS / f"experiment-{name}.md"
        assert path.read_text("utf-8") == experiment.MADE_BY + table, AGAIN


def test_the_manuals_numbers_are_means_of_the_data():
    """Without the code that makes the tables."""
    lines = experiment.READS.read_text("utf-8").splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    table = (experiment.DOCS / "experiment-known.md").read_text("utf-8")
    for name in dict.fromkeys(row["surface"] for row in rows):
        of = [row for row in rows if row["surface"] == name]
        assert len(of) == 24
        shown = re.search(rf"^\| {re.escape(name)} \|(.*)\|$", table, re.MULTILINE)[1].split("|")
        for model, cell in zip(models.NAMES, shown, strict=True):
            numbers = [float(row[f"stated {model}"]) for row in of]
            mean, most = map(float, re.findall(r"[\d.]+", cell))
            assert mean == pytest.approx(np.mean(numbers), abs=0.00501)
            assert most == pytest.approx(max(numbers), abs=0.00501)


def test_the_data_are_what_the_models_say_today(stored):
    """What was kept of two surfaces and three patches comes out again."""
    grays = [
        of for of in stored.grays if (of.kind, of.degrees) in {("gaussian", 30), ("grains", 30)}
    ]
    reads, _ = judge.judge(meshes.surfaces(grays, colored.chart()[12:15]))
    assert len(reads) == 6
    kept = {(read.surface, read.material): read for read in stored.reads}
    for read in reads:
        old = kept[read.surface, read.material]
        for field in ("stated", "stated_percent", "albedo_stated"):
            new = getattr(read, field)
            assert new == pytest.approx(getattr(old, field), abs=1e-3), AGAIN


def test_the_manual_tells_what_was_found(stored):
    """The page's own sentences, held to the data."""
    mean = {
        (name, model): np.mean([r.stated[model] for r in stored.reads if r.surface == name])
        for name in dict.fromkeys(read.surface for read in stored.reads)
        for model in models.NAMES
    }
    heights = [name for name, _ in mean if "heights" in name]
    assert max(mean[name, "surface"] for name in heights) < 0.045
    assert max(mean[name, "reference"] for name in heights) < 0.315
    sigma = {of.surface: of for of in stored.inferred}
    assert all(abs(sigma[name].sigma - sigma[name].stated) < 0.15 for name in heights)
    grooves = [name for name in sigma if "Gaussian slopes" in name]
    assert all(abs(sigma[name].sigma - sigma[name].stated) < 1.05 for name in grooves)
    assert sigma["packed grains, 30°"].sigma == pytest.approx(17, abs=0.5)


def test_inks_are_told_apart_on_white():
    inks = [figures._color(model) for model in models.NAMES]
    assert len(set(inks)) == len(models.NAMES)
    assert all(looks.contrast(ink, (1.0, 1.0, 1.0)) >= 1.99 for ink in inks)
