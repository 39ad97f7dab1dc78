# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The house as it stands: which file imports what, and which wing a file belongs to."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

ROWS = (
    ("core",),
    ("addon/support",),
    ("addon/colorimetry", "addon/readings"),
    ("addon/samples",),
    ("addon/matching",),
    ("addon/blender",),
    ("addon/material",),
    ("addon/scene", "addon/instrument", "addon/preview"),
    ("addon/laboratory", "addon/textures", "addon/export", "addon/picture"),
    ("addon/assets", "addon/api"),
    ("addon/commands",),
    ("addon/interface",),
)
"""Wings from the ground up; those in one row don't import each other."""

BLENDERS_OWN = ("bpy", "bpy_extras", "bl_ui", "blf", "bmesh", "gpu", "gpu_extras", "mathutils")
"""What only Blender has."""

FREE_OF_BLENDER = (
    *(wing for row in ROWS[: ROWS.index(("addon/blender",))] for wing in row),
    "addon/preview/drawing",
    "addon/preview/figures",
)
"""Where Blender is not known."""


@dataclass(frozen=True)
class Import:
    """A name that a file takes from another, or from a module that is not ours.

    Parameters
    ----------
    importer
        Path from the root.
    line
        In the importer.
    source
        Path of ours, or the name of a module.
    name
        What is taken, or an empty string where it is the module itself.
    """

    importer: str
    line: int
    source: str
    name: str

    def __str__(self) -> str:
        taken = f" ({self.name})" if self.name else ""
        return f"{self.importer}:{self.line} imports {self.source}{taken}"


def wing_of(path: str) -> tuple[int, str] | None:
    """Row and name of the wing that a file belongs to; None outside of all."""
    for row, wings in enumerate(ROWS):
        for wing in wings:
            if path == wing or path.startswith(f"{wing}/"):
                return row, wing
    return None


def files(root: Path) -> dict[str, str]:
    """Every module of core and addon by its dotted name, and its path from the root."""
    found = {}
    for top in ("core", "addon"):
        for path in sorted((root / top).rglob("*.py")):
            parts = path.relative_to(root).with_suffix("").parts
            name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
            found[name] = path.relative_to(root).as_posix()
    return found


def imports(root: Path) -> list[Import]:
    """Every import, those inside functions and for types alone included."""
    modules = files(root)
    found: list[Import] = []
    for module, path in modules.items():
        tree = _parsed((root / path).read_text(encoding="utf-8"))
        package = module if path.endswith("__init__.py") else module.rpartition(".")[0]
        aliases: dict[str, str] = {}
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom):
                base = _base(node, package)
                for alias in node.names:
                    whole = f"{base}.{alias.name}"
                    if whole in modules:
                        aliases[alias.asname or alias.name] = modules[whole]
                        found.append(Import(path, node.lineno, modules[whole], ""))
                    else:
                        found.append(Import(path, node.lineno, modules.get(base, base), alias.name))
            elif isinstance(node, ast.Import):
                found += [Import(path, node.lineno, alias.name, "") for alias in node.names]
        for node in ast.walk(tree):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                source = aliases.get(node.value.id)
                if source is not None:
                    found.append(Import(path, node.lineno, source, node.attr))
    return found


@lru_cache(maxsize=1024)
def _parsed(text: str) -> ast.Module:
    """Parse once what a broken copy and the house have in common."""
    return ast.parse(text)


def _base(node: ast.ImportFrom, package: str) -> str:
    if not node.level:
        return node.module or ""
    parts = package.split(".")
    kept = parts[: len(parts) - node.level + 1]
    return ".".join([*kept, *([node.module] if node.module else [])])


def upward(root: Path) -> list[str]:
    """Imports from a wing further up, from another one of the same row, or from outside of all."""
    faults = []
    for found in imports(root):
        if not found.source.startswith(("core/", "addon/")):
            continue
        from_wing, to_wing = wing_of(found.importer), wing_of(found.source)
        if "addon/__init__.py" in (found.importer, found.source):
            continue
        if from_wing is None or to_wing is None:
            faults.append(f"{found}: one of them is in no wing")
        elif to_wing[0] > from_wing[0] or (to_wing[0] == from_wing[0] and to_wing != from_wing):
            faults.append(str(found))
    return faults


def private(root: Path) -> list[str]:
    """Names beginning with an underscore that are taken from another wing."""
    return [
        str(found)
        for found in imports(root)
        if found.name.startswith("_")
        and not found.name.startswith("__")
        and found.source.startswith(("core/", "addon/"))
        and wing_of(found.importer) != wing_of(found.source)
    ]


def blender_below_the_wall(root: Path) -> list[str]:
    """Imports of Blender where Blender is not known."""
    return [
        str(found)
        for found in imports(root)
        if found.source.partition(".")[0] in BLENDERS_OWN and free_of_blender(found.importer)
        if found.importer != "addon/support/openimageio.py"
    ]


def free_of_blender(path: str) -> bool:
    """Whether a file lies where Blender is not known."""
    return path.startswith(tuple(f"{wing}/" for wing in FREE_OF_BLENDER))


def circles(root: Path) -> list[list[str]]:
    """Files that import each other in a circle, each as a list."""
    graph: dict[str, set[str]] = {path: set() for path in files(root).values()}
    for found in imports(root):
        if found.source in graph and found.source != found.importer:
            graph[found.importer].add(found.source)
    return [sorted(part) for part in _strong_components(graph) if len(part) > 1]


def _strong_components(graph: dict[str, set[str]]) -> Iterator[Sequence[str]]:
    """Tarjan, "Depth-first search and linear graph algorithms" (1972), without recursion."""
    order: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    for start in graph:
        if start in order:
            continue
        work = [(start, iter(sorted(graph[start])))]
        order[start] = low[start] = len(order)
        stack.append(start)
        while work:
            node, rest = work[-1]
            for neighbor in rest:
                if neighbor not in order:
                    order[neighbor] = low[neighbor] = len(order)
                    stack.append(neighbor)
                    work.append((neighbor, iter(sorted(graph[neighbor]))))
                    break
                if neighbor in stack:
                    low[node] = min(low[node], order[neighbor])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == order[node]:
                    part = stack[stack.index(node) :]
                    del stack[stack.index(node) :]
                    yield part
