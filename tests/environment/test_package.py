# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip that users install: its content, Blender's own verdict, and a real installation."""

import json
import os
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

from tools.environment import package, wheels
from tools.environment.errors import SetupError

ROOT = Path(__file__).resolve().parents[2]
CXF = ROOT / "tests" / "fixtures" / "cxf" / "two.cxf"
ALLOWED = {"__init__.py", "blender_manifest.toml", "LICENSE", "README.md"}
ALLOWED_FOLDERS = {"core", "addon", "farm", "presets", "wheels"}

INSTALL = """
import importlib, json, sys, unittest.mock
import bpy
before = set(sys.modules)
bpy.ops.extensions.package_install_files(
    filepath=sys.argv[1], repo="user_default", enable_on_install=True
)
name = "bl_ext.user_default.rough_spectra"
enabled = name in bpy.context.preferences.addons
added = set(sys.modules) - before
stand_ins = [
    key for key, value in sys.modules.items() if isinstance(value, unittest.mock.MagicMock)
]
bpy.ops.preferences.addon_disable(module=name)
bpy.ops.preferences.addon_enable(module=name)
# The tests' own environment has the library too; what Blender unpacked comes first now.
sys.path.sort(key=lambda entry: "extensions" not in entry)
readers = importlib.import_module(name + ".addon.samples.readers")
samples = readers.read(sys.argv[2])
print("RESULT " + json.dumps({
    "enabled": enabled,
    "again": name in bpy.context.preferences.addons,
    "colour": [key for key in added if key.partition(".")[0] == "colour"],
    "stand_ins": stand_ins,
    "samples": [[sample.name, sample.values.tolist()] for sample in samples],
    "defusedxml": sys.modules["defusedxml"].__file__,
    "bare": sorted(key for key in added if key.partition(".")[0] in ("core", "addon")),
}))
"""


def test_zip_holds_what_ships_and_nothing_else(built):
    names = zipfile.ZipFile(built).namelist()
    assert {name for name in names if "/" not in name} == ALLOWED
    assert {name.split("/")[0] for name in names if "/" in name} == ALLOWED_FOLDERS
    assert not [name for name in names if "__pycache__" in name or "/." in name]
    assert sorted(name for name in names if name.endswith(".whl")) == [
        f"wheels/{wheels.pin(ROOT).trimmed}",
        f"wheels/{wheels.pin(ROOT, wheels.DEFUSEDXML).upstream}",
    ]


@pytest.mark.parametrize("page", ["README.md", "docs/install.md"])
def test_installing_begins_with_the_zip_and_building_it_comes_after(page):
    """Who paints has no compiler: the zip is named as it is built, and where Blender wants it."""
    text = (ROOT / page).read_text("utf-8").partition("Install")[2]
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text("utf-8"))
    zipped = f"`{manifest['id']}-{manifest['version']}.zip`"
    named, chosen = text.index(zipped), text.index("Install from Disk…")
    assert named < text.index("dev.py build")
    assert chosen < text.index("dev.py build")


def test_blender_finds_the_zip_valid(built):
    builder = package.builder(Path(sys.executable))
    verdict = subprocess.run(
        [sys.executable, str(builder), "validate", str(built)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert verdict.returncode == 0, verdict.stdout + verdict.stderr


def test_same_sources_give_the_same_bytes(built, tmp_path):
    python = Path(sys.executable)
    again = tmp_path / "again.zip"
    package.build(ROOT, python, wheels.shipped(ROOT, python), tmp_path / "stage", again)
    assert again.read_bytes() == built.read_bytes()


def test_builder_refuses_a_broken_manifest(tmp_path):
    """Proof that the verdict above can be negative."""
    for name in ALLOWED:
        (tmp_path / name).write_text("", encoding="utf-8")
    for name in ALLOWED_FOLDERS - {"wheels"}:
        (tmp_path / name).mkdir()
    python, output = Path(sys.executable), tmp_path / "out" / "x.zip"
    with pytest.raises(SetupError, match="refuses to build"):
        package.build(tmp_path, python, wheels.shipped(ROOT, python), tmp_path / "stage", output)
    assert not output.exists()


def test_missing_license_is_named(tmp_path):
    (tmp_path / "__init__.py").touch()
    (tmp_path / "blender_manifest.toml").touch()
    with pytest.raises(SetupError, match="LICENSE is missing"):
        package.stage(tmp_path, tmp_path / "stage")


def test_installs_into_a_fresh_blender_and_leaves_modules_clean(built, tmp_path):
    environ = {**os.environ, "BLENDER_USER_RESOURCES": str(tmp_path)}
    blender = subprocess.run(
        [sys.executable, "-c", INSTALL, str(built), str(CXF)],
        capture_output=True,
        text=True,
        check=False,
        env=environ,
        cwd=tmp_path,
    )
    lines = [line for line in blender.stdout.splitlines() if line.startswith("RESULT ")]
    assert lines, blender.stdout + blender.stderr
    result = json.loads(lines[0].removeprefix("RESULT "))
    assert result["enabled"], blender.stdout + blender.stderr
    assert result["again"], "disabling and enabling once more failed"
    assert result["colour"] == [], "colour-science is imported on first use, not at register"
    assert result["stand_ins"] == []
    assert result["bare"] == [], "inside the extension imports are relative"
    packages = list(tmp_path.glob("extensions/.local/lib/python3.*/site-packages/colour"))
    assert len(packages) == 1, "Blender did not unpack the wheel"
    assert not (packages[0] / "htmlcov").exists()
    assert [name for name, _ in result["samples"]] == ["Rust", "Slate"]
    assert Path(result["defusedxml"]).is_relative_to(packages[0].parent)
