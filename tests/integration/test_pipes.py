# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever file the user names may be a pipe or a device: it is refused, and not waited for."""

import os
import signal
from contextlib import contextmanager
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes on this system")

PATIENCE = 20  # seconds; refusing takes a moment


@contextmanager
def impatient():
    def give_up(_signal, _frame):
        raise AssertionError("it waits for the pipe")

    before = signal.signal(signal.SIGALRM, give_up)
    signal.alarm(PATIENCE)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


@pytest.fixture
def pipe(tmp_path):
    path = tmp_path / "pipe"
    os.mkfifo(path)
    return path


def into(folder):
    """Where `assign` is to save: it asks for that before it reads anything."""
    return "--output", folder / "new.blend"


WAYS = {
    "mapping": lambda file, out: ("assign", "--mapping", file, "--create", *into(out)),
    "measurement": lambda file, out: ("assign", "--by-name", file, "--create", *into(out)),
    "preset": lambda file, out: ("assign", "--preset", file, "--material", "M", *into(out)),
    "import": lambda file, out: ("import", file, "--folder", out),
    "part": lambda file, out: ("merge", file, "--output", out / "x"),
    "preset to check": lambda file, _out: ("validate", file),
    "blend": lambda file, out: ("bake", "--blend", file, "--output", out / "x"),
    "assets": lambda file, out: ("assets", "--file", file, "--output", out / "library"),
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("kind", ["pipe", "device"])
def test_what_is_no_file_is_refused_in_one_sentence(way, kind, pipe, main, tmp_path):
    named = tmp_path / "named.json"
    named.symlink_to(pipe if kind == "pipe" else Path("/dev/zero"))
    out = tmp_path / "out"
    with impatient():
        result = main(*WAYS[way](named, out))
    assert result.status == 2
    assert "named.json" in result.err
    assert "is no regular file" in result.err or "is no file" in result.err
    assert not out.exists()


def test_a_mapping_that_names_a_pipe_is_refused(pipe, main, tmp_path):
    mapping = tmp_path / "mapping.csv"
    mapping.write_text("material,sample,file\nM,a,pipe\n", encoding="utf-8")
    with impatient():
        result = main("assign", "--mapping", mapping, "--create", *into(tmp_path))
    assert result.status == 2
    assert "pipe: this is no regular file" in result.err


def test_a_lock_that_is_a_pipe_is_refused(tmp_path):
    from rough_spectra.addon.support import file_lock
    from rough_spectra.core.errors import OutputError

    os.mkfifo(tmp_path / file_lock.NAME)
    lock = file_lock.locked(tmp_path)
    with impatient(), pytest.raises(OutputError, match="no regular file"), lock:
        pass


def test_catalogs_that_are_a_pipe_are_refused(pipe):
    from rough_spectra.addon.assets import catalogs
    from rough_spectra.core.errors import InputError

    with impatient(), pytest.raises(InputError, match="no regular file"):
        catalogs.merge(pipe, ["Mine"])


def test_a_configuration_of_colors_that_is_a_pipe_says_nothing(pipe, monkeypatch):
    from rough_spectra.addon.blender import ocio

    monkeypatch.setenv("OCIO", str(pipe))
    with impatient():
        assert ocio.warning.__wrapped__() == ""


def test_a_pipe_in_a_library_is_passed_over(tmp_path):
    from rough_spectra.addon.samples import library

    os.mkfifo(tmp_path / "walls.json")
    with impatient():
        assert all(entry.is_preset for entry in library.entries(tmp_path))
