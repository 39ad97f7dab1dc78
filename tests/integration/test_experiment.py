# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The verb `experiment` on tables of readings, good and bad, and interrupted."""

import math
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from core import reading
from tests.integration.support import COMMAND, SECONDS, contents

NM = np.arange(400, 701, 20)
COLORS = {
    "green": 0.08 + 0.3 * np.exp(-(((NM - 540) / 50) ** 2)),
    "gray": np.full(NM.size, 0.35),
}


@pytest.fixture
def measured(tmp_path):
    """Two materials, smooth and at two roughnesses, read with noise of 0.1 %."""
    noise = np.random.default_rng(2007)
    columns = {}
    for name, albedo in COLORS.items():
        columns[f"{name} smooth"] = albedo
        for degrees in (20, 40):
            columns[f"{name} {degrees}"] = reading.from_albedo(
                albedo, math.radians(degrees), "surface"
            )
    rows = [["nm", *columns]]
    noisy = [v * (1 + 0.001 * noise.standard_normal(v.size)) for v in columns.values()]
    rows += zip(NM, *(values.round(6) for values in noisy), strict=True)
    path = tmp_path / "readings.csv"
    path.write_text("".join(",".join(map(str, row)) + "\n" for row in rows), encoding="utf-8")
    return path


def table(folder, *rows):
    path = folder / "which.csv"
    header = "sample,surface,material,file,sigma_deg,rdq"
    path.write_text("\n".join((header, *rows)) + "\n", encoding="utf-8")
    return path


GOOD = (
    *(f"{name} smooth,smooth,{name},readings.csv,," for name in COLORS),
    "green 20,fine,green,readings.csv,,0.364",
    "gray 20,fine,gray,readings.csv,,",
    *(f"{name} 40,coarse,{name},readings.csv,," for name in COLORS),
)


def test_readings_become_a_page(main, measured, tmp_path):
    path = table(measured.parent, *GOOD)
    base = tmp_path / "out" / "page"
    result = main("experiment", "--mapping", path, "--output", base)
    assert result.status == 0
    assert "2 surfaces, 4 readings; wrote page.md" in result.err
    text = base.with_suffix(".md").read_text("utf-8")
    pictures = {name for name in contents(base.parent) if name.endswith(".png")}
    assert pictures == {f"page.{name}.png" for name in ("albedo", "known", "own", "sigma")}
    assert all(f"(<{name}>)" in text for name in pictures)
    rows = {
        line.split("|")[1].strip(): line.split("|")
        for line in text[text.index("## σ inferred") :].splitlines()
        if line.startswith("| ")
    }
    assert rows["fine"][2].strip() == "20.0°"
    assert rows["coarse"][2].strip() == "–"
    for name, degrees in (("fine", 20), ("coarse", 40)):
        assert float(rows[name][3].split("°")[0]) == pytest.approx(degrees, abs=0.3)


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (("green 20,fine,g,readings.csv,,abc",), "row 1: rdq is 'abc'; give a number"),
        (("green 20,fine,g,readings.csv,95,",), "row 1: σ is 95°; give 0 to 60"),
        (("green 20,fine,g,readings.csv,-3,",), "row 1: σ is -3°; give 0 to 60"),
        (("green 20,fine,g,readings.csv,nan,",), "row 1: σ is nan°; give 0 to 60"),
        (("green 20,fine,g,readings.csv,20,0.9",), "row 1: sigma_deg and rdq contradict"),
        (("green smooth,smooth,g,readings.csv,3,",), "row 1: a smooth surface has σ = 0"),
        (("green smooth,smooth,g,readings.csv,,",), "has no row of a rough surface"),
        (("grass,fine,g,readings.csv,,",), "row 1: "),
        (("14 green,fine,g,,,",), "row 1: 'ColorChecker 14 Green' is of the kind 'albedo'"),
        (
            ("green 20,fine,g,readings.csv,20,", "gray 20,fine,h,readings.csv,22,"),
            "row 2: σ of 'fine' is 22° here and 20° above",
        ),
    ],
)
def test_a_bad_table_is_one_sentence_with_its_row(main, measured, tmp_path, rows, words):
    path = table(measured.parent, *rows)
    before = contents(tmp_path)
    result = main("experiment", "--mapping", path, "--output", tmp_path / "page")
    assert result.status == 2
    assert "which.csv" in result.sentence
    assert words in result.sentence
    assert contents(tmp_path) == before


def test_meshes_and_readings_are_not_asked_for_at_once(main, measured, tmp_path):
    path = table(measured.parent, *GOOD)
    words = ("--mapping", path, "--kind", "gaussian", "--sigma", 30, "--output", tmp_path / "page")
    result = main("experiment", *words)
    assert result.status == 2
    assert "leave --kind and --sigma out" in result.sentence
    result = main("experiment", "--kind", "gaussian", "--output", tmp_path / "page")
    assert result.status == 2
    assert "--kind and --sigma together" in result.sentence


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_an_interrupt_leaves_nothing(environment, tmp_path):
    target = tmp_path / "out"
    target.mkdir()
    words = [*COMMAND, "experiment", "--kind", "gaussian", "--sigma", "30", "--rays", "4096"]
    with subprocess.Popen(
        [*words, "--output", str(target / "page")],
        env=environment,
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
        # Tests that run in the background of a shell inherit SIGINT ignored.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as process:
        assert process.stderr is not None
        assert process.stderr.readline().startswith("measuring: ")
        time.sleep(1)
        os.kill(process.pid, signal.SIGINT)
        _, err = process.communicate(timeout=SECONDS)
    assert process.returncode == 130
    assert err.strip().endswith("nothing was written.")
    assert list(target.iterdir()) == []
