# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Input that cannot be used: one clear sentence, exit status 2, and the .blend as it was."""

import json
import resource
import signal

import bpy
import numpy as np
import pytest
from rough_spectra.addon.support.version import version

from tests.integration.support import contents, rgb_material, spectrum_csv

UNUSABLE = 2


@pytest.fixture
def blend(tmp_path):
    """A .blend with one material that waits for the sample `paper`."""
    rgb_material("paper")
    path = tmp_path / "waiting.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def refused(result, *words):
    """The sentence of a run that was refused; it holds all these words."""
    assert result.status == UNUSABLE
    sentence = result.sentence
    assert sentence.startswith("rough_spectra ")
    assert sentence.endswith(".")
    for word in words:
        assert str(word) in sentence
    return sentence


def bands(values, wavelengths=None, delimiter=","):
    wavelengths = wavelengths or [400 + 10 * i for i in range(len(values))]
    rows = [f"wavelength{delimiter}paper"]
    rows += [f"{nm}{delimiter}{v}" for nm, v in zip(wavelengths, values, strict=True)]
    return "\n".join(rows) + "\n"


GOOD = [0.3] * 31
FAULTS = {
    "empty": ("", "empty"),
    "blank": (" \n\n", "empty"),
    "prose": ("These are not the spectra you are looking for.\n", "format"),
    "delimiter that changes": (bands(GOOD).replace("410,", "410;"), "line 3"),
    "bars between columns": (bands(GOOD, delimiter="|"), "file"),
    "infinite": (bands([*GOOD[:5], "inf", *GOOD[6:]]), "450"),
    "far below 0": (bands([*GOOD[:5], -0.1, *GOOD[6:]]), "450"),
    "far above 1": (bands([*GOOD[:5], 41.0, *GOOD[6:]]), "450"),
    "unordered": (bands(GOOD, [400, 420, 410, *range(430, 701, 10)]), "410"),
    "duplicate": (bands(GOOD, [*range(400, 700, 10), 690]), "690"),
    "one band": (bands([0.3]), "one band"),
    "no band": ("wavelength,paper\n", ""),
    "one column": ("wavelength\n400\n410\n", "column"),
    "binary": ("\0\1\2" * 40, "text"),
    "too short for a color": (bands([0.3, 0.3]), "'paper': The bands from 400 to 410 nm"),
}


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("way", ["by name", "mapping"])
def test_measurement_file_with_a_fault(fault, way, blend, main, tmp_path):
    content, word = FAULTS[fault]
    source = tmp_path / "measured.csv"
    source.write_text(content, encoding="utf-8")
    words = ["--by-name", source]
    if way == "mapping":
        mapping = tmp_path / "mapping.csv"
        mapping.write_text("material,sample,file\npaper,paper,measured.csv\n", encoding="utf-8")
        words = ["--mapping", mapping]
    before = contents(tmp_path)
    sentence = refused(main("assign", "--blend", blend, *words), word)
    assert "measured.csv" in sentence
    assert contents(tmp_path) == before


ODDITIES = {
    "NaN": (bands([*GOOD[:5], "NaN", *GOOD[6:]]), "left out", "450"),
    "hole": (bands([*GOOD[:5], "", *GOOD[6:]]), "left out", "450"),
    "noise": (bands([*GOOD[:5], -0.01, *GOOD[6:]]), "below 0", "450"),
    "more than white": (bands([*GOOD[:5], 1.01, *GOOD[6:]]), "1.01", "450"),
    "falling": (bands(GOOD[::-1], [700 - 10 * i for i in range(31)]),),
}


@pytest.mark.parametrize("oddity", ODDITIES)
def test_measurement_file_with_an_oddity_is_read_and_told_of(oddity, blend, main, tmp_path):
    content, *words = ODDITIES[oddity]
    source = tmp_path / "measured.csv"
    source.write_text(f"{content}# geometry: 45/0\n", encoding="utf-8")
    done = main("assign", "--blend", blend, "--by-name", source)
    assert done.status == 0
    told = [line for line in done.err.splitlines() if line.startswith("warning: ")]
    assert len(told) == bool(words)
    for word in words:
        assert word in told[0]


