# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verbs as a pipeline calls them: help, exit statuses, and what the options do."""

import json
import subprocess
import sys

import bpy
import pytest

from tests.integration.support import ROOT, SECONDS, contents, rgb_material, spectrum_csv

VERBS = (
    "analyze",
    "assign",
    "bake",
    "check",
    "compare",
    "emissivity",
    "estimate",
    "experiment",
    "gloss",
    "import",
    "lab",
    "merge",
    "search",
    "spectral",
    "texture",
)


def stored(name):
    return bpy.data.materials[name].rough_spectra


def degrees(name):
    from rough_spectra.addon.material import snapshot

    return snapshot.sigma_degrees(stored(name))


@pytest.fixture
def blend(tmp_path):
    """A .blend with two plain materials."""
    rgb_material("Wall")
    rgb_material("Floor")
    path = tmp_path / "plain.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_help_names_every_verb(run):
    result = run("--help")
    assert result.status == 0
    assert "--command rough_spectra" in result.out
    assert all(f"\n    {verb}" in result.out for verb in VERBS)


@pytest.mark.parametrize("verb", VERBS)
def test_help_of_a_verb_explains_every_option(verb, main):
    import argparse

    from rough_spectra.addon.commands import command_line

    result = main(verb, "--help")
    assert result.status == 0
    (verbs,) = (
        action
        for action in command_line._parser()._actions
        if isinstance(action, argparse._SubParsersAction)
    )
    for action in verbs.choices[verb]._actions:
        name = action.option_strings[-1] if action.option_strings else action.metavar
        assert name in result.out
        assert action.help or action.choices or action.metavar in ("BASE", "PART.json"), name


def test_help_goes_through_a_pipe_that_knows_only_ascii(run):
    result = run("check", "--help", PYTHONIOENCODING="ascii", PYTHONUTF8="0")
    assert result.status == 0
    assert "--max-delta-e" in result.out


def test_dev_py_runs_a_verb_and_passes_its_exit_status_on(environment, tmp_path):
    def dev(*words):
        return subprocess.run(
            [sys.executable, ROOT / "dev.py", "run", *words],
            env=environment,
            cwd=tmp_path,
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=SECONDS,
            check=False,
        )

    done = dev("merge", "none.json", "--output", "x")
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1].startswith(
        "rough_spectra merge: none.json: there is no such file"
    )
    assert dev("bake", "--help").returncode == 0


@pytest.mark.parametrize("words", [[], ["polish"], ["assign"], ["bake"], ["merge"]])
def test_missing_or_unknown_words_are_unusable_input(words, main):
    result = main(*words)
    assert result.status == 2
    assert result.err.startswith("usage: ")


def test_assign_bake_check_from_start_to_end(blend, run, main, tmp_path):
    words = ("--preset", "green", "--material", "Wall", "--material", "Floor", "--sigma", "25")
    result = run("assign", "--blend", blend, *words)
    assert result.status == 0
    assert "assigned 2 materials" in result.sentence
    result = main("check", "--blend", blend, "--max-delta-e", "0.05")
    assert result.status == 0
    assert "0 of 2 materials exceed" in result.err

    bpy.ops.wm.open_mainfile(filepath=str(blend))
    assert degrees("Wall") == 25
    shader = next(n for n in bpy.data.materials["Wall"].node_tree.nodes if n.type == "BSDF_DIFFUSE")
    shader.inputs["Color"].default_value = (0.8, 0.1, 0.1, 1)
    bpy.ops.wm.save_mainfile()
    result = run("check", "--blend", blend, "--output", tmp_path / "found" / "x")
    assert result.status == 1
    assert "material 'Wall' differs by ΔE00" in result.err
    assert "edited by hand" in result.err
    assert "'Floor'" not in result.err
    assert "1 of 2 materials exceed" in result.err
    assert "x.json" in contents(tmp_path / "found")  # what failed can be looked at
    assert main("check", "--blend", blend, "--material", "Floor").status == 0
    assert main("check", "--blend", blend, "--max-delta-e", "200").status == 0


