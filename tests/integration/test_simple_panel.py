# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What everybody sees while Details is closed: few words, one verdict, and a remedy that works."""

import math
import re
import types
from dataclasses import replace
from pathlib import Path
from typing import get_args

import bpy
import pytest
from rough_spectra.addon.blender import shader_nodes
from rough_spectra.addon.interface.operators import common, targets
from rough_spectra.addon.interface.panels import panels, renewal, sentences, simple, text
from rough_spectra.addon.matching.request import Request
from rough_spectra.addon.material import (
    derive,
    last_measurement,
    settled,
    snapshot,
    state,
    storage,
    verdict,
)
from rough_spectra.addon.preview import balls, icons, theme
from rough_spectra.addon.samples import presets

from tests.integration.support import rgb_material
from tests.integration.test_operators import mesh_object
from tests.integration.test_panels import EEVEE, OPS, Layout, context, drawn, light_and_camera

BRICK, CYAN = "everyday/brick", "colorchecker/18-cyan"
MARKS = {simple.icon_value(icon): mark for mark, icon in simple._MARKS.items()}
WORDS, NUMBERS = 20, 3


class Shown(Layout):
    """Writes down what can be read: labels, names of sliders with a number, buttons' texts."""

    def label(self, *, text="", icon_value=0, translate=True):
        super().label(text=text, icon_value=icon_value)
        if icon_value in MARKS:
            self.page[-1] = f"{MARKS[icon_value]}: {text}"

    def row(self, **_options):
        return Shown(self.page)

    column = box = split = row

    def prop(self, data, name, *, text=None, **options):
        super().prop(data, name, **options)
        self.page[-1] = f"{data.bl_rna.properties[name].name if text is None else text} 0.5"

    def operator(self, name, *, text=None, **options):
        super().operator(name, text=text, **options)
        self.page[-1] = f"<{text}>" if text else ""
        properties = types.SimpleNamespace()
        self.page.append((name, properties))
        return properties


def closed(space="PROPERTIES", **more):
    """All that the closed panel draws."""
    where, page, shown = context(space, **more), [], set()
    for cls in panels.classes:
        if cls.bl_space_type != where.area.type or not cls.poll(where):
            continue
        around = getattr(cls, "bl_parent_id", "")
        if not around:
            shown.add(cls.__name__)
            cls.draw(types.SimpleNamespace(layout=Shown(page)), where)
        elif around in shown:
            cls.draw_header(types.SimpleNamespace(layout=Shown(page)), where)
    return page


def texts(page):
    """What there is to read, without the squares that mark a verdict."""
    found = [text for text in page if isinstance(text, str) and not text.startswith("enabled:")]
    return [re.sub(r"^(right|near|off|open): |^picture .*", "", text) for text in found]


def counted(page):
    """How many words and how many numbers; those in a sample's own name are words."""
    names = [text for text in texts(page) if text.startswith("<")]
    others = " ".join(text for text in texts(page) if not text.startswith("<")).split()
    numbers = [token for token in others if re.search(r"\d", token)]
    return len(others) - len(numbers) + len(" ".join(names).split()), len(numbers)


def judged(**where):
    """The verdict that is drawn, and the operator of its remedy."""
    closed(**where)
    icons._work()
    page = closed(**where)
    if renewal._asked:
        renewal._work()
        page = closed(**where)
    [at] = [i for i, text in enumerate(page) if str(text).partition(":")[0] in MARKS.values()]
    said = [text for text in page[at:] if isinstance(text, str) and not text.startswith("<")]
    words = re.split(" enabled:| (?:Rough Spectra )?Details", " ".join(said))[0]
    remedy = [entry for entry in page[at:] if isinstance(entry, tuple)]
    return words.strip(), remedy[0] if remedy else None


def apply(remedy):
    """Press its button."""
    name, properties = remedy
    _, _, name = name.partition(".")
    assert getattr(OPS, name)("EXEC_DEFAULT", **vars(properties)) == {"FINISHED"}


@pytest.fixture(autouse=True)
def _forgotten(empty_file):
    bpy.context.scene.render.engine = "CYCLES"
    yield
    icons.clear()
    balls.clear()
    renewal.clear()


