# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Choosing a sample: what is loaded before it is needed, and what then becomes of materials."""

from dataclasses import asdict

import pytest
from rough_spectra.addon.samples import library, preset_index

LARGEST_STEP = 50_000  # bytes of source: some 30 ms to compile


def test_index_says_of_the_presets_what_reading_them_does():
    read = [entry for file in library.read_presets() for entry in file.entries]
    # Else: .venv/bpy-5.2/bin/python -m tools.tables.make_preset_index
    indexed = preset_index.entries()
    assert indexed is not None
    for one, other in zip(indexed, read, strict=True):
        one, other = asdict(one), asdict(other)
        for colors in ("swatch", "lab"):
            assert one.pop(colors) == pytest.approx(other.pop(colors), abs=1e-9)
        assert one == other


def test_presets_that_the_index_does_not_know_are_read(tmp_path, monkeypatch):
    known = preset_index.FILE.read_text(encoding="utf-8")
    other = tmp_path / "index.json"
    monkeypatch.setattr(preset_index, "FILE", other)
    assert preset_index.entries() is None
    for text in ("[]", "{", known.replace('"bytes": 1', '"bytes": 2', 1)):
        other.write_text(text, encoding="utf-8")
        assert preset_index.entries() is None
    other.write_text(known, encoding="utf-8")
    assert preset_index.entries()


def test_after_loading_ahead_an_assignment_brings_no_module(blender):
    found = blender("""
        extension = load_extension()
        extension.register()
        from rough_spectra.addon.interface.operators import ahead
        def ours():
            return {
                name: module.__file__ for name, module in sys.modules.items()
                if name.startswith("rough_spectra.") and module.__file__
            }
        import os
        steps, before = [], ours()
        for name in ahead.STEPS:
            importlib.import_module(f"rough_spectra.{name}")
            new = {n: os.path.getsize(f) for n, f in ours().items() if n not in before}
            steps.append([name, sum(new.values()) - new.get("rough_spectra.core.surface.data", 0)])
            before = ours()
        for work in ahead._WORK:
            work()
        before = set(sys.modules)
        mesh = bpy.data.meshes.new("Wall")
        thing = bpy.data.objects.new("Wall", mesh)
        bpy.context.collection.objects.link(thing)
        bpy.context.view_layer.objects.active = thing
        bpy.ops.rough_spectra.choose_sample("EXEC_DEFAULT", sample="everyday/brick")
        from rough_spectra.addon.preview import icons
        made = thing.active_material
        icons._make(made, [icons._Wish(made.session_uid, "sheet", 300)])
        new = [name for name in sys.modules if name not in before]
        left = [name for name in new if name.startswith(("rough_spectra.", "numpy."))]
        bpy.ops.wm.read_factory_settings(use_empty=True)
        extension.unregister()
        print(json.dumps([steps, left]))
    """)
    steps, left = found
    assert [step for step in steps if step[1] > LARGEST_STEP] == []
    assert left == []
