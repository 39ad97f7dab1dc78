# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The spectra of lamps in the interface: the file's operator, and what a .blend stores."""

import bpy
import pytest
from rough_spectra.addon.scene import chosen_light

from tests.integration.support import ROOT

LAMP = ROOT / "tests" / "fixtures" / "spdx" / "lamp.spdx"


@pytest.fixture
def light(empty_file):
    bpy.ops.object.light_add(type="POINT")
    return bpy.context.object.data


def test_a_file_becomes_the_light_s_own(light):
    assert bpy.ops.rough_spectra.open_light(filepath=str(LAMP)) == {"FINISHED"}
    group = light.rough_spectra
    assert (group.spectrum, group.sample_name, group.source) == ("MEASURED", LAMP.name, str(LAMP))
    _, words = chosen_light.known(light)
    assert words == "measured: lamp.spdx"


def test_a_file_that_is_no_light_changes_nothing(light):
    with pytest.raises(RuntimeError, match="holds no spectrum of light"):
        bpy.ops.rough_spectra.open_light(filepath=str(LAMP.with_name("tile.spdx")))
    assert light.rough_spectra.spectrum == "COLOR"
    assert light.rough_spectra.measured == ""


def test_without_a_light_the_button_says_what_to_do(light):
    bpy.ops.object.delete()
    with pytest.raises(RuntimeError, match="Select a light"):
        bpy.ops.rough_spectra.open_light(filepath=str(LAMP))


def test_the_numbers_that_files_hold_stay(light):
    group = light.rough_spectra
    items = {item.value: item.identifier for item in group.bl_rna.properties["spectrum"].enum_items}
    lights = ["D65", "A", "D50", "D55", "D75", "E", "F2", "F7", "F11", "LED-B3"]
    assert items == {100: "COLOR", 101: "MEASURED"} | dict(enumerate(lights))
    assert group.spectrum == "COLOR"
