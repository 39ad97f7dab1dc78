# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a material stores: the measured spectrum, the settings, and a stamp on what was derived.

The spectrum is kept as JSON text, because Blender's number properties are single precision and
would change measured values. `storage` reads and writes all of this.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)
from bpy.types import Material, PropertyGroup

from ...core import limits, models, white_scale
from ...core.instruments import DEFAULT, REGISTRY
from ..matching import shaders
from . import changes, gloss, together

SCHEMA = 1
"""Version of what is stored; raise it with each change, and let `storage` lift older files."""

# The numbers are what a .blend stores: never give one to another item, nor change it. The order is
# that of the menus.
KIND_ITEMS = (
    (
        "reading",
        "Reading",
        "Reflectance factor that the instrument printed for the rough surface",
        0,
    ),
    ("albedo", "Albedo", "Reflectance of one facet: what the smooth material reflects", 1),
)
INSTRUMENT_ITEMS = tuple((i.name, i.menu, i.description, i.number) for i in REGISTRY.values())
WHITE_ITEMS = tuple(
    (w.name, w.menu, w.description, w.number) for w in white_scale.REGISTRY.values()
)
PLAQUE_ITEMS = (
    (
        white_scale.PTFE,
        "Sintered PTFE",
        f"Spectralon and its like: {white_scale.PTFE_FACTORS['45:0']:g} at 45°/0°, "
        f"{white_scale.PTFE_FACTORS['8:d']:g} in a sphere, 8°/d",
        0,
    ),
    (white_scale.STATED, "Stated Factor", "Another plaque, whose factor you know", 1),
    (
        white_scale.UNKNOWN,
        "Not Known",
        "Fits where certificate and instrument are of one geometry",
        2,
    ),
)
MODEL_ITEMS = (
    ("auto", "Auto", "Random rough surfaces, all bounces: the closest to real ones", 3),
    *((m.name, m.title, m.description, m.number) for m in models.REGISTRY.values()),
)
SHADER_ITEMS = (
    (
        shaders.AUTO,
        "As It Is",
        f"Set the {shaders.listed()} in use; make a {shaders.DEFAULT.title} if none",
        0,
    ),
    *((s.name, s.title, s.description, s.number) for s in shaders.REGISTRY.values()),
)
_TITLES = {
    setting: {item[0]: item[1] for item in items}
    for setting, items in (
        *(("kind", KIND_ITEMS), ("instrument", INSTRUMENT_ITEMS)),
        *(("model", MODEL_ITEMS), ("shader", SHADER_ITEMS)),
        ("virtual instrument", INSTRUMENT_ITEMS),
    )
}
ILLUMINANT_ITEMS = tuple(
    (name, name, f"CIE illuminant {name}: {what}", number)
    for name, what, number in (
        ("D65", "noon daylight, 6500 K", 0),
        ("A", "incandescent lamp, 2856 K", 1),
        ("D50", "warm daylight, 5000 K, as in print shops", 2),
        ("D55", "daylight, 5500 K", 3),
        ("D75", "north sky, 7500 K", 4),
        ("E", "the same at every wavelength", 5),
        ("F2", "cool white fluorescent lamp, 4230 K", 6),
        ("F7", "daylight fluorescent lamp, 6500 K", 7),
        ("F11", "fluorescent lamp of three narrow bands, 4000 K", 8),
        ("LED-B3", "white LED with a blue chip, 4100 K", 9),
    )
)
OBSERVER_ITEMS = (
    ("2", "2°", "CIE 1931 standard observer", 0),
    ("10", "10°", "CIE 1964 standard observer, in reports only: scene colors are always 2°", 1),
)


SIGMA = {
    "name": "σ",
    "description": "How rough it is: 0° is smooth, 10° as office paper, 20° as brick, 30° as "
    "concrete; more is coarser.\n"
    "For color people: σ, the angle whose tangent is the rms slope of a profile across the "
    "surface, a profilometer's Rdq; Sdq, of an area, is √2 larger",
    "subtype": "ANGLE",
    "precision": 1,
    "step": 100,
    "min": 0.0,
    "max": limits.MATCHED_SIGMA,
}
"""The slider of σ, wherever it stands."""

_GLOSS = (
    "How shiny it is: 0 is matte, 1 a mirror. It sets how sharp the shine is; how strong it is, "
    "Specular IOR Level, stays as it was set, and so does the coat"
)

WHITE = {"name": "White", "description": "What the values are relative to"}
PLAQUE = {
    "name": "Plaque",
    "description": "White plaque that the instrument was set to",
    "items": PLAQUE_ITEMS,
}
WHITE_FACTOR = {
    "name": "White's Factor",
    "description": "The plaque's true reflectance factor at the instrument's geometry, over the "
    "value of its certificate",
    "default": 1.0,
    "precision": 4,
    "step": 0.1,
    "min": white_scale.FACTORS[0],
    "max": white_scale.FACTORS[1],
}
"""The white of a reading, wherever it is asked for."""


def _gloss(group: Any) -> float:
    return gloss.shown(group.id_data)


def _put_gloss(group: Any, value: float) -> None:
    gloss.put(group.id_data, value)


