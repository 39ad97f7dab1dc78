# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a scene's spectral picture is rendered from the interface, kept with the scene."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
)
from bpy.types import PropertyGroup, Scene

from ...core import limits
from . import cameras

if TYPE_CHECKING:
    from . import infrared_wanted, thermal
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
    infrared_band: FloatVectorProperty(
        name="Band",
        description="First and last wavelength of an infrared camera, nanometers",
        size=2,
        default=cameras.NEAR,
        min=limits.E308_NM[0],
        max=cameras.THERMAL[1],
        precision=0,
        step=1000,
    )
    false_color: BoolProperty(
        name="False Color",
        description="Red, green and blue are the thirds of the band, red the longest wavelengths",
    )
    thermal_band: FloatVectorProperty(
        name="Band",
        description="First and last wavelength of a thermal camera, nanometers",
        size=2,
        default=cameras.THERMAL,
        min=cameras.NEAR[0],
        max=cameras.LONGEST,
        precision=0,
        step=10000,
    )
    ambient: FloatProperty(
        name="Ambient",
        description="Temperature of objects that have none of their own, kelvin",
        default=cameras.AMBIENT,
        min=0.0,
        max=cameras.HOTTEST,
        precision=2,
        step=100,
    )
    use_sky: BoolProperty(
        name="Own Sky",
        description="The sky has a temperature of its own, instead of the ambient one",
    )
    sky: FloatProperty(
        name="Sky",
        description="Temperature where nothing is, kelvin",
        default=250.0,
        min=0.0,
        max=cameras.HOTTEST,
        precision=2,
        step=100,
    )
    emissivity: FloatProperty(
        name="Emissivity",
        description="Of materials without infrared data",
        default=cameras.EMISSIVITY,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
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


def wanted(scene: Any, renders: int = 0) -> Wanted:
    """Give what a scene's settings ask for; `renders` instead of what decides the bands."""
    from ...core.bands import IN_A_PASS
    from .render import Wanted

    group = scene.rough_spectra
    if not renders and group.by == "RENDERS":
        renders = group.renders
    return Wanted(
        tolerance=group.tolerance,
        bands=IN_A_PASS * renders if renders else None,
        observer=int(group.observer),
        direct=_DIRECT[group.direct],
        plain=group.compare,
        percentage=percentage(scene),
    )


def lamps(scene: Any) -> Wanted:
    """Give what a scene's settings ask of the light of each lamp apart.

    Half of the tolerance is for the lamps as they are; they are going to be changed.
    """
    asked = wanted(scene)
    return replace(asked, tolerance=asked.tolerance / 2, direct=False, plain=False, steady=True)


def percentage(scene: Any) -> int:
    """Give the part of the resolution that pictures of a scene have."""
    whole = scene.render.resolution_percentage
    return max(round(whole * scene.rough_spectra.percentage / 100), 1)


def infrared(scene: Any) -> infrared_wanted.Wanted:
    """Give what a scene's settings ask of an infrared camera."""
    from . import infrared_wanted

    first, last = scene.rough_spectra.infrared_band
    return infrared_wanted.Wanted((first, last), percentage=percentage(scene))


def heat(scene: Any) -> thermal.Wanted:
    """Give what a scene's settings ask of a thermal camera."""
    from . import thermal

    group = scene.rough_spectra
    first, last = group.thermal_band
    # Single precision has 293.15 as 293.149994 and 0.95 as 0.949999988.
    return thermal.Wanted(
        (first, last),
        ambient=round(group.ambient, 4),
        sky=round(group.sky, 4) if group.use_sky else None,
        emissivity=round(group.emissivity, 6),
        percentage=percentage(scene),
    )
