# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which model and which target hold for a material now, and how far what it shows is from that.

The one answer for panel, pictures, bake, check, measurement and scene: the target is that of the
spectrum and of the settings as they are, whatever the shader node was derived from. What the stamp
says of it is taken where it was derived from these very settings; else a model that is left to
choose is chosen anew. `derived` and `numbers` only look that up, for a panel that draws; the others
compute.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

from ..core.errors import MaterialError
from . import facts, nodes, stamp
from .facts import Facts
from .stamp import Stamp

if TYPE_CHECKING:
    from ..core.arrays import Array
    from .preview.shown import Differences
    from .request import Request
    from .working_space import WorkingSpace


class Settled(NamedTuple):
    """What a material is to become, as its settings are now.

    Parameters
    ----------
    request
        With a settled model.
    model_reason
        Why it was taken.
    """

    request: Request
    model_reason: str


def derived(found: Facts) -> Stamp | None:
    """Give the stamp where it was derived from spectrum and settings as they are, else None.

    The shader node may have been edited since. What was kept is of an edit and not of a target:
    the settings may have changed before it was.
    """
    last = stamp.parse(found.stamp)
    if last is None or last.kept or last.derivation != stamp.DERIVATION:
        return None
    return last if last.inputs == facts.digest(found.inputs) else None


def numbers(found: Facts, flat: bool) -> Differences | None:
    """Give the stamp's ΔE00 if they are those of what is shown now, else None.

    `flat` is whether an engine shows it that ignores roughness.
    """
    known = stamp.judge(found)
    last = known.stamp
    if last is None or known.kind != "fresh" or (flat and not found.inputs.scene_view):
        return None
    return last.delta_e_instrument, last.delta_e_mean, last.delta_e_95


def of(material: Any, known: Facts | None = None) -> Settled:
    """Settle what a material stores.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    known
        Its facts, for who has just read them.

    Raises
    ------
    MaterialError
        If the material has no spectrum that can be read.
    DomainError
        If its spectrum or a setting cannot be used.
    """
    from . import storage

    request, last = storage.load(material), derived(known or facts.of(material))
    if last is None:
        return _choose(request)
    return Settled(replace(request, model=last.model), last.model_reason)


def shader(material: Any, known: Facts | None = None) -> tuple[Array, float]:
    """Color, shape (3,), and roughness in the shader node, or as they were derived.

    Parameters as in `of`.

    Raises
    ------
    MaterialError
        If there is neither, or a socket holds no number.
    """
    import numpy as np

    found = nodes.surface(material) if known is None else known.surface
    if found is not None:
        if not all(map(math.isfinite, (*found.color, found.roughness))):
            msg = f"Material {material.name!r}: {found.node!r} holds a value that is no number."
            raise MaterialError(msg)
        return np.array(found.color), found.roughness
    last = stamp.get_stamp(material)
    if last is None:
        msg = f"Material {material.name!r} has no color derived from its spectrum yet; renew it."
        raise MaterialError(msg)
    return np.array(last.color), last.roughness


def differences(
    material: Any, space: WorkingSpace, flat: bool = False, known: Facts | None = None
) -> Differences:
    """Compare what a material shows with its target.

    Parameters
    ----------
    material
        A `bpy.types.Material`.
    space
        The working space that its node is in.
    flat
        Whether an engine shows it that ignores roughness.
    known
        As in `of`.

    Raises
    ------
    MaterialError, DomainError
        As in `of` and `shader`.
    """
    found = known or facts.of(material)
    told = numbers(found, flat)
    if told is not None:
        return told
    from . import spectra
    from .preview import shown

    request, (color, roughness) = of(material, found).request, shader(material, found)
    [read], [albedo] = spectra.readings_and_albedos([request])
    what = color, 0.0 if flat else roughness
    return shown.differences(request, (read, albedo), what, space)


@lru_cache(maxsize=64)
def _choose(request: Request) -> Settled:
    """Choose the model; once, while a color is edited by hand and its pictures follow."""
    from . import target

    [found] = target.settle([request])
    return Settled(*found)