def test_what_a_reader_assumes_is_told_unless_the_user_says_it(blend, main, tmp_path):
    source = spectrum_csv(tmp_path / "measured.csv", "paper", "paper 2")
    assumed = f"warning: {source}: The file does not say the geometry; 45°a:0° is assumed."
    done = main("assign", "--blend", blend, "--by-name", source, "--create")
    assert [line for line in done.err.splitlines() if "geometry" in line] == [assumed]
    mapping = tmp_path / "mapping.csv"
    for instrument, told in (("", [assumed]), ("di:8", [])):
        mapping.write_text(
            f"material,sample,file,instrument\npaper,paper,{source},{instrument}\n", "utf-8"
        )
        done = main("assign", "--blend", blend, "--mapping", mapping)
        assert done.status == 0
        assert [line for line in done.err.splitlines() if "geometry" in line] == told


def test_measurement_file_that_is_missing(blend, main, tmp_path):
    before = blend.read_bytes()
    refused(main("assign", "--blend", blend, "--by-name", tmp_path / "none.csv"), "none.csv")
    refused(main("assign", "--blend", blend, "--by-name", tmp_path), "folder")
    mapping = tmp_path / "mapping.json"
    row = {"material": "paper", "sample": "paper", "file": "gone.csv"}
    mapping.write_text(json.dumps([row]), encoding="utf-8")
    refused(main("assign", "--blend", blend, "--mapping", mapping), "gone.csv")
    assert blend.read_bytes() == before


def test_the_fault_of_a_process_is_one_sentence_without_traceback(blend, run, tmp_path):
    source = tmp_path / "measured.csv"
    source.write_text(FAULTS["far below 0"][0], encoding="utf-8")
    before = blend.read_bytes()
    refused(run("assign", "--blend", blend, "--by-name", source), source, "line 7", "below 0")
    assert blend.read_bytes() == before


LONG, LONGEST = "stretch" * 2000, 1000
"""A cell, and characters that a sentence about it may have."""
MAPPINGS = {
    "empty": ("", "header", "material"),
    "header alone": ("material,sample\n", "no rows"),
    "unknown column": ("material,sample,gloss\npaper,14,1\n", "'gloss'", "sigma_deg"),
    "no sample column": ("material,preset\npaper,14\n", "sample"),
    "unknown preset": ("material,sample\npaper,no such patch\n", "row 1", "no such patch"),
    "several presets": ("material,sample\npaper,\n", "row 1", "sample"),
    "missing material": ("material,sample\npaper,14\nglass,14\n", "'glass'", "--create"),
    "material twice": ("material,sample\npaper,14\npaper,15\n", "'paper'", "twice"),
    "bad sigma": ("material,sample,sigma_deg\npaper,14,rough\n", "row 1", "'rough'"),
    "sigma beyond": ("material,sample,sigma_deg\npaper,14,75\n", "row 1", "75°", "up to 60°"),
    "sigma above 90": ("material,sample,sigma_deg\npaper,14,91\n", "91", "0 to 60"),
    "sigma below 0": ("material,sample,sigma_deg\npaper,14,-1\n", "-1", "0 to 60"),
    "sigma NaN": ("material,sample,sigma_deg\npaper,14,nan\n", "nan", "degrees"),
    "bad rdq": ("material,sample,rdq\npaper,14,steep\n", "row 1", "rdq", "'steep'", "slope"),
    "rdq below 0": ("material,sample,rdq\npaper,14,-0.1\n", "row 1", "rdq is -0.1", "0 or more"),
    "rdq in degrees": ("material,sample,rdq\npaper,14,19\n", "row 1", "rdq is 19", "sigma_deg"),
    "sdq in degrees": ("material,sample,sdq\npaper,14,2.45\n", "row 1", "sdq is 2.45", "60°"),
    "rdq infinite": ("material,sample,rdq\npaper,14,inf\n", "row 1", "'inf'", "slope"),
    "rdq against sigma": (
        "material,sample,sigma_deg,rdq\npaper,14,30,\npaper,15,30,0.35\n",
        *("row 2", "sigma_deg and rdq", "30°", "Rdq 0.35 (19.3°)", "leave out"),
    ),
    "sdq against rdq": (
        "material,sample,rdq,sdq\npaper,14,0.35,0.35\n",
        *("row 1", "rdq and sdq", "19.3°", "13.9°", "leave out"),
    ),
    "rdq against sigma in JSON": (
        '[{"material": "paper", "sample": "14", "sigma_deg": 30, "rdq": 0.35}]',
        *("entry 1", "sigma_deg and rdq", "contradict"),
    ),
    "bad kind": ("material,sample,kind\npaper,14,gloss\n", "row 1", "'gloss'", "albedo"),
    "more cells than columns": ("material,sample\npaper,14,15\n", "row 1", "3 cells"),
    "open quotation mark": (f'material,sample\npaper,"{"14" * 99999}\n', "quotation mark"),
    "broken JSON": ('[{"material": "paper"', "JSON"),
    "deep JSON": ("[" * 100_000, "JSON"),
    "JSON of another form": ('{"paper": "14"}', "list"),
    "JSON without a sample": ('[{"material": "paper"}]', "entry 1", "sample"),
    **{
        f"endless {column}": (
            f"material,sample,{column}\npaper,14,{LONG}\n",
            *("row 1", column, LONG[:30]),
        )
        for column in ("sigma_deg", "scale", "kind", "shader", "instrument", "white")
    },
    "endless column": (f"material,sample,{LONG}\npaper,14,1\n", "row 1", LONG[:30]),
    "endless header": (f"{LONG}\n", "header", LONG[:30]),
    "endless preset": (f"material,sample\npaper,{LONG}\n", "row 1", LONG[:30]),
    "endless material": (f"material,sample\n{LONG},14\n", LONG[:30]),
    "unknown key": ('[{"material": "paper", "sample": "14", "gloss": 1}]', "'gloss'"),
}


