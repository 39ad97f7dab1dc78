# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The spectrum that a lamp or a world has in spectral pictures, kept with it in the .blend.

A measured one is kept whole, as JSON text: single precision would change it, and the file it came
from may be gone tomorrow.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from bpy.props import EnumProperty, PointerProperty, StringProperty
from bpy.types import Light, PropertyGroup, World

from ...core.errors import InputError, MaterialError
from ..material.properties import ILLUMINANT_ITEMS

if TYPE_CHECKING:
    from ..samples.light_source import LightSource
    from .light_spectra import KnownLight

_Used = TypeVar("_Used")
COLOR, MEASURED = "COLOR", "MEASURED"
# The numbers are what a .blend stores: never give one to another item, nor change it.
SPECTRUM_ITEMS = (
    (COLOR, "From Its Color", "A spectrum that fits its color, temperature or textures", 100),
    (MEASURED, "Measured", "The spectrum of a file", 101),
    *ILLUMINANT_ITEMS,
)


class RoughSpectraLight(PropertyGroup):
    """Spectrum of a lamp or a world in spectral pictures."""

    spectrum: EnumProperty(
        name="Spectrum",
        description="What it sends in spectral pictures, as bright as its color is",
        items=SPECTRUM_ITEMS,
        default=COLOR,
    )
    sample_name: StringProperty(name="File", description="Name of the file of its spectrum")
    source: StringProperty(name="Source", description="Path of the file of its spectrum")
    measured: StringProperty(name="Measured", description="Wavelengths and power, as JSON")


classes = (RoughSpectraLight,)
_OWNERS = (Light, World)


def register_pointers() -> None:
    """Give lamps and worlds their `rough_spectra` group."""
    for owner in _OWNERS:
        owner.rough_spectra = PointerProperty(
            type=RoughSpectraLight, override={"LIBRARY_OVERRIDABLE"}
        )


def unregister_pointers() -> None:
    """Take the groups away; what is stored in files stays there."""
    for owner in _OWNERS:
        del owner.rough_spectra


def keep(data: Any, source: LightSource, path: str) -> None:
    """Let a lamp or a world have a measured spectrum.

    Parameters
    ----------
    data
        A `bpy.types.Light` or `bpy.types.World`.
    source
        What was measured.
    path
        Of its file.
    """
    group = data.rough_spectra
    group.sample_name, group.source = source.name, path
    group.measured = json.dumps([source.wavelengths.tolist(), source.power.tolist()])
    group.spectrum = MEASURED


def known(data: Any) -> KnownLight | None:
    """Give the spectrum that was chosen for a lamp or a world, and what it is; None for none.

    Raises
    ------
    MaterialError
        If it should be a measured one, and there is none that can be used.
    """
    from . import light_spectra

    group = data.rough_spectra
    if group.spectrum == COLOR:
        return None
    if group.spectrum != MEASURED:
        return light_spectra.find(group.spectrum)
    return _undamaged(data, light_spectra.measured)


def source(data: Any) -> LightSource | None:
    """Give what was measured of a lamp or a world, if that was chosen for it.

    Raises
    ------
    MaterialError
        As of `known`.
    """
    return None if data.rough_spectra.spectrum != MEASURED else _undamaged(data, lambda kept: kept)


def _undamaged(data: Any, use: Callable[[LightSource], _Used]) -> _Used:
    """Read what is stored, and use it."""
    group = data.rough_spectra
    remedy = "open a file for its spectrum, or choose another one"
    if not group.measured:
        msg = f"{data.name!r} is to have a measured spectrum and has none; {remedy}."
        raise MaterialError(msg)
    from ..samples import light_source

    try:
        nm, power = json.loads(group.measured)
        return use(light_source.checked(group.sample_name, nm, power))
    except (ValueError, TypeError, InputError) as error:
        reason = str(error).rstrip(".")
        msg = f"The spectrum stored with {data.name!r} is damaged ({reason}); {remedy}."
        raise MaterialError(msg) from None
