# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Use the extension in a real window: one desktop Blender acts out all scenes for the tests.

ROUGH_SPECTRA_BLENDER names the executable; there has to be a screen, which may be virtual. The
built extension is installed into a new, empty user folder: nothing of yours is touched.
"""

import faulthandler
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BLENDER = os.environ.get("ROUGH_SPECTRA_BLENDER", "")
SECONDS = 1800


def pytest_collection_modifyitems(items):
    """Skip these tests where there is no Blender or no screen."""
    screen = sys.platform in {"win32", "darwin"} or any(
        os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY")
    )
    if BLENDER and screen:
        return
    skip = pytest.mark.skip(reason="needs a screen, and ROUGH_SPECTRA_BLENDER to name a Blender")
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(skip)


@pytest.fixture(scope="session")
def session(tmp_path_factory):
    """What was found in each scene, and everything that Blender printed."""
    folder = tmp_path_factory.mktemp("desktop")
    # A Blender that had to make its user folder itself may not find what it installs there.
    for name in ("tmp", "user"):
        (folder / name).mkdir()
    build = [sys.executable, str(ROOT / "dev.py"), "build"]
    subprocess.run(build, check=True, stdout=subprocess.DEVNULL)
    # One test waits for all scenes: for longer than a test may take elsewhere.
    faulthandler.cancel_dump_traceback_later()
    [package] = (ROOT / "build").glob("rough_spectra-*.zip")
    inside = Path(__file__).with_name("inside.py")
    with (folder / "console").open("wb") as console:
        done = subprocess.run(
            [
                *(BLENDER, "--gpu-backend", "opengl", "--enable-event-simulate"),
                *("--window-geometry", "0", "0", "1500", "1300"),
                *("--python-exit-code", "1", "--python", str(inside), "--"),
                *(str(package), str(folder)),
                *os.environ.get("ROUGH_SPECTRA_SCENES", "").split(),
            ],
            env=os.environ
            | {"BLENDER_USER_RESOURCES": str(folder / "user"), "TMPDIR": str(folder / "tmp")},
            stdout=console,
            stderr=subprocess.STDOUT,
            timeout=SECONDS,
            check=False,
        )
    said = (folder / "console").read_text(encoding="utf-8", errors="replace")
    results = folder / "results.json"
    if not results.exists():
        pytest.fail(f"Blender ended with status {done.returncode}:\n{said[-4000:]}")
    return {"scenes": json.loads(results.read_text()), "said": said, "status": done.returncode}


@pytest.fixture
def scene(session, request):
    """What was found in the scene that the test is named after."""
    name = request.node.name.removeprefix("test_")
    if name not in session["scenes"]:
        pytest.fail(f"Blender ended before the scene {name}:\n{session['said'][-4000:]}")
    found = session["scenes"][name]
    if "failed" in found:
        pytest.fail(found["failed"])
    return found