@pytest.mark.parametrize("fault", MAPPINGS)
def test_mapping_with_a_fault(fault, blend, main, tmp_path):
    content, *words = MAPPINGS[fault]
    mapping = tmp_path / "mapping"
    mapping.write_text(content, encoding="utf-8")
    before = contents(tmp_path)
    sentence = refused(main("assign", "--blend", blend, "--mapping", mapping), *words)
    assert len(sentence) < LONGEST
    assert contents(tmp_path) == before


def test_mapping_that_is_missing_or_not_text(blend, main, tmp_path):
    refused(main("assign", "--blend", blend, "--mapping", tmp_path / "none.csv"), "none.csv")
    refused(main("assign", "--blend", blend, "--mapping", blend), blend)


def test_sample_that_a_file_lacks(blend, main, tmp_path):
    spectrum_csv(tmp_path / "two.csv", "gray", "white")
    mapping = tmp_path / "mapping.csv"
    mapping.write_text("material,sample,file\npaper,paper,two.csv\n", encoding="utf-8")
    words = ("row 1", "two.csv", "'paper'", "gray, white")
    refused(main("assign", "--blend", blend, "--mapping", mapping), *words)
    words = ("--by-name", tmp_path / "two.csv")
    refused(main("assign", "--blend", blend, *words), "gray, white")
    refused(main("assign", "--blend", blend, *words, "--material", "paper"), "'paper'")


def test_preset_without_a_material(blend, main):
    refused(main("assign", "--blend", blend, "--preset", "14"), "--material")


def test_preset_that_is_not_there(blend, main):
    result = main("assign", "--blend", blend, "--preset", "mauve", "--material", "paper")
    refused(result, "'mauve'")


def test_mapping_beside_materials_is_refused_rather_than_ignored(blend, main, tmp_path):
    mapping = tmp_path / "mapping.csv"
    mapping.write_text("material,sample\npaper,14\n", encoding="utf-8")
    words = ("--mapping", mapping, "--material", "paper")
    refused(main("assign", "--blend", blend, *words), "--material")