def wall(preset=BRICK, degrees=20.0):
    material = rgb_material("Wall")
    mesh_object("Wall", material)
    OPS.assign_preset("EXEC_DEFAULT", preset=preset, sigma=math.radians(degrees))
    return material


def shader(material):
    return shader_nodes.shader_node(material)


def edited():
    shader(wall()).inputs[0].default_value = (0.5, 0.1, 0.1, 1)


def muted():
    shader(wall()).mute = True


def kept():
    edited()
    storage.keep(bpy.data.materials["Wall"])


def textured():
    tree = wall().node_tree
    noise = tree.nodes.new("ShaderNodeTexNoise")
    tree.links.new(noise.outputs["Color"], shader(bpy.data.materials["Wall"]).inputs["Color"])


def too_dark():
    """A texture without green, which no scale makes brick: its log alone told of it."""
    tree = wall().node_tree
    noise, ramp = (tree.nodes.new(f"ShaderNode{name}") for name in ("TexNoise", "ValToRGB"))
    for end, red in zip(ramp.color_ramp.elements, (0.2, 0.8), strict=True):
        end.color = (red, 0.0, red / 4, 1.0)
    tree.links.new(noise.outputs[0], ramp.inputs[0])
    tree.links.new(ramp.outputs["Color"], shader(bpy.data.materials["Wall"]).inputs["Color"])
    OPS.renew()


def metallic():
    material = wall()
    material.rough_spectra.shader = "PRINCIPLED"
    shader(material).inputs["Metallic"].default_value = 0.5


def flat():
    wall(degrees=30)
    bpy.context.scene.render.engine = EEVEE


def solid():
    wall(CYAN, 0)
    bpy.context.scene.render.engine = "BLENDER_WORKBENCH"


def shiny():
    material = wall("colorchecker/24-black-2", 0)
    material.rough_spectra.shader = "PRINCIPLED"
    node = shader(material)
    node.inputs["Specular IOR Level"].default_value = 1.0
    node.inputs["Roughness"].default_value = 0.6
    OPS.renew()


def steep():
    """Brighter than a surface this rough can be, under a model that loses light."""
    material = wall()
    path = Path(bpy.app.tempdir, "chalk.csv")
    path.write_text("nm,Chalk\n" + "\n".join(f"{nm},0.94" for nm in range(400, 701, 20)))
    OPS.assign_file("EXEC_DEFAULT", filepath=str(path), sigma=math.radians(60))
    material.rough_spectra.model = "two-bounce"


def other_space():
    material = wall()
    stamp = material.rough_spectra.stamp
    material.rough_spectra.stamp = stamp.replace('"Linear Rec.709"', '"Another"')


STATES = {
    "fresh": (wall, "right: looks right", None),
    "edited": (edited, "off: edited by hand", "renew"),
    "muted": (muted, "off: node is muted", "unmute"),
    "kept": (kept, "open: edited, and kept", "renew"),
    "textured": (textured, "off: texture not matched", "renew"),
    "metallic": (metallic, "open: cannot be predicted", "remove_obstacle"),
    "too dark": (too_dark, "off: differs: texture too dark", None),
    "flat": (flat, "off: differs: Eevee lacks roughness", "switch_to_cycles"),
    "solid": (solid, "open: Workbench shows no materials", "switch_to_cycles"),
    "shiny": (shiny, "off: differs: too glossy", "remove_gloss"),
    "steep": (steep, "off: brighter than possible", "set_roughness"),
    "another space": (other_space, "off: color space changed", "renew"),
}


def test_a_roughness_that_nobody_stated_is_called_a_guess():
    material = rgb_material("Wall")
    mesh_object("Wall", material)
    path = Path(bpy.app.tempdir, "chalk.csv")
    path.write_text("nm,Chalk\n" + "\n".join(f"{nm},0.5" for nm in range(400, 701, 20)))
    OPS.assign_file("EXEC_DEFAULT", filepath=str(path))
    page = closed()
    assert "Roughness is a guess" in page
    words, numbers = counted(page)
    assert words <= WORDS
    assert numbers <= NUMBERS
    material.rough_spectra.sigma = math.radians(30)
    assert "Roughness is a guess" not in closed()
    OPS.choose_sample("EXEC_DEFAULT", sample=BRICK, sigma=math.radians(20))
    assert "Roughness is a guess" not in closed()


