# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A set of files is published as a set: processes are killed before each rename and removal."""

import json
import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from rough_spectra.addon.samples import library
from rough_spectra.addon.support import atomic_files, journal
from rough_spectra.core.errors import OutputError

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="forks and kills")

TESTS = Path(__file__).resolve().parents[1]
CHILD = f"""
import json, os, shutil, signal, sys
sys.path.insert(0, {str(TESTS)!r})
import conftest
from argparse import Namespace
from pathlib import Path
import numpy as np
from rough_spectra.addon.readings import json_document, writers
from rough_spectra.addon.samples import library
from rough_spectra.addon.support import atomic_files as outputs, journal
from rough_spectra.addon.readings.document import CyclesReading, Predicted, Reading, Readings
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.commands.verbs import merge
from rough_spectra.core.errors import OutputError

base = Path(sys.argv[1]) / "out" / "x"
CHANGES = ("os.rename", "os.remove", "os.link")

def shown(folder):
    return {{path.name: path.read_bytes().hex() for path in folder.iterdir()
            if path.suffix != ".part" and path.name != ".lock"}}

def end(number):
    \"\"\"Die before the so manieth change of the folder.\"\"\"
    count = 0
    def hook(event, _arguments):
        nonlocal count
        count += event in CHANGES
        if count == number and event in CHANGES:
            os.kill(os.getpid(), signal.SIGKILL)
    sys.addaudithook(hook)

def break_off(number):
    \"\"\"Interrupt once, as the keyboard does, instead of the so manieth change.\"\"\"
    count = 0
    def hook(event, _arguments):
        nonlocal count
        count += event in CHANGES
        if count == number and event in CHANGES:
            count += 1
            raise KeyboardInterrupt
    sys.addaudithook(hook)

def forked(work, *hooks):
    \"\"\"Do it in a process of its own; give how that ended.\"\"\"
    pid = os.fork()
    if not pid:
        for hook, number in hooks:
            hook(number)
        try:
            work()
        except KeyboardInterrupt:
            os._exit(3)
        except BaseException as error:
            print(repr(error), file=sys.stderr)
            os._exit(4)
        os._exit(0)
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])

def reading(name, bands, level):
    color = (level, level, level)
    predicted = Predicted("reading", "lambert", "", 0.0, "D65", 2, bands, (level,) * len(bands),
                          color, color, color)
    measured = CyclesReading(color, (0.0, 0.0, 0.0), "D65", color, color)
    return Reading(name, "", "", "", predicted, measured, 0.0, "", ())

def document(level):
    grids = (400.0, 500.0, 600.0), (400.0, 450.0, 500.0, 600.0)
    entries = tuple(reading(str(i), bands, level) for i, bands in enumerate(grids))
    return Readings("Linear Rec.709", "5", entries)

def start_again(make):
    shutil.rmtree(base.parent, ignore_errors=True)
    base.parent.mkdir()
    make()
"""


