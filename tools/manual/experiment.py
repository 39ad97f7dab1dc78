# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make tables, numbers and figures of docs/experiment.md, as the verb `experiment` does.

    .venv/bpy-5.2/bin/python -m tools.manual.experiment [--from judge | --from draw]

It measures rough meshes in Cycles, holds them against the models, and draws; takes ten minutes on
two cores. Each step begins from the files in docs/data that the one before has left, so that it
can be taken again alone.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.commands.progress import ProgressLine
from rough_spectra.addon.laboratory.trial import colored, figures, meshes, page, results
from rough_spectra.addon.support import atomic_files, png

DOCS = ROOT / "docs"
DATA = DOCS / "data"
MEASURED = DATA / "experiment-measured.csv"
READS = DATA / "experiment.csv"
SIGMA = DATA / "experiment-sigma.csv"
MADE_BY = "<!-- Made by tools/manual/experiment.py -->\n\n"


STEPS = ("measure", "judge", "draw")


def main(arguments: Sequence[str] | None = None) -> int:
    """Take the steps; exit status 0."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--from", dest="first", choices=STEPS, default=STEPS[0])
    options = parser.parse_args(arguments)
    for step in STEPS[STEPS.index(options.first) :]:
        {"measure": measure, "judge": judge, "draw": draw}[step]()
    return 0


def measure() -> None:
    """Measure all meshes."""
    progress = ProgressLine("measuring")
    try:
        grays = meshes.measure(progress=progress)
    finally:
        progress.close()
    with atomic_files.publication() as files:
        files.write(MEASURED, meshes.to_csv(grays))


def judge() -> None:
    """Hold what was measured against the models."""
    progress = ProgressLine("judging")
    try:
        found = colored.found(meshes.from_csv(MEASURED), progress=progress)
    finally:
        progress.close()
    with atomic_files.publication() as files:
        files.write(READS, results.reads_csv(found.reads))
        files.write(SIGMA, results.inferred_csv(found.inferred))


def stored() -> page.Found:
    """Give what the files in docs/data say."""
    grays = meshes.from_csv(MEASURED)
    panels = figures.panels_of_grays(grays)
    reads, inferred = results.reads_from_csv(READS), results.inferred_from_csv(SIGMA)
    return page.Found(reads, inferred, panels, grays, ())


def draw() -> None:
    """Write tables and figures."""
    found = stored()
    with atomic_files.publication() as files:
        for name, table in page.parts(found).items():
            files.write(DOCS / f"experiment-{name}.md", (MADE_BY + table).encode())
        for name, picture in page.pictures(found).items():
            files.write(DOCS / "images" / f"experiment-{name}.png", png.encode(picture()))


if __name__ == "__main__":
    sys.exit(main())
