# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A set of readings shows as one sample, and is used as one."""

from dataclasses import replace

import bpy
import numpy as np
import pytest
from rough_spectra.addon.interface.operators import assign_file, import_review
from rough_spectra.addon.interface.operators.library import matching_samples
from rough_spectra.addon.material import storage
from rough_spectra.addon.samples import gloss_of_set, importing, library, readers, sets
from rough_spectra.addon.samples.sample import Sample

NM = np.arange(400, 701, 20)
LEVELS = np.linspace(0.2, 0.3, NM.size)


@pytest.fixture
def path(tmp_path):
    """SCI with a band below 0, SCE, and gloss at 60°."""
    lines = ["name,Gloss 60," + ",".join(f"{nm} nm" for nm in NM)]
    for name, values in (
        ("Tile (SCI)", LEVELS + 0.04 - 0.26 * (NM == 400)),
        ("Tile (SCE)", LEVELS),
        ("Board", LEVELS + 0.2),
    ):
        lines.append(f"{name},23.5," + ",".join(f"{value:.4f}" for value in values))
    path = tmp_path / "tiles.csv"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_set_is_one_in_import_and_search(path, tmp_path, main):
    folder = str(tmp_path / "library")
    told = main("import", path, "--folder", folder)
    assert told.out.split() == ["tiles/tile", "tiles/board"]
    assert "2 readings of one surface" in told.err
    assert "2 samples added" in told.err
    found = main("search", "tiles", "--folder", folder).out.splitlines()
    assert found == ["tiles/tile\tTile\t2 readings", "tiles/board\tBoard"]
    near = main("search", "--near", "#808080", "--count", "100", "--folder", folder)
    rows = [line.split("\t") for line in near.out.splitlines()]
    assert [row[3:] for row in rows if row[0] == "tiles/tile"] == [["2 readings"]]


def test_every_reading_is_judged(path):
    found, _ = importing.read([path]).found
    [noise] = [sentence for sentence in found.warnings if "below 0" in sentence]
    assert noise.startswith("'Tile (SCI) at di:8°'")
    assert not any("specular light included" in sentence for sentence in found.sentences)
    assert any("follows from its name" in sentence for sentence in found.sentences)
    assert import_review._about(found).endswith("2 readings")


def test_materials_of_a_file_have_the_gloss_that_a_chosen_sample_brings(path):
    """Of the same file, one way gave a shine and the other none."""
    options = {"filepath": str(path), "add_to_library": False, "materials": "CREATE"}
    bpy.ops.rough_spectra.import_samples("EXEC_DEFAULT", **options)
    thing = bpy.data.objects.new("Wall", bpy.data.meshes.new("Wall"))
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.rough_spectra.assign_file("EXEC_DEFAULT", filepath=str(path), sample="Board")
    chosen = storage.shown_gloss(thing.active_material)
    assert chosen.level > 0.1
    assert storage.shown_gloss(bpy.data.materials["Board"]) == chosen
    assert storage.own_gloss(bpy.data.materials["Board"]) == chosen
    assert storage.shown_gloss(bpy.data.materials["Tile"]).level > 0.1


def test_gloss_is_derived_and_told(path):
    """0.04 between SCI and SCE, but for the band that is below 0; 23.5 GU are 0.0235."""
    found, board = importing.read([path]).found
    low = 0.04 - 0.26
    mean = 0.04 - 0.26 / NM.size
    told = gloss_of_set.of_sample(found.sample)
    assert told.sphere.reflectance == pytest.approx(mean, abs=1e-4)
    assert told.sphere.lowest == pytest.approx(low, abs=1e-4)
    assert told.units == {60.0: 23.5}
    assert any("SCI less SCE is 0.0" in sentence for sentence in found.sentences)
    [meter] = [sentence for sentence in board.sentences if "GU at 60°" in sentence]
    assert meter.startswith("23.5 GU at 60° are a reflection of 0.0235: F0 is 0.0")
    assert gloss_of_set.of_sample(board.sample).sphere is None


def test_gloss_follows_from_readings_of_other_wavelengths():
    nm = np.arange(360.0, 741.0, 5.0)
    slope = nm / 1000
    sci = Sample("T", nm, slope + 0.04, "reading", instrument="di:8", specular="SCI")
    few = np.arange(380.0, 781.0, 20.0)
    sce = Sample("T", few, few / 1000, "reading", instrument="de:8", specular="SCE", others=(sci,))
    found = gloss_of_set.of_sample(sce).sphere
    assert found.reflectance == pytest.approx(0.04, abs=1e-12)
    assert found.index == pytest.approx(1.5, abs=0.001)
    infrared = replace(sci, wavelengths=nm + 1000)
    assert gloss_of_set.of_sample(replace(sce, others=(infrared,))) is None
    # Relative to another white, both are scaled before they are compared.
    scaled = {"white": "8:d", "white_factor": 1.1}
    relative = replace(sce, **scaled, others=(replace(sci, **scaled),))
    assert gloss_of_set.of_sample(relative).sphere.reflectance == pytest.approx(0.044, abs=1e-9)


def test_the_lists_of_the_window_tell_a_set(path, monkeypatch, tmp_path):
    from rough_spectra.addon.material import preferences

    monkeypatch.setattr(preferences, "user_folder", lambda: tmp_path / "library")
    importing.add(importing.read([path]).found, "mine", tmp_path / "library")
    assert dict(matching_samples(None, None, "mine")) == {
        "mine/tile": "Tile (2 readings)",
        "mine/board": "Board",
    }


def test_a_reading_is_found_by_the_name_that_it_has_in_the_file(path):
    samples = readers.read(path)
    for name, specular, others in (
        ("Tile", "SCE", 1),
        ("Tile (SCI)", "SCI", 0),
        ("Tile (SCE)", "SCE", 0),
    ):
        found = assign_file.choose(samples, name, str(path))
        assert (found.specular, len(found.others)) == (specular, others)
    assert list(sets.by_name(samples))[:3] == ["Tile", "Board", "Tile (SCI)"]


def test_a_mapping_names_sets_and_readings(path, tmp_path, main):
    rows = tmp_path / "rows.csv"
    rows.write_text("material,sample,file\nA,Tile,tiles.csv\nB,Tile (SCI),tiles.csv\n")
    blend = tmp_path / "out.blend"
    assert main("assign", "--mapping", rows, "--create", "--output", blend).status == 0
    first, second = (bpy.data.materials[name].rough_spectra for name in "AB")
    assert (first.instrument, second.instrument) == ("de:8", "di:8")
    assert '"others"' in first.details
    assert '"others"' not in second.details


def test_the_library_gives_the_set_back(path, tmp_path):
    samples = readers.read(path)
    library.add(samples, "mine", tmp_path / "library")
    found = library.load("mine/tile", tmp_path / "library")
    assert found.gloss == ((60.0, 23.5),)
    for one, two in zip(found.readings, samples[0].readings, strict=True):
        np.testing.assert_array_equal(one.values, two.values)
        assert (one.name, one.instrument, one.notes) == (two.name, two.instrument, two.notes)
