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
    "infrared",
    "lab",
    "list",
    "merge",
    "relight",
    "search",
    "spectral",
    "texture",
    "thermal",
    "verdict",
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


def mapped(blend, tmp_path, text, *words):
    mapping = tmp_path / "mapping.csv"
    mapping.write_text(text, encoding="utf-8")
    return "assign", "--blend", blend, "--mapping", mapping, *words


def test_a_row_says_what_options_say_for_all(blend, main, tmp_path):
    percent = tmp_path / "percent.csv"
    percent.write_text("nm,Card\n400,61\n500,70\n600,72\n700,73\n", encoding="utf-8")
    rows = (
        "material,sample,file,illuminant,observer,model,shader,instrument,scale,rdq\n"
        "Wall,Card,percent.csv,A,10,two-bounce,principled,di:8,100,0.35\n"
        "Floor,14,,,,,,,,\n"
    )
    assert main(*mapped(blend, tmp_path, rows)).status == 0
    wall, floor = stored("Wall"), stored("Floor")
    assert (wall.illuminant, wall.observer, wall.model) == ("A", "10", "two-bounce")
    assert (wall.shader, wall.instrument) == ("PRINCIPLED", "di:8")
    assert json.loads(wall.spectrum)["values"] == [0.61, 0.7, 0.72, 0.73]
    assert "divided by 100, as stated in mapping.csv, row 1" in wall.details
    assert degrees("Wall") == pytest.approx(19.29, abs=0.01)
    assert bpy.data.materials["Wall"].node_tree.nodes["Principled BSDF"].outputs[0].is_linked
    assert (floor.illuminant, floor.observer, floor.model) == ("D65", "2", "auto")
    assert (floor.shader, floor.instrument) == ("AUTO", "45a:0")
    assert main(*mapped(blend, tmp_path, rows), "--illuminant", "D50").status == 0
    assert {stored(name).illuminant for name in ("Wall", "Floor")} == {"D50"}


