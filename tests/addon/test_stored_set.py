# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A material keeps every reading of its sample's set: stored, saved, appended, shown."""

import json

import bpy
import numpy as np
import pytest
from rough_spectra.addon.interface.panels import sentences
from rough_spectra.addon.material import derive, snapshot, storage
from rough_spectra.addon.samples.sample import Sample

NM = np.arange(400.0, 701.0, 10.0)
RNG = np.random.default_rng(14)
OTHERS = (
    Sample(
        "Tile (SCI)",
        NM,
        RNG.uniform(0.2, 0.3, NM.size),
        "reading",
        instrument="di:8",
        specular="SCI",
        notes=("A note.",),
        lab=(50.0, 1 / 3, 2.0),
    ),
    Sample("Tile", [400.0, 550.0, 700.0], RNG.uniform(0.2, 0.3, 3), "reading", surface="smooth"),
)
SET = Sample(
    "Tile",
    NM,
    RNG.uniform(0.2, 0.3, NM.size),
    "reading",
    instrument="de:8",
    specular="SCE",
    surface="rough",
    others=OTHERS,
    gloss=((20.0, 1 / 3), (60.0, 23.5)),
    gloss_source="By a meter.",
)


def check(material):
    found = storage.load(material).sample
    assert (found.gloss, found.gloss_source) == (SET.gloss, SET.gloss_source)
    assert found.surface == "rough"
    for other, wanted in zip(found.others, OTHERS, strict=True):
        np.testing.assert_array_equal(other.values, wanted.values)
        np.testing.assert_array_equal(other.wavelengths, wanted.wavelengths)
        for name in ("name", "instrument", "specular", "notes", "lab", "surface"):
            assert getattr(other, name) == getattr(wanted, name)


@pytest.fixture
def material(make_material, request_for):
    material = make_material("Wall")
    derive.assign([(material, request_for(SET))])
    return material


def test_a_material_keeps_the_set(material):
    check(material)
    # Assigning what it stores again, as renewing σ does, loses nothing either.
    derive.assign([(material, storage.load(material))])
    check(material)


def test_the_set_comes_along_saved_and_appended(material, tmp_path):
    path = str(tmp_path / "walls.blend")
    material.use_fake_user = True
    bpy.ops.wm.save_as_mainfile(filepath=path, check_existing=False)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(path, link=False) as (_, wanted):
        wanted.materials = ["Wall"]
    check(bpy.data.materials["Wall"])


def test_without_a_set_the_stored_text_is_as_before(make_material, request_for):
    """Stored texts are compared: a material of an earlier version has to stay up to date."""
    material = make_material("Wall")
    derive.assign([(material, request_for(Sample("Tile", NM, SET.values, "reading")))])
    stored = json.loads(material.rough_spectra.details)
    assert list(stored) == [
        *("license", "position", "device", "condition", "illuminant", "observer", "lab", "xyz"),
        *("quantity", "geometry", "aperture", "specular", "notes", "altered", "white_factor"),
    ]


def test_the_panel_tells_what_the_set_says_of_gloss(make_material, request_for):
    sci = Sample("T", NM, SET.values + 0.04, "reading", instrument="di:8", specular="SCI")
    fields = {"instrument": "de:8", "specular": "SCE", "others": (sci,), "gloss": ((60.0, 23.5),)}
    material = make_material("Wall")
    derive.assign([(material, request_for(Sample("T", NM, SET.values, "reading", **fields)))])
    group = material.rough_spectra
    white = (*snapshot.white(group), group.instrument)
    wanted = [
        "SCI less SCE is 0.0400 (0.0400 to 0.0400 over the bands): F0 is 0.0400 at least, as of an "
        "index of 1.500.",
        # Fresnel at 60° and 1.152: 0.0425 across and 0.0046 along the plane of incidence.
        "23.5 GU at 60° are a reflection of 0.0235: F0 is 0.0050 at least, as of an index of "
        "1.152.",
    ]
    assert sentences._gloss(group.details, group.spectrum, white) == wanted
    for damaged in ("{", '{"others": 5}', '{"gloss": [1]}', '{"others": [[]]}'):
        assert sentences._gloss(damaged, group.spectrum, white) == []
        assert sentences._gloss(group.details, damaged, white) == []


def test_the_panel_tells_the_set(material):
    about, _ = sentences._details(material.rough_spectra.details)
    assert ("Also Read", "di:8° Sphere; 45°a:0°, smooth") in about
    assert ("Gloss", "0.333333 GU at 20°, 23.5 GU at 60°") in about
