# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write docs/caches.md from what `caches.py` measured, docs/data/caches.csv."""

from __future__ import annotations

import csv
import inspect
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "caches.md"
KEPT = ROOT / "docs" / "data" / "caches.csv"

NO_FUNCTIONS = {
    "addon.interface.panels.renewal._answers": "material; snapshot",
    "addon.material.derivation._known": "text of a stamp",
    "addon.blender.shader_nodes._layouts": "type of a node",
    "addon.blender.surface._numbers": "type of a node",
    "addon.preview.balls._rows": "spectrum and settings without σ, working space, side",
    "addon.preview.drawing.lines._kept": "points, width, dash, box, size",
    "addon.preview.icons._pictures": "material, figure, side; snapshot, look",
    "addon.preview.list_icons._balls": "color, σ, gloss, side",
    "addon.samples.library._contents": "folder; names, sizes, times of its files",
    "addon.samples.library._files": "path; size, time",
}
"""What dictionaries are keyed by; after a semicolon, what has to be equal besides."""

_TEXT = """\
# Caches

What Rough Spectra remembers, and what each saves. `core/numerics/memoized.py` makes every cache and
has the list of all: `memoized.listed()` gives name, hits, misses and entries, and
`memoized.clear_all()` forgets everything. Disabling the extension does that, and so does every file
of tests with what `addon` remembers. A result is keyed by all that it depends on, so that
forgetting changes time and no number.

The share is that of the named task's processor time that is saved by having the cache: the median
of pairs of runs, with all caches and without this one, and the median's standard error. Of several
tasks the table names the one in which it saves most. None stays that saves under 2 % in all of
them; a cache without a share holds what Blender shows, which is no choice.

`.venv/bpy-5.2/bin/python -m tools.checks.caches` measures and writes this page; its tasks are in
`tools/checks/caches_tasks.py`. Blender 5.2, one thread.

| cache | keyed by | at most | task | % saved |
|---|---|---|---|---|
"""


def write(caches: dict[str, Any]) -> None:
    """Write the page; `caches` are all that are listed, by name: their function, and their size."""
    with KEPT.open(encoding="utf-8", newline="") as file:
        measured = {row[0]: row[1:] for row in csv.reader(file)}
    rows = []
    for name, (function, limit) in sorted(caches.items()):
        task, share, error = measured.get(name, ("", "–", ""))
        saved = f"{share} ± {error}" if error else share
        rows.append(f"| `{name}` | {_key(name, function)} | {limit or ''} | {task} | {saved} |")
    PAGE.write_text(_TEXT + "\n".join([*rows, ""]), encoding="utf-8")


def _key(name: str, function: Any) -> str:
    if name in NO_FUNCTIONS:
        return NO_FUNCTIONS[name]
    words = (word.strip("_").replace("_", " ") for word in inspect.signature(function).parameters)
    return ", ".join(words) or "nothing"
