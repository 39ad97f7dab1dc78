# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files appear whole and together, or not at all: kills, full disks and closed folders are real."""

import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from rough_spectra.addon.support.atomic_files import publication
from rough_spectra.core.errors import OutputError

# ruff: noqa: PT012 - what is in such a block fails together

TESTS = Path(__file__).resolve().parents[1]
SETUP = f"""
import sys
sys.path.insert(0, {str(TESTS)!r})
import conftest
from pathlib import Path
from rough_spectra.addon.support.atomic_files import publication
from rough_spectra.core.errors import OutputError
folder = Path(sys.argv[1])
"""


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.fixture
def folder(tmp_path):
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "a.csv").write_bytes(b"old a")
    (folder / "b.csv").write_bytes(b"old b")
    return folder


def test_files_take_their_names_at_the_end_and_all_together(folder):
    with publication() as files:
        files.write(folder / "a.csv", b"new a")
        files.stage(folder / "c.csv").write_bytes(b"new c")
        files.write(folder / "deeper" / "d.csv", b"new d")
        assert (folder / "a.csv").read_bytes() == b"old a"
        assert not (folder / "c.csv").exists()
    assert (folder / "deeper" / "d.csv").read_bytes() == b"new d"
    (folder / "deeper" / "d.csv").unlink()
    (folder / "deeper").rmdir()
    assert contents(folder) == {"a.csv": b"new a", "b.csv": b"old b", "c.csv": b"new c"}


def test_files_go_when_the_others_appear_unless_they_are_written(folder):
    with publication() as files:
        files.write(folder / "deeper" / "a.csv", b"new a")
        files.write(folder / "b.csv", b"new b")
        files.remove(folder / "a.csv")
        files.clear(folder, lambda path: path.name == "b.csv")
        assert (folder / "a.csv").read_bytes() == b"old a"
    assert (folder / "deeper" / "a.csv").read_bytes() == b"new a"
    assert {path.name for path in folder.iterdir()} == {"deeper", "b.csv"}
    assert (folder / "b.csv").read_bytes() == b"new b"


def test_results_get_the_permissions_of_any_new_file(folder):
    with publication() as files:
        files.write(folder / "c.csv", b"c")
    plain = folder / "plain"
    plain.write_bytes(b"")
    assert (folder / "c.csv").stat().st_mode == plain.stat().st_mode


@pytest.mark.parametrize("failure", [ValueError, KeyboardInterrupt, OutputError, SystemExit])
def test_any_failure_leaves_everything_as_it_was(folder, failure):
    before = contents(folder)
    with pytest.raises(failure), publication() as files:
        files.write(folder / "a.csv", b"new a")
        files.write(folder / "c.csv", b"new c")
        raise failure
    assert contents(folder) == before


def test_the_last_of_two_contents_for_one_target_counts(folder):
    with publication() as files:
        files.write(folder / "a.csv", b"first")
        files.write(folder / "a.csv", b"second")
    assert contents(folder) == {"a.csv": b"second", "b.csv": b"old b"}


def test_a_folder_in_place_of_a_file_is_refused(folder):
    with pytest.raises(OutputError) as caught, publication() as files:
        files.write(folder / "a.csv", b"new a")
        files.write(folder, b"x")
    assert str(caught.value) == f"{folder} is a folder; choose a file name."
    assert contents(folder) == {"a.csv": b"old a", "b.csv": b"old b"}


def test_a_target_that_becomes_a_folder_does_not_take_the_others_along(folder):
    """The first rename is done when the second fails: the first file has to come back."""
    (folder / "b.csv").unlink()
    with pytest.raises(OutputError, match=r"b\.csv"), publication() as files:
        files.write(folder / "a.csv", b"new a")
        files.write(folder / "b.csv", b"new b")
        files.write(folder / "c.csv", b"new c")
        (folder / "b.csv").mkdir()
    (folder / "b.csv").rmdir()
    assert contents(folder) == {"a.csv": b"old a"}


def test_a_file_as_parent_is_refused(folder):
    with (
        pytest.raises(OutputError, match=r"nothing was changed\. Free the disk") as caught,
        publication() as files,
    ):
        files.write(folder / "a.csv" / "x.csv", b"x")
    assert str(folder / "a.csv" / "x.csv") in str(caught.value)
    assert contents(folder) == {"a.csv": b"old a", "b.csv": b"old b"}


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="root may write anywhere")
def test_a_closed_folder_is_refused(folder):
    folder.chmod(0o500)
    try:
        with pytest.raises(OutputError, match="Permission denied"), publication() as files:
            files.write(folder / "a.csv", b"new a")
    finally:
        folder.chmod(0o700)
    assert contents(folder) == {"a.csv": b"old a", "b.csv": b"old b"}


def test_a_file_system_that_takes_no_files_is_refused():
    with (
        pytest.raises(OutputError, match=r"^/proc/none/a\.csv cannot be written \("),
        publication() as files,
    ):
        files.write(Path("/proc/none/a.csv"), b"x")


@pytest.mark.parametrize("length", [230, 250, 255])
def test_names_as_long_as_the_system_allows(folder, length):
    target = folder / ("n" * (length - 4) + ".csv")
    target.write_bytes(b"old")
    with publication() as files:
        files.write(target, b"new")
    assert target.read_bytes() == b"new"


def run(script, folder, **options):
    return subprocess.run(
        [sys.executable, "-c", SETUP + script, str(folder)],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        **options,
    )


def test_full_disk_is_one_sentence_and_leaves_everything(folder):
    """The system refuses the bytes beyond 64 kB, as a full disk or a quota does."""

    def small_files():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (65536, 65536))

    done = run(
        """
try:
    with publication() as files:
        files.write(folder / "a.csv", b"new a")
        files.write(folder / "b.csv", bytes(1 << 20))
except OutputError as error:
    print(error)
""",
        folder,
        preexec_fn=small_files,
        env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
    )
    assert done.stdout == (
        f"{folder / 'b.csv'} cannot be written (File too large); nothing was changed. Free the "
        "disk or choose another place.\n"
    ), done.stderr
    assert contents(folder) == {"a.csv": b"old a", "b.csv": b"old b"}


@pytest.mark.parametrize("moment", ["while writing", "before the end"])
def test_a_kill_leaves_the_old_files(folder, moment):
    script = """
import os, signal
with publication() as files:
    files.write(folder / "a.csv", b"new a")
    part = files.stage(folder / "b.csv")
    with part.open("wb") as stream:
        stream.write(b"half of")
        stream.flush()
        if MOMENT: os.kill(os.getpid(), signal.SIGKILL)
    os.kill(os.getpid(), signal.SIGKILL)
""".replace("MOMENT", str(moment == "while writing"))
    done = run(script, folder)
    assert done.returncode == -signal.SIGKILL
    left = contents(folder)
    assert left.pop("a.csv") == b"old a"
    assert left.pop("b.csv") == b"old b"
    # What was being written stays under names that no program takes for results.
    assert all(name.startswith(".") and name.endswith(".part") for name in left)
    with publication() as files:
        files.write(folder / "a.csv", b"after")
    assert (folder / "a.csv").read_bytes() == b"after"
