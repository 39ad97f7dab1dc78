# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a scene's spectral picture is rendered from the interface, kept with the scene."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty
from bpy.types import PropertyGroup, Scene

from ...core import limits

if TYPE_CHECKING:
    from .render import Wanted

_MOST_RENDERS = 12
# The numbers are what a .blend stores: never give one to another item, nor change it.
BY_ITEMS = (
    ("TOLERANCE", "Tolerance", "As many renders as bring 95 % of the picture within it", 0),
    ("RENDERS", "Renders", "As many renders as you say, three bands each", 1),
)
OBSERVER_ITEMS = (
    ("2", "2°", "CIE 1931 standard observer, as everywhere in Blender", 0),
    ("10", "10°", "CIE 1964 standard observer, adapted so that daylight is white", 1),
)
DIRECT_ITEMS = (
    ("AUTO", "Auto", "Apart where that needs fewer renders", 0),
    ("APART", "Apart", "Direct light exactly, in one more render for each spectrum of light", 1),
    ("TOGETHER", "With the Rest", "All light in bands", 2),
)
_DIRECT = {"AUTO": None, "APART": True, "TOGETHER": False}


class RoughSpectraPicture(PropertyGroup):
    """How spectral pictures of a scene are rendered."""

    by: EnumProperty(name="Accuracy", description="What decides the bands", items=BY_ITEMS)
    tolerance: FloatProperty(
        name="Tolerance",
        description="ΔE00 within which 95 % of the picture shall be",
        default=limits.TOLERANCE,
        min=limits.TOLERANCES[0],
        soft_max=5.0,
        max=limits.TOLERANCES[1],
        precision=2,
    )
    renders: IntProperty(
        name="Renders",
        description="Each holds three bands, and costs about what a render costs",
        default=3,
        min=1,
        max=_MOST_RENDERS,
    )
    observer: EnumProperty(
        name="Observer", description="Whose eye sees the picture", items=OBSERVER_ITEMS
    )
    direct: EnumProperty(
        name="Direct Light",
        description="How light is rendered that met one surface alone",
        items=DIRECT_ITEMS,
    )
    percentage: IntProperty(
        name="Size",
        description="Part of the size that the scene is rendered in",
        subtype="PERCENTAGE",
        default=100,
        min=1,
        max=100,
    )
    compare: BoolProperty(
        name="Compare RGB",
        description="Render the ordinary picture, too, and a map of how far it is off",
        default=True,
    )


classes = (RoughSpectraPicture,)


def register_pointers() -> None:
    """Give every scene its `rough_spectra` group."""
    Scene.rough_spectra = PointerProperty(
        type=RoughSpectraPicture, override={"LIBRARY_OVERRIDABLE"}
    )


def unregister_pointers() -> None:
    """Take the group away; what is stored in files stays there."""
    del Scene.rough_spectra


def wanted(scene: Any) -> Wanted:
    """Give what a scene's settings ask for."""
    from ...core.bands import IN_A_PASS
    from .render import Wanted

    group = scene.rough_spectra
    return Wanted(
        tolerance=group.tolerance,
        bands=group.renders * IN_A_PASS if group.by == "RENDERS" else None,
        observer=int(group.observer),
        direct=_DIRECT[group.direct],
        plain=group.compare,
        percentage=max(round(scene.render.resolution_percentage * group.percentage / 100), 1),
    )