def _put_sigma_of_all(group: Any, value: float) -> None:
    together.set_sigma(group.id_data, bpy.context.selected_objects, value)


def _put_gloss_of_all(group: Any, value: float) -> None:
    together.set_gloss(group.id_data, bpy.context.selected_objects, value)


class RoughSpectraMaterial(PropertyGroup):
    """Measured spectrum of a material, its roughness, and what was derived from them."""

    schema: IntProperty(name="Schema", description="Version of the stored data", default=0)
    sample_name: StringProperty(name="Sample", description="Name of the measured sample")
    source: StringProperty(name="Source", description="File or citation of the spectrum")
    kind: EnumProperty(
        name="Kind", description="What the spectrum is", items=KIND_ITEMS, update=changes.on_setting
    )
    instrument: EnumProperty(
        name="Instrument",
        description="Geometry of the reading",
        items=INSTRUMENT_ITEMS,
        update=changes.on_setting,
    )
    white: EnumProperty(**WHITE, items=WHITE_ITEMS, update=changes.on_setting)
    plaque: EnumProperty(**PLAQUE, update=changes.on_setting)
    white_factor: FloatProperty(**WHITE_FACTOR, update=changes.on_setting)
    spectrum: StringProperty(name="Spectrum", description="Wavelengths and values, as JSON")
    details: StringProperty(name="Details", description="What else the file said, as JSON")
    sigma: FloatProperty(**SIGMA, update=changes.on_setting)
    sigma_source: StringProperty(name="σ from", description="Where the roughness comes from")
    own_sigma: FloatProperty(
        name="Sample's σ",
        description="Roughness that the sample came with, radians; below 0 where nobody knows",
        default=-1.0,
    )
    own_gloss: StringProperty(
        name="Sample's Gloss", description="Gloss that the sample came with, as JSON"
    )
    solid_color: FloatVectorProperty(
        name="Viewport Color",
        description="What we set as the color of solid shading; another one is the user's",
        default=(-1.0, -1.0, -1.0),
    )
    gloss: FloatProperty(
        name="Gloss",
        description=_GLOSS,
        subtype="FACTOR",
        precision=2,
        min=0.0,
        max=1.0,
        get=_gloss,
        set=_put_gloss,
        update=changes.on_setting,
        options=set(),  # what it sets can be animated, and it would be set twice
    )
    sigma_of_all: FloatProperty(
        **SIGMA
        | {"description": f"{SIGMA['description']}. Of all selected objects of this sample"},
        get=lambda group: float(group.sigma),
        set=_put_sigma_of_all,
        options=set(),  # one material's σ is animated
    )
    gloss_of_all: FloatProperty(
        name="Gloss",
        description=f"{_GLOSS}. Of all selected objects of this sample",
        subtype="FACTOR",
        precision=2,
        min=0.0,
        max=1.0,
        get=_gloss,
        set=_put_gloss_of_all,
        options=set(),
    )
    illuminant: EnumProperty(
        name="Illuminant",
        description="Light under which the color is right",
        items=ILLUMINANT_ITEMS,
        update=changes.on_setting,
    )
    observer: EnumProperty(
        name="Observer", description="Observer of the reports", items=OBSERVER_ITEMS
    )
    read_at: EnumProperty(
        name="Read At",
        description="Virtual instrument that the material reads right at, and is measured with",
        items=INSTRUMENT_ITEMS,
        default=DEFAULT,
        update=changes.on_setting,
    )
    model: EnumProperty(
        name="Model",
        description="How light between facets is counted",
        items=MODEL_ITEMS,
        default="auto",
        update=changes.on_setting,
    )
    shader: EnumProperty(
        name="Shader", description="Node that is set", items=SHADER_ITEMS, update=changes.on_setting
    )
    tolerance: FloatProperty(
        name="Tolerance",
        description="Largest color difference, ΔE00, that Auto accepts for a simpler model",
        default=limits.TOLERANCE,
        min=limits.TOLERANCES[0],
        soft_max=5.0,
        max=limits.TOLERANCES[1],
        precision=2,
        update=changes.on_setting,
    )
    use_scene: BoolProperty(
        name="Light from the Scene",
        description="Be right under the lights and in the directions that Analyze Scene found, "
        "instead of under the illuminant",
        default=False,
        update=changes.on_setting,
    )
    scene_view: StringProperty(name="Scene", description="What the analysis found, as JSON")
    stamp: StringProperty(name="Stamp", description="What was derived and from what, as JSON")
    error: StringProperty(name="Error", description="Why the color could not be derived")
    measured: StringProperty(name="Measured", description="The last measurement, as JSON")


classes = (RoughSpectraMaterial,)


def title(setting: str, identifier: str) -> str:
    """Give what the panel calls a value of a setting: "45°a:0°" for the instrument "45a:0"."""
    return _TITLES.get(setting, {}).get(identifier, identifier)


def register_pointer() -> None:
    """Give every material its `rough_spectra` group."""
    Material.rough_spectra = PointerProperty(
        type=RoughSpectraMaterial, override={"LIBRARY_OVERRIDABLE"}
    )


def unregister_pointer() -> None:
    """Take the group away; what is stored in files stays there."""
    del Material.rough_spectra
