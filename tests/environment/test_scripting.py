# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The script of docs/scripting.md, as it stands there, with the extension installed."""

import csv
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
TERRACOTTA = ROOT / "tests" / "fixtures" / "nix" / "terracotta.csv"
DESKTOP = os.environ.get("ROUGH_SPECTRA_BLENDER", "")
SECONDS = 300

RUN = """
import os, runpy, sys
import bpy
bpy.ops.extensions.package_install_files(
    filepath=sys.argv[1], repo="user_default", enable_on_install=True
)
# The tests' own environment has the libraries too; what Blender unpacked comes first now.
sys.path.sort(key=lambda entry: "extensions" not in entry)
bpy.ops.wm.open_mainfile(filepath=os.path.abspath("scene.blend"))
runpy.run_path("spectra.py", run_name="__main__")
"""


@pytest.fixture
def folder(tmp_path, empty_file):
    """What the script's first lines ask for: a scene with some of the materials, and a file."""
    import bpy

    page = (ROOT / "docs" / "scripting.md").read_text(encoding="utf-8")
    [script] = re.findall(r'```python title="spectra.py"\n(.*?)```', page, re.DOTALL)
    (tmp_path / "spectra.py").write_text(script, encoding="utf-8")
    shutil.copy(TERRACOTTA, tmp_path)
    bpy.data.materials.new("Wall").use_fake_user = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"), copy=True)
    (tmp_path / "tmp").mkdir()
    return tmp_path


def act(folder, *commands):
    """Run commands as a user would, in that folder and with a user folder of its own."""
    said = ""
    for command in commands:
        done = subprocess.run(
            list(map(str, command)),
            cwd=folder,
            env=os.environ
            | {"BLENDER_USER_RESOURCES": str(folder / "user"), "TMPDIR": str(folder / "tmp")},
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=SECONDS,
            check=False,
        )
        said += done.stdout + done.stderr
        assert done.returncode == 0, said
    assert "Traceback" not in said, said
    return said


def check(folder, said):
    """Three materials with the σ that the script ends with, measured in Cycles, in all files."""
    document = json.loads((folder / "readings" / "scene.json").read_text(encoding="utf-8"))
    found = {entry["material"]: entry for entry in document["readings"]}
    assert {
        name: (entry["predicted"]["sigma_degrees"], entry["predicted"]["illuminant"])
        for name, entry in found.items()
    } == {"Door": (15.0, "D50"), "Pot": (35.0, "D65"), "Wall": (25.0, "D65")}
    assert found["Pot"]["sample"] == "Terracotta"
    assert all(entry["delta_e_00"] < 0.01 for entry in found.values())
    assert "stale" not in json.dumps(document)
    # The reading that the file states is what the finished material is to show at σ = 35°.
    rows = list(csv.reader(TERRACOTTA.open(encoding="utf-8"), delimiter=";"))
    [header] = [row for row in rows if "R400 nm" in row]
    first = header.index("R400 nm")
    stated = [float(cell) for cell in rows[rows.index(header) + 1][first : first + 31]]
    assert found["Pot"]["predicted"]["values"] == pytest.approx(stated, abs=1e-6)
    assert f"measured: ΔE00 at most {document['largest_delta_e_00']:.3f}" in said
    assert {path.name for path in (folder / "readings").iterdir()} > {
        "scene.measured.csv",
        "scene.predicted.cgats.txt",
    }


def test_the_script_runs_in_the_bpy_module(built, folder):
    words = ["--", "terracotta.csv", "readings/scene"]
    check(folder, act(folder, [sys.executable, "-c", RUN, built, *words]))


@pytest.mark.skipif(not DESKTOP, reason="needs ROUGH_SPECTRA_BLENDER to name a Blender")
def test_the_script_runs_in_blender_as_its_first_lines_say(built, folder):
    """The zip installed as docs/install.md says for a farm; the command is the script's own."""
    install = ["--command", "extension", "install-file", "--repo", "user_default", "--enable"]
    script = (folder / "spectra.py").read_text(encoding="utf-8")
    [command] = [line for line in script.splitlines() if line.startswith("blender -b")]
    words = shlex.split(command)[1:]
    check(folder, act(folder, [DESKTOP, *install, built], [DESKTOP, *words]))
