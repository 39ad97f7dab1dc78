# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever is remembered is on one list, told of in the manual, and gone when asked to go."""

import ast
import importlib

import pytest

from tests.architecture import house

PAGE = house.ROOT / "docs" / "caches.md"
MEMOIZED = "core/numerics/memoized.py"
NO_CACHES = {
    # What Blender reads later, so that somebody has to hold it.
    ("addon/interface/operators/build_assets.py", "_items"),
    ("addon/interface/operators/export_materials.py", "_items"),
    ("addon/interface/operators/choose_sample.py", "_items"),
    ("addon/interface/operators/choose_sample.py", "_before"),
    ("addon/interface/operators/assign_preset.py", "_items"),
    ("addon/interface/operators/assign_file.py", "_items"),
    ("addon/commands/command_line.py", "_handles"),
    # What is under way.
    ("addon/interface/operators/ahead.py", "_left"),
    ("addon/interface/operators/ahead.py", "_waiting"),
    ("addon/interface/operators/import_review.py", "_batch"),
    ("addon/interface/panels/redraw.py", "_last"),
    ("addon/interface/panels/renewal.py", "_asked"),
    ("addon/preview/balls.py", "_pending"),
    ("addon/material/changes.py", "_pauses"),
    ("addon/preview/icons.py", "_pending"),
    # What was rendered last, which is dear to make again.
    ("addon/picture/of_file.py", "_kept"),
    # What is registered.
    ("addon/interface/panels/menus.py", "_groups"),
    ("addon/interface/shelf.py", "_asked"),
    # On the list, in the order of use.
    ("addon/material/derivation.py", "_known"),
    ("addon/material/together.py", "_counted"),
    # On the list as one, because Blender holds the pictures.
    ("addon/preview/icons.py", "_pictures"),
    ("addon/preview/list_icons.py", "_balls"),
    ("addon/preview/balls.py", "_rows"),
    ("addon/preview/icons.py", "_differences"),
    ("core/numerics/memoized.py", "_caches"),
}
"""Variables of modules that begin empty and are filled later."""


def trees():
    for path in house.files(house.ROOT).values():
        yield path, ast.parse((house.ROOT / path).read_text("utf-8"))


def by_functools(tree):
    """Uses of `functools.lru_cache` and `functools.cache`, under whatever name."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module == "functools":
            yield from (name.name for name in node.names if name.name in {"lru_cache", "cache"})
        elif isinstance(node, ast.Attribute) and node.attr in {"lru_cache", "cache"}:
            yield node.attr


def begins_empty(tree):
    """Names that a module binds to a container without anything in it."""
    for node in tree.body:
        if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
            continue
        value = node.value
        bare = isinstance(value, ast.Call) and not value.args and not value.keywords
        called = bare and ast.unparse(value.func).split(".")[-1]
        if (
            called in {"dict", "list", "set", "OrderedDict", "defaultdict"}
            or (isinstance(value, ast.List) and not value.elts)
            or (isinstance(value, ast.Dict) and not value.keys)
        ):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            yield from (ast.unparse(target) for target in targets)


def test_there_is_one_way_to_remember():
    used = {path for path, tree in trees() for _ in by_functools(tree)}
    assert used == {MEMOIZED}


@pytest.mark.parametrize(
    "text",
    [
        "from functools import lru_cache",
        "from functools import cache as kept",
        "import functools\n@functools.lru_cache(maxsize=3)\ndef f(): pass",
    ],
)
def test_another_way_is_found(text):
    assert list(by_functools(ast.parse(text)))


def test_no_dictionary_of_a_module_remembers_on_the_quiet():
    found = {(path, name) for path, tree in trees() for name in begins_empty(tree)}
    assert found == NO_CACHES


@pytest.fixture(scope="module")
def memoized(extension):
    """The list, with all modules loaded and something in many caches."""
    import bpy

    for name in house.files(house.ROOT):
        if not name.endswith("instrument.worker"):
            importlib.import_module(f"rough_spectra.{name}")
    material = bpy.data.materials.new("Remembered")
    from rough_spectra.addon.matching.request import Request
    from rough_spectra.addon.material import derive, state
    from rough_spectra.addon.samples import library, presets

    derive.assign([(material, Request(presets.load("green"), 0.5))])
    assert state.state(material).kind == "fresh"
    library.contents(house.ROOT / "nowhere")
    bpy.data.materials.remove(material)
    return importlib.import_module("rough_spectra.core.numerics.memoized")


def test_all_are_cleared_at_once(memoized):
    filled = [cache for cache in memoized.listed() if cache.entries]
    assert {cache.name.split(".")[1] for cache in filled} >= {"colorimetry", "material", "samples"}
    memoized.clear_all()
    assert not [cache for cache in memoized.listed() if cache.entries]


def test_some_are_cleared_by_the_beginning_of_their_name(memoized):
    from rough_spectra.addon.support import version
    from rough_spectra.core.instruments import curves

    version.version()
    curves._published_factors("45a:0")
    memoized.clear_all("addon.")
    filled = {cache.name for cache in memoized.listed() if cache.entries}
    assert "core.instruments.curves._published_factors" in filled
    assert not [name for name in filled if name.startswith("addon.")]


def test_disabling_the_extension_forgets_everything(memoized, extension):
    from rough_spectra.addon.support import version

    version.version()
    extension.unregister()
    try:
        assert not [cache for cache in memoized.listed() if cache.entries]
    finally:
        extension.register()


def test_the_manual_tells_of_each(memoized):
    rows = [line for line in PAGE.read_text("utf-8").splitlines() if line.startswith("| `")]
    told = {row.split("`")[1] for row in rows}
    assert told == {c.name for c in memoized.listed() if c.name.startswith(("core.", "addon."))}


def test_none_that_saves_under_two_percent_stays():
    for row in PAGE.read_text("utf-8").splitlines():
        if row.startswith("| `"):
            share = row.split("|")[-2].split("±")[0].strip(" %")
            assert share == "–" or float(share) >= 2, row