@pytest.mark.parametrize("name", STATES)
def test_one_verdict_in_few_words_and_the_one_thing_to_do(name):
    make, words, remedy = STATES[name]
    make()
    told, button = judged()
    assert told == words
    assert (button and button[0].partition(".")[2]) == remedy
    for width in (420, 180):
        region = types.SimpleNamespace(width=width)
        count = counted(closed(region=region))
        assert count[0] <= WORDS, closed(region=region)
        assert count[1] <= NUMBERS, closed(region=region)


@pytest.mark.parametrize("name", ["edited", "muted", "metallic", "flat", "shiny", "another space"])
def test_the_remedy_makes_it_look_right(name):
    STATES[name][0]()
    apply(judged()[1])
    assert judged()[0] == "right: looks right"


@pytest.mark.parametrize(
    ("delta_e", "words"),
    [
        (0.1, "right: measured: looks right"),
        (1.5, "near: measured: slightly off"),
        (4.0, "off: measured: differs"),
    ],
)
def test_what_was_measured_stays_to_be_read_where_nothing_is_predicted(delta_e, words):
    metallic()
    material = bpy.data.materials["Wall"]
    of = last_measurement.fingerprint(material)
    last_measurement.note(material, of, (0.1, 0.1, 0.1), delta_e)
    told, remedy = judged()
    assert told == words
    assert (remedy is None) == (delta_e < 2)
    shader(material).inputs["Metallic"].default_value = 0.6
    told, remedy = judged()
    assert told == "open: changed since measured"
    assert remedy is not None
    last_measurement.note(material, last_measurement.fingerprint(material), (0, 0, 0), None)
    assert judged()[0] == "open: cannot be predicted"


def test_what_a_flat_sample_cannot_show_makes_no_green():
    metallic()
    material = bpy.data.materials["Wall"]
    of = last_measurement.fingerprint(material)
    last_measurement.note(material, of, (0.1, 0.1, 0.1), 0.1, unlike=("it has no UV map",))
    assert judged()[0] == "open: measured flat: looks right"


def test_it_is_the_engine_that_is_said_to_lack_the_roughness():
    """Below a roughness of 20° it would sound as if that one were missing."""
    flat()
    told, _ = judged()
    assert told == "off: differs: Eevee lacks roughness"
    assert len(told.rpartition(":")[2].split()) <= 3


def test_a_small_difference_names_its_reason_where_something_can_be_done():
    """As with the cube of a factory start, whose engine leaves the roughness out."""
    wall(degrees=15)
    bpy.context.scene.render.engine = EEVEE
    told, remedy = judged()
    assert told == "near: Eevee lacks roughness"
    assert remedy[0] == "rough_spectra.switch_to_cycles"


def test_another_engine_alone_makes_nothing_stale():
    """After an analysis each switch cost a Renew, and Eevee was green at 30° that it lacks."""
    material = wall(degrees=30)
    light_and_camera()
    OPS.analyze_scene("EXEC_DEFAULT")
    scene, written = bpy.context.scene, shader(material).inputs["Roughness"].default_value
    assert judged()[0] == "right: looks right"
    of = last_measurement.fingerprint(material)
    scene.render.engine = EEVEE
    assert last_measurement.fingerprint(material) == of  # Cycles measured it, whatever shows it
    told, remedy = judged()
    assert told == "near: Eevee lacks roughness"
    assert state.state(material).kind == "fresh"
    # A slider that is dragged meanwhile leaves it matched for Cycles.
    material.rough_spectra.sigma = math.radians(25)
    assert shader(material).inputs["Roughness"].default_value > 0.3 * written
    material.rough_spectra.sigma = math.radians(30)
    apply(remedy)
    assert judged()[0] == "right: looks right"
    assert shader(material).inputs["Roughness"].default_value == pytest.approx(written, abs=1e-4)


