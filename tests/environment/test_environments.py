# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""An environment is ready when it was made whole from the present pins, and not before."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tools.environment import environments, interpreters, wheels
from tools.environment.errors import SetupError

ROOT = Path(__file__).resolve().parents[2]
HERE = "{}.{}".format(*sys.version_info[:2])


@pytest.fixture
def environment(tmp_path, monkeypatch):
    """An environment with no pins, which is made of a folder instead of by the venv module."""
    requirements = tmp_path / "requirements"
    requirements.mkdir()
    (requirements / "tools.txt").write_text("# nothing\n", encoding="utf-8")

    def create(folder, _interpreter, python):
        python.parent.mkdir(parents=True)
        python.symlink_to(sys.executable)

    monkeypatch.setattr(environments, "_create", create)
    found = interpreters.Interpreter(Path(sys.executable), HERE)
    monkeypatch.setattr(interpreters, "find", lambda _version: found)
    return environments.Environment(tmp_path, environments.TOOLS, (HERE,), "nothing to fetch")


class Installer:
    """Stands in for pip: counts its calls and may fail."""

    def __init__(self):
        self.calls = 0
        self.error = None

    def __call__(self, environment, _say):
        self.calls += 1
        if self.error is not None:
            raise self.error


def test_second_preparation_does_nothing(environment, monkeypatch):
    """Not even look for a Python: running candidates is what would make a second start slow."""
    pip, said = Installer(), []
    assert environments.prepare(environment, said.append, pip)
    said.clear()
    monkeypatch.delattr(interpreters, "find")
    assert environments.prepare(environment, said.append, pip)
    assert pip.calls == 1
    assert said == []


@pytest.mark.parametrize("error", [SetupError("no network"), KeyboardInterrupt()])
def test_failed_setup_is_redone(environment, error):
    pip, said = Installer(), []
    pip.error = error
    with pytest.raises(type(error)):
        environments.prepare(environment, said.append, pip)
    assert not environment.is_ready()
    pip.error = None
    assert environments.prepare(environment, said.append, pip)
    assert environment.is_ready()
    assert any("broke off" in sentence for sentence in said)


KILLED = """
import sys
from pathlib import Path
sys.path.insert(0, {root!r})
from tools.environment import environments, interpreters
found = interpreters.Interpreter(Path(sys.executable), {here!r})
interpreters.find = lambda _version: found
environments._create = lambda folder, *_: folder.mkdir()
made = environments.Environment(Path({at!r}), environments.TOOLS, ({here!r},), "")
pip = "print('at work', flush=True); import sys; sys.stdin.read(); open({done!r}, 'w')"
def install(*_):
    environments._child([sys.executable, "-c", pip])
environments.prepare(made, lambda _sentence: None, install)
"""


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGKILL")
def test_killed_setup_is_redone_once_its_pip_has_ended(environment):
    """dev.py dies while pip is at work: nothing gets a chance to tidy up, and pip goes on."""
    done = environment.root / "orphan-done"
    code = KILLED.format(root=str(ROOT), here=HERE, at=str(environment.root), done=str(done))
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen([sys.executable, "-c", code], **pipes) as child:
        assert child.stdout.readline() == "at work\n"
        child.send_signal(signal.SIGKILL)
        child.wait()
        assert environment.folder.exists()
        assert not environment.is_ready()
        said = []

        def say(sentence):
            said.append(sentence)
            if "waiting" in sentence:
                assert not done.exists()
                child.stdin.close()

        pip = Installer()
        assert environments.prepare(environment, say, pip)
    assert done.exists()
    assert "waiting" in said[0]
    assert pip.calls == 1
    assert environment.is_ready()


def test_changed_pins_are_noticed(environment):
    pip = Installer()
    environments.prepare(environment, lambda _sentence: None, pip)
    environment.requirements.write_text("something==1\n", encoding="utf-8")
    assert not environment.is_ready()


@pytest.mark.parametrize("stamp", ["", "{", "[]", "{}", '{"pins": "old"}'])
def test_damaged_stamp_means_not_ready(environment, stamp):
    environments.prepare(environment, lambda _sentence: None, Installer())
    (environment.folder / environments.STAMP).write_text(stamp, encoding="utf-8")
    assert not environment.is_ready()


def test_deleted_interpreter_is_noticed(environment):
    environments.prepare(environment, lambda _sentence: None, Installer())
    environment.python.unlink()
    environment.python.symlink_to(environment.root / "deleted")
    assert not environment.is_ready()


def test_wheel_belongs_to_the_pins_of_blender_only(tmp_path, monkeypatch):
    tools = environments.Environment(ROOT, environments.TOOLS, (HERE,), "")
    blender = environments.Environment(ROOT, "bpy-5.2", (HERE,), "")
    before = tools.pins(), blender.pins()
    monkeypatch.setattr(wheels, "BUILD_TAG", "99")
    assert tools.pins() == before[0]
    assert blender.pins() != before[1]
