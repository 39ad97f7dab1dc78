# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which white a reading is relative to: asked, stored, told, and applied when targets are made."""

import csv
import dataclasses
import json

import bpy
import numpy as np
import pytest
from rough_spectra.addon import api
from rough_spectra.addon.commands import command_line
from rough_spectra.addon.interface.panels import sentences
from rough_spectra.addon.material import snapshot, state, storage
from rough_spectra.addon.samples import (
    importing,
    library,
    library_files,
    preset_validation,
    readers,
)
from rough_spectra.core.errors import InputError, MaterialError

OPS = bpy.ops.rough_spectra
RATIO = 1.0156 / 0.99
"""What sintered PTFE reads at 45°/0° over its 8°/d certificate."""

NM = np.arange(400.0, 710.0, 10.0)
VALUES = np.linspace(0.2, 0.6, NM.size)


def table(path, *comments):
    lines = [f"# {comment}" for comment in comments] + ["nm,paper"]
    lines += [f"{nm:g},{value!r}" for nm, value in zip(NM, VALUES.tolist(), strict=True)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def sample(**more):
    return api.Sample("paper", NM, VALUES, "reading", **more)


def make(found=None, name="paper"):
    material = bpy.data.materials.get(name) or bpy.data.materials.new(name)
    material.use_fake_user = True
    if found is not None:
        api.assign([(material, found)])
    return material


def target(material):
    """What the virtual instrument has to read, band by band."""
    return np.array(api.bake([material], measure=False).entries[0].predicted.values)


def stated(found):
    return found.white, found.white_factor, found.plaque


def active(material):
    thing = bpy.data.objects.new("thing", bpy.data.meshes.new("mesh"))
    thing.data.materials.append(material)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing


WHITES = [
    ({}, 1.0),
    ({"white": "8:d", "plaque": "ptfe"}, RATIO),
    ({"white": "45:0"}, 1.0),
    ({"white": "45:0", "plaque": "ptfe"}, 1.0),
    ({"white": "8:d", "white_factor": 1.017}, 1.017),
    ({"white": "45:0", "white_factor": 1 / 1.003}, 1 / 1.003),
    ({"white": "8:d", "instrument": "di:8"}, 1.0),
    ({"white": "45:0", "plaque": "ptfe", "instrument": "de:8"}, 1 / RATIO),
]


@pytest.mark.parametrize(("white", "factor"), WHITES)
def test_what_is_computed_with_is_scaled_and_what_was_measured_is_not(white, factor):
    found = sample(**white)
    assert found.scale == pytest.approx(factor, rel=1e-15)
    np.testing.assert_allclose(found.reflectance, VALUES * factor, rtol=1e-15)
    np.testing.assert_array_equal(found.values, VALUES)
    material = make(found)
    if found.instrument == "45a:0":
        np.testing.assert_allclose(target(material), VALUES * factor, atol=6e-7)
    np.testing.assert_array_equal(storage.load(material).sample.values, VALUES)


@pytest.mark.parametrize(("white", "factor"), WHITES)
@pytest.mark.parametrize("way", ["save", "append", "library"])
def test_it_comes_back(tmp_path, white, factor, way):
    found = sample(**white)
    if way == "library":
        library_files.add_all({"walls": [found]}, tmp_path)
        again = library.load("walls/paper", tmp_path)
        assert stated(again) == stated(found)
        return
    before = target(make(found))
    path = str(tmp_path / "file.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    if way == "save":
        bpy.ops.wm.open_mainfile(filepath=path)
        material = bpy.data.materials["paper"]
    else:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        with bpy.data.libraries.load(path) as (_, wanted):
            wanted.materials = ["paper"]
        material = wanted.materials[0]
    again = storage.load(material).sample
    expected = stated(found) if found.white != "perfect" else ("perfect", None, "")
    assert stated(again) == expected
    assert again.scale == pytest.approx(factor, rel=1e-15)
    assert state.state(material).kind == "fresh"
    np.testing.assert_array_equal(target(material), before)


def test_a_setting_is_followed_at_once_and_told_where_it_is_not():
    material = make(sample())
    group = material.rough_spectra
    first = api.state(material).stamp
    group.white = "8:d"  # the plaque is taken for PTFE until one says otherwise
    assert state.state(material).kind == "fresh"
    np.testing.assert_allclose(target(material), VALUES * RATIO, atol=6e-7)
    group.plaque, group.white_factor = "stated", 1.018
    np.testing.assert_allclose(target(material), VALUES * 1.018, atol=6e-7)
    with api.paused():
        group.white = "perfect"
    assert state.state(material).reasons == (
        "the white was changed from 8°/d certificate, factor 1.018 to perfect diffuser",
    )
    api.renew([material])
    assert api.state(material).stamp == first
    with api.paused():
        group.white, group.plaque = "8:d", "ptfe"
    assert state.state(material).reasons == (
        "the white was changed from perfect diffuser to 8°/d certificate, sintered PTFE",
    )


def test_a_stamp_from_before_the_white_was_asked_for_stays_fresh():
    material = make(sample())
    group = material.rough_spectra
    data = json.loads(group.stamp)
    assert data["settings"].pop("white") == "perfect diffuser"
    group.stamp = json.dumps(data)
    with api.paused():
        group.plaque, group.white_factor = "stated", 1.5  # of no white that is in use
    assert state.state(material).kind == "fresh"
    with api.paused():
        group.white = "45:0"
    assert state.state(material).reasons == (
        "the white was changed from perfect diffuser to 45°/0° certificate, factor 1.5",
    )


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"plaque": "unknown"}, "give the factor between, or the plaque, such as ptfe"),
        ({"plaque": "ptfe", "instrument": "45as15"}, "factor of ptfe at 45as15 is not known"),
    ],
)
def test_a_factor_that_does_not_follow_is_said_and_nothing_changes(settings, words):
    material = make(sample())
    group = material.rough_spectra
    group.white = "8:d"
    before = target(material)
    for name, value in settings.items():
        setattr(group, name, value)
    known = state.state(material)
    assert known.kind == "error"
    assert words in known.reasons[0]
    with pytest.raises(MaterialError, match="Material 'paper': "):
        api.renew([material])
    group.plaque = "ptfe"
    group.instrument = "45a:0"
    assert state.state(material).kind == "fresh"
    np.testing.assert_array_equal(target(material), before)