def test_what_is_matched_for_eevee_says_so_under_every_engine():
    material = wall(degrees=30)
    material.rough_spectra.tolerance = 0.1
    light_and_camera()
    bpy.data.objects["Sun"].rotation_euler.x = 0.3
    bpy.data.cameras["Camera"].lens = 30
    bpy.context.view_layer.update()
    scene = bpy.context.scene
    scene.render.engine = EEVEE
    OPS.analyze_scene("EXEC_DEFAULT")
    for sigma in (30, 29):  # dragged in Eevee it stays so
        material.rough_spectra.sigma = math.radians(sigma)
        told, remedy = judged()
        assert told == "near: matched for Eevee, flat"
        assert shader(material).inputs["Roughness"].default_value == 0
    apply(remedy)
    told, remedy = judged()
    assert told == "near: matched for Eevee, flat"
    apply(remedy)
    assert judged()[0] == "right: looks right"
    assert shader(material).inputs["Roughness"].default_value > 0.1


LIMITS = [limit for limit in get_args(verdict.Limit) if limit not in {"nothing", "solid"}]


@pytest.mark.parametrize("limit", LIMITS)
def test_a_small_difference_never_goes_without_what_it_comes_from(limit, monkeypatch):
    """It said "visible side by side": nobody knew beside what."""
    wall()
    monkeypatch.setattr(verdict, "limit", lambda *_: limit)
    monkeypatch.setattr(icons, "differences", lambda *_: (1.2, 1.2, 1.5))
    monkeypatch.setattr(settled, "numbers", lambda *_: None)
    told, _ = judged()
    assert told.startswith("near: ")
    assert not told.endswith("slightly off")
    assert "side by side" not in told
    assert counted(closed())[0] <= WORDS
    said = next(line for line in drawn() if line.startswith(("What differs: ", "Matched ")))
    assert "Limited" not in said


def test_without_a_sample_there_is_one_thing_to_do():
    mesh_object("Wall")
    page = closed()
    assert page[0] == "Rough Spectra"
    assert page[2][0] == "rough_spectra.choose_sample"
    assert counted(page)[0] <= WORDS
    assert counted(page)[1] == 0


def test_out_of_gamut_a_wider_space_helps_where_blender_has_one():
    material = wall(CYAN, 0)
    told, remedy = judged()
    assert told == "off: differs: out of gamut"
    assert counted(closed())[1] <= NUMBERS
    if not hasattr(bpy.data, "colorspace"):
        assert remedy is None
        return
    assert remedy[0] == "rough_spectra.use_wide_gamut"
    other = rgb_material("Edited")
    apply(remedy)
    assert bpy.data.colorspace.working_space == "ACEScg"
    assert judged()[0] == "right: looks right"
    assert state.state(material).stamp.delta_e_instrument < 0.01
    assert not other.rough_spectra.stamp


def test_a_linked_material_is_made_local_where_it_says_so(scene_file):
    with bpy.data.libraries.load(str(scene_file), link=True) as (_, wanted):
        wanted.objects = ["Panel"]
    [thing] = wanted.objects
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    assert not thing.is_editable
    told, remedy = judged()
    assert told == "open: linked: settings locked"
    assert enabled_of(closed(), "rough_spectra.choose_sample") == "enabled: False"
    apply(remedy)
    assert enabled_of(closed(), "rough_spectra.choose_sample") == "enabled: True"
    assert thing.active_material.is_editable
    assert thing.active_material.rough_spectra.sample_name
    assert judged()[0] == "right: looks right"
    with pytest.raises(RuntimeError, match="belongs to this file"):
        OPS.make_local()


def test_an_override_is_made_local_too(scene_file):
    with bpy.data.libraries.load(str(scene_file), link=True) as (_, wanted):
        wanted.materials = ["Alpha"]
    thing = mesh_object("Wall", wanted.materials[0].override_create())
    apply(judged()[1])
    assert thing.active_material.override_library is None
    assert state.state(thing.active_material).kind == "fresh"