def test_assign_in_place_keeps_the_older_version_and_nothing_else(blend, main, tmp_path):
    before = blend.read_bytes()
    words = ("--blend", blend, "--preset", "14", "--material", "Wall")
    assert main("assign", *words).status == 0
    assert sorted(contents(tmp_path)) == ["plain.blend", "plain.blend1"]
    assert (tmp_path / "plain.blend1").read_bytes() == before
    assert blend.read_bytes() != before


def test_assign_to_another_file_leaves_the_first(blend, main, tmp_path):
    before = blend.read_bytes()
    target = tmp_path / "new" / "lit.blend"
    words = ("--preset", "14", "--material", "Wall", "--output", target)
    assert main("assign", "--blend", blend, *words).status == 0
    assert blend.read_bytes() == before
    assert sorted(contents(tmp_path)) == ["plain.blend"]
    bpy.ops.wm.open_mainfile(filepath=str(target))
    assert stored("Wall").spectrum
    assert not stored("Floor").spectrum


def test_compressed_file_stays_compressed_and_is_taken_for_whole(main, tmp_path):
    rgb_material("Wall")
    path = tmp_path / "small.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)
    assert path.read_bytes()[:4] == bytes.fromhex("28b52ffd")
    words = ("--blend", path, "--preset", "14", "--material", "Wall")
    assert main("assign", *words).status == 0
    assert path.read_bytes()[:4] == bytes.fromhex("28b52ffd")
    bpy.ops.wm.open_mainfile(filepath=str(path))
    assert stored("Wall").spectrum


def test_mapping_gives_each_row_its_sample_sigma_and_kind(blend, main, tmp_path):
    spectrum_csv(tmp_path / "plaster.csv", "plaster")
    rows = "# rows may be commented\nmaterial;sample;file;sigma_deg;kind\n"
    rows += "Wall;plaster;plaster.csv;12.5;albedo\n\nFloor;14\n"
    (tmp_path / "m.csv").write_text(rows, encoding="utf-8")
    words = ("--mapping", tmp_path / "m.csv", "--model", "closure", "--illuminant", "A")
    assert main("assign", "--blend", blend, *words).status == 0
    assert (stored("Wall").sample_name, stored("Wall").kind) == ("plaster", "albedo")
    assert degrees("Wall") == 12.5
    assert (stored("Floor").sample_name, degrees("Floor")) == ("ColorChecker 14 Green", 0)
    assert (stored("Wall").model, stored("Wall").illuminant) == ("closure", "A")


def test_sigma_of_zero_in_json_overrules_the_sample(blend, main, tmp_path):
    preset = json.loads((ROOT / "presets/colorchecker/14-green.json").read_text("utf-8"))
    rough = preset | {"name": "Rough", "sigma_degrees": 30}
    (tmp_path / "rough.json").write_text(json.dumps(rough), encoding="utf-8")
    rows = [
        {"material": "Wall", "sample": "Rough", "file": "rough.json", "sigma_deg": 0},
        {"material": "Floor", "sample": "Rough", "file": "rough.json"},
    ]
    (tmp_path / "m.json").write_text(json.dumps(rows), encoding="utf-8")
    assert main("assign", "--blend", blend, "--mapping", tmp_path / "m.json").status == 0
    assert (degrees("Wall"), degrees("Floor")) == (0, 30)
    words = ("--mapping", tmp_path / "m.json", "--sigma", "7")
    assert main("assign", "--blend", blend, *words).status == 0
    assert (degrees("Wall"), degrees("Floor")) == (7, 7)


