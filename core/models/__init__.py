# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The models of a rough surface: one line each, and one file each.

lambert       r = ρ
first-order   r = F1 ρ                             light that leaves after one bounce
two-bounce    r = F1 ρ + F2 ρ²                     the published model: `core.oren_nayar`
closure       r = ρ (b + a / (1 + √(1 - g ρ)))     V-grooves, tabulated: `core.vcavity.closed`
reference     r = Σ a_k ρ^k                        the V-cavity itself: `core.vcavity`
surface       r = ρ (b + a / (1 + √(1 - g ρ)))     random surfaces, traced: `core.surface`

A model is added by its line here, before the last, which is what materials are matched to, and its
file: core/models/<name>.py with the three functions of `Formulas`. Everything that lists models
follows: `core.reading`, `core.ladder`, the menu of the panel, and the options of the command line.

Blender reads this at its start: nothing here may import numpy.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Protocol, cast

from ..errors import DomainError

if TYPE_CHECKING:
    import numpy.typing as npt

    from ..numerics.arrays import Array


class Formulas(Protocol):
    """What the file of a model holds."""

    def reflectance(
        self,
        albedo: npt.ArrayLike,
        theta_i: npt.ArrayLike,
        theta_r: npt.ArrayLike,
        delta_phi: npt.ArrayLike,
        sigma: npt.ArrayLike,
    ) -> Array:
        """Give r(λ) in one direction each: see `core.ladder.reflectance`."""

    def from_albedo(self, albedo: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
        """Give r(λ) at an instrument: see `core.reading.from_albedo`."""

    def to_albedo(self, reading: npt.ArrayLike, sigma: npt.ArrayLike, instrument: str) -> Array:
        """Give the albedo behind a reading: see `core.reading.to_albedo`."""


@dataclass(frozen=True)
class Model:
    """One model.

    Attributes
    ----------
    name
        What code, files and the command line call it.
    title, description
        What the panel calls it, and its tooltip, which Blender ends with a period.
    number
        What a .blend stores for it: never changed, and never given to another. 3 is taken by
        "auto".
    largest_sigma
        To where it holds, degrees. A table ends there; the reference goes on, less exactly, to
        grooves that are slots.
    """

    name: str
    title: str
    description: str
    number: int
    largest_sigma: float = 90.0

    @cached_property
    def formulas(self) -> Formulas:
        """The functions of its file."""
        file = f".{self.name.replace('-', '_')}"
        return cast("Formulas", import_module(file, __name__))


_MODELS = (
    Model("lambert", "Lambert", "As if the surface were smooth", 4),
    Model("first-order", "First-order", "Without light between facets: F1 ρ", 1),
    Model("two-bounce", "Two-bounce", "Oren and Nayar's published model: F1 ρ + F2 ρ²", 0),
    Model("closure", "Closure", "V-grooves, all bounces, in closed form and tabulated", 2, 65.0),
    Model(
        "reference",
        "Reference",
        "The V-cavity itself, all bounces; takes seconds at first use",
        5,
        80.0,
    ),
    Model(
        "surface", "Surface", "Random rough surfaces, all bounces, traced and tabulated", 6, 65.0
    ),
)

REGISTRY: Mapping[str, Model] = MappingProxyType({model.name: model for model in _MODELS})
"""Every model by its name."""

NAMES = tuple(REGISTRY)

TARGET = NAMES[-1]
"""The model that materials are matched to unless another is asked for. Choosing a cheaper one where
it would do saves nothing: this one is a table, and the choice costs more than its evaluation."""


def find(name: str) -> Model:
    """Give the model of this name.

    Raises
    ------
    DomainError
        If there is none; the message lists the names.

    Examples
    --------
    >>> find("two-bounce").title
    'Two-bounce'
    >>> float(find("two-bounce").formulas.from_albedo([1.0], 0.0, "45a:0")[0])
    1.0
    """
    if name not in REGISTRY:
        msg = f"Model {name!r} is not known; choose one of: {', '.join(REGISTRY)}."
        raise DomainError(msg)
    return REGISTRY[name]
