# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A render farm's job: tasks over many scenes, resumed, joined, judged, and ended when asked to.

`tools/checks/check_farm.py` runs the bundles by the engines themselves.
"""

import io
import json
import shutil
import signal
import subprocess
import time

import bpy
import pytest

from tests.integration.support import COMMAND, ROOT, SECONDS, contents

BAKE = "bake --skip-done --predicted-only"


@pytest.fixture
def scenes(scene_file, tmp_path):
    """Two scenes in a folder, one of them further down."""
    folder = tmp_path / "scenes"
    (folder / "sub").mkdir(parents=True)
    shutil.copy(scene_file, folder / "a.blend")
    shutil.copy(scene_file, folder / "sub" / "b.blend")
    return folder


def done_before(result):
    return result.err.count("is there already")


def test_tasks_do_every_part_once_and_merge_to_what_one_bake_writes(scenes, main, tmp_path):
    out = tmp_path / "out"
    words = ("job", "--files", scenes, "--output", out, "--shards", "2")
    for task in ("1/3", "2/3", "3/3"):
        result = main(*words, "--task", task, "--", BAKE)
        assert result.status == 0, result.err
        assert done_before(result) == 0
    parts = {"a.part-1-of-2.json", "a.part-2-of-2.json"}
    assert (set(contents(out)), set(contents(out / "sub"))) == (
        *(parts, {name.replace("a.", "b.") for name in parts}),
    )
    # One of them never came to its end.
    (out / "a.part-2-of-2.json").unlink()
    result = main(*words, "--", "merge", "--max-delta-e", "1")
    assert result.status == 2
    last = result.err.splitlines()[-1]
    assert last.startswith("rough_spectra job: 1 of 2 units failed; ")
    assert "a.part-2-of-2.json: there is no such file" in last
    resumed = [main(*words, "--task", task, "--", BAKE) for task in ("1/3", "2/3", "3/3")]
    assert [result.status for result in resumed] == [0, 0, 0]
    assert sum(map(done_before, resumed)) == 3
    result = main(*words, "--", "merge", "--max-delta-e", "1")
    assert result.status == 0, result.err
    for name in ("a", "sub/b"):
        one = tmp_path / "one" / name
        words = ("--blend", scenes / f"{name}.blend", "--output", one, "--predicted-only")
        assert main("bake", *words).status == 0
        merged = contents((out / name).parent)
        assert contents(one.parent).items() <= merged.items()


def test_what_changed_is_baked_again(scenes, main, tmp_path):
    words = ("bake", "--blend", scenes / "a.blend", "--output", tmp_path / "x", *BAKE.split()[1:])
    assert main(*words).status == 0
    assert "nothing was measured" in main(*words).err
    bpy.ops.wm.open_mainfile(filepath=str(scenes / "a.blend"))
    node = bpy.data.materials["Alpha"].node_tree.nodes["Diffuse BSDF"]
    node.inputs["Color"].default_value = (0.5, 0.1, 0.1, 1)
    bpy.ops.wm.save_mainfile()
    again = main(*words)
    assert "nothing was measured" not in again.err
    assert "4 readings" in again.err
    # Other options are another bake; what is damaged is none.
    assert "nothing was" not in main(*words, "--read-at", "di:8").err
    (tmp_path / "x.json").write_text("{", encoding="utf-8")
    assert "4 readings" in main(*words).err


def test_a_wrong_scene_is_named_last_and_the_others_are_done(scenes, main, tmp_path):
    (scenes / "broken.blend").write_bytes(b"no scene")
    result = main("job", "--files", scenes, "--output", tmp_path / "out", "--", BAKE)
    assert result.status == 2
    last = result.err.splitlines()[-1]
    assert last.startswith("rough_spectra job: 1 of 3 units failed; ")
    assert last.endswith("check the file.")
    assert str(scenes / "broken.blend") in last
    assert (tmp_path / "out" / "sub" / "b.json").is_file()


def test_any_verb_and_lists_of_files(scenes, main, tmp_path):
    listed = tmp_path / "list.txt"
    listed.write_text("# scenes\nscenes/a.blend\n\nscenes/sub/b.blend\n", encoding="utf-8")
    result = main("job", "--files", listed, "--json", "--", "list", "--material", "Al*")
    told = json.loads(result.out.splitlines()[-1])
    assert [each["status"] for each in told["result"]["units"]] == [0, 0]
    found = [each["result"]["materials"] for each in told["result"]["units"]]
    assert [[material["material"] for material in each] for each in found] == [["Alpha"]] * 2
    once = main("job", "--files", "", "--", "search green")
    assert (once.status, "colorchecker/14-green" in once.out) == (0, True)
    for words, fault in (
        (("--", "job --help"), "cannot hold a job"),
        (("--shards", "2", "--", "check"), "--shards is for bake and merge"),
        (("--files", tmp_path / "none.txt", "--", "check"), "none.txt"),
        (("--files", tmp_path / "scenes" / "sub" / "..", "--", "merge"), "--output FOLDER"),
    ):
        result = main("job", *words)
        assert result.status == 2
        assert fault in result.err.splitlines()[-1]


@pytest.mark.parametrize(("limit", "status"), [("0", 1), ("1", 0)])
def test_merge_judges(limit, status, baked, main, tmp_path):
    words = ("--output", tmp_path / "x", "--max-delta-e", limit)
    result = main("merge", baked.path("json"), *words)
    assert result.status == status
    assert f"exceed ΔE00 {limit}; the largest is" in result.err.splitlines()[-1]
    # Joined from one part, the files are those of the bake.
    assert {name[1:]: data for name, data in contents(tmp_path).items()} == {
        name[5:]: data for name, data in baked.files.items()
    }


def test_engines_are_told_the_percentage_of_the_task():
    from rough_spectra.addon.commands.progress import ProgressLine
    from rough_spectra.addon.support.shown_text import Said, listening

    stream = io.StringIO()
    with listening(Said(engine="openjd", share=(0.5, 1.0))):
        progress = ProgressLine("measuring", stream, count=200)
        for done in (0, 0, 24, 24):
            progress(done, 24)
    lines = stream.getvalue().splitlines()
    assert lines[::2] == ["openjd_progress: 50.0", "openjd_progress: 100.0"]
    assert lines[1] == "openjd_status: measuring: 0 of 200 materials"
    assert lines[3].startswith("openjd_status: measuring: 200 of 200 materials")


def test_a_request_to_end_leaves_nothing_and_a_sentence(scenes, environment, tmp_path):
    words = ["job", "--files", str(scenes), "--output", str(tmp_path / "out"), "--", "bake"]
    log = tmp_path / "log"
    with log.open("w") as file:
        work = subprocess.Popen([*COMMAND, *words], env=environment, stdout=file, stderr=file)
        end = time.monotonic() + SECONDS
        while "measuring" not in log.read_text() and time.monotonic() < end:
            time.sleep(0.05)
        work.send_signal(signal.SIGTERM)
        assert work.wait(SECONDS) == 130
    last = log.read_text().splitlines()[-1]
    assert last.startswith("rough_spectra job: 1 of 2 units failed; ")
    assert "nothing was written" in last
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("bundle", ["bake", "verb"])
def test_the_bundles_call_what_the_command_line_takes(bundle):
    from rough_spectra.addon.commands import command_line

    template = json.loads((ROOT / "farm" / "openjd" / bundle / "template.json").read_text("utf-8"))
    values = {"{{Task.Param.Task}}": "1"}
    for each in template["parameterDefinitions"]:
        values["{{Param." + each["name"] + "}}"] = str(each.get("default", "/somewhere"))
    for step in template["steps"]:
        action = step["script"]["actions"]["onRun"]
        words = action["args"]
        for mark, value in values.items():
            words = [word.replace(mark, value) for word in words]
        assert not [word for word in words if "{{" in word]
        assert words[:3] == ["-b", "--command", command_line.NAME]
        options = command_line._parser().parse_args(words[3:])
        rest = {"Bake": ("--output", "x"), "Judge": ("part", "--output", "x")}
        inner = [*options.words[0].split(), *rest.get(step["name"], ())]
        verb = command_line._parser().parse_args(inner).verb
        assert verb == {"Bake": "bake", "Judge": "merge", "Run": "check"}[step["name"]]