def test_another_white_is_another_sample_of_the_library(tmp_path):
    """The same numbers, which mean another reflectance."""
    library_files.add_all({"walls": [sample()]}, tmp_path)
    added = library_files.add_all({"walls": [sample(white="8:d", plaque="ptfe")]}, tmp_path)
    assert added[0].present == ()
    assert library.load("walls/paper-2", tmp_path).scale == pytest.approx(RATIO)


@pytest.mark.parametrize(
    ("comments", "expected"),
    [
        ((), ("perfect", None, "")),
        (("white: perfect diffuser",), ("perfect", None, "")),
        (("white: 8°/d", "white_factor: ptfe"), ("8:d", None, "ptfe")),
        (("white_factor: 1.02", "white: d/8"), ("8:d", 1.02, "")),
        (("white: 45/0",), ("45:0", None, "")),
    ],
)
def test_comments_of_a_table(tmp_path, comments, expected):
    [found] = readers.read(table(tmp_path / "paper.csv", *comments))
    assert stated(found) == expected
    np.testing.assert_array_equal(found.values, VALUES)


@pytest.mark.parametrize(
    ("comments", "words"),
    [
        (("white: paper",), "line 1: white is 'paper'; make it one of perfect, 45:0, 8:d"),
        (("white_factor: 1.02",), "line 1: white_factor stands without white"),
        (("white: 8:d", "white_factor: large"), "line 2: white_factor is 'large'; make it a"),
        (("white: 8:d", "white_factor: 102"), "the white's factor is 102"),
        (("white: 8:d", "white_factor: nan"), "white_factor is 'nan'"),
        (("white: perfect", "white_factor: 1.02"), "the perfect diffuser has no factor"),
        (("white: 8:d",), "the white's certificate is of 8:d and the reading of 45a:0"),
    ],
)
def test_comments_that_cannot_be_used(tmp_path, comments, words):
    path = table(tmp_path / "paper.csv", *comments)
    with pytest.raises(InputError) as caught:
        readers.read(path)
    assert words in str(caught.value)
    assert str(path) in str(caught.value)


