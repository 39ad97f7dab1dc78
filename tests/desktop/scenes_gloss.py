# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gloss that is dragged, textures that are looked at, and other instruments."""

from pathlib import Path

import bpy
import numpy as np
from driver import TICK, area, find, middle, move, over, press, scene, window
from scenes_background import children, jobs
from stage import GREEN, OPS, empty_file, green_file, ours, state, undo_step, wall

GLOSSY = ("Specular IOR Level", "Roughness")


def _ended():
    return not jobs()


def _node(name="ShaderNodeBsdfPrincipled"):
    tree = wall().node_tree
    return next(node for node in tree.nodes if node.bl_idname == name)


def _draw_sliders(self, _context):
    """Draw the sliders of the gloss, which Blender keeps in a panel that is folded."""
    for name in GLOSSY:
        self.layout.prop(_node().inputs[name], "default_value", text=name, slider=True)


def _slider(where, node, name):
    """Move over an area until the socket of a node is under the pointer; returns the point."""
    seen = set()
    x = where.x + int(where.width * 0.7)
    for y in range(where.y + where.height - 4, where.y, -8):
        yield from move(x, y)
        with over(where):
            copy = bpy.ops.ui.copy_data_path_button
            if not copy.poll() or copy(full_path=True) != {"FINISHED"}:
                continue
        found = bpy.context.window_manager.clipboard
        seen.add(found)
        number = node.inputs.find(name)
        if found.endswith((f"inputs[{number}].default_value", f'inputs["{name}"].default_value')):
            yield from move(x, y - 4)
            return x, y - 4
    msg = f"{node.name}: {name} is not in the {where.type} editor, but {seen} are"
    raise LookupError(msg)


def _drag(x, y, by):
    """Drag a slider, and tell what there is at each step."""
    seen = []
    window().event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    yield TICK
    for step in range(1, 7):
        yield from move(x + by * step, y)
        yield 2 * TICK
        seen.append(_reads())
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=x + 6 * by, y=y)
    yield 0.3
    return seen


def _reads():
    """Tell the gloss, the color below it, and how far the whole is from the sample's reading."""
    api, node = ours("addon.api"), _node()
    return {
        "gloss": [round(node.inputs[name].default_value, 4) for name in GLOSSY],
        "color": [round(value, 6) for value in node.inputs["Base Color"].default_value[:3]],
        "kind": state()["kind"],
        "apart": api.differences(wall())[0],
    }


@scene
def dragging_the_sockets(found):
    """Drag specular level and roughness of a Principled BSDF, and undo."""
    yield from empty_file()
    material = bpy.data.materials.new("Paint")
    bpy.data.objects["Wall"].active_material = material
    panel = area("PROPERTIES")
    with over(panel):
        OPS.assign_preset("EXEC_DEFAULT", preset=GREEN)
    undo_step("Green")
    yield 0.5
    found["before"] = _reads()
    ours_of = bpy.types.ROUGHSPECTRA_PT_material
    ours_of.prepend(_draw_sliders)
    panel.tag_redraw()
    yield 0.5
    found["dragged"] = {}
    for name, by in zip(GLOSSY, (6, -8), strict=True):
        x, y = yield from _slider(panel, _node(), name)
        found["dragged"][name] = yield from _drag(x, y, by)
    found["after"] = _reads()
    yield from press("Z", ctrl=True)
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = _reads()
    ours_of.remove(_draw_sliders)


def _textured():
    """Let an image of two halves be the color of the wall, of which it shows one."""
    picture = bpy.data.images.new("Halves", 64, 64, float_buffer=True)
    pixels = np.full((64, 64, 4), 0.5, np.float32)
    pixels[:, :32, :3] = 0.25
    picture.pixels.foreach_set(pixels.ravel())
    picture.pack()
    material = bpy.data.materials.new("Bricks")
    thing = bpy.data.objects["Wall"]
    thing.active_material = material
    layer = thing.data.uv_layers.new(name="UVMap")
    uv = np.array([(0, 0), (0.25, 0), (0.25, 1), (0, 1)], np.float32) + np.float32(0.125)
    layer.uv.foreach_set("vector", uv.ravel())
    tree = material.node_tree
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = picture
    shader = ours("addon.blender.surface").shader_node(material)
    tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    shader.inputs["Specular IOR Level"].default_value = 0
    undo_step("Bricks")


def _scale():
    shader = ours("addon.blender.surface").shader_node(wall())
    scale = ours("addon.blender.texture_scale")
    node = scale.node_of(shader.inputs["Base Color"])
    return None if node is None else list(scale.factors(node))


