# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which model and which target hold for a material now, and how far what it shows is from that.

The one answer for panel, pictures, bake, check, measurement and scene: the target is that of the
spectrum and of the settings as they are, whatever the shader node was derived from. `derived` and
`numbers` only look up what the stamp says of them, for a panel that draws; the others compute.
Where a surface shows what nobody predicts, such as sheen, there is no number: `obstacle` says so.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from ...core.errors import MaterialError
from ..blender import shader_nodes
from ..matching import shaders
from . import derivation, snapshot, state
from .derivation import Stamp
from .snapshot import Snapshot

if TYPE_CHECKING:
    from ...core.numerics.arrays import Array
    from ..colorimetry.rgb_space import WorkingSpace
    from ..matching.assess import Differences
    from ..matching.request import Request


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


class Obstacle(NamedTuple):
    """Why there is no telling how far a surface is from its target.

    Parameters
    ----------
    template
        The reason, without its first capital and its full stop, with a place for the names.
    names
        Of sockets.
    """

    template: str
    names: str = ""

    def __str__(self) -> str:
        return self.template.format(names=self.names)


_NO_NODE = Obstacle(f"the surface comes from no {shaders.listed()}: there is no color to compare")
_MUTED = Obstacle("the shader node is muted: there is no color to compare")
LINKED = Obstacle("color or roughness comes from another node: there is no one color to compare")
_NO_NUMBER = Obstacle("color or roughness is no number: there is no color to compare")
_ABOVE = Obstacle("no ΔE00 is predicted for a color above 1")
_IN_USE = "no ΔE00 is predicted with {names} in use"
_ROUNDING = 1e-6
"""Above 1; sockets are single precision."""


def obstacle(surface: shader_nodes.Surface | None) -> Obstacle | None:
    """Say why there is no number for what a surface shows; None where there is one.

    A bump or normal map is none: it turns each point, which shows as it was predicted in the
    directions seen from there. The numbers are then said to be of the surface without it, whose
    color is what was measured; a strong one makes a whole sample read otherwise.
    """
    if surface is None:
        return _NO_NODE
    if surface.muted:
        return _MUTED
    if surface.color_linked or surface.roughness_linked:
        return LINKED
    if surface.disturbing:
        return Obstacle(_IN_USE, ", ".join(surface.disturbing))
    of_gloss = () if surface.gloss is None else surface.gloss.numbers()
    if not all(map(math.isfinite, (*surface.color, surface.roughness, *of_gloss))):
        return _NO_NUMBER
    # Cycles limits what such a surface sends on, in a way of its own.
    return _ABOVE if max(surface.color) > 1 + _ROUNDING else None


def derived(found: Snapshot) -> Stamp | None:
    """Give the stamp where it was derived from spectrum and settings as they are, else None.

    The shader node may have been edited since. What was kept is of an edit and not of a target:
    the settings may have changed before it was.
    """
    last = derivation.parse(found.stamp)
    if last is None or last.kept or last.derivation != derivation.DERIVATION:
        return None
    return last if derivation.is_current(last, found.inputs) else None


def numbers(found: Snapshot, flat: bool) -> Differences | None:
    """Give the stamp's ΔE00 if they are those of what is shown now, else None.

    `flat` is whether an engine shows it that ignores roughness.
    """
    known = state.evaluate(found)
    last = known.stamp
    if found.surface is not None and found.surface.scaled:
        return None  # of a texture there is no one color to compare
    if last is None or known.kind != "fresh" or (flat and last.roughness > 0.0):
        return None
    return last.delta_e_instrument, last.delta_e_mean, last.delta_e_95


def of(material: Any) -> Settled:
    """Settle what a material stores.

    Parameters
    ----------
    material
        A `bpy.types.Material`.

    Raises
    ------
    MaterialError
        If the material has no spectrum that can be read.
    DomainError
        If its spectrum or a setting cannot be used.
    """
    from ..matching import solve
    from . import storage

    [found] = solve.settle([storage.load(material)])
    return Settled(*found)


def shader(material: Any, known: Snapshot | None = None) -> tuple[Array, float]:
    """Color, shape (3,), and roughness that the surface shows, within 0 to 1 as Cycles takes them.

    Parameters as in `of`.

    Raises
    ------
    MaterialError
        If there is an `obstacle`.
    """
    import numpy as np

    found = shader_nodes.surface(material) if known is None else known.surface
    reason = obstacle(found)
    if found is None or reason is not None:
        msg = f"Material {material.name!r}: {reason}."
        raise MaterialError(msg)
    return np.clip(found.color, 0.0, 1.0), min(max(found.roughness, 0.0), 1.0)


def differences(
    material: Any, space: WorkingSpace, flat: bool = False, known: Snapshot | None = None
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
        Its facts, for who has just read them.

    Raises
    ------
    MaterialError, DomainError
        As in `of` and `shader`.
    """
    found = known or snapshot.of(material)
    told = numbers(found, flat)
    if told is not None:
        return told
    return predicted(of(material).request, shader(material, found), space, flat)


def predicted(
    request: Request, shown: tuple[Array, float], space: WorkingSpace, flat: bool
) -> Differences:
    """Compare color and roughness with the target of a request with a settled model.

    Other parameters as in `differences`.
    """
    from ..matching import assess, surface_spectra

    color, roughness = shown
    [read], [albedo] = surface_spectra.readings_and_albedos([request])
    what = color, 0.0 if flat else roughness
    return assess.differences(request, (read, albedo), what, space)
