# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What to make of one sample: its roughness, the model, and the light to be right under."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...core.errors import DomainError
from ..samples.sample import Sample
from .scene_view import SceneView

VIRTUAL = "45a:0"
"""Instrument that materials are matched and measured with, whichever gave the reading."""

AUTO = "auto"
"""Model of a request that leaves the choice to `solve.choose`."""

TOLERANCE = 1.0
"""Largest ΔE00 from the reference that a model may have to be chosen."""


@dataclass(frozen=True)
class Request:
    """What to make of one sample.

    Parameters
    ----------
    sample
        The measured spectrum.
    sigma
        Roughness σ, radians.
    model
        One of `core.models.NAMES`, or `AUTO` for the cheapest that is good enough.
    illuminant
        The light under which the color is right.
    observer
        Of the colorimetry in reports; scene RGB is always of the 2° observer.
    scene
        Lights and directions that it is matched for instead of the illuminant and the whole
        hemisphere, or None.
    flat
        Whether the scene is rendered by an engine that ignores roughness. Only a scene has an
        engine: without one, a material is always made for Cycles.
    tolerance
        Largest ΔE00 that "auto" accepts for the sake of a simpler model.

    Raises
    ------
    DomainError
        If σ or the tolerance is no number, as a driver or a script may leave it.
    """

    sample: Sample
    sigma: float
    model: str = AUTO
    illuminant: str = "D65"
    observer: int = 2
    scene: SceneView | None = None
    flat: bool = False
    tolerance: float = TOLERANCE

    def __post_init__(self) -> None:
        """Refuse what would spread through every color."""
        for label, value in (("σ", self.sigma), ("The tolerance", self.tolerance)):
            if not math.isfinite(value):
                msg = f"{label} is not a number; set it again, or mend its driver."
                raise DomainError(msg)
