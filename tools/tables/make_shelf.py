# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the shelf: the asset library of all presets that comes with the extension.

    .venv/bpy-4.5/bin/python -m tools.tables.make_shelf [FOLDER]

By the bpy module of the oldest Blender that is supported, for every newer one reads what it wrote.
To be made anew when presets change, or what is derived from them; a test says when.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from tools.run.run_command_line import ROOT, load_extension

FOLDER = ROOT / "presets" / "shelf"


GROUPS = {
    "Bricks and Stone": (
        *("basalt", "brick", "chalk", "cinder-block", "clay", "concrete", "limestone", "paving"),
        *("plaster", "terracotta", "tuff"),
    ),
    "Cloth and Carpet": ("burlap", "carpet", "cloth", "fleece", "nylon", "tarp-", "webbing"),
    "Earth and Plants": ("grass", "mud", "pine-needles", "reed", "sage", "sand", "soil"),
    "Kitchen": ("chocolate", "egg-shell", "lemon", "orange", "toothpaste"),
    "Paper": ("cardboard", "paper", "printed", "toilet-paper", "tyvek"),
    "Pigments": ("pigment",),
    "Roofs and Roads": ("asphalt", "roofing", "shingle", "siding", "tar-paper"),
    "Things": ("blackboard", "musou-black", "polystyrene", "rust", "tire"),
    "Wood and Boards": ("cedar", "particle", "pine", "plywood", "strand", "willow"),
}
"""Catalogs of the everyday presets, by how their ids begin; the longest beginning counts."""


def group(slug: str) -> str:
    """Return the catalog of an everyday preset.

    Raises
    ------
    KeyError
        None is for it: add the beginning of its id to `GROUPS`.
    """
    found = {start: title for title, starts in GROUPS.items() for start in starts}
    fitting = [start for start in found if slug.startswith(start)]
    if not fitting:
        raise KeyError(f"{slug} belongs to no group of the shelf")
    return found[max(fitting, key=len)]


def main(arguments: list[str]) -> int:
    """Make it and say where."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("folder", type=Path, nargs="?", default=FOLDER)
    folder = parser.parse_args(arguments).folder
    extension = load_extension()
    extension.register()
    try:
        return make(folder)
    finally:
        extension.unregister()  # the bpy module of 4.5 crashes at exit over what is left registered


def make(folder: Path) -> int:
    """Make it in a folder; exit status 0."""
    from rough_spectra.addon.assets import build, plan
    from rough_spectra.addon.samples import presets

    chosen = plan.of_collection("colorchecker")
    for name in presets.names_of("everyday"):
        chosen.append(plan.Chosen(presets.load(name), group(name.partition("/")[2])))
    built = build.build(plan.assets(chosen, [], 63), folder)
    for name, sentences in built.warnings.items():
        for sentence in sentences:
            print(f"{name}: {sentence}")
    print(f"{built.count} materials, {built.blend.stat().st_size / 1e6:.1f} MB in {built.blend}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
