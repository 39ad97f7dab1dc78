# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make tables, numbers and figures of docs/experiment.md, as the verb `experiment` does.

    .venv/bpy-5.2/bin/python -m tools.manual.experiment [--again]

It measures rough meshes in Cycles and holds them against the models; takes ten minutes on two
cores. With `--again` what was measured before is taken from docs/data/experiment-measured.csv.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from tools.run.run_command_line import ROOT, load_extension

if "rough_spectra" not in sys.modules:
    load_extension()

from rough_spectra.addon.commands.progress import ProgressLine
from rough_spectra.addon.laboratory.trial import colored, meshes, page, results
from rough_spectra.addon.support import atomic_files, png

DOCS = ROOT / "docs"
DATA = DOCS / "data"
MEASURED = DATA / "experiment-measured.csv"
READS = DATA / "experiment.csv"
SIGMA = DATA / "experiment-sigma.csv"
MADE_BY = "<!-- Made by tools/manual/experiment.py -->\n\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, judge, write; exit status 0."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--again", action="store_true", help="do not measure anew")
    options = parser.parse_args(arguments)
    progress = ProgressLine("measuring")
    try:
        grays = meshes.from_csv(MEASURED) if options.again else meshes.measure(progress=progress)
    finally:
        progress.close()
    progress = ProgressLine("judging")
    try:
        found = colored.found(grays, progress=progress)
    finally:
        progress.close()
    with atomic_files.publication() as files:
        files.write(MEASURED, meshes.to_csv(grays))
        files.write(READS, results.reads_csv(found.reads))
        files.write(SIGMA, results.inferred_csv(found.inferred))
        for name, table in page.parts(found).items():
            files.write(DOCS / f"experiment-{name}.md", (MADE_BY + table).encode())
        for name, draw in page.pictures(found).items():
            files.write(DOCS / "images" / f"experiment-{name}.png", png.encode(draw()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