PRESET = {
    "format": "rough-spectra-preset",
    "schema": 1,
    "name": "paper",
    "source": "me",
    "license": "CC0-1.0",
    "kind": "reading",
    "instrument": "45a:0",
    "sigma_degrees": 10,
    "sigma_source": "Estimate.",
    "wavelengths": NM.tolist(),
    "values": VALUES.tolist(),
}


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        ({"white": "8:d", "white_factor": "ptfe"}, ("8:d", None, "ptfe")),
        ({"white": "8:d", "white_factor": 1.018}, ("8:d", 1.018, "")),
        ({"white": "45:0"}, ("45:0", None, "")),
        ({"white": "paper"}, "field 'white': it is 'paper' and must be"),
        ({"white": "8:d"}, "field 'white': the white's certificate is of 8:d"),
        ({"white_factor": 1.02}, "field 'white_factor': white_factor stands without white"),
        ({"white": "8:d", "white_factor": 3}, "field 'white_factor': the white's factor is 3"),
        ({"white": "8:d", "white_factor": "chalk"}, "field 'white_factor': it is 'chalk'"),
    ],
)
def test_a_preset(tmp_path, fields, expected):
    path = tmp_path / "paper.json"
    path.write_text(json.dumps(PRESET | fields), encoding="utf-8")
    faults = preset_validation.validate(path).faults
    if isinstance(expected, tuple):
        assert faults == ()
        assert stated(readers.read(path)[0]) == expected
        return
    with pytest.raises(InputError) as caught:
        readers.read(path)
    assert expected in str(caught.value)
    assert str(caught.value) in faults


def test_a_library_with_a_slip_of_the_pen(tmp_path):
    record = {key: PRESET[key] for key in ("name", "kind", "wavelengths", "values")}
    head = {"format": "rough-spectra-library", "schema": 1}
    path = tmp_path / "walls.json"
    for more, words in (
        ({"white": "8:d"}, "sample 1 'paper': the white's certificate is of 8:d"),
        ({"white": "snow"}, "sample 1 'paper': the white is 'snow'; make it one of"),
        ({"white": "8:d", "plaque": 5}, "the field 'plaque' must be a text"),
    ):
        path.write_text(json.dumps(head | {"samples": [record | more]}), encoding="utf-8")
        with pytest.raises(InputError) as caught:
            readers.read(path)
        assert words in str(caught.value)
        assert str(path) in str(caught.value)


def main(*words):
    return command_line.main(list(map(str, words)))


def test_columns_of_a_mapping_and_options(tmp_path, capsys):
    table(tmp_path / "paper.csv")
    mapping, output = tmp_path / "map.csv", tmp_path / "out.blend"
    lines = ["material,sample,file,white,white_factor"]
    lines += [
        "one,paper,paper.csv,8/d,ptfe",
        "two,paper,paper.csv,,",
        "three,paper,paper.csv,45:0,",
    ]
    mapping.write_text("\n".join(lines) + "\n", encoding="utf-8")
    words = ("assign", "--mapping", mapping, "--create", "--output", output)
    assert main(*words) == 0
    note = "note: material 'one': 'paper' is relative to the 8°/d certificate, sintered PTFE: "
    assert note in capsys.readouterr().err
    bpy.ops.wm.open_mainfile(filepath=str(output))
    scales = [storage.load(bpy.data.materials[n]).sample.scale for n in ("one", "two", "three")]
    assert scales == pytest.approx([RATIO, 1, 1])
    assert main(*words, "--white", "8:d", "--white-factor", "1.02") == 0
    assert storage.load(bpy.data.materials["two"]).sample.scale == 1.02
    capsys.readouterr()
    mapping.write_text("\n".join([*lines, "four,paper,paper.csv,8:d,"]), encoding="utf-8")
    assert main(*words) == 2
    assert "map.csv, row 4: " in (said := capsys.readouterr().err)
    assert "give the factor between" in said
    assert "four" not in bpy.data.materials


def test_an_option_of_import(tmp_path, capsys):
    path, folder = table(tmp_path / "paper.csv"), tmp_path / "library"
    words = ("import", path, "--folder", folder, "--white", "8:d")
    assert main(*words) == 2
    assert "give the factor between" in capsys.readouterr().err
    assert not folder.exists()
    assert main(*words, "--white-factor", "ptfe") == 0
    assert "times 1.0259 are relative to the perfect diffuser" in capsys.readouterr().err
    assert library.load("paper/paper", folder).scale == pytest.approx(RATIO)