@pytest.mark.parametrize("verb", ["assign", "bake", "check"])
def test_blend_that_is_missing_or_none(verb, main, tmp_path):
    words = {
        "assign": ["--preset", "14", "--material", "paper"],
        "bake": ["--output", tmp_path / "x"],
        "check": [],
    }[verb]
    refused(main(verb, "--blend", tmp_path / "none.blend", *words), "none.blend", "does not exist")
    refused(main(verb, "--blend", tmp_path, *words), tmp_path)
    text = tmp_path / "text.blend"
    text.write_text("no .blend at all", encoding="utf-8")
    before = contents(tmp_path)
    main_result = main(verb, "--blend", text, *words)
    assert main_result.status == UNUSABLE
    # Blender itself prints a line of its own before ours.
    ours = [line for line in main_result.err.splitlines() if line.startswith("rough_spectra")]
    assert len(ours) == 1
    assert "text.blend" in ours[0]
    assert ours[0].endswith(".")
    assert contents(tmp_path) == before


def test_names_that_are_not_in_the_file(scene_file, main, tmp_path):
    words = ("bake", "--blend", scene_file, "--output", tmp_path / "x")
    refused(main(*words, "--material", "Nobody"), "'Nobody'", "scene.blend")
    refused(main(*words, "--object", "Nobody"), "'Nobody'", "scene.blend")
    refused(main(*words, "--object", "Bare"), "'Bare'")
    assert not contents(tmp_path)


def test_nothing_to_measure(blend, main, tmp_path):
    refused(main("check", "--blend", blend), "waiting.blend", "assign")
    refused(main("bake", "--blend", blend, "--output", tmp_path / "x"), "assign")
    refused(main("check", "--blend", blend, "--max-delta-e", "nan"), "--max-delta-e")
    refused(main("check", "--blend", blend, "--max-delta-e", "-1"), "--max-delta-e")


def test_check_of_a_material_without_a_spectrum(blend, main):
    result = main("check", "--blend", blend, "--material", "paper")
    assert result.status == UNUSABLE
    assert "None of paper stores a spectrum" in result.err
    assert "Traceback" not in result.err


def test_targets_that_no_file_can_have(scene_file, main, tmp_path):
    (tmp_path / "file").write_bytes(b"in the way")
    (tmp_path / "x.json").mkdir()
    before = contents(tmp_path)
    words = ("bake", "--blend", scene_file, "--predicted-only", "--output")
    refused(main(*words, tmp_path / "file" / "x"), tmp_path / "file", "folder")
    refused(main(*words, tmp_path / "x"), "x.json", "folder")
    for folder in (".", "..", "/"):
        refused(main(*words, folder), "folder")
        refused(main(*words, folder, "--shard", "1/2"), "folder")
        refused(main("check", "--blend", scene_file, "--output", folder), "folder")
    refused(main(*words, tmp_path / ("x" * 300)), "cannot be written")
    assert contents(tmp_path) == before
    assert not list((tmp_path / "x.json").iterdir())


def test_blend_that_cannot_be_saved(blend, main, tmp_path):
    (tmp_path / "file").write_bytes(b"in the way")
    before = contents(tmp_path)
    words = ("assign", "--blend", blend, "--preset", "14", "--material", "paper", "--output")
    for target in (tmp_path / "file" / "x.blend", tmp_path):
        result = main(*words, target)
        assert result.status == UNUSABLE
        assert result.err.splitlines()[-1].endswith("--output.")
        assert str(target) in result.err
    assert contents(tmp_path) == before


def limit(size):
    """Let a child write no file beyond this size: what a full disk looks like from inside."""

    def apply():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return apply


@pytest.mark.parametrize("ending", ["json", "spectral.exr"])
def test_full_disk_leaves_the_old_outputs(ending, scene_file, run, main, tmp_path):
    """With five materials the JSON is longer than the EXR, which comes first; 1 kB stops that."""
    words = ["bake", "--blend", scene_file, "--predicted-only", "--output", tmp_path / "x"]
    words += ["--format", "exr", "--object", "Panel"]
    assert main(*words, "--material", "Alpha").status == 0
    before = contents(tmp_path)
    sizes = {name.partition(".")[2]: len(content) for name, content in before.items()}
    assert sizes["predicted.spectral.exr"] + 1000 < sizes["json"]
    size = sizes["json"] - 500 if ending == "json" else 1024
    words += ["--material", "Delta"]
    refused(run(*words, before=limit(size)), f".{ending}", "nothing was changed")
    assert contents(tmp_path) == before


