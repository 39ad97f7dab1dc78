# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A name on PATH is trusted after it has run, not before."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tools.environment import interpreters

ROOT = Path(__file__).resolve().parents[2]
HERE = "{}.{}".format(*sys.version_info[:2])
OTHER = "3.11" if HERE != "3.11" else "3.13"

pytestmark = pytest.mark.skipif(os.name == "nt", reason="the fakes are shell scripts")


def fake(path: Path, script: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
    path.chmod(0o755)
    return path


def fake_python(path: Path, version: str, plain: bool = True) -> Path:
    answer = f'{{"path": "{path}", "version": "{version}", "plain": {str(plain).lower()}}}'
    return fake(path, f"echo '{answer}'")


@pytest.fixture
def broken_shim(tmp_path):
    return fake(
        tmp_path / "shims" / f"python{OTHER}",
        f"echo 'pyenv: python{OTHER}: not found' >&2; exit 127",
    )


def find(version, tmp_path, folders, **environ):
    environ["PATH"] = os.pathsep.join(str(folder) for folder in folders)
    return interpreters.find(version, environ, tmp_path / "home")


def test_working_interpreter_wins_over_broken_shim(tmp_path, broken_shim):
    works = fake_python(tmp_path / "bin" / f"python{OTHER}", f"{OTHER}.4")
    found = find(OTHER, tmp_path, [broken_shim.parent, works.parent])
    assert found == interpreters.Interpreter(works, f"{OTHER}.4")


def test_shim_that_talks_but_is_no_python_is_passed_over(tmp_path):
    talks = fake(tmp_path / "shims" / f"python{OTHER}", "echo hello")
    works = fake_python(tmp_path / "bin" / f"python{OTHER}", f"{OTHER}.4")
    assert find(OTHER, tmp_path, [talks.parent, works.parent]).path == works


@pytest.mark.parametrize(
    ("place", "environ"),
    [
        ("home/.pyenv/versions/{v}.1/bin", {}),
        ("elsewhere/versions/{v}.1/bin", {"PYENV_ROOT": "elsewhere"}),
        ("home/.local/share/uv/python/cpython-{v}.1-linux-x86_64-gnu/bin", {}),
        ("uv/cpython-{v}.1-linux-x86_64-gnu/bin", {"UV_PYTHON_INSTALL_DIR": "uv"}),
        ("data/uv/python/cpython-{v}.1-linux-x86_64-gnu/bin", {"XDG_DATA_HOME": "data"}),
    ],
)
def test_looks_where_version_managers_keep_theirs(tmp_path, broken_shim, place, environ):
    folder = tmp_path / place.format(v=OTHER)
    works = fake_python(folder / f"python{OTHER}", f"{OTHER}.1")
    absolute = {name: str(tmp_path / value) for name, value in environ.items()}
    assert find(OTHER, tmp_path, [broken_shim.parent], **absolute).path == works


def test_newest_patch_release_of_a_version_manager_wins(tmp_path):
    versions = tmp_path / "home" / ".pyenv" / "versions"
    for patch in (2, 10, 9):
        release = f"{OTHER}.{patch}"
        fake_python(versions / release / "bin" / f"python{OTHER}", release)
    assert find(OTHER, tmp_path, []).version == f"{OTHER}.10"


def test_free_threaded_build_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(interpreters, "_managed", lambda *_: iter(()))
    odd = fake_python(tmp_path / "bin" / f"python{OTHER}", f"{OTHER}.4", plain=False)
    assert find(OTHER, tmp_path, [odd.parent]) is None


def test_running_interpreter_is_found_and_not_as_a_virtual_environment(tmp_path):
    found = find(HERE, tmp_path, [])
    assert found.version.startswith(f"{HERE}.")
    assert not found.path.is_relative_to(sys.prefix) or sys.prefix == sys.base_prefix


@pytest.mark.parametrize("command", ["setup", "test", "demo", "build", "bench", "run"])
def test_neither_python_ends_with_one_sentence_and_status_2(tmp_path, command):
    """The whole command, in a clone without environments, on a machine without fitting Pythons."""
    clone = tmp_path / "clone"
    shutil.copytree(ROOT / "tools", clone / "tools")
    shutil.copytree(ROOT / "requirements", clone / "requirements")
    shutil.copy(ROOT / "dev.py", clone)
    start = (
        "import runpy, sys; import tools.environment.interpreters as interpreters\n"
        "interpreters.find = lambda *_: None\n"
        f"sys.argv = ['dev.py', {command!r}]; runpy.run_path('dev.py', run_name='__main__')\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", start], cwd=clone, capture_output=True, text=True, check=False
    )
    assert ended.returncode == 2
    assert ended.stdout == ""
    assert ended.stderr.count("\n") == 1
    assert "install" in ended.stderr
    assert not (clone / ".venv").exists()