@scene
def choosing_for_a_texture(found):
    """Import a sample onto a texture and stop; choose one, working meanwhile; and undo."""
    yield from empty_file()
    _textured()
    path = Path(bpy.app.tempdir) / "gray.csv"
    path.write_text("nm,Gray\n" + "\n".join(f"{nm},0.2" for nm in range(400, 701, 20)))
    yield 0.5
    for way in ("stopped", "whole"):
        with over(area("PROPERTIES")):
            if way == "stopped":
                OPS.import_samples("EXEC_DEFAULT", filepath=str(path), materials="ASSIGN")
            else:
                OPS.choose_sample("EXEC_DEFAULT", sample="colorchecker/22-neutral-5")
        yield lambda: bool(jobs())
        found[f"{way}_modal"] = [op.bl_idname for op in window().modal_operators]
        yield from move(*middle(area("TEXT_EDITOR")))
        yield from move(*middle(area("PROPERTIES")))
        found[f"{way}_ran"] = bool(children())
        if way == "stopped":
            yield from press("ESC")
            yield 0.5
            found["left"] = [len(children()), len(jobs()), _scale(), wall().rough_spectra.spectrum]
            folder = ours("addon.material.preferences").user_folder()
            found["imported"] = (folder / "gray.json").exists()
    yield _ended
    yield 0.5
    found["scale"], found["kind"] = _scale(), state()["kind"]
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = [_scale(), wall().rough_spectra.spectrum]
    api, plain = ours("addon.api"), bpy.data.materials.new("Plain")
    [solution] = api.assign([(plain, api.find("colorchecker/22-neutral-5"))], gloss="none")
    found["plain"] = list(solution.color)


@scene
def reading_at_another_instrument(found):
    """Choose an instrument in the list, measure there, and undo."""
    yield from green_file()
    panel = area("PROPERTIES")
    found["before"] = state()
    x, y = yield from find(panel, "read_at")
    window().event_simulate(type="LEFTMOUSE", value="PRESS", x=x, y=y)
    yield TICK
    window().event_simulate(type="LEFTMOUSE", value="RELEASE", x=x, y=y)
    yield 0.5
    for _ in range(2):
        yield from press("DOWN_ARROW")
    yield from press("RET")
    yield 0.5
    found["read_at"], found["chosen"] = wall().rough_spectra.read_at, state()
    with over(panel):
        OPS.measure("EXEC_DEFAULT")
    yield lambda: bool(jobs())
    yield _ended
    yield 0.5
    measured = ours("addon.material.last_measurement").get(wall())
    found["measured"] = [measured.delta_e, measured.current]
    for _ in range(2):
        yield from press("Z", ctrl=True)
        yield 0.3
    found["undone"] = [wall().rough_spectra.read_at, state()]


@scene
def matching_by_measuring(found):
    """Match a mix of two shaders, stop it once, and undo."""
    yield from green_file()
    tree, shader = wall().node_tree, ours("addon.blender.surface").shader_node(wall())
    mix, sheen = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("MixShader", "BsdfSheen"))
    mix.inputs[0].default_value = 0.2
    tree.links.new(shader.outputs[0], mix.inputs[1])
    tree.links.new(sheen.outputs[0], mix.inputs[2])
    output = tree.get_output_node("CYCLES")
    tree.links.new(mix.outputs[0], output.inputs["Surface"])
    undo_step("Mix")
    yield 0.3
    color = ours("addon.blender.sockets").color_socket
    name = shader.name
    found["before"] = list(color(shader).default_value)
    for way in ("stopped", "whole"):
        with over(area("PROPERTIES")):
            OPS.match_by_measuring("EXEC_DEFAULT", color=f"{name}: Base Color")
        yield lambda: bool(jobs())
        found[f"{way}_ran"] = bool(children())
        if way == "stopped":
            yield from press("ESC")
            yield 0.5
            found["left"] = [len(children()), len(jobs())]
            found["same"] = list(color(wall().node_tree.nodes[name]).default_value)
    yield lambda: not window().modal_operators
    yield 0.5
    found["after"] = list(color(wall().node_tree.nodes[name]).default_value)
    measured = ours("addon.material.last_measurement").get(wall())
    found["measured"] = None if measured is None else measured.delta_e
    yield from press("Z", ctrl=True)
    yield 0.5
    found["undone"] = list(color(wall().node_tree.nodes[name]).default_value)
