# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What to make of one sample: its roughness, the model, and the light to be right under."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ...core import instruments, limits
from ...core.errors import DomainError
from ...core.models import NAMES
from ..colorimetry.tristimulus import ILLUMINANTS, OBSERVERS
from ..samples.sample import Sample
from .scene_view import SceneView

AUTO = "auto"
"""Model of a request that asks for none: `core.models.TARGET`."""


@dataclass(frozen=True)
class Request:
    """What to make of one sample.

    Parameters
    ----------
    sample
        The measured spectrum.
    sigma
        Roughness σ, radians, up to `limits.MATCHED_SIGMA`: tan σ is Rdq, the rms slope of a
        profile; see `core.roughness`.
    model
        One of `core.models.NAMES`, or `AUTO`.
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
        Largest ΔE00 that "auto" accepts for the sake of a shader without roughness.
    read_at
        Virtual instrument that the material is to read right at, one of
        `core.instruments.REGISTRY`. `sample.instrument` is the real one that the sample was
        measured with.

    Raises
    ------
    DomainError
        If a setting is none that a material could store, as a driver or a script may leave it, or
        the sample has no color.
    """

    sample: Sample
    sigma: float
    model: str = AUTO
    illuminant: str = "D65"
    observer: int = 2
    scene: SceneView | None = None
    flat: bool = False
    tolerance: float = limits.TOLERANCE
    read_at: str = instruments.DEFAULT

    def __post_init__(self) -> None:
        """Refuse what would spread through every color, or stop the writing of many materials."""
        if not self.sample.has_color:
            nm = self.sample.wavelengths
            holds = (
                "emissivity" if self.sample.kind == "emissivity" else "nothing that the eye sees"
            )
            msg = (
                f"{self.sample.source or 'Sample'}, {self.sample.name!r}: it holds {holds}, "
                f"{nm[0]:g} to {nm[-1]:g} nm, so it has no color for a material; take a visible "
                "reading or albedo, and this one for 'emissivity'."
            )
            raise DomainError(msg)
        for label, value in (("σ", self.sigma), ("The tolerance", self.tolerance)):
            if not math.isfinite(value):
                msg = f"{label} is not a number; set it again, or mend its driver."
                raise DomainError(msg)
        if not 0 <= self.sigma <= limits.MATCHED_SIGMA:
            msg = f"σ is {self.sigma:g} radians; give 0 to π/3, as math.radians(30) is."
            if limits.MATCHED_SIGMA < self.sigma <= limits.LARGEST_SIGMA:
                msg = limits.sigma_fault(math.degrees(self.sigma))
            raise DomainError(msg)
        lowest, highest = limits.TOLERANCES
        if not lowest <= self.tolerance <= highest:
            msg = f"The tolerance is ΔE00 {self.tolerance:g}; give {lowest:g} to {highest:g}."
            raise DomainError(msg)
        for label, name, known in (
            ("model", self.model, (AUTO, *NAMES)),
            ("illuminant", self.illuminant, ILLUMINANTS),
            ("observer", self.observer, OBSERVERS),
            ("virtual instrument", self.read_at, tuple(instruments.REGISTRY)),
        ):
            if name not in known:
                choices = ", ".join(map(str, known))
                msg = f"The {label} {name!r} is not known; choose one of {choices}."
                raise DomainError(msg)
