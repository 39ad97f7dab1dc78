# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tools name each other and the extension as they are, and load the extension before they need it.

A tool is started too seldom for a wrong name to be noticed when a file moves.
"""

import ast
from pathlib import Path

import pytest

from tests.architecture import house

OURS = {"rough_spectra": "", "core": "core", "tools": "tools", "tests": "tests", "dev": "dev"}


def tools():
    return sorted((house.ROOT / "tools").rglob("*.py"))


def imported(tree):
    """Line, module and names of every absolute import, those inside functions included."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.lineno, node.module, [alias.name for alias in node.names]
        elif isinstance(node, ast.Import):
            for alias in node.names:
                yield node.lineno, alias.name, []


def file_of(module):
    """Path of a module of ours, or None."""
    first, *rest = module.split(".")
    path = house.ROOT.joinpath(OURS[first], *rest)
    return next((p for p in (path / "__init__.py", path.with_suffix(".py")) if p.is_file()), None)


def missing(tree):
    """What an import of ours names and does not find."""
    for line, module, names in imported(tree):
        if module.partition(".")[0] not in OURS:
            continue
        path = file_of(module)
        if path is None:
            if not any(file_of(f"{module}.{name}") for name in names):
                yield f"{line}: {module}"
            continue
        text = path.read_text(encoding="utf-8")
        for name in names:
            if file_of(f"{module}.{name}") is None and name not in text:
                yield f"{line}: {module}.{name}"


def too_early(tree):
    """Lines that take from the extension, when the module is imported, before it is loaded."""
    loaded = False
    for node in tree.body:
        loaded |= "load_extension()" in ast.unparse(node) and not isinstance(node, ast.FunctionDef)
        taken = isinstance(node, ast.ImportFrom) and (node.module or "").startswith("rough_spectra")
        if taken and not loaded:
            yield node.lineno


def bare(tree, neighbors):
    """Imports of tools by a name that a path of sys.path would have to be there for."""
    return [line for line, module, _ in imported(tree) if module in neighbors]


@pytest.mark.parametrize("path", tools(), ids=lambda path: path.stem)
def test_a_tool_finds_what_it_imports(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    neighbors = {tool.stem for tool in tools() if tool.stem != "__init__"}
    assert list(missing(tree)) == []
    assert list(too_early(tree)) == []
    assert bare(tree, neighbors) == []


@pytest.mark.parametrize(
    ("text", "check"),
    [
        ("from rough_spectra.addon import target", missing),
        ("from tools.run import nothing", missing),
        ("def f():\n    from rough_spectra.core.grid import hemisphere", missing),
        ("from rough_spectra.core import reading", too_early),
        ("import desktop", lambda tree: bare(tree, {"desktop"})),
    ],
)
def test_the_search_finds_what_it_looks_for(text, check):
    assert list(check(ast.parse(text))) != []


@pytest.mark.parametrize("path", [house.ROOT / "dev.py", *tools()], ids=lambda path: path.stem)
def test_modules_that_are_named_as_text_exist(path):
    """A module that a tool names as text, as what runs in another process is."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            name = node.value
            if name.startswith("tools.") and name.replace(".", "").replace("_", "").isalnum():
                assert file_of(name), name
            if name.startswith("tools/") and name.endswith(".py"):
                assert Path(house.ROOT, name).is_file(), name