def test_signs_in_a_name_mean_every_material_that_fits(main, tmp_path):
    for name in ("Wall", "Wall.001", "Walnut", "Floor", "What?", "What!"):
        rgb_material(name)
    blend = tmp_path / "walls.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))
    rows = "material,sample\nWal*,14\nWalnut,15\nWhat?,16\n"
    assert main(*mapped(blend, tmp_path, rows)).status == 0
    found = {m.name: m.rough_spectra.sample_name for m in bpy.data.materials if m.users}
    assert {name: text.split()[1:2] for name, text in found.items()} == {
        "Wall": ["14"],
        "Wall.001": ["14"],
        "Walnut": ["15"],
        # A material that is called exactly so is meant alone.
        "What?": ["16"],
        "What!": [],
        "Floor": [],
    }


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ("material,sample\nWall,14\nDoor*,14\n", ("row 2", "called like 'Door*'")),
        ("material,sample\nW*,14\nFloor,15\n*l,14\n", ("row 3", "'Wall'", "twice", "row 1")),
        ("material,sample\nWall,14\nDoor,14\n", ("row 2", "no material 'Door'", "--create")),
        ("material,sample,shader\nWall,14,glass\n", ("row 1", "shader is 'glass'", "principled")),
        ("material,sample,observer\nWall,14,5\n", ("row 1", "observer is '5'", "2, 10")),
        ("material,sample,file,scale\nWall,14,a.csv,-1\n", ("row 1", "scale is '-1'", "above 0")),
        ("material,sample,file\nWall,14,gone.csv\n", ("row 1", "gone.csv")),
        ("material,sample\nFloor,14\nMixed,14\n", ("row 2", "'Mixed'", "cannot set")),
    ],
)
def test_a_fault_of_a_row_names_file_and_row_and_nothing_is_changed(rows, words, main, tmp_path):
    rgb_material("Wall")
    rgb_material("Floor")
    tree = rgb_material("Mixed").node_tree
    glossy = tree.nodes.new("ShaderNodeBsdfGlass")
    tree.links.new(glossy.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    blend = tmp_path / "plain.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))
    before = blend.read_bytes()
    result = main(*mapped(blend, tmp_path, rows))
    assert result.status == 2
    assert all(word in result.sentence for word in ("mapping.csv", *words)), result.sentence
    assert blend.read_bytes() == before


def test_list_tells_what_a_file_holds_without_rendering(scene, main):
    before = scene.read_bytes()
    result = main("list", "--blend", scene)
    assert result.status == 0
    header, *lines = (line.split("\t") for line in result.out.splitlines() if "\t" in line)
    rows = {row[0]: dict(zip(header, row, strict=True)) for row in lines}
    assert len(rows) == 4
    beta = bpy.data.materials["Beta"]
    assert rows["Beta"] | {"illuminant": "A", "observer": "10", "sigma_deg": "0"} == rows["Beta"]
    assert rows["Beta"]["state"] == "fresh"
    socket = beta.node_tree.nodes["Diffuse BSDF"].inputs["Color"].default_value
    assert float(rows["Beta"]["G"]) == pytest.approx(socket[1], abs=1e-6)
    assert result.err.splitlines()[-1] == "4 of 6 materials store a spectrum"
    assert scene.read_bytes() == before


def test_list_as_json_holds_all_of_it(scene, main):
    result = main("list", "--blend", scene, "--json", "--quiet", "--material", "?lp*")
    assert (result.status, result.err) == (0, "")
    told = json.loads(result.out.splitlines()[-1])
    assert (told["format"], told["verb"], told["status"]) == ("rough-spectra-result", "list", 0)
    assert told["error"] == ""
    [alpha] = told["result"]["materials"]
    found = json.loads(stored("Alpha").spectrum)
    assert {key: alpha["stored"][key] for key in found} == found
    assert alpha["derivation"]["state"] == "fresh"
    assert alpha["node"]["shader"] == "diffuse"


def test_every_verb_takes_the_options_of_all(main):
    from rough_spectra.addon.support.version import version

    for verb in VERBS:
        result = main(verb, "--version")
        assert result.status == 0
        assert result.out.strip() == f"Rough Spectra {version()}, Blender {bpy.app.version_string}"
    assert main("--version").out.startswith("Rough Spectra ")


def test_json_tells_of_faults_and_rows_and_quiet_leaves_warnings(scene, main, tmp_path):
    words = ("--predicted-only", "--output", tmp_path / "x")
    quiet = main("bake", "--blend", scene, *words, "--quiet")
    assert (quiet.status, quiet.err) == (0, "")
    told = json.loads(main("bake", "--blend", scene, *words, "--json").out.splitlines()[-1])
    assert told["result"]["readings"] == 4
    assert str(tmp_path / "x.json") in told["result"]["files"]
    fault = main("bake", "--blend", scene, *words, "--json", "--quiet", "--material", "None")
    told = json.loads(fault.out.splitlines()[-1])
    assert (fault.status, told["status"]) == (2, 2)
    assert told["error"] in fault.sentence
    found = json.loads(main("search", "green", "--json").out.splitlines()[-1])
    assert ["colorchecker/14-green", "ColorChecker 14 Green"] in found["rows"]


def test_the_example_of_the_readme_works_when_it_is_copied(main, tmp_path, monkeypatch):
    text = (ROOT / "README.md").read_text("utf-8").partition("## First batch")[2]
    table = text.partition("```csv\n")[2].partition("```")[0]
    assert table in (ROOT / "docs" / "examples" / "mapping.csv").read_text("utf-8")
    (tmp_path / "mapping.csv").write_text(table, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    commands = [line.split() for line in text.splitlines() if line.startswith("blender -b")]
    assert [words[words.index("rough_spectra") + 1] for words in commands] == [
        *("assign", "bake", "check"),
    ]
    for words in commands:
        place = words.index("--command")
        opened = [word for file in words[2:place] for word in ("--blend", file)]
        result = main(words[place + 2], *opened, *words[place + 3 :])
        assert result.status == 0, result.err
    assert (tmp_path / "readings" / "scene.measured.csv").is_file()
