# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What docs/development.md promises who adds a model or an instrument: one place, and all follows.

One of each is added to a copy of the extension, which is then used.
"""

import json
import shutil
import subprocess
import sys
import textwrap

import pytest

from tests.integration.conftest import START
from tests.integration.support import ROOT, SECONDS

MODEL_LINE = """\
    Model("almost", "Almost", "The reference under another name", 6),
"""
MODEL_FILE = '''\
"""The model "almost": the reference under another name."""

from .model_reference import from_albedo, to_albedo
from .vcavity import reflectance

__all__ = ["from_albedo", "reflectance", "to_albedo"]
'''
INSTRUMENT_RECORD = """\
    Instrument(
        name="60a:0",
        title="60°a:0°, ideal",
        menu="60°a:0°",
        description="Ring light at 60°, view along the normal",
        number=14,
        light=Beam(60.0, all_around=True),
        view=NORMAL,
    ),
"""

USE = """
    extension = load_extension()
    extension.register()
    import numpy as np
    from pathlib import Path
    from rough_spectra.addon import command_line, properties, readers, storage
    from rough_spectra.core import cycles_instrument, ladder, models, reading

    white, sigma = np.ones((1, 31)), np.radians(50)
    light = np.linspace(0.01, 0.06, 93).reshape(31, 3)
    choice = ladder.choose_model(white, sigma, np.zeros((3, 1)), [light])[0]
    try:
        models.find("mirror")
    except ValueError as error:
        refused = str(error)

    words = ["--mapping", sys.argv[1], "--create", "--model", "almost"]
    words += ["--output", sys.argv[1] + ".blend"]
    status = command_line.main(["assign", *words])
    material = bpy.data.materials["Wall"]
    group = material.rough_spectra
    request = storage.load(material)

    def menu(name):
        items = group.bl_rna.properties[name].enum_items
        return {item.identifier: [item.value, item.name, item.description] for item in items}

    def reads(model, instrument):
        return reading.from_albedo([0.6], 0.5, model, instrument).tolist()

    table = importlib.import_module("tools.manual.instruments_table").described()
    print(json.dumps({
        "core": [extension.__file__, command_line.__file__, models.__file__],
        "names": models.NAMES,
        "rungs": list(choice.errors),
        "chosen": choice.model,
        "refused": refused,
        "directions": [
            ladder.reflectance(model, [0.6], 0.7, 0.2, 1.0, 0.5).tolist()
            for model in ("almost", "reference")
        ],
        "readings": [[reads(m, n) for n in ("45a:0", "45as15")] for m in ("almost", "reference")],
        "at_60": [[m, reads(m, "60a:0"), reading.to_albedo(
            reads(m, "60a:0"), 0.5, m, "60a:0").tolist()] for m in models.NAMES],
        "directions_at_60": ladder.reflectance("reference", [0.6], np.pi / 3, 0, 0, 0.5).tolist(),
        "angles": np.degrees(reading.INSTRUMENT_ANGLES["60a:0"]).tolist(),
        "cycles": cycles_instrument.reflectance([0.5], 1.0, "60a:0").tolist(),
        "menus": {name: menu(name) for name in ("model", "instrument")},
        "titles": [properties.title("model", "almost"), properties.title("instrument", "60a:0")],
        "status": status,
        "stored": [group.model, group.instrument, request.model, request.sample.instrument],
        "error": group.error,
        "notes": list(request.sample.notes),
        "told": [readers.read(Path(path))[0].instrument for path in sys.argv[2:]],
        "table": table.splitlines()[-1],
    }))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    extension.unregister()
"""

SPECTRUM = "Geometry: {}\nnm,clay\n" + "".join(f"{nm},0.4\n" for nm in range(380, 731, 10))


@pytest.fixture(scope="module")
def found(tmp_path_factory, environment):
    folder = tmp_path_factory.mktemp("additions")
    home = folder / "rough_spectra"
    for name in ("core", "addon", "tools"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / name, home / name, ignore=ignored)
    shutil.copytree(ROOT / "presets", home / "presets")
    for name in ("__init__.py", "blender_manifest.toml"):
        shutil.copy(ROOT / name, home / name)
    add(home / "core" / "models.py", 'to the V-cavity reference", 2),\n', MODEL_LINE)
    (home / "core" / "model_almost.py").write_text(MODEL_FILE, encoding="utf-8")
    add(home / "core" / "instruments.py", "    _multi_angle(110, number=13),\n", INSTRUMENT_RECORD)

    files = []
    for number, words in enumerate(("60/0", "0:60 annular", "60a:0")):
        files.append(folder / f"{number}.csv")
        files[-1].write_text(SPECTRUM.format(words), encoding="utf-8")
    mapping = folder / "mapping.csv"
    mapping.write_text("material,sample,file,kind\nWall,clay,0.csv,reading\n", encoding="utf-8")
    done = subprocess.run(
        [
            *(sys.executable, "-c", START.format(root=str(home)) + textwrap.dedent(USE)),
            *map(str, (mapping, *files)),
        ],
        env=environment,
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=SECONDS,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(next(line for line in done.stdout.splitlines() if line.startswith("{")))
    assert all(path.startswith(str(home)) for path in found["core"])
    return found


def add(path, mark, text):
    code = path.read_text(encoding="utf-8")
    assert code.count(mark) == 1
    path.write_text(code.replace(mark, mark + text), encoding="utf-8")


def test_a_model_of_one_line_and_one_file_is_found_everywhere(found):
    rungs = ["lambert", "first-order", "two-bounce", "closure", "almost", "reference"]
    assert found["names"] == found["rungs"] == rungs
    # Where the closure is off by 8 %, the ladder now has something cheaper than the reference.
    assert found["chosen"] == "almost"
    assert found["refused"].endswith(f"choose one of: {', '.join(rungs)}.")
    for almost, reference in (found["directions"], found["readings"]):
        assert almost == reference
    assert list(found["menus"]["model"]) == ["auto", *rungs]
    assert found["menus"]["model"]["almost"] == [6, "Almost", "The reference under another name"]
    assert found["titles"][0] == "Almost"
    assert (found["status"], found["error"]) == (0, "")
    assert (found["stored"][0], found["stored"][2]) == ("almost", "almost")


def test_an_instrument_of_one_record_is_found_everywhere(found):
    assert [model for model, *_ in found["at_60"]] == found["names"]
    for model, read, albedo in found["at_60"]:
        assert albedo == pytest.approx([0.6], rel=1e-12), model
        if model in ("almost", "reference"):
            # Its one direction, from the table over σ.
            assert read == pytest.approx(found["directions_at_60"], rel=1e-12)
    assert found["angles"] == pytest.approx([60, 0, 0])
    assert 0 < found["cycles"][0] < 0.5
    menu = found["menus"]["instrument"]
    assert list(menu)[-1] == "60a:0"
    assert menu["60a:0"] == [14, "60°a:0°", "Ring light at 60°, view along the normal"]
    assert found["titles"][1] == "60°a:0°"
    assert found["told"] == ["60a:0"] * 3
    assert (found["stored"][1], found["stored"][3]) == ("60a:0", "60a:0")
    assert not [note for note in found["notes"] if "geometry" in note]
    assert found["table"] == "| `60a:0` | ring at 60° | along the normal |"
