# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table "To add something" of docs/development.md: one place each, and all follows.

One of each kind is added to a copy of the extension, which one Blender then uses.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from tests.architecture.house import ROOT

MODEL = """\
    Model("almost", "Almost", "The reference under another name", 99),
"""
INSTRUMENT = """\
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
SOCKETS = """\
    "SHEEN": Sockets("ShaderNodeBsdfSheen", "Color", "Roughness", "Normal"),
"""
LINES = {
    "core/models/__init__.py": ('in closed form and tabulated", 2, 65.0),\n', MODEL),
    "core/instruments/geometries.py": ("    _multi_angle(110, number=13),\n", INSTRUMENT),
    "addon/blender/sockets.py": ("OF_SHADER: Mapping[str, Sockets] = {\n", SOCKETS),
}
"""What is added to files, and after which line."""

FILES = {
    "core/models/almost.py": '''
        """The model "almost": the reference under another name."""

        from .reference import from_albedo, reflectance, to_albedo

        __all__ = ["from_albedo", "reflectance", "to_albedo"]
    ''',
    "addon/samples/readers/formats/shouting.py": '''
        """Two bands after a shout."""

        from ...sample import Sample

        NAME = "shouting"
        ENDINGS = ("shout", "txt")
        PRIORITY = 50


        def sniff(document):
            return document.head.startswith(b"SPECTRUM!")


        def read(document):
            return [Sample("loud", [380, 730], [0.5, 0.5], "reading")]
    ''',
    "addon/matching/shaders/sheen.py": '''
        """The Sheen BSDF, which is no diffuse lobe: for a test."""

        from ..target_shader import TargetShader

        SHADER = TargetShader("SHEEN", "Sheen BSDF", "Set a Sheen BSDF", 3)
    ''',
    "addon/commands/verbs/greet_all.py": '''
        """`greet`: say hello."""

        NAME = "greet"
        SUMMARY = "say hello"
        DESCRIPTION = "Say hello to a name."


        def add_arguments(parser):
            parser.add_argument("--name", metavar="NAME", help="who is greeted")


        def run(options):
            print("Hello", options.name)
            return 0
    ''',
    "addon/interface/operators/wave.py": '''
        """Wave a hand."""

        import bpy


        class ROUGHSPECTRA_OT_wave(bpy.types.Operator):
            """Wave a hand"""

            bl_idname = "rough_spectra.wave"
            bl_label = "Wave"
            menu_place = 2, 9

            def execute(self, context):
                return {"FINISHED"}


        classes = (ROUGHSPECTRA_OT_wave,)
    ''',
    "addon/interface/panels/boxes/weather.py": '''
        """The box Weather."""

        LABEL = "Weather"
        TOOLTIP = "How it is outside"
        PLACE = 15
        IN_SIDEBAR = True
        IS_CLOSED = True


        def poll(context):
            return context is not None


        def draw(layout, context):
            layout.label(text=f"Sunny in {context}")
    ''',
    "addon/readings/writers/names.py": '''
        """Names of the materials, and nothing else."""

        NAME = "names"
        PLACE = 15
        ENDINGS = r"predicted\\.names"
        CREATOR = rb"names by Rough Spectra "


        def files(readings):
            names = [entry.material for entry in readings.entries]
            text = "\\n".join(["names by Rough Spectra 0", *names])
            return [("predicted.names", text.encode())]
    ''',
    "addon/export/targets/roster.py": '''
        """Colors of the materials, and nothing else."""

        from ....core.lobes import LAMBERT
        from ..spaces import REC709

        NAME = "roster"
        TITLE = "Roster"
        PLACE = 25
        ENDING = "roster"
        LOBES = (LAMBERT,)
        SPACES = (REC709,)


        def content(entries):
            return "".join(f"{entry.identifier} {entry.color}" for entry in entries).encode()
    ''',
}
"""Files that are added."""

USE = """
    import contextlib, importlib, importlib.util, io, json, sys, types
    from pathlib import Path

    home, folder = Path(sys.argv[1]), Path(sys.argv[2])
    sys.path.insert(0, str(home))
    import bpy
    spec = importlib.util.spec_from_file_location(
        "rough_spectra", home / "__init__.py", submodule_search_locations=[str(home)]
    )
    extension = sys.modules["rough_spectra"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(extension)
    extension.register()
    at_start = [name for name in sys.modules if ".formats" in name]

    import numpy as np
    from rough_spectra.addon.blender import shader_nodes
    from rough_spectra.addon.commands import command_line
    from rough_spectra.addon.instrument import arrangement
    from rough_spectra.addon.interface import registration
    from rough_spectra.addon.material import properties, settled, storage
    from rough_spectra.addon.readings import writers
    from rough_spectra.addon.samples import endings, readers
    from rough_spectra.core import ladder, models, reading
    from rough_spectra.core.cycles import instrument_lobe
    from rough_spectra.core.errors import RoughSpectraError

    def refusal(act, *arguments):
        try:
            act(*arguments)
        except RoughSpectraError as error:
            return str(error)

    def main(*words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = command_line.main([str(word) for word in words])
        return [status, out.getvalue(), err.getvalue()]

    assign = main(
        *("assign", "--mapping", folder / "mapping.csv", "--create", "--model", "almost"),
        *("--shader", "sheen", "--output", folder / "wall.blend"),
    )
    material = bpy.data.materials["Wall"]
    group = material.rough_spectra
    request = storage.load(material)
    surface = shader_nodes.surface(material)
    other = bpy.data.materials.new("Other")
    if other.node_tree is None:
        other.use_nodes = True
    nodes = other.node_tree.nodes
    nodes.clear()
    output, glass = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeBsdfGlass")
    other.node_tree.links.new(glass.outputs[0], output.inputs["Surface"])

    def baked(*words):
        status, _, err = main("bake", "--output", folder / "chart", "--predicted-only", *words)
        return [status, sorted(path.name for path in folder.glob("chart*")), err]

    def menu(name, of=group):
        items = of.bl_rna.properties[name].enum_items
        return {item.identifier: [item.value, item.name, item.description] for item in items}

    def reads(model, instrument):
        return reading.from_albedo([0.6], 0.5, model, instrument).tolist()

    drawn = []
    layout = types.SimpleNamespace(
        operator=lambda name, **_: drawn.append(name),
        separator=lambda **_: drawn.append("-"),
        label=lambda text: drawn.append(text),
    )
    this = types.SimpleNamespace(layout=layout)
    bpy.types.ROUGHSPECTRA_MT_actions.draw(this, None)
    boxes = [
        [cls.__name__, cls.bl_label, getattr(cls, "bl_parent_id", ""), cls.__doc__]
        for cls in registration.classes
        if issubclass(cls, bpy.types.Panel)
    ]
    for name in ("weather", "view_weather", "nodes_weather"):
        cls = getattr(bpy.types, f"ROUGHSPECTRA_PT_{name}")
        if cls.poll("Rome"):
            cls.draw(this, "Rome")

    instruments_table = importlib.import_module("tools.manual.instruments_table")
    found = {
        "ours": [extension.__file__, command_line.__file__, models.__file__],
        "at_start": at_start,
        "names": models.NAMES,
        "refused": [refusal(models.find, "mirror"), refusal(shader_nodes.find, other)],
        "directions": [
            ladder.reflectance(model, [0.6], 0.7, 0.2, 1.0, 0.5).tolist()
            for model in ("almost", "reference")
        ],
        "readings": [[reads(m, n) for n in ("45a:0", "45as15")] for m in ("almost", "reference")],
        "at_60": [[m, reads(m, "60a:0"), reading.to_albedo(
            reads(m, "60a:0"), 0.5, m, "60a:0").tolist()] for m in models.NAMES],
        "directions_at_60": ladder.reflectance("reference", [0.6], np.pi / 3, 0, 0, 0.5).tolist(),
        "angles": np.degrees(reading.INSTRUMENT_ANGLES["60a:0"]).tolist(),
        "renders": [
            [*np.degrees(shot.light).round(6).tolist(), shot.view]
            for shot in arrangement.of("60a:0").shots
        ],
        "cycles": instrument_lobe.reflectance([0.5], 1.0, "60a:0").tolist(),
        "menus": {name: menu(name) for name in ("model", "instrument", "read_at", "shader")},
        "operator_shaders": list(menu("shader", bpy.ops.rough_spectra.assign_file.get_rna_type())),
        "titles": [
            properties.title(*pair)
            for pair in (("model", "almost"), ("instrument", "60a:0"), ("shader", "SHEEN"))
        ],
        "assign": assign,
        "stored": [group.model, group.instrument, request.model, request.sample.instrument],
        "error": group.error,
        "notes": list(request.sample.notes),
        "told": [readers.read(folder / f"{n}.csv")[0].instrument for n in range(3)],
        "table": instruments_table.described().splitlines()[-1],
        "node": [surface.shader, material.node_tree.nodes[surface.node].bl_idname, group.shader],
        "shown": surface.color,
        "obstacle": str(settled.obstacle(surface)),
        "no_node": str(settled.obstacle(None)),
        "loud": readers.read(folder / "loud.csv")[0].name,
        "formats": {reader.NAME: reader.ENDINGS for reader in readers.readers()},
        "endings": endings.endings(),
        "dropped": bpy.types.ROUGHSPECTRA_FH_import.bl_file_extensions.split(";"),
        "help": {
            verb: main(verb, "--help")[1]
            for verb in ("assign", "assets", "bake", "check", "compare", "export", "merge")
        },
        "greeted": [main("--help"), main("greet", "--help"), main("greet", "--name", "Ada")],
        "waved": [
            list(bpy.ops.rough_spectra.wave()), bpy.ops.rough_spectra.wave.get_rna_type().name
        ],
        "drawn": drawn,
        "boxes": boxes,
        "written": writers.FORMATS,
        "exported": main("export", "--output", folder / "wall", "--target", "roster"),
        "roster": (folder / "wall.roster").read_text(),
        "bakes": [baked(), baked("--format", "names"), baked("--format", "csv")],
    }
    bpy.ops.wm.read_factory_settings(use_empty=True)
    extension.unregister()
    found["left"] = [name for name in dir(bpy.types) if name.startswith("ROUGHSPECTRA")]
    found["left"] += [name for name in dir(bpy.ops.rough_spectra) if name == "wave"]
    (folder / "found.json").write_text(json.dumps(found), encoding="utf-8")
"""

SPECTRUM = "Geometry: {}\nnm,clay\n" + "".join(f"{nm},0.4\n" for nm in range(380, 731, 10))
SECONDS = 120


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    folder = tmp_path_factory.mktemp("additions")
    home, user = folder / "rough_spectra", folder / "user"
    user.mkdir()
    for name in ("core", "addon", "tools", "presets"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(ROOT / name, home / name, ignore=ignored)
    for name in ("__init__.py", "blender_manifest.toml"):
        shutil.copy(ROOT / name, home / name)
    for path, (mark, text) in LINES.items():
        code = (home / path).read_text(encoding="utf-8")
        assert code.count(mark) == 1
        (home / path).write_text(code.replace(mark, mark + text), encoding="utf-8")
    for path, code in FILES.items():
        (home / path).write_text(textwrap.dedent(code).lstrip(), encoding="utf-8")

    for number, words in enumerate(("60/0", "0:60 annular", "60a:0")):
        (folder / f"{number}.csv").write_text(SPECTRUM.format(words), encoding="utf-8")
    (folder / "loud.csv").write_text("SPECTRUM! 380 0.5", encoding="utf-8")
    mapping = "material,sample,file,kind\nWall,clay,0.csv,reading\n"
    (folder / "mapping.csv").write_text(mapping, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(USE), home, folder],
        env=os.environ | {"BLENDER_USER_RESOURCES": str(user), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=SECONDS,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found = json.loads((folder / "found.json").read_text(encoding="utf-8"))
    assert all(path.startswith(str(home)) for path in found["ours"])
    assert found["left"] == []
    return found


def test_a_file_format_of_one_file_is_found_everywhere(found):
    assert found["loud"] == "loud"
    assert "shout" in found["endings"]
    assert ".shout" in found["dropped"]
    assert found["at_start"] == []  # endings are known without importing what reads
    manual = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
    rows = {f"| {name} | " for name in found["formats"]}
    # The manual's list is held to the formats by tests/input/test_readers.py.
    assert {row for row in rows if row not in manual} == {"| shouting | "}


def test_a_model_of_one_line_and_one_file_is_found_everywhere(found):
    rungs = ["lambert", "first-order", "two-bounce", "closure", "almost", "reference", "surface"]
    assert found["names"] == rungs
    assert found["refused"][0].endswith(f"choose one of: {', '.join(rungs)}.")
    for almost, reference in (found["directions"], found["readings"]):
        assert almost == reference
    assert list(found["menus"]["model"]) == ["auto", *rungs]
    assert found["menus"]["model"]["almost"] == [99, "Almost", "The reference under another name"]
    assert found["titles"][0] == "Almost"
    assert (found["assign"][0], found["error"]) == (0, "")
    assert (found["stored"][0], found["stored"][2]) == ("almost", "almost")
    assert all("almost" in found["help"][verb] for verb in ("assign", "assets"))


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
    assert found["menus"]["read_at"] == menu
    assert found["renders"] == [[60, 45 * k, 0] for k in range(8)]
    assert all("60a:0" in found["help"][verb] for verb in ("assign", "bake", "check", "compare"))
    assert found["titles"][1] == "60°a:0°"
    assert found["told"] == ["60a:0"] * 3
    assert (found["stored"][1], found["stored"][3]) == ("60a:0", "60a:0")
    assert not [note for note in found["notes"] if "geometry" in note]
    assert found["table"] == "| `60a:0` | ring at 60° | along the normal |"


def test_a_target_shader_of_one_file_and_one_map_is_found_everywhere(found):
    names = ["AUTO", "DIFFUSE", "PRINCIPLED", "SHEEN"]
    assert found["node"] == ["ShaderNodeBsdfSheen", "ShaderNodeBsdfSheen", "SHEEN"]
    assert all(0 < value < 1 for value in found["shown"])
    assert found["obstacle"] == "None"
    menu = found["menus"]["shader"]
    assert list(menu) == found["operator_shaders"] == names
    assert [menu[name][0] for name in names] == [0, 1, 2, 3]
    assert menu["SHEEN"] == [3, "Sheen BSDF", "Set a Sheen BSDF"]
    assert found["titles"][2] == "Sheen BSDF"
    listed = "Diffuse, Principled or Sheen BSDF"
    for sentence in (menu["AUTO"][2], found["no_node"], found["refused"][1]):
        assert listed in sentence
    assert "{auto,diffuse,principled,sheen}" in found["help"]["assign"]
    assert "{diffuse,principled,sheen}" in found["help"]["assets"]


def test_a_verb_of_one_file_is_found_everywhere(found):
    everything, own, hello = found["greeted"]
    assert re.search(r"\n    greet +say hello\n", everything[1])
    assert own[0] == 0
    assert "Say hello to a name." in own[1]
    assert all(option in own[1] for option in ("--name", "--blend", "--debug"))
    assert hello == [0, "Hello Ada\n", ""]


def test_an_operator_of_one_file_is_found_everywhere(found):
    assert found["waved"] == [["FINISHED"], "Wave"]
    menu = found["drawn"][: found["drawn"].index("rough_spectra.bake") + 1]
    groups = " ".join(name.removeprefix("rough_spectra.") for name in menu).split(" - ")
    assert groups[1:] == [
        "analyze_scene renew keep estimate_sigma make_local remove_gloss remove_scale "
        "switch_to_cycles show_rendered use_wide_gamut use_rec2020 wave",
        "measure bake",
    ]


def test_a_box_of_one_file_is_found_everywhere(found):
    names = [name.removeprefix("ROUGHSPECTRA_PT_") for name, *_ in found["boxes"]]
    assert names == [
        *("material", "details"),
        *("difference", "weather", "plots", "measurement", "scene", "source"),
        *("view", "view_details"),
        *("view_difference", "view_weather", "view_plots", "view_measurement"),
        *("nodes", "nodes_details"),
        *("nodes_difference", "nodes_weather", "nodes_plots", "nodes_measurement"),
        *("light", "world", "picture", "picture_rules", "pixel", "lamps", "infrared", "thermal"),
    ]
    about = ["Weather", "ROUGHSPECTRA_PT_details", "How it is outside"]
    assert found["boxes"][3] == ["ROUGHSPECTRA_PT_weather", *about]
    assert found["drawn"][-3:] == ["Sunny in Rome"] * 3


def test_an_output_format_of_one_file_is_found_everywhere(found):
    assert found["written"] == ["csv", "names", "cgats", "exr"]
    all_of_them, alone, another = found["bakes"]
    assert [status for status, *_ in found["bakes"]] == [0, 0, 0]
    csv, json_, names = "chart.predicted.csv", "chart.json", "chart.predicted.names"
    assert {csv, json_, names} < set(all_of_them[1])
    assert alone[1] == [json_, names]  # those of the bake before are known as ours, and go
    assert another[1] == [json_, csv]
    assert names in alone[2]
    assert all("{csv,names,cgats,exr}" in found["help"][v] for v in ("bake", "check", "merge"))


def test_a_renderer_of_one_file_is_found_everywhere(found):
    assert found["exported"][0] == 0
    assert "Roster: 1 material, at most ΔE00 0.00" in found["exported"][2]
    assert found["roster"].startswith("Wall [0.")
    assert re.search(r"\{materialx,\w*,?roster,.*\}", found["help"]["export"])
    assert "BASE.roster" in found["help"]["export"]


def test_the_manual_has_the_table():
    manual = (ROOT / "docs" / "development.md").read_text(encoding="utf-8")
    section = manual.partition("\n## To add something\n")[2].partition("\n## ")[0]
    rows = [row.split("|")[1].strip() for row in section.splitlines() if row.startswith("| ")]
    assert rows[1:] == [
        *("a file format", "an instrument", "a model", "a target shader", "a verb"),
        *("an operator", "a box of the panel", "an output format", "a preset"),
        "a renderer to export to",
    ]
    for path in re.findall(r"`((?:core|addon)/[\w/]*)", section):
        assert Path(ROOT, path).exists() or Path(ROOT, f"{path}.py").exists(), path
