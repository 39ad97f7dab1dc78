# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The core as a package of its own: pip installs it, and it works and is typed without Blender."""

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tools.environment import core_package, package
from tools.environment.errors import SetupError

ROOT = Path(__file__).resolve().parents[2]

USE = """
import importlib.metadata, json, math, sys
import rough_spectra_core
from rough_spectra_core import reading, surface
found = reading.from_albedo([0.2, 0.5, 0.8], math.radians(30), model="surface", instrument="45a:0")
print(json.dumps({
    "read": found.round(3).tolist(),
    "file": rough_spectra_core.__file__,
    "blender": "bpy" in sys.modules,
    "requires": importlib.metadata.requires("rough-spectra-core"),
    "version": importlib.metadata.version("rough-spectra-core"),
}))
"""


def test_pip_installs_it_and_it_computes(tmp_path):
    wheel = core_package.build(ROOT, tmp_path)
    pip = [
        sys.executable,
        "-m",
        "pip",
        "install",
        "--quiet",
        "--no-deps",
        "--no-index",
        "--no-compile",
    ]
    target = tmp_path / "site"
    done = subprocess.run(
        [*pip, "--target", str(target), str(wheel)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    used = subprocess.run(
        [sys.executable, "-c", USE],
        cwd=tmp_path,
        env={"PYTHONPATH": str(target), "PATH": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    assert used.returncode == 0, used.stderr
    told = json.loads(used.stdout)
    assert told["read"] == [0.168, 0.447, 0.767]  # as in the manual, "Numbers alone"
    assert Path(told["file"]).is_relative_to(target)
    assert not told["blender"]
    assert told["requires"] == ["numpy>=1.26"]
    assert told["version"] == package.version(ROOT)
    assert (target / "rough_spectra_core" / "py.typed").is_file()


def test_the_wheel_holds_the_core_and_the_same_bytes_again(tmp_path):
    wheel = core_package.build(ROOT, tmp_path / "one")
    names = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    assert names == {
        f"rough_spectra_core/{path.relative_to(ROOT / 'core').as_posix()}"
        for path in (ROOT / "core").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert core_package.build(ROOT, tmp_path / "two").read_bytes() == wheel.read_bytes()


def test_the_website_comes_into_the_manifest(tmp_path):
    manifest = tmp_path / package.MANIFEST
    manifest.write_bytes((ROOT / package.MANIFEST).read_bytes())
    package._name_website(manifest, "https://example.org/rough")
    text = manifest.read_text("utf-8")
    assert re.findall(r"^website = .*$", text, re.M) == ['website = "https://example.org/rough"']
    assert package.has_website(tmp_path)
    package._name_website(manifest, "https://example.org/again")
    assert manifest.read_text("utf-8").count("website = ") == 1
    with pytest.raises(SetupError, match="is no website"):
        package._name_website(manifest, 'x"')