def test_the_dialogs(tmp_path):
    path = str(table(tmp_path / "paper.csv", "white: 45:0"))
    material = make(sample())
    active(material)
    options = {"white": "8:d", "plaque": "stated", "white_factor": 1.02}
    assert OPS.assign_file(filepath=path, **options) == {"FINISHED"}
    assert stated(storage.load(material).sample) == ("8:d", 1.02, "")
    assert OPS.assign_file(filepath=path) == {"FINISHED"}  # as in the file
    assert stated(storage.load(material).sample) == ("45:0", None, "")
    into = {"filepath": path, "add_to_library": False, "materials": "ASSIGN"}
    assert OPS.import_samples(**into, white="8:d") == {"FINISHED"}
    assert stated(storage.load(material).sample) == ("8:d", None, "ptfe")
    assert OPS.import_samples(**into, white="perfect") == {"FINISHED"}
    assert stated(storage.load(material).sample) == ("perfect", None, "")
    with pytest.raises(RuntimeError, match="give the factor between"):
        OPS.import_samples(**into, white="8:d", plaque="unknown")


def test_what_the_panel_tells():
    material = make(sample(white="8:d", plaque="ptfe"))

    class Plain:
        def sentence(self, text, icon="NONE", inset=0.0):
            return text

    style = sentences.Style(Plain(), "", "", "")
    white = (*snapshot.white(material.rough_spectra), "45a:0")
    told = [text for part in sentences.source("", "", (30.0, ""), white, style) for text in part]
    assert (
        "Relative to: 8°/d certificate, sintered PTFE; times 1.0259 it is relative to the perfect "
        "diffuser" in told
    )
    assert "σ 30° is an Rdq of 0.577 and an Sdq of 0.816" in told
    white = ("perfect", None, "", "45a:0")
    assert "Relative to: perfect diffuser" in str(sentences.source("", "", (0, ""), white, style))


def test_readings_say_so_and_read_back(tmp_path):
    one = make(sample(white="8:d", plaque="ptfe"), "one")
    two = make(sample(), "two")
    result = api.bake([one, two], measure=False)
    assert [entry.predicted.white_factor for entry in result.entries] == [round(RATIO, 6), 1]
    api.write(result, tmp_path / "out", ["csv", "cgats"])
    text = (tmp_path / "out.predicted.csv").read_text(encoding="utf-8")
    assert "# white: perfect diffuser\n" in text
    assert "# stored spectra relative to another white: 8°/d certificate, sintered PTFE" in text
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    assert [row["stored_white"] for row in rows] == [
        "8°/d certificate, sintered PTFE, times 1.02586",
        "perfect diffuser",
    ]
    cgats = (tmp_path / "out.predicted.cgats.txt").read_text(encoding="utf-8")
    assert 'ROUGH_SPECTRA_WHITE\t"perfect diffuser"' in cgats
    for name in ("out.predicted.csv", "out.predicted.cgats.txt"):
        first, second = readers.read(tmp_path / name)
        assert first.scale == second.scale == 1
        np.testing.assert_allclose(first.reflectance, VALUES * RATIO, atol=6e-7)
        np.testing.assert_allclose(second.reflectance, VALUES, atol=6e-7)


def test_a_script():
    with pytest.raises(api.InputError, match="'paper': white is 'snow'"):
        api.request(sample(), white="snow")
    with pytest.raises(api.InputError, match="white_factor stands without white"):
        api.request(sample(), white_factor=1.02)
    # What the sample said does not mix with what is said now.
    other = api.request(sample(white="8:d", plaque="ptfe"), white="8:d", white_factor=1.02)
    assert stated(other.sample) == ("8:d", 1.02, "")


def test_what_is_brighter_than_white_facets_is_judged_on_the_right_scale():
    """The reading fits as printed, and not once it is relative to the perfect diffuser."""
    bright = dataclasses.replace(sample(), values=np.full(NM.size, 0.995))
    material = make()
    [plain] = api.assign([(material, api.request(bright, 0.1, model="closure"))])
    [scaled] = api.assign(
        [(material, api.request(bright, 0.1, model="closure", white="8:d", white_factor="ptfe"))]
    )
    assert not any("white facets" in warning for warning in plain.warnings)
    [told] = [warning for warning in scaled.warnings if "white facets" in warning]
    assert "reads 1.021" in told


def test_a_batch_keeps_what_was_judged(tmp_path):
    found = importing.read([table(tmp_path / "paper.csv")]).found
    [each] = importing.relative_to(found, "8:d", "ptfe")
    assert each.judged == found[0].judged
    assert any("times 1.0259" in sentence for sentence in each.sentences)
    assert importing.relative_to(found, None, None) == list(found)