def test_material_preview_of_a_scene_for_cycles_is_said_to_be_eevee():
    wall()
    made = types.SimpleNamespace

    def shown(kind):
        view = made(type="VIEW_3D", shading=made(type=kind))
        return made(type="VIEW_3D", spaces=made(active=view))

    areas = [shown("MATERIAL")]
    screen, view = made(areas=areas), areas[0].spaces.active
    told, remedy = judged(screen=screen)
    assert told == "near: preview is Eevee"
    assert remedy[0] == "rough_spectra.show_rendered"
    view.shading.type = "SOLID"
    assert judged(screen=screen)[0] == "right: looks right"
    view.shading.type = "MATERIAL"
    areas.append(shown("RENDERED"))
    assert judged(screen=screen)[0] == "right: looks right"
    # In the view's own sidebar it is of that view.
    assert judged(space="VIEW_3D", screen=screen, space_data=view)[0] == "near: preview is Eevee"


def enabled_of(page, name):
    """Whether the button of an operator is drawn enabled: what was said last before it."""
    at = next(i for i, entry in enumerate(page) if isinstance(entry, tuple) and entry[0] == name)
    return next(text for text in reversed(page[:at]) if str(text).startswith("enabled:"))


def test_renew_is_enabled_only_when_it_can_succeed():
    edited()
    node = shader(bpy.data.materials["Wall"])
    assert enabled_of(closed(), "rough_spectra.renew") == "enabled: False"  # not known yet
    renewal._work()
    assert enabled_of(closed(), "rough_spectra.renew") == "enabled: True"
    tree = node.id_data
    mix, output = tree.nodes.new("ShaderNodeMixShader"), tree.get_output_node("CYCLES")
    tree.links.new(mix.outputs[0], output.inputs["Surface"])
    closed()
    renewal._work()
    assert enabled_of(closed(), "rough_spectra.renew") == "enabled: False"
    with pytest.raises(RuntimeError, match="which Rough Spectra cannot set"):
        OPS.renew()
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    node.inputs["Color"].driver_add("default_value", 0)
    closed()
    renewal._work()
    buttons = [entry[0] for entry in closed() if isinstance(entry, tuple)]
    assert "rough_spectra.renew" not in buttons
    with pytest.raises(RuntimeError, match="is animated or driven"):
        OPS.renew()
    # A driver changes no fact of the panel's, so that it is asked again after a while.
    node.inputs["Color"].driver_remove("default_value", 0)
    [uid] = renewal._answers
    renewal._answers[uid] = renewal._answers[uid]._replace(when=-math.inf)
    closed()
    renewal._work()
    assert enabled_of(closed(), "rough_spectra.renew") == "enabled: True"
    assert OPS.renew() == {"FINISHED"}


