# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A measurement leaves the open file as it was: every property, flag, path and selection."""

import bpy
import numpy as np
import pytest
from rough_spectra.addon.instrument.measure import RING_45_0, Measurement, measure
from rough_spectra.addon.material import derive

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")  # all properties are read
SKIPPED = {"rna_type", "bl_rna", "original", "storage_type"}
"""Python's view of the data, not the data; reading a mesh attribute settles its storage."""
WINDOWS = {"window_managers", "screens", "workspaces"}
"""Only counted and named: without a window Blender 4.5 crashes on some of their properties."""


def dump(thing, depth=0, seen=None):
    """Every property below a datablock, as plain Python; other datablocks only by name."""
    seen = set() if seen is None else seen
    if thing is None or thing.as_pointer() in seen or depth > 12:
        return None
    seen.add(thing.as_pointer())
    found = {}
    for prop in thing.bl_rna.properties:
        name = prop.identifier
        if name in SKIPPED or name.startswith("bl_"):
            continue
        try:
            content = getattr(thing, name)
        except (AttributeError, TypeError, ValueError):
            continue
        if prop.type == "POINTER":
            if isinstance(content, bpy.types.ID) and not content.is_embedded_data:
                found[name] = content.name_full
            elif content is not None:
                found[name] = dump(content, depth + 1, seen)
        elif prop.type == "COLLECTION":
            found[name] = [
                item.name_full
                if isinstance(item, bpy.types.ID) and not item.is_embedded_data
                else dump(item, depth + 1, seen)
                for item in content
            ]
        elif getattr(prop, "is_array", False):
            found[name] = repr(np.array(content).tolist())
        else:
            found[name] = repr(content)
    try:
        custom = thing.items()
    except (AttributeError, TypeError):
        return found
    return found | {f"[{key}]": repr(content) for key, content in custom}


def whole_file():
    """Every datablock of every collection, with users and flags, and the state around them."""
    data = {}
    for prop in bpy.data.bl_rna.properties:
        if prop.type == "COLLECTION":
            blocks = getattr(bpy.data, prop.identifier)
            data[prop.identifier] = [
                (
                    *(block.name_full, block.users, block.use_fake_user, block.tag),
                    None if prop.identifier in WINDOWS else dump(block),
                )
                for block in blocks
            ]
        else:
            data[prop.identifier] = repr(getattr(bpy.data, prop.identifier))
    context = bpy.context
    data["context"] = (
        context.scene.name,
        context.view_layer.name,
        context.mode,
        getattr(context.view_layer.objects.active, "name", None),
        [thing.name for thing in context.selected_objects],
        context.scene.frame_current_final,
    )
    return data


def differences(before, after, path=""):
    """Paths at which two dumps differ."""
    if isinstance(before, dict) and isinstance(after, dict):
        return [
            line
            for key in sorted({*before, *after}, key=str)
            for line in differences(before.get(key), after.get(key), f"{path}.{key}")
        ]
    if isinstance(before, list | tuple) and isinstance(after, list | tuple):
        if len(before) != len(after):
            return [f"{path}: {len(before)} items became {len(after)}"]
        return [
            line
            for i, pair in enumerate(zip(before, after, strict=True))
            for line in differences(*pair, f"{path}[{i}]")
        ]
    return [] if before == after else [f"{path}: {before!r} became {after!r}"]


