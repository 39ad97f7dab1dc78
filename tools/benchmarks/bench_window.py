# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure what drawing the panel and dragging σ cost in a real window.

    python -m tools.benchmarks.bench_window --blender BLENDER --zip build/rough_spectra-….zip

BLENDER is the executable of a desktop Blender; a screen (or a virtual one) has to be there. The
file has 500 materials with a spectrum, and all panels of the Material tab are open. Of drawing,
Blender's own layout code is included.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from tools.run import desktop

INSIDE = "tools.benchmarks.bench_window_inside"
SIZE = (1200, 1500)


def main(arguments: Sequence[str]) -> int:
    """Start Blender and let `bench_window_inside` do the rest."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--blender", required=True, help="executable of a desktop Blender")
    parser.add_argument("--zip", type=Path, required=True, help="the built extension")
    options = parser.parse_args(arguments)
    return desktop.run(options.blender, INSIDE, SIZE, [options.zip.resolve()])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