def test_each_ball_sets_its_roughness_and_has_the_samples_color():
    material = wall()
    closed()
    assert balls._pending
    assert not balls._rows
    balls._work()
    [row] = balls._rows.values()
    assert len(row) == 4
    drawn = [entry for entry in closed() if isinstance(entry, tuple)]
    buttons = [entry for entry in drawn if entry[0] == "rough_spectra.set_roughness"]
    assert [round(math.degrees(entry[1].sigma)) for entry in buttons] == [0, 15, 30, 45]
    apply(buttons[3])
    assert snapshot.sigma_degrees(material.rough_spectra) == 45
    assert state.state(material).kind == "fresh"
    assert not balls._pending  # they are of no roughness: nothing is made again
    closed()
    assert not balls._pending
    pixels = [ball_pixels(number) for number in range(4)]
    for image in pixels:
        red, green, blue, alpha = image[len(image) // 2][len(image) // 2]
        assert red > green > blue
        assert alpha == 255
    # The rougher, the brighter is the edge against the middle.
    shares = [brightness(image, 13) / brightness(image, len(image) // 2) for image in pixels]
    assert shares == sorted(shares)
    assert shares[3] > 1.1 * shares[0]


def ball_pixels(number):
    """The rows of a ball's icon, lowest first, of its four bytes each."""
    preview = list(balls._kept._collection.values())[number]
    width, height = preview.icon_size
    flat = preview.icon_pixels_float[:]
    values = [round(255 * value) for value in flat]
    rows = [values[4 * width * y : 4 * width * (y + 1)] for y in range(height)]
    return [[row[4 * x : 4 * x + 4] for x in range(width)] for row in rows]


def brightness(image, x):
    return sum(image[len(image) // 2][x][:3])


def test_grease_pencil_shows_no_panel():
    data = (
        bpy.data.grease_pencils_v3.new("Lines")
        if hasattr(bpy.data, "grease_pencils_v3")
        else bpy.data.grease_pencils.new("Lines")
    )
    material = bpy.data.materials.new("Stroke")
    bpy.data.materials.create_gpencil_data(material)
    data.materials.append(material)
    thing = bpy.data.objects.new("Lines", data)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    for space in ("PROPERTIES", "VIEW_3D"):
        assert closed(space) == []
        assert closed(space, material=material) == []
    tree = types.SimpleNamespace(bl_idname="ShaderNodeTree")
    nodes = types.SimpleNamespace(edit_tree=tree, id=material, type="NODE_EDITOR")
    assert closed("NODE_EDITOR", space_data=nodes) == []
    with pytest.raises(RuntimeError, match="Select an object"):
        OPS.choose_sample("EXEC_DEFAULT", sample=BRICK)


def test_the_three_places_show_the_same():
    material = wall()
    space = types.SimpleNamespace(edit_tree=material.node_tree, id=material, type="NODE_EDITOR")
    pages = [
        closed(),
        closed("VIEW_3D"),
        closed("NODE_EDITOR", space_data=space),
    ]
    one, two, three = ([text for text in texts(page) if "Details" not in text] for page in pages)
    # In the tab the panel has no header, which would stand far below the slots, but a title.
    assert one == ["Rough Spectra", *two]
    assert two == three
    assert {texts(page)[-1] for page in pages} == {"Details"}


def test_the_panel_stands_right_below_the_slots():
    """Blender sorts: panels without a header first, and these by their order."""
    for name in ("EEVEE_MATERIAL_PT_context_material", "CYCLES_PT_context_material"):
        slots = getattr(bpy.types, name, None)
        if slots is not None:
            assert "HIDE_HEADER" in slots.bl_options
            assert getattr(slots, "bl_order", 0) < panels.ROUGHSPECTRA_PT_material.bl_order
    assert panels.ROUGHSPECTRA_PT_material.bl_options == {"HIDE_HEADER"}
    assert not hasattr(panels.ROUGHSPECTRA_PT_material, "bl_parent_id")


def test_what_limits_and_the_verdict_do_not_contradict_each_other():
    """With gloss that outshines the color, it is not the gamut."""
    shiny()
    material = bpy.data.materials["Wall"]
    known = snapshot.of(material)
    found = state.evaluate(known).stamp
    assert verdict.limit(known, found, (3.0, 3.0, 3.0)) == "gloss"
    assert theme.current(bpy.context.preferences).scale == 1


def test_what_readers_say_does_not_read_like_a_fault():
    """What they left out of a file is told with the source."""
    material = wall()
    left_out = "2 bands without a value were left out: 400, 410 nm."
    sample = replace(storage.load(material).sample, altered=(left_out,))
    derive.assign([(material, Request(sample, math.radians(20)))])
    found = state.state(material).stamp
    assert found.warnings
    last = storage.load(material)
    reported = []
    solution = types.SimpleNamespace(warnings=(*found.warnings, "Too dark."))
    operator = types.SimpleNamespace(report=lambda kind, text: reported.append((kind, text)))
    common.report_warnings(operator, [(material, solution)])
    assert reported[-1] == ({"WARNING"}, "Wall: Too dark.")
    assert {*map(str, (kind for kind, _ in reported[:-1]))} == {"{'INFO'}"}
    assert len(reported) == 1 + len(last.sample.altered)
    style = sentences.style(text.Format(2000, False, 1.0, 11.0))
    known = snapshot.of(material)
    details = material.rough_spectra.details
    told = sentences.difference(known, (0.0, 0.5, 1.0), style, details)
    fault = simple.icon_value("ERROR")
    assert not [line for [(line, icon), *_] in told if icon == fault]
    white = (*snapshot.white(material.rough_spectra), "45a:0")
    about = sentences.source("", details, (20.0, ""), white, style)
    assert any(last.sample.altered[0] in line for [(line, _), *_] in about[2])


def test_no_two_lines_of_the_numbers_contradict_each_other():
    """What is visible is told of the mean; of the few angles that are further off, the number."""
    wall()
    drawn()
    icons._work()
    page = drawn()
    [spread] = [line for line in page if line.startswith("95 %")]
    assert re.fullmatch(r"95 % of them: below ΔE00 \d\.\d\d", spread)
    assert not any("worst" in line for line in page)


def test_what_a_sentence_names_is_a_button_below_it():
    flat()
    drawn()
    icons._work()
    page = drawn()
    difference = page[page.index("[Difference]") : page.index("[Plots]")]
    assert any(
        "analyze the scene" in " ".join(difference[i : i + 3]) for i in range(len(difference))
    )
    assert difference[-2:] == ["rough_spectra.switch_to_cycles", "rough_spectra.analyze_scene"]
    OPS.switch_to_cycles()
    OPS.assign_preset("EXEC_DEFAULT", preset=CYAN, sigma=0.0)
    wide = "rough_spectra.use_wide_gamut" in drawn()
    assert wide == hasattr(bpy.data, "colorspace")


def test_counts_leave_out_materials_that_nobody_uses_any_more():
    """A material that was taken off its object is deleted for who does not save it."""
    wall()
    gone = bpy.data.materials.new("Gone")
    other = mesh_object("Door", gone)
    OPS.assign_preset("EXEC_DEFAULT", preset=BRICK, sigma=0.3)
    for material in (gone, bpy.data.materials["Wall"]):
        shader(material).inputs[0].default_value = (0.5, 0.1, 0.1, 1)
    where = types.SimpleNamespace()
    assert len(targets.materials_in_scope(where, "ALL")) == 2
    other.data.materials.clear()
    assert [m.name for m in targets.materials_in_scope(where, "ALL")] == ["Wall"]
    assert OPS.renew(scope="ALL_STALE", overwrite_edits=True) == {"FINISHED"}
    assert state.state(gone).kind == "stale"
    assert state.state(bpy.data.materials["Wall"]).kind == "fresh"


def test_what_cannot_be_written_is_refused_by_every_operator_alike(tmp_path):
    """A library override is no more ours to write than what is linked: Blender resets its nodes."""
    wall().name = "Theirs"
    path = tmp_path / "theirs.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(path), link=True) as (_, wanted):
        wanted.materials = ["Theirs"]
    [linked] = wanted.materials
    mesh_object("Wall", linked)
    for material in (linked, linked.override_create()):
        bpy.data.objects["Wall"].active_material = material
        assert not OPS.keep.poll()
        assert not OPS.set_roughness.poll()
        assert OPS.make_local.poll()


def keyed():
    """An animation that brings another color, so that renewing is asked for and refused."""
    edited()
    shader(bpy.data.materials["Wall"]).inputs["Color"].keyframe_insert("default_value", frame=1)


def driven():
    edited()
    shader(bpy.data.materials["Wall"]).inputs["Roughness"].driver_add("default_value")


def rough_by_a_node():
    tree = wall().node_tree
    value = tree.nodes.new("ShaderNodeValue")
    tree.links.new(value.outputs[0], shader(bpy.data.materials["Wall"]).inputs["Roughness"])


OBSTACLES = {
    "keyed": (keyed, "off: edited by hand", ("CLEAR", "Color"), "off: edited by hand"),
    "driven": (driven, "off: edited by hand", ("CLEAR", "Roughness"), "off: edited by hand"),
    "rough by a node": (
        *(rough_by_a_node, "off: roughness is linked"),
        *(("UNLINK", "Roughness"), "right: looks right"),
    ),
}


@pytest.mark.parametrize("name", OBSTACLES)
def test_a_remedy_takes_the_place_of_a_renewal_that_would_fail(name):
    make, words, wanted, afterwards = OBSTACLES[name]
    make()
    closed()
    renewal._work()
    told, remedy = judged()
    assert told == words
    assert remedy[0] == "rough_spectra.remove_obstacle"
    assert (remedy[1].kind, remedy[1].socket) == wanted
    apply(remedy)
    renewal._answers.clear()
    told, remedy = judged()
    assert told == afterwards
    if remedy is not None:
        apply(remedy)
        assert judged()[0] == "right: looks right"


def test_details_offer_what_their_sentence_names():
    metallic()
    node = shader(bpy.data.materials["Wall"])
    node.inputs["Sheen Weight"].default_value = 0.5
    for name in ("Metallic", "Sheen Weight"):
        renewal._answers.clear()
        drawn()
        renewal._work()
        page = drawn()
        assert f"{name} is in use" in " ".join(page)
        assert f"rough_spectra.remove_obstacle: Set {name} to 0" in page
        assert judged()[1][0] == "rough_spectra.remove_obstacle"
        done = OPS.remove_obstacle("EXEC_DEFAULT", kind="NEUTRAL", socket=name)
        assert done == {"FINISHED"}
    assert not any("remove_obstacle" in text for text in drawn())
    assert judged()[0] == "right: looks right"


JARGON = (
    "σ",
    "rms",
    "Rdq",
    "ΔE",
    "spectrophotometer",
    "derive",
    "gamut",
    "reflectance",
    "spectrum",
)


@pytest.mark.parametrize("name", ["fresh", "edited", "muted", "metallic", "flat", "shiny"])
def test_tooltips_of_the_closed_panel_begin_with_a_plain_sentence(name, monkeypatch):
    """How it is called by color people comes after, for who reads on."""
    shown, real = {}, Shown.prop

    def prop(self, data, prop, **options):
        shown[prop] = data.bl_rna.properties[prop].description
        real(self, data, prop, **options)

    monkeypatch.setattr(Shown, "prop", prop)
    STATES[name][0]()
    judged()
    for entry in closed():
        if not isinstance(entry, tuple):
            continue
        call, properties = entry
        name = call.partition(".")[2]
        kind = bpy.types.Operator.bl_rna_get_subclass_py(f"ROUGH_SPECTRA_OT_{name}")
        shown[call] = getattr(OPS, name).get_rna_type().description
        if "description" in vars(kind):
            shown[call] = kind.description(bpy.context, properties)
    assert {"sigma", "gloss", "rough_spectra.choose_sample"} <= shown.keys()
    for what, tooltip in shown.items():
        first = re.split(r"[.:;] ", tooltip)[0]
        assert not [word for word in JARGON if word in first], (what, tooltip)
        assert len(first.split()) <= 18, (what, tooltip)


def test_the_roughness_that_the_tooltip_names_is_that_of_the_presets():
    tooltip = bpy.types.Material.bl_rna.properties["rough_spectra"].fixed_type.properties["sigma"]
    named = dict(re.findall(r"(\d+)° as ([a-z ]+)", tooltip.description.partition("\n")[0]))
    assert named == {"10": "office paper", "20": "brick", "30": "concrete"}
    shipped = {"office paper": "paper", "brick": "brick", "concrete": "concrete"}
    for degrees, what in named.items():
        assert presets.load(f"everyday/{shipped[what]}").sigma_degrees == float(degrees)


@pytest.mark.parametrize("width", range(200, 620, 20))
def test_neither_verdict_nor_button_is_cut_where_they_stand_beside_each_other(width):
    """Blender divides a line as it is told to, and cuts what does not fit into its part."""
    here = types.SimpleNamespace(format=text.Format(width, False, 1.0, 11.0))
    icon, margins = 20.0, 16.0
    beside = 0
    for words in ("looks right", "differs: Eevee lacks roughness", "measured: differs"):
        for button in (
            "Renew",
            "Switch to Cycles",
            "Set Metallic to 0",
            "Set Specular IOR Level to 0",
        ):
            share = simple._share(here, words, button)
            if share == 0:
                continue
            beside += 1
            room = width - 40.0  # of tabs and margins, as in `docs/images/window`
            assert text._width(words, 11.0) + icon <= share * room
            assert text._width(button, 11.0) + margins <= (1 - share) * room
    assert beside > 0 or width < 400
