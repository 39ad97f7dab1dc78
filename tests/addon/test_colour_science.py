# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What using colour-science leaves behind in Blender's Python: nothing."""

import subprocess
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]

SCRIPT = """
import sys, warnings
sys.path.insert(0, {tests!r})
import conftest
import bpy
import numpy as np
from unittest import mock

def outsiders():
    return sorted(name for name in sys.modules if name.split(".")[0] in (
        "colour", "scipy", "matplotlib", "pandas", "networkx", "trimesh", "sklearn", "xxhash",
        "tqdm", "pydot", "pygraphviz", "OpenImageIO", "ctlrender"))

before = outsiders()
import rough_spectra
rough_spectra.register()
assert outsiders() == before == [], (before, outsiders())

# The first preset of a session needs its own reader and no other format's.
from rough_spectra.addon.samples import presets
assert presets.load("14").name
formats = [name for name in sys.modules if name.startswith("rough_spectra.addon.samples.readers.")]
own = {{"formats", "formats.preset", "parts", "parts.document", "parts.preset_fields"}}
own |= {{"parts.joining", "parts.name_marks", "parts.geometry_words"}}  # what readers share
own |= {{"parts.json_object", "parts.unsaid"}}
assert {{name.partition(".readers.")[2] for name in formats}} <= own, formats

np.set_printoptions(precision=3, suppress=True)
options, filters, errors = np.get_printoptions(), list(warnings.filters), np.geterr()
show, hook = warnings.showwarning, sys.excepthook
from rough_spectra.addon.colorimetry import tristimulus as colorimetry
assert outsiders() == [], outsiders()
lab = colorimetry.spectrum_to_lab([0.2, 0.4, 0.6, 0.5], [400, 500, 600, 700], "F11", 10)
# Our own tables are enough, of any grid and light: importing it, the window would stand still.
colorimetry.weights(range(400, 701, 20))
from rough_spectra.addon.colorimetry import illuminant_spectra
illuminant_spectra.like([0.9, 1.0, 0.8])
assert outsiders() == [], outsiders()
from rough_spectra.addon.support import colour_science
colour_science.colour()
assert "colour" in sys.modules
fakes = [name for name, module in sys.modules.items() if isinstance(module, mock.MagicMock)]
assert fakes == [], fakes
assert np.get_printoptions() == options, (options, np.get_printoptions())
assert warnings.filters == filters, (filters, warnings.filters)
assert np.geterr() == errors
assert (warnings.showwarning, sys.excepthook) == (show, hook)
for name in ("scipy", "matplotlib.pyplot"):
    try:
        __import__(name)
    except ImportError:
        pass
    else:
        raise AssertionError(name)

rough_spectra.unregister()
bpy.ops.wm.read_factory_settings(use_empty=True)
print("clean", lab.shape)
"""


def test_import_and_use_leave_no_trace():
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT.format(tests=str(TESTS))],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert "clean (3,)" in done.stdout, done.stderr
    # Nothing on the console for the user: neither missing packages nor aligned tables.
    told = [line for line in done.stderr.splitlines() if "colour" in line or "Warning" in line]
    assert told == []
