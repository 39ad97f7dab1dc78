# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the manual's computed figures are those that the code draws now.

    .venv/tools/bin/python -m tools.checks.check_figures

Clones what is committed, draws its figures there, and names each file that then differs: it was
made by older code. Pictures of windows and renders, and what takes minutes to measure, are not
made. Takes two minutes. Exit status 1 if a file differs.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from tools.run.run_command_line import ROOT

MAKERS = (
    "figures",
    "bands_figures",
    "emissivity_figures",
    "estimate_figures",
    "instruments_table",
    "report_2007_figures",
    "stability_figures",
)
"""In tools/manual: equal numbers give equal bytes."""


def main() -> int:
    """Draw all figures in a clone, and print what differs."""
    with tempfile.TemporaryDirectory() as folder:
        clone = Path(folder) / "clone"
        subprocess.run(["git", "clone", "--quiet", str(ROOT), str(clone)], check=True)
        for name in (".venv", "wheels"):  # environments, which are not committed
            if (ROOT / name).exists():
                (clone / name).symlink_to(ROOT / name)
        for maker in MAKERS:
            print(f"{maker} …", flush=True)
            command = [sys.executable, "-m", f"tools.manual.{maker}"]
            subprocess.run(command, cwd=clone, check=True, stdout=subprocess.DEVNULL)
        status = subprocess.run(
            ["git", "status", "--porcelain", "docs"],
            cwd=clone,
            check=True,
            capture_output=True,
            text=True,
        ).stdout
    print((status and f"not what the code draws now:\n{status}") or "all figures are current")
    return 1 if status else 0


if __name__ == "__main__":
    sys.exit(main())
