# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The file's own rough materials in the list of samples: to give more objects the very same one.

What was made rougher or shiny is a material and no sample any more. It is linked to the objects,
and nothing is copied.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.app.translations import pgettext_rpt as rpt_

from ....core.errors import MaterialError, RoughSpectraError
from . import targets

if TYPE_CHECKING:
    from ...preview.list_icons import Pictured

_PREFIX = "this file/"
"""How the identifiers of these items begin; no collection of samples is called so."""
_NUMBERS = 1_000_000
"""From where on items are numbered, by the materials: other samples have smaller numbers."""


class Own(NamedTuple):
    """A material as the list offers it.

    Parameters
    ----------
    identifier, label, about, number
        As Blender wants them of an item.
    pictured
        What its ball shows.
    """

    identifier: str
    label: str
    about: str
    number: int
    pictured: Pictured


def entries() -> list[Own]:
    """List the materials in use that have a spectrum, by name."""
    from ...material import selection, snapshot
    from ...preview.list_icons import Pictured

    found = selection.in_use(selection.with_spectrum())
    return [
        Own(
            f"{_PREFIX}{material.session_uid}",
            _label(material),
            _about(material),
            _NUMBERS + material.session_uid,
            Pictured(color, snapshot.sigma_degrees(material.rough_spectra), _gloss(material)),
        )
        for material, color in zip(found, _colors(found), strict=True)
    ]


def is_one(identifier: str) -> bool:
    """Whether an item is of these."""
    return identifier.startswith(_PREFIX)


def give(context: Any, scope: str, identifier: str) -> str:
    """Give the objects that a scope of `giving.AssignOptions` means a material of the file.

    Returns
    -------
    A sentence on who has it now.

    Raises
    ------
    RoughSpectraError
        If it is gone, or an object cannot be given one; nothing was changed then.
    """
    there = {f"{_PREFIX}{material.session_uid}": material for material in bpy.data.materials}
    material = there.get(identifier)
    if material is None:
        msg = "The chosen material is no longer in this file; open the list again."
        raise MaterialError(msg)
    things = targets.carriers_in_scope(context, scope)
    for thing in things:
        targets.refuse_linked(thing)
    for thing in things:
        if scope == "SELECTED":
            for slot in thing.material_slots:
                slot.material = material
        if thing.active_material != material:
            thing.active_material = material
    names = ", ".join(thing.name for thing in things[:3])
    return rpt_("{objects}: {material} of this file").format(objects=names, material=material.name)


def _label(material: Any) -> str:
    sample, name = material.rough_spectra.sample_name, material.name
    if sample.casefold() not in name.casefold():
        name = f"{name} ({sample})"  # so that it is found by either
    return iface_("{material} – in this file").format(material=name)


def _about(material: Any) -> str:
    group = material.rough_spectra
    told = iface_("The material itself, as it is in this file: it is shared, not copied")
    return f"{told}. {group.sample_name}, {group.source}"


def _gloss(material: Any) -> Any:
    from ...material import storage

    return storage.shown_gloss(material)


def _colors(materials: Sequence[Any]) -> list[tuple[float, float, float] | None]:
    """Give the colors of their samples, or None where what is stored is damaged.

    Materials of one sample are looked at once: a list opens without a pause.
    """
    from ...material import snapshot, storage
    from ...samples import swatches

    keys = [(m.rough_spectra.spectrum, snapshot.white(m.rough_spectra)) for m in materials]
    samples = {}
    for key, material in dict(zip(keys, materials, strict=True)).items():
        try:
            samples[key] = storage.load(material).sample
        except RoughSpectraError:
            continue
    rgb, _ = swatches.of_samples(list(samples.values()))
    colors = {
        key: (red, green, blue)
        for key, (red, green, blue) in zip(samples, rgb.tolist(), strict=True)
        if not math.isnan(red)
    }
    return [colors.get(key) for key in keys]
