# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The developer commands as they are called."""

from pathlib import Path

import pytest

import dev
from tools.environment.errors import SetupError

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def stubbed(monkeypatch):
    """Nothing is set up or run; the list receives the steps."""
    ran = []

    def run(steps, _lanes, _say):
        ran.extend(steps)
        return [dev.Result(step.name, "ok") for step in steps]

    monkeypatch.setattr(dev.side_by_side, "run", run)
    monkeypatch.setattr(dev.environments, "prepare", lambda *_: True)
    monkeypatch.setattr(dev.package, "stage", lambda *_: None)
    monkeypatch.setattr(dev.wheels, "ensure", lambda *_: None)
    monkeypatch.delenv("CI", raising=False)
    return ran


def test_test_runs_every_step_and_sums_them_up(stubbed, capsys):
    assert dev.main(["test"]) == 0
    assert [step.name.split(" (")[0] for step in stubbed] == [
        "tests, Blender 5.2",
        "tests, Blender 4.5",
        "lint",
        "layout",
        "types",
    ]
    said = capsys.readouterr().out
    assert said.endswith("All steps passed.\n")
    assert all(f"{step.name}: ok" in said for step in stubbed)


def test_one_failing_step_fails_the_run(stubbed, monkeypatch, capsys):
    monkeypatch.setattr(
        dev.side_by_side,
        "run",
        lambda steps, *_: [dev.Result(s.name, "no", 0, "lint" in s.name) for s in steps],
    )
    assert dev.main(["test"]) == 1
    assert capsys.readouterr().out.endswith("1 of 5 steps failed.\n")


def test_blenders_that_run_at_once_share_no_folder_and_no_screen(stubbed, monkeypatch):
    monkeypatch.setenv("ROUGH_SPECTRA_BLENDER", "/opt/blender")
    assert dev.main(["test", "--only", "5.2", "--only", "4.5"]) == 0
    one, other = stubbed
    for name in ("BLENDER_USER_RESOURCES", "HYPOTHESIS_STORAGE_DIRECTORY"):
        assert Path(one.settings[name]).is_dir()
        assert one.settings[name] != other.settings[name]
    caches = [word for step in stubbed for word in step.command if "cache_dir" in str(word)]
    assert len(set(caches)) == 2
    assert "ROUGH_SPECTRA_BLENDER" not in one.settings
    assert other.settings["ROUGH_SPECTRA_BLENDER"] == ""


def test_only_picks_steps(stubbed):
    assert dev.main(["test", "--only", "lint", "--only", "4.5", "-k", "something"]) == 0
    names = [step.name.split(" (")[0] for step in stubbed]
    assert names == ["tests, Blender 4.5", "lint", "layout"]
    assert stubbed[0].command[-2:] == ["-k", "something"]


@pytest.mark.parametrize(
    ("ci", "only", "status"), [("", [], 0), ("true", [], 1), ("", ["--only", "4.5"], 1)]
)
def test_missing_python_is_said_and_fails_where_it_must(
    stubbed, monkeypatch, capsys, ci, only, status
):
    monkeypatch.setenv("CI", ci)
    monkeypatch.setattr(dev.environments, "prepare", lambda e, _say: e is not dev.BLENDER_4_5)
    assert dev.main(["test", *only]) == status
    said = capsys.readouterr().out
    assert "Blender 4.5 was not tested: no Python 3.11 that runs was found; install it" in said


def test_run_keeps_arguments_and_folder(monkeypatch, tmp_path):
    """Options after the verb belong to the verb, `--help` too."""
    calls = []
    monkeypatch.setattr(dev.environments, "prepare", lambda *_: True)
    monkeypatch.setattr(dev.os, "execv", lambda path, command: calls.append(command))
    monkeypatch.setattr(dev.sys, "platform", "linux")
    monkeypatch.setattr(dev, "call", lambda *_, **__: 0)
    dev.main(["run", "bake", "--help", "a.csv"])
    assert calls[0][2:] == ["bake", "--help", "a.csv"]


def test_unknown_argument_is_refused(stubbed):
    with pytest.raises(SystemExit) as end:
        dev.main(["build", "--fast"])
    assert end.value.code == 2


def test_missing_script_is_named():
    with pytest.raises(SetupError, match=r"tools/nothing\.py does not exist"):
        dev.script("tools/nothing.py")


def test_tables_wants_a_tool_that_there_is(stubbed):
    with pytest.raises(SetupError, match="Name a tool of tools/tables"):
        dev.main(["tables"])
    with pytest.raises(SetupError, match=r"tools/tables/nothing\.py does not exist"):
        dev.main(["tables", "nothing", "FOLDER"])


@pytest.mark.parametrize("command", [*dev.COMMANDS, ""])
def test_help(command):
    with pytest.raises(SystemExit) as end:
        dev.main([*command.split(), "--help"])
    assert end.value.code == 0


def test_ci_calls_the_test_command():
    script = ROOT / ".ci" / "run"
    lines = [line for line in script.read_text(encoding="utf-8").splitlines() if line[:1] != "#"]
    assert lines[-1] == "python3 dev.py test"
    assert "set -e" in lines
    assert script.stat().st_mode & 0o111
