# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The cheapest that is good enough, with the reason in words.

Takes color differences that are known already, ΔE00: `addon.matching.solve` predicts those of
Blender's materials.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .limits import TOLERANCE

SHADERS = ("lambert", "rough")
"""Blender's materials: the Diffuse BSDF with roughness 0 and with the matched one."""


@dataclass(frozen=True)
class Choice:
    """The cheapest that is good enough.

    Attributes
    ----------
    model
        One of `SHADERS`.
    error
        Its predicted largest color difference from the target.
    errors
        The same for each that was looked at, cheapest first. Infinite where nothing is known.
    reason
        One sentence for a person.
    """

    model: str
    error: float
    errors: Mapping[str, float]
    reason: str


def choose_shader(
    errors_lambert: npt.ArrayLike,
    errors_rough: npt.ArrayLike,
    tolerance: float = TOLERANCE,
    gloss: bool = False,
) -> Choice:
    """Choose Blender's Lambertian or its rough material, both with the same reading at 45°/0°.

    Parameters
    ----------
    errors_lambert, errors_rough
        ΔE00 of the two from the target, over the directions and lights that occur, any shape.
    tolerance
        Largest ΔE00 allowed.
    gloss
        Whether both lie under a gloss, which was set by hand and is kept: the reason says so.

    Returns
    -------
    The cheaper one that is good enough; if none is, the closer one, and the reason says so.

    Examples
    --------
    >>> choice = choose_shader([0.4, 2.5], [0.1, 0.3])
    >>> choice.model, choice.error
    ('rough', 0.3)
    >>> choice.reason
    'rough: ΔE00 0.30 in the worst direction, within the 1 allowed; without roughness 2.50.'
    """
    lambert, rough = (
        float(np.max(np.where(np.isfinite(e), e, np.inf)))
        for e in (np.asarray(errors_lambert), np.asarray(errors_rough))
    )
    errors = dict(zip(SHADERS, (lambert, rough), strict=True))
    limit = f"the {tolerance:g} allowed"
    kept = " with gloss, which is kept as it is set" if gloss else ""
    if lambert <= tolerance:
        worst = _number(lambert, tolerance)
        reason = f"lambert{kept}: ΔE00 {worst} in the worst direction, within {limit}."
        return Choice("lambert", lambert, errors, reason)
    model = "rough" if rough <= tolerance or rough < lambert else "lambert"
    other = SHADERS[1 - SHADERS.index(model)]
    reason = (
        f"{model}{kept}: ΔE00 {_number(errors[model], tolerance)} in the worst direction, "
        f"{'within' if errors[model] <= tolerance else 'the closest there is to'} {limit}; "
        f"{'without' if model == 'rough' else 'with'} roughness "
        f"{_number(errors[other], tolerance)}."
    )
    return Choice(model, errors[model], errors, reason)


def _number(error: float, tolerance: float) -> str:
    """Two digits, and four where two would print the error as the tolerance it isn't."""
    if not np.isfinite(error):
        return "an unknown amount"
    short = f"{error:.2f}"
    return f"{error:.4f}" if short == f"{tolerance:.2f}" else short
