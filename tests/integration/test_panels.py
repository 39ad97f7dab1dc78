# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels draw in every state of a material.

A background Blender has no layouts, so the panels draw onto one that writes down what it is told
and holds every property, operator and icon name against Blender's own. The real window is looked
at by `dev.py screenshots`.
"""

import json
import math
import re
import sys
import types

import bpy
import numpy as np
import pytest
from rough_spectra.addon.blender import texture_colors
from rough_spectra.addon.interface.panels import menus, panels, sentences, text
from rough_spectra.addon.interface.panels.boxes import difference
from rough_spectra.addon.material import derive, last_measurement, snapshot, storage
from rough_spectra.addon.preview import icons, theme
from rough_spectra.core import reading

from tests.integration.support import ROOT, rgb_material
from tests.integration.test_operators import mesh_object

OPS = bpy.ops.rough_spectra
PARAMETERS = bpy.types.UILayout.bl_rna.functions["label"].parameters
ICONS = {item.identifier: item.value for item in PARAMETERS["icon"].enum_items}
GREEN = "colorchecker/14-green"
_ENGINES = bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items
[EEVEE] = [engine.identifier for engine in _ENGINES if "EEVEE" in engine.identifier]


class Layout:
    """Writes down what is drawn; a part of a layout writes onto the same page."""

    def __init__(self, page=None):
        object.__setattr__(self, "page", [] if page is None else page)

    def row(self, **_options):
        return Layout(self.page)

    column = box = split = row

    def label(self, *, text="", icon_value=0, translate=True):
        assert icon_value in ICONS.values()
        self.page.append(text)

    def prop(self, data, name, *, text=None, slider=False, expand=False, translate=True):
        if not name.startswith("["):  # a custom property
            assert name in data.bl_rna.properties
            assert data.bl_rna.properties[name].description
        self.page.append(name)

    def operator(
        self, name, *, text=None, icon="NONE", icon_value=0, translate=True, depress=False
    ):
        assert icon in ICONS
        assert icon_value in ICONS.values()
        module, _, function = name.partition(".")
        kind = getattr(getattr(bpy.ops, module), function).get_rna_type()
        self.page.append(name if text is None else f"{name}: {text}")
        return types.SimpleNamespace(**dict.fromkeys(kind.properties.keys()))

    def operator_menu_enum(self, name, property, *, text="", icon="NONE", translate=True):
        assert text
        return self.operator(name, text=text, icon=icon)

    def progress(self, *, text="", factor=0.0, type="RING"):
        assert 0 <= factor <= 1
        self.page.append(text)

    def template_icon(self, icon_value, scale=1.0):
        assert scale >= 1
        self.page.append(f"picture {icon_value > 0}")

    def separator(self):
        pass

    def __setattr__(self, name, value):
        assert name in bpy.types.UILayout.bl_rna.properties
        if name == "enabled":
            self.page.append(f"enabled: {value}")


def context(space="PROPERTIES", **more):
    """The context of this Blender, as in an editor of the given kind."""
    region = types.SimpleNamespace(width=420)
    area = types.SimpleNamespace(type=space)
    real = {name: getattr(bpy.context, name) for name in ("scene", "view_layer", "preferences")}
    real["selected_objects"] = bpy.context.selected_objects
    real["space_data"] = None
    return types.SimpleNamespace(**{**real, "region": region, "area": area, **more})


def drawn(where=None):
    """All that the panels of the Material tab draw now, in order; inner ones in those around."""
    where = where or context()
    page, shown = [], {""}
    for cls in panels.classes:
        around = getattr(cls, "bl_parent_id", "")
        if cls.bl_space_type == where.area.type and around in shown and cls.poll(where):
            shown.add(cls.__name__)
            page.append(f"[{cls.bl_label}]")
            cls.draw(types.SimpleNamespace(layout=Layout(page)), where)
    return page


@pytest.fixture
def green():
    bpy.context.scene.render.engine = "CYCLES"
    material = rgb_material("Wall")
    mesh_object("Wall", material)
    OPS.assign_preset("EXEC_DEFAULT", preset=GREEN, sigma=0.5)
    yield material
    icons.clear()


def differences(material):
    """ΔE00 that the panel computed of what is in the shader node."""
    state = (snapshot.of(material), theme.current(bpy.context.preferences))
    return icons.differences(material.session_uid, state)


def test_without_an_object_there_is_no_panel():
    assert drawn() == []


def test_without_a_spectrum_the_panel_says_how_to_begin():
    mesh_object("Wall")
    page = drawn()
    title = ["[Rough Spectra]", "Rough Spectra"]
    assert page[:3] == [*title, "rough_spectra.choose_sample: Choose Sample"]
    assert any("Choose a sample" in line for line in page)
    assert "[Difference]" not in page
    assert "[Measurement]" not in page


def test_a_fresh_material_shows_everything(green):
    page = drawn()
    for wanted in ("[Difference]", "[Plots]", "[Measurement]", "[Scene]", "[Source]", "sigma"):
        assert wanted in page
    assert "rough_spectra.choose_sample: ColorChecker 14 Green" in page
    assert "45°/0°: ΔE00 0.00, not visible" in page
    assert any(line.startswith("What differs: slanting light, mostly") for line in page)
    assert not any("rough_spectra.renew" in line for line in page)
    assert any("BSD-3-Clause" in line for line in page)


def test_pictures_are_made_after_drawing_and_not_while(green):
    drawn()
    assert not icons._pictures  # without a window Blender gives no icon numbers to look at
    icons._work()
    assert {wish.figure for wish in icons._pictures} == {"ball", "swatches", "sheet"}


def test_drawing_computes_nothing(green):
    drawn()
    icons._work()
    called = set()

    def note(frame, event, _argument):
        if event == "call":
            called.add(frame.f_code.co_filename)

    sys.setprofile(note)
    try:
        drawn()
    finally:
        sys.setprofile(None)
    ours = {name.removeprefix(str(ROOT)) for name in called}
    for busy in ("/core/", "target.py", "colorimetry.py", "storage.py", "/colour/", "/numpy/"):
        assert not [name for name in ours if busy in name]


def test_an_edit_by_hand_is_offered_to_be_renewed_or_kept(green):
    node = next(node for node in green.node_tree.nodes if node.type == "BSDF_DIFFUSE")
    node.inputs["Color"].default_value = (0.5, 0.1, 0.1, 1)
    page = drawn()
    assert any("edited by hand" in line for line in page)
    assert "rough_spectra.renew" in page
    assert "rough_spectra.keep" in page
    storage.keep(green)
    page = drawn()
    assert any("kept" in line for line in page)
    assert "rough_spectra.keep" not in page


def test_the_difference_is_of_what_the_node_holds_now(green):
    """The render is the judge of the number that the panel computes after an edit by hand."""
    node = next(node for node in green.node_tree.nodes if node.type == "BSDF_DIFFUSE")
    node.inputs["Color"].default_value = (0.09, 0.27, 0.11, 1)
    # The target is now of another roughness than the color was derived with.
    green.rough_spectra.sigma = 1.0
    drawn()
    icons._work()
    at_instrument, mean, high = differences(green)
    assert OPS.measure("EXEC_DEFAULT") == {"FINISHED"}
    assert at_instrument == pytest.approx(last_measurement.get(green).delta_e, abs=0.01)
    assert at_instrument > 1
    assert high > mean > 0
    page = drawn()
    assert f"45°/0°: ΔE00 {at_instrument:.2f}, visible" in page
    assert page[page.index(f"Predicted: ΔE00 {at_instrument:.2f}, visible") + 1].startswith("Meas")
    OPS.renew("EXEC_DEFAULT")
    assert "45°/0°: ΔE00 0.00, not visible" in drawn()


def test_what_is_found_of_a_texture_is_said(green, monkeypatch):
    """The box ended with the sentence that there is no one color to compare."""
    colors = np.random.default_rng(1).uniform(0.05, 0.5, (400, 3))
    monkeypatch.setattr(texture_colors, "seen", lambda sockets: [colors for _ in sockets])
    tree = green.node_tree
    node = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs["Color"], node.inputs["Color"])
    [solution] = derive.renew([green])
    page = " ".join(drawn())
    assert len(solution.warnings) > 0
    assert all(note in page for note in solution.warnings)
    assert "its mean reads as the sample; its points are ΔE00 " in page
    green.rough_spectra.illuminant = "A"
    node.inputs["Roughness"].default_value = 0.123
    assert "its mean reads" not in " ".join(drawn())  # edited by hand


def test_what_is_said_of_the_instrument_follows_the_menu(green):
    assert "read_at" in drawn()
    green.rough_spectra.sigma = math.radians(40)
    green.rough_spectra.read_at = "45as75"
    drawn()
    icons._work()
    assert OPS.measure("EXEC_DEFAULT") == {"FINISHED"}
    page = drawn()
    assert "45°:as75°: ΔE00 0.00, not visible" in page
    assert "Measured at 45°:as75°: ΔE00 0.00, not visible" in page
    assert not any(line.startswith("45°/0°") for line in page)
    green.rough_spectra.read_at = "45a:0"
    page = drawn()
    assert "Measured before the last change; measure again" in page
    # Where it was read, and not where it would be read now.
    assert "Measured at 45°:as75°: ΔE00 0.00, not visible" in page


def test_the_range_of_sigma_stands_below_the_slider(green):
    assert not any("Fits up to" in line for line in drawn())
    OPS.assign_preset("EXEC_DEFAULT", preset="colorchecker/19-white-9-5", sigma=0.2)
    group = green.rough_spectra
    group.kind, group.model = "reading", "two-bounce"
    spectrum = json.loads(group.spectrum)
    limit = math.degrees(reading.sigma_max(max(spectrum["values"])))  # the closed form
    page = drawn()
    settings = page[page.index("kind") :]
    assert settings[settings.index("sigma") + 2] == f"Fits up to {limit:.1f}°"


def test_what_was_derived_before_is_not_told_of_a_stale_material(green):
    """Neither how far σ may go with other settings, nor what each light of the scene shows."""
    OPS.assign_preset("EXEC_DEFAULT", preset="colorchecker/19-white-9-5", sigma=0.2)
    light_and_camera()
    assert OPS.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    group = green.rough_spectra
    group.kind, group.model = "reading", "two-bounce"
    assert any(line.startswith("Fits up to") for line in drawn())
    assert sentence_with("Matched to one color of light")
    node = next(node for node in green.node_tree.nodes if node.type == "BSDF_DIFFUSE")
    node.inputs["Color"].default_value = (0.5, 0.1, 0.1, 1)
    page = drawn()
    assert any(line.startswith("Fits up to") for line in page)
    assert not any(line.startswith(("Matched to", "Sun")) for line in page)
    group.instrument = "di:8"
    assert not any(line.startswith("Fits up to") for line in drawn())


def test_another_engine_is_named_as_what_limits(green):
    in_cycles = float(next(line for line in drawn() if "All angles" in line).split()[-3].strip(","))
    bpy.context.scene.render.engine = EEVEE
    drawn()
    icons._work()
    page = drawn()
    assert any("only Cycles shows the roughness" in line for line in page)
    _, mean, _ = differences(green)
    assert mean > 2 * in_cycles


def sentence_with(beginning):
    """The sentence that begins so, with the line after it, or an empty text."""
    page = drawn()
    return next(
        (" ".join(page[i : i + 2]) for i, line in enumerate(page) if line.startswith(beginning)), ""
    )


def test_under_an_engine_without_roughness_the_sentences_are_of_what_it_shows(green):
    scene = bpy.context.scene
    assert sentence_with("Model surface")
    assert sentence_with("Material rough")
    scene.render.engine = EEVEE
    assert sentence_with("Target of the model surface")
    assert not sentence_with("Model")
    assert "analyze the scene" in sentence_with("Material lambert: this engine leaves")
    light_and_camera()
    assert OPS.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    assert "right for its scene" in sentence_with("Material lambert: the render engine ignores")
    assert sentence_with("What differs: only Cycles shows")
    green.rough_spectra.use_scene = False
    assert "Light from the Scene" in sentence_with("Material lambert: this engine leaves")


def test_what_the_match_to_the_scene_leaves_open_is_no_matter_of_the_gamut(green):
    """Brick was said not to be held by a working space that holds it, with a button to widen it."""
    OPS.assign_preset("EXEC_DEFAULT", preset="everyday/brick", sigma=math.radians(30))
    light_and_camera()
    assert OPS.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    missed = json.loads(green.rough_spectra.stamp)["delta_e_instrument"]
    assert missed > 0.05
    assert f"so 45°/0° differs by ΔE00 {missed:.2f}" in sentence_with("Matched to the light")
    assert "rough_spectra.use_wide_gamut" not in drawn()
    OPS.assign_preset("EXEC_DEFAULT", preset="colorchecker/18-cyan", sigma=0.0)
    assert sentence_with("What differs: Linear Rec.709")  # under the same light
    if hasattr(bpy.data, "colorspace"):
        assert "rough_spectra.use_wide_gamut" in drawn()


def test_workbench_is_said_to_show_no_materials(green):
    bpy.context.scene.render.engine = "BLENDER_WORKBENCH"
    drawn()
    icons._work()
    assert sentence_with("Workbench shows no materials")
    assert "rough_spectra.switch_to_cycles" in drawn()


def test_what_was_matched_for_eevee_is_renewed_for_cycles_where_it_says_so(green):
    light_and_camera()
    bpy.context.scene.render.engine = EEVEE
    assert OPS.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    page = drawn()
    assert "rough_spectra.renew" not in page
    bpy.context.scene.render.engine = "CYCLES"
    assert sentence_with("Matched for Eevee, which shows no roughness")
    assert "rough_spectra.renew" in drawn()
    OPS.renew()
    assert not sentence_with("Matched for Eevee")
    bpy.context.scene.render.engine = EEVEE  # where Light from the Scene is checked already
    drawn()
    icons._work()
    assert "analyze the scene" in sentence_with("Material lambert: this engine leaves")
    assert drawn().count("rough_spectra.analyze_scene") == 2


def test_the_scene_of_an_analysis_is_named_where_it_is_another(green):
    light_and_camera()
    assert OPS.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    assert not sentence_with("Analyzed in scene")
    bpy.context.scene.name = "Elsewhere"
    assert sentence_with("Analyzed in scene 'Scene'")


@pytest.mark.parametrize(
    ("cold", "instrument", "limit"),
    [(2.9, 0.0, "no one color"), (2.1, 1.8, "no one color"), (2.1, 0.2, "slanting light")],
)
def test_the_lights_limit_only_where_they_contradict_each_other(green, cold, instrument, limit):
    found = json.loads(green.rough_spectra.stamp)
    found |= {"delta_e_lights": [["Warm", 2.0], ["Cold", cold]], "delta_e_instrument": instrument}
    green.rough_spectra.stamp = json.dumps(found)
    assert sentence_with(f"What differs: {limit}")


def test_a_smooth_surface_is_the_same_in_every_engine(green):
    green.rough_spectra.sigma = 0.0
    for engine in ("CYCLES", EEVEE):
        bpy.context.scene.render.engine = engine
        drawn()
        icons._work()
        assert sentence_with("Nothing differs")
        assert sentence_with("Material lambert: within ΔE00 1 in all directions, at most 0.00")


def test_what_another_node_sets_is_not_compared(green):
    links = green.node_tree.links
    node = next(node for node in green.node_tree.nodes if node.type == "BSDF_DIFFUSE")
    noise = green.node_tree.nodes.new("ShaderNodeTexNoise")
    links.new(noise.outputs["Color"], node.inputs["Color"])
    page = drawn()
    assert "Color comes from another node" in page
    assert "no one color to compare" in sentence_with("Color or roughness comes from another")
    assert not any("ΔE00" in line for line in page)
    assert "There is no one color to plot" in page
    assert not any(line.startswith("picture") for line in page)


def test_no_two_lines_sound_as_if_they_contradicted_each_other(green):
    """What looks right may be off where it slants: what is right is said first."""
    OPS.assign_preset("EXEC_DEFAULT", preset="everyday/brick", sigma=math.radians(20))
    page = " ".join(drawn())
    assert "All angles, mean: ΔE00 0.51, not visible" in page
    [(most, share)] = re.findall(
        r"Material rough: looks right from the front; at slanting angles up to ΔE00 (\S+) "
        r"\((\d+) % of directions\); without roughness up to \d",
        page,
    )
    assert int(share) < 15
    reason = json.loads(green.rough_spectra.stamp)["shader_reason"]
    assert f"in {share} % of directions, all slanting, at most {most};" in reason
    assert "off by more than" not in page
    assert "worst" not in page
    stamp = green.rough_spectra.stamp
    wider = reason.replace("more than ΔE00 1 in", "more than ΔE00 2.5 in")
    green.rough_spectra.stamp = json.dumps(json.loads(stamp) | {"shader_reason": wider})
    assert "rough: within ΔE00 2.5 from the front; at slanting" in " ".join(drawn())
    green.rough_spectra.stamp = stamp
    green.rough_spectra.gloss = 0.5
    page = " ".join(drawn())
    assert len(re.findall("kept|include the gloss", page)) == 1  # said once


def test_gloss_is_counted_and_can_be_removed(green):
    green.rough_spectra.shader = "PRINCIPLED"
    node = next(node for node in green.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    assert "rough_spectra.remove_gloss" not in drawn()
    node.inputs["Specular IOR Level"].default_value = 0.1
    assert sentence_with("Its gloss was changed")
    OPS.renew()
    page = drawn()
    assert "45°/0°: ΔE00 0.00, not visible" in page
    assert any(" with gloss: " in line for line in page)
    assert "rough_spectra.remove_gloss" in page
    assert OPS.remove_gloss() == {"FINISHED"}
    assert node.inputs["Specular IOR Level"].default_value == 0
    page = drawn()
    assert "45°/0°: ΔE00 0.00, not visible" in page
    assert "rough_spectra.remove_gloss" not in page
    with pytest.raises(RuntimeError, match="there is none to remove"):
        OPS.remove_gloss()


def test_a_measurement_of_what_is_not_predicted_stands_alone(green):
    green.rough_spectra.shader = "PRINCIPLED"
    node = next(node for node in green.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    assert any("ΔE00" in line for line in drawn())
    node.inputs["Metallic"].default_value = 0.5
    for act in (lambda: None, lambda: storage.keep(green)):
        act()
        page = drawn()
        assert any("No ΔE00 is predicted with Metallic" in line for line in page)
        assert not any("ΔE00 0" in line for line in page)
        assert "There is no color to plot" in page
        assert not any(line.startswith("picture") for line in page)
    last_measurement.note(green, last_measurement.fingerprint(green), (0.1, 0.2, 0.1), 5.5)
    page = drawn()
    assert "Measured: ΔE00 5.50, visible" in page
    assert not any(line.startswith("Predicted") for line in page)


def test_bump_is_said_not_to_be_counted(green):
    tree = green.node_tree
    assert not sentence_with("Bump is not counted")
    node = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    tree.links.new(tree.nodes.new("ShaderNodeBump").outputs[0], node.inputs["Normal"])
    assert sentence_with("Bump is not counted")
    assert "45°/0°: ΔE00 0.00, not visible" in drawn()


def test_in_a_narrow_region_the_numbers_stand_below_the_swatches(green):
    wide = drawn()
    narrow = drawn(context(region=types.SimpleNamespace(width=230)))
    assert any("ΔE00" in line for line in wide)
    assert "45°/0°: ΔE00 0.00, not visible" in narrow


def test_wrapped_numbers_begin_with_a_mark_each(green):
    for beside in (False, True):
        narrow = text.Format(200, False, 1.0, 11.0)
        told = sentences.numbers((1.0, 1.0, 1.0), "45a:0", beside, sentences.style(narrow))
        assert len(told) == 3
        assert any(len(lines) > 1 for lines in told)
        for (_, first), *others in told:
            assert first == ICONS["DOT"]
            assert {icon for _, icon in others} <= {ICONS["BLANK1"]}


def test_the_corner_of_a_swatch_is_explained_where_it_is():
    assert "corner marks a color that your screen cannot" in difference.TOOLTIP
    assert bpy.types.ROUGHSPECTRA_PT_difference.__doc__ == difference.TOOLTIP


def test_in_a_narrow_region_a_box_to_check_has_its_own_name(green, monkeypatch):
    """It read Light from the Scene, and below it Yes."""
    light_and_camera()
    assert OPS.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    told, real = {}, Layout.prop

    def prop(self, data, name, *, text=None, **options):
        told[name] = data.bl_rna.properties[name].name if text is None else text
        real(self, data, name, text=text, **options)

    monkeypatch.setattr(Layout, "prop", prop)
    page = drawn(context(region=types.SimpleNamespace(width=230)))
    assert told["use_scene"] == "Light from the Scene"
    assert "Light from the Scene" not in page  # no second time above it
    assert "Tolerance" in page  # as names of numbers stand


def test_what_the_scene_decided_is_said_without_names_of_shaders(green):
    OPS.assign_preset("EXEC_DEFAULT", preset="everyday/brick", sigma=math.radians(30))
    light_and_camera()
    assert OPS.analyze_scene("EXEC_DEFAULT") == {"FINISHED"}
    page = " ".join(drawn())
    assert re.search(r"rough: ΔE00 \S+ off on average in its scene; without roughness it is", page)
    assert "would be off" not in page


def light_and_camera():
    """Put both above the wall: the light low, the camera close, so that directions differ."""
    scene = bpy.context.scene
    lens = bpy.data.cameras.new("Camera")
    lens.lens = 12
    camera = bpy.data.objects.new("Camera", lens)
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.rotation_euler.x = 1
    for thing in (camera, sun):
        thing.location.z = 1
        scene.collection.objects.link(thing)
    scene.camera = camera
    bpy.context.view_layer.update()


def test_a_measurement_stands_beside_the_prediction(green):
    rgb = (0.1, 0.2, 0.1)
    last_measurement.note(green, last_measurement.fingerprint(green), rgb, 0.004)
    page = drawn()
    at = page.index("Predicted: ΔE00 0.00, not visible")
    assert page[at + 1] == "Measured: ΔE00 0.00, not visible"
    assert not any("before the last change" in line for line in page)
    green.rough_spectra.sigma = 0.3
    assert any("before the last change" in line for line in drawn())


def test_a_linked_material_is_not_to_be_changed_here(scene_file):
    with bpy.data.libraries.load(str(scene_file), link=True) as (_, wanted):
        wanted.materials = ["Alpha"]
    (linked,) = wanted.materials
    mesh_object("Wall", linked)
    page = drawn()
    assert any("linked" in line for line in page)
    assert "rough_spectra.renew" not in page
    assert "enabled: False" in page


def test_the_settings_of_an_override_can_be_changed(scene_file):
    with bpy.data.libraries.load(str(scene_file), link=True) as (_, wanted):
        wanted.materials = ["Alpha"]
    (linked,) = wanted.materials
    mesh_object("Wall", linked.override_create())
    page = drawn()
    assert any("library override" in line for line in page)
    assert "enabled: True" in page


def test_the_sidebar_of_the_shader_editor_shows_the_same(green):
    space = types.SimpleNamespace(edit_tree=green.node_tree, id=green)
    page = drawn(context("NODE_EDITOR", space_data=space))
    assert page[0] == "[Rough Spectra]"
    assert "[Difference]" in page
    other = types.SimpleNamespace(edit_tree=None, id=None)
    assert drawn(context("NODE_EDITOR", space_data=other)) == []


def test_right_click_menus_offer_to_measure_what_was_clicked(green):
    for space in ("VIEW_3D", "PROPERTIES", "OUTLINER"):
        menu = types.SimpleNamespace(layout=Layout())
        menus.draw_measure(menu, context(space))
        assert menu.layout.page == ["rough_spectra.measure"]
    for name in menus._MENUS:
        assert menus.draw_measure in getattr(bpy.types, name)._dyn_ui_initialize()


def test_what_has_not_changed_is_not_composed_again(green):
    def composed():
        return [
            made.cache_info().misses
            for made in (sentences.difference, sentences.numbers, sentences.scene)
        ]

    drawn()
    before = composed()
    drawn()
    assert composed() == before
    green.rough_spectra.sigma = 0.6
    assert composed() == before
    drawn()
    assert composed() != before


def test_a_panel_by_itself_asks_anew(green):
    """As with `wm.call_panel`, where none around it has asked."""
    drawn()
    green.rough_spectra.model = "lambert"
    other = context(region=types.SimpleNamespace(width=300))
    page = []
    bpy.types.ROUGHSPECTRA_PT_difference.draw(types.SimpleNamespace(layout=Layout(page)), other)
    assert any("Material rough" in line or "Material lambert" in line for line in page)
    assert not any(line.startswith("Model") for line in page)


def test_a_number_stays_in_one_line_with_what_it_is_of():
    sentence = (
        "At most ΔE00 0.31 from 380 nm on, 5 % of it at 2856 K; σ = 30° and 13 Kinds of 4 nmX"
    )
    kept = [word.replace(text._GLUE, " ") for word in text._words(sentence) if text._GLUE in word]
    assert kept == ["ΔE00 0.31", "380 nm", "5 %", "2856 K;", "σ = 30°"]
    assert " ".join(text._words(sentence)).replace(text._GLUE, " ") == sentence
    for width in range(80, 400, 5):
        lines = text._lines(sentence, width, 11.0, 1.0)
        assert " ".join(lines) == sentence
        assert all(any(part in line for line in lines) for part in kept)
