# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a material stores: the measured spectrum, the settings, and a stamp on what was derived.

The spectrum is kept as JSON text, because Blender's number properties are single precision and
would change measured values. `storage` reads and writes all of this.
"""

from __future__ import annotations

from math import pi

from bpy.props import EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty
from bpy.types import Material, PropertyGroup

SCHEMA = 1
"""Version of what is stored; raise it with each change, and let `storage` lift older files."""

KIND_ITEMS = (
    ("reading", "Reading", "Reflectance factor that the instrument printed for the rough surface"),
    ("albedo", "Albedo", "Reflectance of one facet: what the smooth material reflects"),
)
INSTRUMENT_ITEMS = (("45a:0", "45°a:0°", "Ring light at 45°, view along the normal"),)
MODEL_ITEMS = (
    ("two-bounce", "Two-bounce", "Oren and Nayar's published model: f1 ρ + f2 ρ²"),
    ("first-order", "First-order", "Without light between facets: f1 ρ"),
    ("closure", "Closure", "All bounces, with energy conserved for white facets"),
)
SHADER_ITEMS = (
    ("AUTO", "As It Is", "Set the Diffuse or Principled BSDF in use; make a Diffuse BSDF if none"),
    ("DIFFUSE", "Diffuse BSDF", "Set a Diffuse BSDF, making one if another shader is in use"),
    ("PRINCIPLED", "Principled BSDF", "Set a Principled BSDF with its specular level at 0"),
)
ILLUMINANT_ITEMS = tuple(
    (name, name, f"CIE standard illuminant {name}")
    for name in ("D65", "A", "D50", "D55", "D75", "E", "F2", "F7", "F11", "LED-B3")
)
OBSERVER_ITEMS = (
    ("2", "2°", "CIE 1931 standard observer"),
    ("10", "10°", "CIE 1964 standard observer, in reports only: scene colors are always 2°"),
)


class RoughSpectraMaterial(PropertyGroup):
    """Measured spectrum of a material, its roughness, and what was derived from them."""

    schema: IntProperty(name="Schema", description="Version of the stored data", default=0)
    sample_name: StringProperty(name="Sample", description="Name of the measured sample")
    source: StringProperty(name="Source", description="File or citation of the spectrum")
    kind: EnumProperty(name="Kind", description="What the spectrum is", items=KIND_ITEMS)
    instrument: EnumProperty(
        name="Instrument", description="Geometry of the reading", items=INSTRUMENT_ITEMS
    )
    spectrum: StringProperty(name="Spectrum", description="Wavelengths and values, as JSON")
    details: StringProperty(name="Details", description="What else the file said, as JSON")
    sigma: FloatProperty(
        name="σ",
        description="Roughness: standard deviation of the slope angle of the surface's facets",
        subtype="ANGLE",
        precision=1,
        step=100,
        min=0.0,
        max=pi / 2,
    )
    sigma_source: StringProperty(name="σ from", description="Where the roughness comes from")
    illuminant: EnumProperty(
        name="Illuminant",
        description="Light under which the color is right",
        items=ILLUMINANT_ITEMS,
    )
    observer: EnumProperty(
        name="Observer", description="Observer of the reports", items=OBSERVER_ITEMS
    )
    model: EnumProperty(
        name="Model", description="How light between facets is counted", items=MODEL_ITEMS
    )
    shader: EnumProperty(name="Shader", description="Node that is set", items=SHADER_ITEMS)
    stamp: StringProperty(name="Stamp", description="What was derived and from what, as JSON")


classes = (RoughSpectraMaterial,)


def register_pointer() -> None:
    """Give every material its `rough_spectra` group."""
    Material.rough_spectra = PointerProperty(
        type=RoughSpectraMaterial, override={"LIBRARY_OVERRIDABLE"}
    )


def unregister_pointer() -> None:
    """Take the group away; what is stored in files stays there."""
    del Material.rough_spectra