@pytest.mark.parametrize("compressed", [False, True])
def test_full_disk_leaves_the_blend_as_it_was(compressed, blend, run, tmp_path):
    """Of a compressed file Blender says that it is saved."""
    bpy.ops.wm.save_as_mainfile(filepath=str(blend), compress=compressed)
    before = contents(tmp_path)
    words = ("assign", "--blend", blend, "--preset", "14", "--material", "paper")
    result = run(*words, before=limit(4096))
    assert result.status == UNUSABLE
    assert "Traceback" not in result.err
    ours = [line for line in result.err.splitlines() if line.startswith("rough_spectra assign:")]
    assert len(ours) == 1
    assert f"{blend} cannot be saved (" in ours[0]
    assert "disk" in ours[0].partition(");")[0]
    assert contents(tmp_path) == before


def test_full_disk_for_temporary_files(scene_file, run, tmp_path):
    words = ("bake", "--blend", scene_file, "--material", "Alpha", "--output", tmp_path / "x")
    result = run(*words, before=limit(4096))
    assert result.status == UNUSABLE
    assert "Traceback" not in result.err
    assert result.err.splitlines()[-1].startswith("rough_spectra bake: ")
    assert not contents(tmp_path)


@pytest.fixture
def parts(scene_file, main, tmp_path):
    """Three parts of a bake of all spectra."""
    folder = tmp_path / "parts"
    for number in (1, 2, 3):
        words = ("--predicted-only", "--output", folder / "x", "--shard", f"{number}/3")
        assert main("bake", "--blend", scene_file, *words).status == 0
    return sorted(folder.iterdir())


def test_merge_refuses_parts_that_do_not_fit(parts, main, scene_file, tmp_path):
    out = ("--output", tmp_path / "merged" / "x")
    refused(main("merge", *parts[:2], *out), "1 to 3")
    refused(main("merge", *parts, parts[0], *out), "once")
    refused(main("merge", *parts[:2], tmp_path / "none.json", *out), "none.json")
    foreign = tmp_path / "foreign" / "x"
    words = ("--predicted-only", "--shard", "3/3", "--material", "Beta", "--material", "Alpha")
    words += ("--material", "Delta")
    assert main("bake", "--blend", scene_file, *words, "--output", foreign).status == 0
    (stranger,) = foreign.parent.iterdir()
    refused(main("merge", *parts[:2], stranger, *out), "different bakes")
    assert not (tmp_path / "merged").exists()


def test_merge_refuses_parts_of_another_version(parts, main, tmp_path):
    out = ("--output", tmp_path / "merged" / "x")
    document = json.loads(parts[1].read_text(encoding="utf-8"))
    assert document["version"] == version()
    document["version"] = "0.0.9"
    parts[1].write_text(json.dumps(document), encoding="utf-8")
    refused(main("merge", *parts, *out), "Part 2", "0.0.9", version())
    assert not (tmp_path / "merged").exists()


def other_spectrum(material):
    """Change one value of the stored spectrum by as little as the text can say."""
    group = material.rough_spectra
    bands = json.loads(group.spectrum)
    bands["values"][7] = float(np.nextafter(bands["values"][7], 1))
    group.spectrum = json.dumps(bands)


def shader_of(material):
    return next(node for node in material.node_tree.nodes if node.type == "BSDF_DIFFUSE")


def other_color(material):
    shader_of(material).inputs["Color"].default_value[1] += 1e-6


def other_ramp(material):
    """A stop of a color ramp, a number that no socket holds."""
    material.node_tree.nodes["Ramp"].color_ramp.elements[0].color[0] = 0.25


