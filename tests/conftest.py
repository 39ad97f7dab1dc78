# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Let tests import `core` from the repository's root and the extension as `rough_spectra`."""

import atexit
import importlib.util
import os
import shutil
import sys
import tempfile
from pathlib import Path

import hypothesis
import pytest

ROOT = Path(__file__).resolve().parents[1]

# OpenBLAS splits even small matrices among all cores, and its threads wait for each other by
# spinning: where another process has a core, as the other Blender's tests have, eigenvalues of
# 80 × 80 took twenty times as long. Asked for before numpy starts; child processes inherit it.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

STATUS = pytest.StashKey[int]()

sys.path.insert(0, str(ROOT))
# An example that takes long is no fault: it depends on the machine, and on what else runs there.
hypothesis.settings.register_profile("untimed", deadline=None)
hypothesis.settings.load_profile("untimed")

if "BLENDER_USER_RESOURCES" not in os.environ:
    # Started without dev.py. Tests reset Blender's settings, and that would delete the wheels of
    # the extensions in your own Blender.
    os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp(prefix="blender-user-")
    atexit.register(shutil.rmtree, os.environ["BLENDER_USER_RESOURCES"], ignore_errors=True)
if "rough_spectra" not in sys.modules:
    spec = importlib.util.spec_from_file_location(
        "rough_spectra", ROOT / "__init__.py", submodule_search_locations=[str(ROOT)]
    )
    assert spec is not None
    assert spec.loader is not None
    package = importlib.util.module_from_spec(spec)
    sys.modules["rough_spectra"] = package
    spec.loader.exec_module(package)


@pytest.hookimpl(tryfirst=True)
def pytest_sessionfinish(session, exitstatus):
    """Keep how the run went, for the last act."""
    session.config.stash[STATUS] = int(exitstatus)


@pytest.hookimpl(trylast=True)
def pytest_unconfigure(config):
    """End at once when all is told and tidied up.

    After all of that a Blender 4.5 whose tests had passed hung for an hour, among the destructors
    of its libraries. What ends a Blender that works, `tests/integration/test_exit_status.py` sees.
    """
    if "bpy" in sys.modules and STATUS in config.stash:
        atexit._run_exitfuncs()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(config.stash[STATUS])


@pytest.fixture(scope="module", autouse=True)
def nothing_remembered():
    """Forget what earlier files' tests left in the extension's caches: none depends on another's.

    What `core` remembers stays: it knows neither Blender nor files but those it ships, and its
    tables of instruments take seconds.
    """
    memoized = sys.modules.get("rough_spectra.core.numerics.memoized")
    if memoized is not None:
        memoized.clear_all("addon.")


@pytest.fixture(scope="session")
def extension():
    """Register the extension once for all folders of tests that need Blender.

    Unregistering frees what Blender would trip over when it ends.
    """
    import bpy

    extension = sys.modules["rough_spectra"]
    extension.register()
    yield extension
    bpy.ops.wm.read_factory_settings(use_empty=True)
    extension.unregister()


@pytest.fixture
def empty_file(extension):
    """Open an empty file with the factory's settings.

    Preferences stay, which no test leaves changed: with them Blender registers all its own add-ons
    anew, and takes five times as long.
    """
    import bpy

    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
