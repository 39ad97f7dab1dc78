# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of a second Blender that failed, for reasons that really occur."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import bpy
import pytest
from rough_spectra.addon.blender import job_failure
from rough_spectra.addon.instrument.measure import (
    RING_45_0,
    Geometry,
    Measurement,
    measure,
)
from rough_spectra.core.errors import OutputError, OwnFaultError

SMALLER = "ask for less"
PLENTY = 1 << 40
"""Bytes free on the disk."""


def failure(code, free=PLENTY):
    """What is said of a Python that runs a line; its log ends like that of a real Blender."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    log = f"starting\n{done.stderr}\nBlender quit\n"
    said = job_failure.reason(log)
    return said, job_failure.remedy(done.returncode, said, log, free, SMALLER)


@pytest.mark.parametrize(
    ("code", "said", "remedy"),
    [
        ("import no_such_part", "ModuleNotFoundError: No module named 'no_such_part'", "A part is"),
        ("raise OSError(28, 'No space left on device')", "OSError: [Errno 28] No", "Free the"),
        ("raise MemoryError", "MemoryError", f"other programs, or {SMALLER}."),
        (
            "import numpy; numpy.empty(1 << 60, 'B')",
            "_ArrayMemoryError: Unable to allocate 1.00 EiB",
            f"other programs, or {SMALLER}.",
        ),
        ("raise RuntimeError('\\nError: it burns')", "RuntimeError: Error: it burns", None),
        ("try: 1 / 0\nexcept ArithmeticError: [][0]", "IndexError: list index out of range", None),
        ("import os; os.kill(os.getpid(), 9)", "starting", "The memory is probably full"),
        ("import os; os.kill(os.getpid(), 15)", "starting", "from outside; try again"),
        ("import os; os.abort()", "starting", None),
        ("import sys; sys.exit('no reason')", "no reason", None),
    ],
)
def test_the_exception_is_quoted_and_the_remedy_follows_from_it(code, said, remedy):
    if sys.platform == "win32" and "os.kill" in code:
        pytest.skip("signals of POSIX")
    found = failure(code)
    assert found[0].startswith(said)
    assert (found[1] is None) if remedy is None else (remedy in found[1])


def test_a_full_disk_leaves_no_log():
    assert job_failure.reason("") == "it said nothing"
    assert "Free the disk" in job_failure.remedy(1, "it said nothing", "", 4096, SMALLER)


def test_an_error_of_our_own_names_its_remedy_itself():
    log = "Traceback (most recent call last):\nrough_spectra.core.errors.InputError: Do that.\n"
    assert job_failure.reason(log) == "InputError: Do that."
    assert job_failure.remedy(1, job_failure.reason(log), log, PLENTY, SMALLER) == ""


def test_a_fault_of_ours_is_to_be_reported_with_the_whole_log(make_material):
    broken = Geometry((("not an angle", 0.0),), 0.0)
    with pytest.raises(OwnFaultError) as failed:
        measure([make_material()], [broken])
    sentence = str(failed.value)
    assert "stopped with status 1 (TypeError: must be real number, not str)" in sentence
    [kept] = re.findall(r"please report it with (.*)\.$", sentence)
    try:
        assert "worker.py" in Path(kept).read_text("utf-8")
        assert not Path(kept).with_suffix("").exists()
    finally:
        Path(kept).unlink()


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_a_killed_blender_was_most_likely_short_of_memory(make_material):
    measurement = Measurement([make_material()], [RING_45_0] * 500)
    try:
        os.kill(measurement._process.pid, signal.SIGKILL)
        while not measurement.poll():
            time.sleep(0.01)
        with pytest.raises(OutputError, match="full: close other programs, or measure fewer"):
            measurement.result()
    finally:
        measurement.close()


def test_a_link_that_leads_nowhere_is_named(make_material, tmp_path):
    library = tmp_path / "library.blend"
    bpy.data.libraries.write(str(library), {make_material("Linked")}, fake_user=True)
    with bpy.data.libraries.load(str(library), link=True) as (_, wanted):
        wanted.materials = ["Linked"]
    library.unlink()
    with pytest.raises(OutputError, match=r"library\.blend with .* cannot be read.* link"):
        measure(wanted.materials)
