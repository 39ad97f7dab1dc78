# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Take the manual's pictures of the real window, so that they stay true.

    python3 dev.py screenshots --blender BLENDER [--scale 1|2] [--theme dark|light] [NAME ...]

BLENDER is the executable of a desktop Blender; a screen (or a virtual one) has to be there, as
large as the window: 1600 × 1700 pixels, times the scale. The extension's zip is installed into a
new, empty user folder: nothing of yours is touched.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from tools.run import desktop
from tools.run.run_command_line import ROOT

INSIDE = "tools.manual.screenshots_inside"


def main(arguments: Sequence[str]) -> int:
    """Start Blender and let `screenshots_inside` do the rest."""
    parser = argparse.ArgumentParser(prog="dev.py screenshots", description=__doc__.splitlines()[0])
    parser.add_argument("--blender", required=True, help="executable of a desktop Blender")
    parser.add_argument("--zip", type=Path, required=True, help="the built extension")
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "images" / "window")
    parser.add_argument("--scale", type=float, default=1.0, help="UI scale")
    parser.add_argument("--width", type=int, default=440, help="of the panel, pixels at scale 1")
    parser.add_argument("--theme", choices=("dark", "light"), default="dark")
    parser.add_argument("--size", default="1600x1700", help="of the window, pixels at scale 1")
    parser.add_argument(
        "--grab",
        default="",
        metavar="COMMAND",
        help="saves the screen to the file named last; for screens that Blender cannot read",
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="pictures; all without")
    options = parser.parse_args(arguments)
    options.output.mkdir(parents=True, exist_ok=True)
    # Everything grows with the scale, and dialogs have to fit beside the panel.
    width, height = (round(int(side) * options.scale) for side in options.size.split("x"))
    words = (
        *(options.zip.resolve(), options.output.resolve()),
        *(options.scale, options.width, options.theme, options.grab, *options.names),
    )
    return desktop.run(options.blender, INSIDE, (width, height), words)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
