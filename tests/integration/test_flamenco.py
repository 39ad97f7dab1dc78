# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Submit to Flamenco: what is sent, when nothing is, and what is said where nobody takes it.

The manager is a stand-in of its documented interface, over HTTP on this machine.
"""

import socket

import bpy
import pytest
from rough_spectra.addon.material import preferences
from rough_spectra.addon.support import flamenco
from rough_spectra.core.errors import OutputError

from tests.integration.support import ROOT, rgb_material
from tools.checks import flamenco_stand_in

SCRIPT = {"rough-spectra": ROOT / "farm" / "flamenco" / "rough_spectra.js"}
OPERATOR = bpy.ops.rough_spectra.submit_to_flamenco


@pytest.fixture
def manager():
    found = flamenco_stand_in.Manager(SCRIPT)
    with flamenco_stand_in.serving(found) as address:
        found.address = address
        yield found


@pytest.fixture
def online(monkeypatch):
    """Allow online access, and give a function that names the manager in the preferences."""
    system = bpy.context.preferences.system
    before = system.use_online_access
    system.use_online_access = True
    assert bpy.app.online_access
    yield lambda address: monkeypatch.setattr(preferences, "flamenco_manager", lambda: address)
    system.use_online_access = before


@pytest.fixture
def saved(tmp_path):
    rgb_material("Wall").use_fake_user = True
    path = tmp_path / "a scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_what_the_manager_is_handed(manager, online, saved, tmp_path):
    online(manager.address.removeprefix("http://") + "/")
    assert OPERATOR.poll()
    assert manager.asked == [], "nothing is asked before somebody submits"
    out = str(tmp_path / "read ings")
    options = {"parts": 3, "max_delta_e": 0.5, "output": out}
    assert OPERATOR("EXEC_DEFAULT", **options) == {"FINISHED"}
    assert OPERATOR("EXEC_DEFAULT", what="SPECTRAL", output=out) == {"FINISHED"}
    bake, picture = manager.jobs
    assert (bake["name"], bake["type"]) == ("a scene: bake", "rough-spectra")
    assert bake["settings"] == {
        "scenes": str(saved),
        "output": out,
        "tasks": 3,
        "shards": 3,
        "words": "bake --skip-done",
        "max_delta_e": 0.5,
        "blendfile": str(saved),
    }
    assert picture["settings"]["words"] == f"spectral --output '{out}/{{name}}.exr'"
    assert (picture["settings"]["tasks"], picture["settings"]["shards"]) == (1, 1)


def test_nothing_is_sent_without_an_address_or_leave(manager, online, saved):
    online("")
    assert not OPERATOR.poll()
    online(manager.address)
    bpy.context.preferences.system.use_online_access = False
    assert not OPERATOR.poll()
    bpy.context.preferences.system.use_online_access = True
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    assert not OPERATOR.poll()
    assert manager.asked == []


def test_whoever_does_not_take_the_job_is_named(manager, online, saved):
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        address = f"http://127.0.0.1:{closed.getsockname()[1]}"
    with pytest.raises(OutputError, match=r"No Flamenco manager answers at .*preferences\.$"):
        flamenco.submit(address, "x", {})
    with pytest.raises(OutputError, match=r"unknown settings \['more'\]; mend"):
        flamenco.submit(manager.address, "x", {"more": 1})
    manager.scripts = {}
    with pytest.raises(OutputError, match=r"does not know the job type .* restart it\.$"):
        flamenco.submit(manager.address, "x", {})
    for told, said in (({"name": "Printer"}, "is no Flamenco manager"), ([], "answers as no Flam")):
        manager.answer = lambda *_, told=told: (200, told)
        with pytest.raises(OutputError, match=said):
            flamenco.submit(manager.address, "x", {})
    for address in ("", "ftp://farm", "http://", "http://farm:port"):
        with pytest.raises(OutputError, match="write one such as http://farm:8080"):
            flamenco.submit(address, "x", {})
    online("http://127.0.0.1:1")
    with pytest.raises(RuntimeError, match="No Flamenco manager answers"):
        OPERATOR("EXEC_DEFAULT")
