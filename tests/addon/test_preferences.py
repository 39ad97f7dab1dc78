# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The preferences lead to what there is to read."""

import types
from pathlib import Path

import bpy
import pytest
from rough_spectra.addon.material.preferences import RoughSpectraPreferences
from rough_spectra.addon.support import version


class Layout:
    """Notes the buttons that are drawn."""

    def __init__(self):
        self.buttons = {}

    def column(self):
        return self

    def label(self, **_options):
        pass

    def prop(self, _data, name, **_options):
        assert name in RoughSpectraPreferences.__annotations__

    def operator(self, name, **options):
        module, _, function = name.partition(".")
        kind = getattr(getattr(bpy.ops, module), function).get_rna_type()
        button = types.SimpleNamespace(**dict.fromkeys(kind.properties.keys()))
        self.buttons[options.get("text", kind.name)] = button
        return button


@pytest.mark.parametrize("website", ["", "https://example.org/"])
def test_there_is_a_button_to_read_on(monkeypatch, website):
    known = version._manifest() | ({"website": website} if website else {})
    monkeypatch.setattr(version, "_manifest", lambda: known)
    drawn = types.SimpleNamespace(layout=Layout())
    RoughSpectraPreferences.draw(drawn, None)
    buttons = drawn.layout.buttons
    if website:
        assert buttons["Manual"].url == website
        assert "Read Me" not in buttons
    else:
        assert "## First material" in Path(buttons["Read Me"].filepath).read_text("utf-8")
        assert "Manual" not in buttons