def test_names_match_samples_and_create_makes_the_rest(blend, main, tmp_path):
    source = spectrum_csv(tmp_path / "s.csv", "Wall", "Door")
    assert main("assign", "--blend", blend, "--by-name", source).status == 0
    assert stored("Wall").sample_name == "Wall"
    assert "Door" not in bpy.data.materials
    assert main("assign", "--blend", blend, "--by-name", source, "--create").status == 0
    assert stored("Door").sample_name == "Door"
    bpy.ops.wm.open_mainfile(filepath=str(blend))
    assert stored("Door").spectrum  # a made material has no user, and is saved all the same


@pytest.mark.parametrize(
    ("shader", "node"), [("diffuse", "BSDF_DIFFUSE"), ("principled", "BSDF_PRINCIPLED")]
)
def test_shader_is_chosen(shader, node, blend, main):
    words = ("--preset", "14", "--material", "Wall", "--shader", shader)
    assert main("assign", "--blend", blend, *words).status == 0
    output = bpy.data.materials["Wall"].node_tree.get_output_node("CYCLES")
    assert output.inputs["Surface"].links[0].from_node.type == node


def test_format_chooses_the_files(scene_file, main, tmp_path):
    words = ("--material", "Alpha", "--predicted-only", "--format", "csv", "--format", "cgats")
    assert main("bake", "--blend", scene_file, "--output", tmp_path / "x", *words).status == 0
    assert set(contents(tmp_path)) == {"x.json", "x.predicted.csv", "x.predicted.cgats.txt"}


def test_readings_that_replace_others_are_like_new_files(scene_file, main, tmp_path):
    target = tmp_path / "x.json"
    target.write_text("old", encoding="utf-8")
    (tmp_path / "other").write_text("", encoding="utf-8")
    words = ("--material", "Alpha", "--predicted-only", "--output", tmp_path / "x")
    assert main("bake", "--blend", scene_file, *words).status == 0
    assert json.loads(target.read_bytes())["readings"][0]["material"] == "Alpha"
    assert target.stat().st_mode == (tmp_path / "other").stat().st_mode


WARM = ROOT / "tests" / "fixtures" / "ecostress" / "emissivity.spectrum.txt"


def test_emissivity_of_a_file_and_of_a_preset(main, tmp_path):
    base = tmp_path / "out" / "both"
    options = (
        "--rdq",
        "0.36",
        "--background",
        "250",
        "--angles",
        "0",
        "60",
        "--band",
        "8000-12000",
    )
    result = main("emissivity", WARM, "--output", base, *options)
    assert result.status == 0, result.err
    assert "1 sample; wrote both.csv, both.bands.csv, both.png" in result.err
    assert "counts as 1 in computing" in result.err
    assert {*contents(base.parent)} == {"both.csv", "both.bands.csv", "both.png"}
    table = (base.parent / "both.bands.csv").read_text("utf-8")
    assert "Test Sand σ 19.7989°,19.7989,reference,8000-12000 nm,8000,12000,300,250,60," in table
    assert (base.parent / "both.png").read_bytes()[:4] == b"\x89PNG"
    result = main("emissivity", WARM, "green", "--output", base, "--model", "surface")
    assert result.status == 0, result.err
    assert "2 samples" in result.err


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (("green", "--band", "8-14"), "covers 380 to 780 nm"),
        (("green", "--band", "eight"), "--band is 'eight'"),
        (("green", "--angles", "95"), "--angles holds 95"),
        (("green", "--rdq", "-1"), "--rdq is -1"),
        (("green", "--sigma", "95"), "give 0 to π/2"),
        (("green", "--sigma", "70", "--model", "surface"), "ends at 65°"),
        (("green", "--response", "no.csv"), "no.csv"),
        (("gone.csv",), "gone.csv"),
        (("no such preset",), "no such preset"),
    ],
)
def test_emissivity_refuses_in_one_sentence_and_writes_nothing(main, tmp_path, words, fault):
    result = main("emissivity", *words, "--output", tmp_path / "out" / "it")
    assert result.status == 2
    assert fault in result.err
    assert not (tmp_path / "out").exists()
