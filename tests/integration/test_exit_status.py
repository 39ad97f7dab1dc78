# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Exit statuses say one thing each, and one damaged material does not stop the others."""

import json
import math
import os
import subprocess
from pathlib import Path

import bpy
import numpy as np
import pytest
from rough_spectra.addon.commands.verbs import search
from rough_spectra.addon.instrument import bake

from tests.integration.support import COMMAND, SECONDS, contents

ITSELF = "rough_spectra search: Rough Spectra 0.1.0 itself failed (KeyError: "


@pytest.fixture
def broken(monkeypatch, main):
    """Run a verb with a fault of our own in it; temporary files go to a folder."""

    def run(_options):
        return {}["what was expected\nto be there"]

    def broken(folder, *words):
        with monkeypatch.context() as patched:
            patched.setattr(search, "run", run)
            patched.setattr("tempfile.tempdir", str(folder))
            return main("search", "green", *words)

    return broken


def test_a_fault_of_our_own_has_a_status_a_sentence_and_a_file(broken, tmp_path):
    result = broken(tmp_path)
    assert result.status == 3
    assert result.sentence.startswith(ITSELF)
    assert "report it to" in result.sentence
    (path,) = tmp_path.iterdir()
    assert f"with {path}." in result.sentence
    assert "Traceback" in path.read_text(encoding="utf-8")
    assert "what was expected" in path.read_text(encoding="utf-8")


def test_debug_shows_where_it_failed_instead(broken, tmp_path):
    result = broken(tmp_path, "--debug")
    assert result.status == 3
    assert "Traceback" in result.err
    assert result.err.splitlines()[-1].startswith(ITSELF)
    assert not list(tmp_path.iterdir())


def test_without_a_place_for_the_file_the_sentence_stands_alone(broken, tmp_path):
    result = broken(tmp_path / "none")
    assert result.status == 3
    assert result.sentence.endswith("Rough Spectra authors.")


def test_a_fault_of_ours_in_the_second_blender_has_the_same_status(monkeypatch, main, scene):
    """One that its worker did not expect: an angle that is none."""
    measured, broken = bake.measure.Measurement, bake.measure.Geometry((("none", 0.0),), 0.0)
    monkeypatch.setattr(
        bake.measure, "Measurement", lambda materials, *_rest: measured(materials, [broken])
    )
    result = main("check", "--blend", scene, "--material", "Alpha")
    assert result.status == 3
    assert "Traceback" not in result.err
    told, _, kept = result.err.strip().rpartition(" please report it with ")
    assert told.endswith("This is no fault of yours:")
    Path(kept.rstrip(".")).unlink()


def test_an_interrupt_is_no_fault(monkeypatch, main):
    def run(_options):
        raise KeyboardInterrupt

    monkeypatch.setattr(search, "run", run)
    assert main("search", "green").status == 130


def test_a_closed_pipe_ends_it_without_a_word(environment):
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [*COMMAND, "search", "green"],
        env=environment,
        stdout=writing,
        stderr=subprocess.PIPE,
        text=True,
        timeout=SECONDS,
        check=False,
    )
    os.close(writing)
    assert done.stderr == ""
    assert done.returncode == 141


def test_what_fails_around_the_command_line_is_no_failed_check(environment, tmp_path):
    """The starter with a bpy that cannot be imported."""
    (tmp_path / "bpy.py").write_text("1 / 0\n", encoding="utf-8")
    done = subprocess.run(
        [*COMMAND, "search", "green"],
        env=environment | {"PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=SECONDS,
        check=False,
    )
    assert "ZeroDivisionError" in done.stderr
    assert done.returncode == 3


def damaged(path, **settings):
    """Damage Delta's settings past the checks of Blender's properties, and save."""
    bpy.ops.wm.open_mainfile(filepath=str(path))
    group = bpy.data.materials["Delta"].rough_spectra
    stored = group.bl_system_properties_get() if bpy.app.version >= (5, 0, 0) else group
    for name, value in settings.items():
        stored[name] = value
    bpy.ops.wm.save_mainfile()


DAMAGES = ({"observer": 9}, {"shader": 9}, {"spectrum": "[" * 20_000}, {"sigma": math.nan})


@pytest.mark.parametrize("damage", DAMAGES, ids=lambda damage: next(iter(damage)))
def test_one_damaged_material_does_not_stop_the_others(damage, scene, main, tmp_path):
    words = ("--predicted-only", "--material", "Alpha", "--material", "Delta", "--material", "Beta")
    assert main("bake", "--blend", scene, *words, "--output", tmp_path / "before/x").status == 0
    damaged(scene, **damage)
    result = main("bake", "--blend", scene, *words, "--output", tmp_path / "after/x")
    assert result.status == 2
    assert "rough_spectra: Material 'Delta': " in result.err
    assert "Traceback" not in result.err
    before, after = (
        json.loads((tmp_path / folder / "x.json").read_bytes())["readings"]
        for folder in ("before", "after")
    )
    assert [after[0], after[2]] == [before[0], before[2]]
    assert after[1]["predicted"] is None
    assert after[1]["fault"].startswith("Material 'Delta': ")
    alone = main("bake", "--blend", scene, "--material", "Delta", "--output", tmp_path / "alone/x")
    assert alone.status == 2
    assert "Material 'Delta'" in alone.sentence
    assert not (tmp_path / "alone").exists()


def test_a_check_compares_the_others_and_shards_merge_as_ever(scene, main, tmp_path):
    damaged(scene, observer=9)
    result = main("check", "--blend", scene, "--max-delta-e", "0.05")
    assert result.status == 2
    assert "0 of 3 materials exceed ΔE00 0.05" in result.err
    assert "Material 'Delta': its stored observer is none" in result.err
    assert main("bake", "--blend", scene, "--output", tmp_path / "whole/x").status == 2
    for number in (1, 2, 3):
        base = ("--output", tmp_path / "parts/x", "--shard", f"{number}/3")
        assert main("bake", "--blend", scene, *base).status in (0, 2)
    parts = sorted((tmp_path / "parts").iterdir())
    assert main("merge", *parts, "--output", tmp_path / "merged/x").status == 2
    assert contents(tmp_path / "merged") == contents(tmp_path / "whole")


def test_what_renders_no_number_is_named_and_the_others_are_measured(scene):
    """Cycles mends most of these itself; what it left would be NaN."""
    bpy.ops.wm.open_mainfile(filepath=str(scene))
    prepared = bake.prepare([("", bpy.data.materials[name]) for name in ("Alpha", "Delta")])
    values = np.full((2, 2, 3), 0.25)
    whole = bake.compare(prepared, values)
    values[1, 0, 2] = math.nan
    found = bake.compare(prepared, values)
    assert found.entries[0] == whole.entries[0]
    assert found.entries[1].measured is None
    assert found.faults == [
        "Material 'Delta': Cycles rendered a value that is not a number; check the material's "
        "nodes."
    ]