def child(lines, folder):
    done = subprocess.run(
        [sys.executable, "-c", CHILD + textwrap.dedent(lines), str(folder)],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.parametrize("work", ["merge", "import", "remove"])
def test_a_set_that_a_kill_cut_in_two_is_made_whole_by_the_next_look(work, tmp_path):
    """Wherever it is killed, all is old or all is new, and the next run neither trips nor waits."""
    found = child(
        f"""
        def sample(name, level):
            bands = np.arange(400.0, 701, 10)
            return Sample(name, bands, np.full(bands.size, level), "reading")

        def bake():
            writers.write(document(0.5), base)

        source = base.parent.parent / "x.json"
        source.write_bytes(json_document.to_json(document(0.25)))

        def fill():
            library.add_all({{"a": [sample("one", 0.1)], "b": [sample("two", 0.2)]}}, base.parent)

        def look():
            library.contents(base.parent)

        make, work, look = {{
            "merge": (
                bake,
                lambda: merge.run(Namespace(parts=[source], output=base, format=["csv", "cgats"])),
                lambda: merge.run(Namespace(parts=[base.with_name("x.json")],
                                            output=source.parent / "again" / "y", format=["csv"])),
            ),
            "import": (
                fill,
                lambda: library.add_all({{"a": [sample("three", 0.3)], "b": [sample("four", 0.4)],
                                          "c": [sample("five", 0.5)]}}, base.parent),
                look,
            ),
            "remove": (fill, lambda: library.remove(["a/one", "b/two"], base.parent), look),
        }}[{work!r}]
        start_again(make)
        states = {{"old": shown(base.parent)}}
        assert forked(work) == 0
        states["new"] = shown(base.parent)
        states["killed"], states["after"], states["again"] = [], [], []
        while True:
            start_again(make)
            ended = forked(work, (end, len(states["killed"]) + 1))
            if ended == 0:
                break
            assert ended == -signal.SIGKILL
            states["killed"].append(shown(base.parent))
            look()
            states["after"].append(shown(base.parent))
            if states["after"][-1] == states["old"]:
                assert forked(work) == 0
            states["again"].append(shown(base.parent))
        print(json.dumps(states))
        """,
        tmp_path,
    )
    old, new = found["old"], found["new"]
    assert set(old) != set(new) or work != "remove"
    assert len(found["killed"]) >= 2 * len(old)
    mixed = [seen for seen in found["killed"] if seen not in (old, new)]
    assert mixed, "nothing was ever killed between two renames"
    for seen in found["after"]:
        assert seen in (old, new)
    # Once it is old, it was not new before: the kills run through the work in its order.
    places = [found["after"].index(state) for state in (old, new)]
    assert places == [0, found["after"].count(old)]
    assert all(seen == new for seen in found["again"])


def test_an_interrupt_between_renames_leaves_all_old_and_a_kill_meanwhile_is_mended(tmp_path):
    found = child(
        """
        names = "abcd"

        def make():
            for name in "abc":
                (base.parent / name).write_text(f"old {name}")

        def work():
            with outputs.publication() as files:
                for name in "abd":
                    files.write(base.parent / name, f"new {name}".encode())
                files.remove(base.parent / "c")

        def everything():
            return {path.name: path.read_bytes().hex() for path in base.parent.iterdir()}

        start_again(make)
        states = {"old": everything(), "interrupted": [], "killed": []}
        forked(work)
        states["new"] = everything()
        for first in range(1, 100):
            start_again(make)
            ended = forked(work, (break_off, first))
            if ended == 0:
                break
            assert ended == 3
            states["interrupted"].append(everything())
            for second in range(1, 100):
                start_again(make)
                ended = forked(work, (end, first + second), (break_off, first))
                if ended != -signal.SIGKILL:
                    break
                journal.finish(base.parent)
                states["killed"].append(shown(base.parent))
        print(json.dumps(states))
        """,
        tmp_path,
    )
    old, new = found["old"], found["new"]
    assert set(new) == {"a", "b", "d"}
    renamed = [seen for seen in found["interrupted"] if not any(n.endswith(".part") for n in seen)]
    assert len(renamed) >= 8
    # After the last rename it is done, and only what it leaves behind is still to be removed.
    assert all({n: s for n, s in seen.items() if n in "abcd"} in (old, new) for seen in renamed)
    assert renamed.count(old) >= 7
    assert len(found["killed"]) >= 30
    assert all(seen in (old, new) for seen in found["killed"])


def test_a_set_that_fails_between_renames_is_turned_back(tmp_path):
    """Somebody changes the second file while the first takes its name: that change is kept."""
    found = child(
        """
        base.parent.mkdir()
        for name in "ab":
            (base.parent / name).write_text(f"old {name}")
        def hook(event, arguments):
            if event == "os.rename" and str(arguments[1]).endswith("/a") and not told:
                told.append("")
                (base.parent / "b").write_text("of somebody else")
        told = []
        sys.addaudithook(hook)
        try:
            with outputs.publication() as files:
                for name in "abc":
                    files.write(base.parent / name, b"new")
        except OutputError as error:
            told.append(str(error))
        print(json.dumps([told[-1], {p.name: p.read_text() for p in base.parent.iterdir()}]))
        """,
        tmp_path,
    )
    assert "/b cannot be written (somebody else changed it); nothing was changed" in found[0]
    assert found[1] == {"a": "old a", "b": "of somebody else"}


def test_a_set_waits_for_another_that_takes_its_names_and_a_reader_leaves_it_alone(tmp_path):
    """The first process is stopped between two renames, and goes on while the second waits."""
    found = child(
        """
        import time
        def publish(text):
            with outputs.publication() as files:
                for name in "abcd":
                    files.write(base.parent / name, text)

        def stop(number):
            count = 0
            def hook(event, _arguments):
                nonlocal count
                count += event == "os.rename"
                if count == number and event == "os.rename":
                    count += 1
                    os.kill(os.getpid(), signal.SIGSTOP)
            sys.addaudithook(hook)

        def go_on():
            time.sleep(1.0)
            os.kill(first, signal.SIGCONT)

        start_again(lambda: publish(b"old"))
        first = os.fork()
        if not first:
            stop(3)
            publish(b"first")
            os._exit(0)
        os.waitpid(first, os.WUNTRACED)
        half = shown(base.parent)
        journal.finish(base.parent)
        states = [half, shown(base.parent)]
        helper = os.fork()
        if not helper:
            go_on()
            os._exit(0)
        publish(b"second")
        for process in (first, helper):
            assert os.waitpid(process, 0)[1] == 0
        print(json.dumps([*states, shown(base.parent)]))
        """,
        tmp_path,
    )
    half, read, end = (
        {name: bytes.fromhex(text) for name, text in state.items() if name in "abcd"}
        for state in found
    )
    assert half == read == {"a": b"first", "b": b"first", "c": b"old", "d": b"old"}
    assert end == dict.fromkeys("abcd", b"second")
    assert set(found[2]) == set("abcd")


@pytest.fixture
def half(tmp_path):
    """A folder with a journal of a process that was killed before all its renames."""
    (tmp_path / "a").write_bytes(b"old a")
    for name in ".a.1.part", ".b.1.part":
        (tmp_path / name).write_bytes(b"new")
    steps = [
        {"name": "a", "was": journal.seen(tmp_path / "a"), "part": ".a.1.part", "old": None},
        {"name": "b", "was": None, "part": ".b.1.part", "old": None},
    ]

    def write(*changes):
        changed = [step | change for step, change in zip(steps, changes, strict=False)]
        text = json.dumps(changed + steps[len(changed) :]) + "\n"
        (tmp_path / journal.NAME).write_text(text, encoding="ascii")
        return text

    write()
    return tmp_path, write


def test_a_line_without_its_end_does_not_count(half):
    folder, write = half
    text = write()
    (folder / journal.NAME).write_text(text[:-1], encoding="ascii")
    journal.finish(folder)
    assert (folder / "a").read_bytes() == b"old a"
    assert not (folder / journal.NAME).exists()
    (folder / journal.NAME).write_text(f"{text}[half of the ne", encoding="ascii")
    journal.finish(folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {"a": b"new", "b": b"new"}


def test_what_somebody_changed_after_the_kill_stays(half):
    folder, _ = half
    (folder / "a").write_bytes(b"edited since")
    journal.finish(folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {
        "a": b"edited since",
        "b": b"new",
    }


def test_the_next_set_does_not_fall_back_to_the_one_that_was_killed(half):
    """Neither when it writes the same names, nor when it is a single file."""
    folder, _ = half
    with atomic_files.publication() as files:
        files.write(folder / "b", b"newest")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {
        "a": b"new",
        "b": b"newest",
    }


@pytest.mark.parametrize(
    "change",
    [
        {"name": "../victim"},
        {"name": ".."},
        {"name": ""},
        {"part": "/etc/hostname"},
        {"part": "victim"},
        {"part": "../.x.part"},
        {"old": "victim"},
        {"was": [1]},
        {"was": "ab"},
        {"name": 5},
    ],
    ids=str,
)
def test_a_journal_from_anywhere_reaches_no_other_file(half, change):
    folder, write = half
    victim = folder / "victim"
    victim.write_bytes(b"precious")
    write(change)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    with pytest.raises(OutputError, match=r"lists no renames of ours \(.*\); delete it\."):
        journal.finish(folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_a_journal_from_anywhere_removes_nothing_that_it_does_not_know(half):
    folder, write = half
    write({"part": None, "was": [5, 0]}, {"part": None, "was": None})
    journal.finish(folder)
    assert (folder / "a").read_bytes() == b"old a"


def test_a_library_says_what_cannot_be_completed_and_shows_the_rest(half):
    folder, write = half
    write({"name": "../victim"})
    found = library.contents(folder)
    assert len(found.faults) == 1
    assert "lists no renames of ours" in found.faults[0]
    assert library.cached(folder) is found
    (folder / journal.NAME).unlink()
    assert library.contents(folder).faults == ()


def test_a_link_or_a_pipe_in_place_of_the_journal_is_refused(tmp_path):
    victim = tmp_path / "victim"
    victim.write_bytes(b"precious")
    place = tmp_path / "out" / journal.NAME
    place.parent.mkdir()
    place.symlink_to(victim)
    with pytest.raises(OutputError, match="journal cannot be written"):
        journal.finish(place.parent)
    place.unlink()
    os.mkfifo(place)
    with pytest.raises(OutputError, match="a device or a pipe"):
        journal.finish(place.parent)
    assert victim.read_bytes() == b"precious"


def test_a_full_disk_before_the_first_rename_changes_nothing(tmp_path):
    """Even the journal does not fit: the system writes a part of it."""
    found = child(
        """
        import resource
        base.parent.mkdir()
        (base.parent / "a0").write_text("old")
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (600, 600))
        try:
            with outputs.publication() as files:
                for i in range(20):
                    files.write(base.parent / f"a{i}", b"new")
        except OutputError as error:
            print(json.dumps([str(error), {p.name: p.read_text() for p in base.parent.iterdir()}]))
        """,
        tmp_path,
    )
    assert f"{journal.NAME} cannot be written" in found[0]
    assert found[1] == {"a0": "old"}