def other_curve(material):
    curve = material.node_tree.nodes["Curve"].mapping.curves[3]
    curve.points[0].location[1] = 0.1


def other_group(material):
    material.node_tree.nodes["Group"].node_tree.nodes["Inside"].inputs[0].default_value = 0.75


def other_link(material):
    tree = material.node_tree
    tree.links.new(tree.nodes["Ramp"].outputs["Color"], shader_of(material).inputs["Color"])


def mute(material):
    material.node_tree.nodes["Curve"].mute = True


def with_many_nodes(path):
    """Give Delta a ramp, a curve and a group, as a material made by hand may have."""
    bpy.ops.wm.open_mainfile(filepath=str(path))
    tree = bpy.data.materials["Delta"].node_tree
    tree.nodes.new("ShaderNodeValToRGB").name = "Ramp"
    tree.nodes.new("ShaderNodeRGBCurve").name = "Curve"
    group = tree.nodes.new("ShaderNodeGroup")
    group.name, group.node_tree = "Group", bpy.data.node_groups.new("Shared", "ShaderNodeTree")
    group.node_tree.nodes.new("ShaderNodeMath").name = "Inside"
    bpy.ops.wm.save_mainfile()


CHANGES = (other_spectrum, other_color, other_ramp, other_curve, other_group, other_link, mute)


@pytest.mark.parametrize("change", [None, *CHANGES])
def test_merge_refuses_parts_of_a_file_that_changed_in_between(change, scene, main, tmp_path):
    """What changes is in the second part; the first one knows of it by its digest alone."""
    with_many_nodes(scene)
    words = ("--predicted-only", "--material", "Alpha", "--material", "Delta")
    words += ("--output", tmp_path / "parts" / "x")
    assert main("bake", "--blend", scene, *words, "--shard", "1/2").status == 0
    bpy.ops.wm.open_mainfile(filepath=str(scene))
    material = bpy.data.materials["Delta"]
    if change is None:  # what no render shows may change
        shader_of(material).location = (7, 7)
        material.node_tree.nodes["Ramp"].label = "A label"
    else:
        change(material)
    bpy.ops.wm.save_mainfile()
    assert main("bake", "--blend", scene, *words, "--shard", "2/2").status == 0
    parts = sorted((tmp_path / "parts").iterdir())
    result = main("merge", *parts, "--output", tmp_path / "merged" / "x")
    if change is None:
        assert result.status == 0
    else:
        refused(result, "different bakes")
        assert not (tmp_path / "merged").exists()


def test_merge_refuses_what_bake_did_not_write(parts, main, tmp_path):
    out = ("--output", tmp_path / "merged" / "x")
    whole = parts[1].read_text(encoding="utf-8")
    document = json.loads(whole)

    def variant(**changes):
        return json.dumps(document | changes)

    reading = document["readings"][0]
    part = reading["predicted"]
    for content, word in {
        "": "JSON",
        whole[: len(whole) // 2]: "JSON",
        "[" * 100_000: "JSON",
        "[]": "no readings",
        variant(format="else"): "no readings",
        variant(schema=99): "schema 99",
        variant(shard=None): "damaged",
        variant(readings=[1]): "damaged",
        variant(readings=[reading | {"predicted": []}]): "damaged",
        variant(readings=[reading | {"predicted": part | {"values": [1]}}]): "damaged",
        variant(readings=[reading | {"predicted": part | {"values": "abc"}}]): "damaged",
        variant(readings=[reading | {"predicted": part | {"xyz": [1, 2, None]}}]): "damaged",
    }.items():
        parts[1].write_text(content, encoding="utf-8")
        refused(main("merge", *parts, *out), parts[1], word)
    parts[1].write_bytes(b"\xff\xfe\x00")
    refused(main("merge", *parts, *out), parts[1])
    assert not (tmp_path / "merged").exists()


@pytest.mark.parametrize("shard", ["0/3", "4/3", "1", "a/b", "1/0"])
def test_shard_that_is_none(shard, main, tmp_path):
    result = main("bake", "--output", tmp_path / "x", "--shard", shard)
    assert result.status == UNUSABLE
    assert shard in result.err
