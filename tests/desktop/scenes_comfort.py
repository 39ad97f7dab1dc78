# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Search, menus, preferences, another language, and the extension switched off and on."""

import bpy
from driver import area, find, middle, move, over, press, scene, window, write
from stage import OPS, PACKAGE, empty_file, green_file, ours, state, wall

EDITORS = {"NODE": "ShaderNodeTree", "OUTLINER": "OUTLINER", "VIEW3D": "VIEW_3D"}
SEARCHED = ("measure with virtual", "choose sample", "analyze scene", "renew", "bake readings")


@scene
def searching(found):
    """Search for operators by name in each editor."""
    yield from green_file("ShaderNodeTree")
    # Something to analyze.
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    for thing in (camera, sun):
        thing.location.z = 4
        bpy.context.scene.collection.objects.link(thing)
    bpy.context.scene.camera = camera
    yield from move(*middle(area("NODE_EDITOR")))
    for words in SEARCHED:
        before = len(bpy.context.window_manager.operators)
        yield from press("F3")
        yield 0.5
        yield from write(words)
        yield 0.5
        yield from press("RET")
        yield 0.8
        ran = [op.bl_idname for op in bpy.context.window_manager.operators][before:]
        modal = [op.bl_idname for op in window().modal_operators]
        found[words] = [name for name in (*ran, *modal) if "ROUGH" in name]
        yield from press("ESC")
        yield 0.5


@scene
def sidebar_and_menus(found):
    """Draw the sidebar of the shader editor, and open the right-click menus."""
    yield from green_file("ShaderNodeTree")
    editor = area("NODE_EDITOR")
    found["material"] = editor.spaces.active.id == wall()
    editor.spaces.active.show_region_ui = True
    yield 0.5
    sidebar = next(region for region in editor.regions if region.type == "UI")
    sidebar.active_panel_category = "Rough Spectra"
    yield 1.0
    found["category"] = sidebar.active_panel_category
    drawn = []
    for name in ours("addon.interface.panels.menus")._MENUS:
        kind, where = getattr(bpy.types, name), area("PROPERTIES")
        if name.partition("_")[0] != "MATERIAL":
            editor.ui_type = EDITORS[name.partition("_")[0]]
            where = editor
            yield 1.0

        def note(_menu, _context, name=name):
            drawn.append(name)

        kind.append(note)
        yield from move(*middle(where))
        with over(where):
            bpy.ops.wm.call_menu(name=name)
        yield 0.5
        yield from press("ESC")
        kind.remove(note)
    found["drawn"] = sorted(set(drawn))


@scene
def preferences(found):
    """Set the preferences, draw them, and assign."""
    yield from empty_file()
    with bpy.context.temp_override(window=window()):
        bpy.ops.preferences.addon_show(module=PACKAGE)
    yield 1.0
    chosen = bpy.context.preferences.addons[PACKAGE].preferences
    chosen.illuminant, chosen.observer, chosen.tolerance = "A", "10", 0.5
    chosen.read_at = "di:8"
    for other in bpy.data.window_managers[0].windows[1:]:
        with bpy.context.temp_override(window=other):
            bpy.ops.wm.window_close()
    yield 0.5
    with over(area("PROPERTIES")):
        OPS.choose_sample("EXEC_DEFAULT", sample="colorchecker/14-green")
    group = wall().rough_spectra
    chosen.library_folder = bpy.app.tempdir
    found["library"] = ours("addon.material.preferences").user_folder().samefile(bpy.app.tempdir)
    chosen.library_folder = ""
    found["new"] = [group.illuminant, group.observer, round(group.tolerance, 3), group.read_at]
    bpy.ops.wm.save_userpref()
    chosen.illuminant, chosen.observer, chosen.tolerance = "D65", "2", 1.0
    chosen.read_at = "45a:0"
    bpy.ops.wm.read_userpref()
    yield 0.5
    chosen = bpy.context.preferences.addons[PACKAGE].preferences
    saved = [chosen.illuminant, chosen.observer, round(chosen.tolerance, 3), chosen.read_at]
    found["saved"] = saved
    chosen.illuminant, chosen.observer, chosen.tolerance = "D65", "2", 1.0
    chosen.read_at = "45a:0"
    bpy.ops.wm.save_userpref()


GERMAN = {
    ("*", "Measured"): "Gemessen",
    ("*", "Predicted"): "Vorhergesagt",
    ("*", "not visible"): "nicht sichtbar",
    ("Operator", "Renew"): "Erneuern",
    ("*", "{materials}: {sample} assigned"): "{sample} an {materials} vergeben",
}


@scene
def another_language(found):
    """Draw in German, as far as a few words go."""
    yield from green_file()
    found["before"] = _measurement()
    view = bpy.context.preferences.view
    bpy.app.translations.register("desktop tests", {"de_DE": GERMAN})
    view.language = "de_DE"
    view.use_translate_interface = view.use_translate_reports = True
    yield 1.0
    found["drawn"] = _measurement()
    with over(area("PROPERTIES")):
        OPS.choose_sample("EXEC_DEFAULT", sample="colorchecker/14-green")
    label = OPS.renew.get_rna_type()
    found["label"] = bpy.app.translations.pgettext_iface(label.name, label.translation_context)
    yield 0.5
    view.language = "en_US"
    bpy.app.translations.unregister("desktop tests")
    found["after"] = _measurement()


def _measurement():
    """The line that the panel draws of a measurement, in the language of now."""
    sentences, text = ours("addon.interface.panels.sentences"), ours("addon.interface.panels.text")
    style = sentences.style(text.Format(600, False, 1.0, 11.0))
    read = ours("addon.material.last_measurement").LastMeasurement((0.1, 0.1, 0.1), 0.1, True)
    _, ((line, _),) = sentences.measurement(0.0, read, style)
    return line


@scene
def off_and_on(found):
    """Switch the extension off and on twice, with a material in sight."""
    yield from green_file()
    before = state()
    for _ in range(2):
        bpy.ops.preferences.addon_disable(module=PACKAGE)
        yield 1.0
        bpy.ops.preferences.addon_enable(module=PACKAGE)
        yield 1.0
    found["same"] = state() == before
    yield from find(area("PROPERTIES"), "sigma")
