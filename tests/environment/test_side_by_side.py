# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps at the same time: their output in order, their failures, and their end."""

import os
import signal
import subprocess
import sys
import textwrap
import time
from dataclasses import replace
from pathlib import Path

import pytest

from tools.environment import side_by_side
from tools.environment.side_by_side import Step

ROOT = Path(__file__).resolve().parents[2]
SECONDS = 30

MEET = """
import sys, time
from pathlib import Path
mine, other = map(Path, sys.argv[1:3])
mine.touch()
end = time.monotonic() + float(sys.argv[3])
while not other.exists() and time.monotonic() < end:
    time.sleep(0.01)
sys.exit(not other.exists())
"""


def step(name, code, *arguments, **settings):
    command = [sys.executable, "-c", textwrap.dedent(code), *arguments]
    return Step(name, command, ROOT, settings)


def said(text):
    print(text, flush=True)


def meeting(folder, patience):
    """Two steps, each of which succeeds if it sees the other one's file within its patience."""
    a, b = folder / "a", folder / "b"
    return [step("a", MEET, a, b, str(patience)), step("b", MEET, b, a, str(patience))]


def test_two_lanes_run_at_the_same_time(tmp_path):
    results = side_by_side.run(meeting(tmp_path, SECONDS), 2, said)
    assert [(each.name, each.result) for each in results] == [("a", "ok"), ("b", "ok")]


def test_one_lane_runs_one_after_the_other_and_a_failure_is_told(tmp_path):
    first, second = side_by_side.run(meeting(tmp_path, 0.2), 1, said)
    assert (first.failed, first.result) == (True, "FAILED (exit status 1)")
    assert first.seconds >= 0.2
    assert not second.failed


@pytest.mark.parametrize("lanes", [1, 2, 8])
def test_output_reads_as_if_one_ran_after_the_other(tmp_path, capfd, lanes):
    """Even where the first ends last, and though it writes to both of its streams."""
    slow = """
        import sys, time
        print("one begins", flush=True)
        time.sleep(0.5)
        print("one ends", file=sys.stderr)
        """
    quick = "import os, sys; print(sys.argv[1]); sys.exit(os.environ['STATUS'] != '0')"
    steps = [
        step("one", slow),
        *(step(name, quick, f"{name} is here", STATUS="0") for name in ("two", "three")),
        step("four", quick, "x" * 10**5, STATUS="1"),
    ]
    results = side_by_side.run(steps, lanes, said)
    assert [each.failed for each in results] == [False, False, False, True]
    out, err = capfd.readouterr()
    assert err == "one ends\n"  # the first has our own streams
    assert out.split() == [
        *("===", "one", "one", "begins"),
        *("===", "two", "two", "is", "here"),
        *("===", "three", "three", "is", "here"),
        *("===", "four", "x" * 10**5),
    ]


def test_a_step_that_hangs_is_ended_and_shows_where_it_was(tmp_path, capfd):
    """CI that waits for it is stopped from outside, and nobody learns which step it was."""
    hang = """
        import faulthandler, time
        faulthandler.enable()
        def hangs_here():
            time.sleep(60)
        hangs_here()
        """
    steps = [replace(step("hangs", hang), minutes=1 / 60), step("next", "print('runs')")]
    first, second = side_by_side.run(steps, 2, said)
    assert first.failed
    assert first.result == "FAILED (still running after 0.0166667 minutes, and ended)"
    assert first.seconds < SECONDS
    assert not second.failed
    out, err = capfd.readouterr()
    assert "in hangs_here" in err
    assert "runs" in out


RUN = """
import sys
sys.path.insert(0, {root!r})
from pathlib import Path
from tools.environment import side_by_side
side_by_side.MOMENT, side_by_side.TIDYING, side_by_side.LAST = {patience}
sleep = '''{sleep}'''
steps = [
    side_by_side.Step(name, [sys.executable, "-c", sleep, Path({folder!r}) / name], Path.cwd())
    for name in "ab"
]
try:
    side_by_side.run(steps, 2, print)
except KeyboardInterrupt:
    sys.exit(130)
"""
POLITE = """
import sys, time
from pathlib import Path
place = Path(sys.argv[1])
try:
    place.write_text("here")
    time.sleep(60)
except KeyboardInterrupt:
    time.sleep(0.1)
    place.write_text("tidy")
"""
DEAF = """
import signal, sys, time
from pathlib import Path
signal.signal(signal.SIGINT, signal.SIG_IGN)
signal.signal(signal.SIGTERM, signal.SIG_IGN)
Path(sys.argv[1]).write_text("here")
time.sleep(60)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize(
    ("sleep", "group", "patience", "left"),
    [
        # A terminal's interrupt reaches all of them, and the children are not disturbed again.
        (POLITE, True, (SECONDS, 0, 0), "tidy"),
        (POLITE, False, (0, SECONDS, 0), "tidy"),
        (DEAF, True, (0.1, 0.1, 0.1), "here"),
    ],
    ids=["terminal", "process", "deaf"],
)
def test_interrupt_ends_all_children(tmp_path, sleep, group, patience, left):
    code = RUN.format(root=str(ROOT), folder=str(tmp_path), sleep=sleep, patience=patience)
    process = subprocess.Popen(
        [sys.executable, "-c", code],
        start_new_session=True,
        # A job that a script put in the background inherits SIGINT ignored.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    try:
        places = [tmp_path / name for name in "ab"]
        end = time.monotonic() + SECONDS
        while not all(place.exists() and place.read_text() for place in places):
            assert time.monotonic() < end
            time.sleep(0.01)
        (os.killpg if group else os.kill)(process.pid, signal.SIGINT)
        assert process.wait(SECONDS) == 130
        assert [place.read_text() for place in places] == [left, left]
        with pytest.raises(ProcessLookupError):  # the session's group is empty
            os.killpg(process.pid, 0)
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
