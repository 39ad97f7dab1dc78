# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials that have a sample: whether it still holds, renewed, kept, and how far off they are."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import AbstractContextManager

import bpy

from ..blender import working_space
from ..matching.assess import Differences
from ..matching.solution import Solution
from ..material import changes, derive, selection, settled, storage
from ..material import state as material_state
from ..material.settled import Settled
from ..material.state import State
from .checks import check_enabled, checked


def materials() -> list[bpy.types.Material]:
    """Return all materials of the open file that store a spectrum, sorted by name.

    Examples
    --------
    >>> plain, wall = (bpy.data.materials.new(name) for name in ("Plain", "Wall"))
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> [material.name for material in materials()]
    ['Wall']
    """
    check_enabled()
    return selection.with_spectrum()


def renew(materials: Iterable[bpy.types.Material]) -> list[Solution]:
    """Derive color and roughness again from what the materials store, all of them or none.

    Edits of the shader node by hand are overwritten: `state` tells beforehand.

    Returns
    -------
    As of `assign`, in the order of `materials`.

    Raises
    ------
    MaterialError
        A material stores no spectrum or cannot be written; nothing was changed.
    DomainError
        A spectrum cannot be used; nothing was changed.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> with paused():
    ...     wall.rough_spectra.sigma = radians(40)
    >>> [solution] = renew([wall])
    >>> round(solution.roughness, 2)
    0.68
    """
    return derive.renew([checked(material) for material in materials])


def paused() -> AbstractContextManager[None]:
    """Let no color follow while several settings are written; call `renew` afterwards.

    Without it every setting of `material.rough_spectra` is followed at once, at a few milliseconds
    each.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], gloss="none")
    >>> with paused():
    ...     wall.rough_spectra.sigma = radians(30)
    ...     wall.rough_spectra.illuminant = "A"
    >>> state(wall).kind
    'stale'
    """
    return changes.paused()


def state(material: bpy.types.Material) -> State:
    """Tell whether color and roughness still follow from the spectrum, and if not, why.

    Only compares what is stored: cheap enough to draw with.

    Returns
    -------
    Its `kind` is "none" (no spectrum), "fresh", "stale", "kept" (edited by hand, and accepted),
    "error" or "linked"; `reasons` are sentences, most important first; `stamp` is what was
    derived, or None.

    Raises
    ------
    MaterialError
        This is no material.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> state(wall).kind
    'none'
    >>> _ = assign([(wall, find("neutral 6.5"))], shader="diffuse")
    >>> state(wall).kind
    'fresh'
    >>> node = wall.node_tree.nodes[state(wall).stamp.node]
    >>> node.inputs["Color"].default_value = (1, 0, 0, 1)
    >>> state(wall).kind, state(wall).reasons
    ('stale', ('color or roughness was edited by hand',))
    """
    return material_state.state(checked(material))


def keep(material: bpy.types.Material) -> None:
    """Accept what the surface shows as edited by hand; the spectrum stays as it is.

    Raises
    ------
    MaterialError
        Nothing was derived from a spectrum yet, or the material is linked.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, find("neutral 6.5"))], shader="diffuse")
    >>> wall.node_tree.nodes[state(wall).stamp.node].inputs["Roughness"].default_value = 0.5
    >>> keep(wall)
    >>> state(wall).kind
    'kept'
    """
    storage.keep(checked(material))


def settle(material: bpy.types.Material) -> Settled:
    """Return what a material is to become, as its settings are now.

    Returns
    -------
    Its `request` has the sample, σ in radians, and the model that holds in place of "auto";
    `model_reason` says why.

    Raises
    ------
    MaterialError
        The material has no spectrum that can be read.
    DomainError
        Its spectrum or a setting cannot be used.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], gloss="none")
    >>> wanted = settle(wall).request
    >>> wanted.sample.name, wanted.model, round(wanted.sigma, 4)
    ('ColorChecker 21 Neutral 6.5 (.44 D)', 'surface', 0.5236)
    """
    return settled.of(checked(material))


def differences(material: bpy.types.Material) -> Differences:
    """Tell how far the surface in Cycles is from its target, as predicted: nothing is rendered.

    Returns
    -------
    ΔE00 at the virtual instrument, and its mean and 95th percentile over all angles.

    Raises
    ------
    MaterialError, DomainError
        As of `settle`; or the surface shows what nobody predicts, such as gloss or a texture.

    Examples
    --------
    >>> wall = bpy.data.materials.new("Wall")
    >>> _ = assign([(wall, request(find("neutral 6.5"), radians(30)))], gloss="none")
    >>> instrument, mean, _ = differences(wall)
    >>> round(instrument, 2), round(mean, 1)
    (0.0, 0.8)
    """
    return settled.differences(checked(material), working_space.current())
