# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything a user can point at says what it is, as Blender's own buttons do."""

import bpy
import pytest

from tests.integration.support import rgb_material
from tests.integration.test_operators import mesh_object

OPS = bpy.ops.rough_spectra
BLENDERS_OWN = {"rna_type", "name", "bl_idname"}


def kinds():
    """Every type of ours that has properties, by name."""
    operators = {f"operator {n}": getattr(OPS, n).get_rna_type() for n in dir(OPS)}
    groups = {
        name: getattr(bpy.types, name).bl_rna
        for name in dir(bpy.types)
        if name.startswith(("RoughSpectra", "ROUGHSPECTRA_P", "ROUGHSPECTRA_U"))
    }
    return operators | groups


def told():
    """Each type and property with its label and tooltip."""
    for name, kind in kinds().items():
        if "_P" in name or "_UL_" in name:
            # Blender takes the docstring of a class as the tooltip of its panel.
            yield name, kind.name, getattr(bpy.types, name).__doc__
            continue
        yield name, kind.name, kind.description
        own = [p for p in kind.properties if p.identifier not in BLENDERS_OWN]
        base = {p.identifier for p in bpy.types.AddonPreferences.bl_rna.properties}
        for item in own:
            if item.identifier in base or (item.is_readonly and item.type == "POINTER"):
                continue
            yield f"{name}.{item.identifier}", item.name, item.description
            for choice in getattr(item, "enum_items", ()):
                yield f"{name}.{item.identifier}={choice.identifier}", choice.name, "-"


def test_every_label_and_tooltip_is_there_and_ends_without_a_period(extension):
    seen = list(told())
    assert len(seen) > 100
    assert [name for name, label, _ in seen if not label] == []
    assert [name for name, _, tooltip in seen if not tooltip] == []
    assert [name for name, label, tip in seen if label.endswith(".") or tip.endswith(".")] == []


def test_operators_are_found_by_different_names(extension):
    labels = [kind.name for name, kind in kinds().items() if name.startswith("operator")]
    twice = {label for label in labels if labels.count(label) > 1}
    # The second one is the first one's dialog, which search leaves out.
    assert twice <= {"Import Spectra"}


def test_a_button_that_is_off_says_why(extension):
    for name in dir(OPS):
        operator = getattr(OPS, name)
        if operator.poll():
            continue
        with pytest.raises(RuntimeError, match="poll") as caught:
            operator()
        said = str(caught.value).strip()
        assert "context is incorrect" not in said, name
    mesh_object("Wall", rgb_material("Wall"))
    assert not OPS.keep.poll()
    with pytest.raises(RuntimeError, match="assign one first"):
        OPS.keep()