@pytest.fixture
def lived_in(make_material, colorchecker, request_for, tmp_path):
    """A saved file as a user has it: library, image, selection, edited render settings."""
    library = tmp_path / "library.blend"
    make_material("Linked", Color=(0.1, 0.4, 0.2, 1)).use_fake_user = True
    bpy.ops.wm.save_as_mainfile(filepath=str(library))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    image = bpy.data.images.new("Pattern", 8, 8)
    image.pixels[:] = np.tile([0.2, 0.4, 0.6, 1.0], 64).tolist()
    image.filepath_raw = str(tmp_path / "pattern.png")
    image.file_format = "PNG"
    image.save()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    with bpy.data.libraries.load(str(library), link=True, relative=True) as (_, wanted):
        wanted.materials = ["Linked"]
    linked = wanted.materials[0]
    image.filepath = "//pattern.png"
    spectral = make_material("Spectral")
    derive.assign([(spectral, request_for(colorchecker[3]))])
    textured = make_material("Textured")
    tree = textured.node_tree
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    tree.links.new(texture.outputs[0], tree.nodes["Diffuse BSDF"].inputs["Color"])
    make_material("Unused and unsaved by users").use_fake_user = False
    kept = make_material("Kept")
    kept.use_fake_user, kept.tag = True, True
    scene = bpy.context.scene
    for i, material in enumerate((spectral, textured, linked)):
        mesh = bpy.data.meshes.new(f"Mesh {i}")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
        mesh.materials.append(material)
        thing = bpy.data.objects.new(f"Object {i}", mesh)
        scene.collection.objects.link(thing)
        thing.select_set(i != 1)
        bpy.context.view_layer.objects.active = thing
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.render.filepath = "//frames/shot_####"
    scene.render.resolution_x, scene.render.resolution_percentage = 333, 71
    scene.cycles.samples, scene.cycles.seed = 77, 5
    scene.view_settings.exposure = 0.7
    scene.frame_set(42, subframe=0.25)
    bpy.ops.wm.save_mainfile()
    return [spectral, textured, linked, kept, bpy.data.materials["Unused and unsaved by users"]]


def test_the_dump_sees_each_kind_of_change(lived_in):
    """Else the next tests prove nothing."""
    before = whole_file()
    assert differences(before, whole_file()) == []
    scene = bpy.context.scene
    for change, where in (
        (lambda: setattr(scene.cycles, "samples", 78), "samples"),
        (lambda: setattr(scene.render, "filepath", "/tmp/x"), "filepath"),
        (lambda: bpy.data.objects["Object 1"].select_set(True), "context"),
        (lambda: setattr(bpy.data.images["Pattern"], "filepath", "/abs.png"), "images"),
        (lambda: setattr(lived_in[4], "use_fake_user", True), "materials"),
        (lambda: bpy.data.meshes.new("more"), "meshes"),
        (lambda: setattr(lived_in[0].rough_spectra, "sigma", 0.3), "sigma"),
        (lambda: setattr(lived_in[1].node_tree.nodes[0], "location", (5, 5)), "location"),
    ):
        change()
        after = whole_file()
        assert any(where in line for line in differences(before, after)), where
        before = after


def test_measuring_changes_nothing_in_the_open_file(lived_in, tmp_path):
    if bpy.app.version >= (5, 0, 0):  # without a window, 4.5 keeps calling a saved file dirty
        assert not bpy.data.is_dirty
    first, second, third = (tmp_path / f"{n}.blend" for n in ("first", "second", "third"))
    before = whole_file()
    bpy.ops.wm.save_as_mainfile(filepath=str(first), copy=True, compress=False)
    bpy.ops.wm.save_as_mainfile(filepath=str(second), copy=True, compress=False)
    seen = measure(lived_in, [RING_45_0])
    assert seen.shape == (1, 5, 2, 3)
    assert (seen[0, :, 0] > 0).all()
    # The texture, found through its relative path, and the material of the library.
    np.testing.assert_allclose(seen[0, 2, 0], [0.1, 0.4, 0.2], rtol=1e-5)
    assert seen[0, 1, 0, 2] > seen[0, 1, 0, 0] > 0.02
    assert differences(before, whole_file()) == []
    bpy.ops.wm.save_as_mainfile(filepath=str(third), copy=True, compress=False)
    # Blender writes the same bytes twice in a row, so a measurement in between may change none.
    assert first.read_bytes() == second.read_bytes()
    assert second.read_bytes() == third.read_bytes()


def test_a_cancelled_measurement_changes_nothing_either(lived_in):
    before = whole_file()
    measurement = Measurement(lived_in, [RING_45_0] * 500)
    measurement.poll()
    folder, process = measurement._folder, measurement._process
    assert folder.exists()
    measurement.close()
    assert not folder.exists()
    assert process.poll() is not None
    assert differences(before, whole_file()) == []


def test_a_measurement_that_raises_leaves_no_process_and_no_folder(lived_in):
    before = whole_file()

    class StopError(Exception):
        pass

    def progress(_done, _total):
        raise StopError

    with pytest.raises(StopError):
        measure(lived_in, [RING_45_0] * 500, progress)
    assert differences(before, whole_file()) == []


def test_the_same_measurement_twice_gives_the_same_bits(lived_in):
    np.testing.assert_array_equal(measure(lived_in, [RING_45_0]), measure(lived_in, [RING_45_0]))
