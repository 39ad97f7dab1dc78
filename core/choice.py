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


SLANTING_DEGREES = 45.0
"""From the surface's normal: farther down than where an instrument's light comes from."""


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
    slanting: npt.ArrayLike | None = None,
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
    slanting
        In which of the directions light or view is more than `SLANTING_DEGREES` from the normal,
        bool, of the same shape; None where nobody knows. Where only these are off by more than is
        allowed, the reason says so.

    Returns
    -------
    The cheaper one that is good enough; if none is, the closer one, and the reason says so.

    Examples
    --------
    >>> choice = choose_shader([0.4, 2.5], [0.1, 0.3])
    >>> choice.model, choice.error
    ('rough', 0.3)
    >>> choice.reason
    'rough: within ΔE00 1 in all directions, at most 0.30; without roughness up to 2.50.'
    >>> choose_shader([0.4, 2.5], [0.1, 1.3], slanting=[False, True]).reason.partition(";")[0]
    'rough: off by more than ΔE00 1 in 50 % of directions, all slanting, at most 1.30'
    """
    apart = {
        name: np.where(np.isfinite(error), error, np.inf)
        for name, error in zip(
            SHADERS, map(np.asarray, (errors_lambert, errors_rough)), strict=True
        )
    }
    errors = {name: float(error.max()) for name, error in apart.items()}
    kept = " with gloss" if gloss else ""
    if errors["lambert"] <= tolerance:
        reason = f"lambert{kept}: {_off(apart['lambert'], tolerance, slanting)}."
        return Choice("lambert", errors["lambert"], errors, reason)
    is_rough = errors["rough"] <= tolerance or errors["rough"] < errors["lambert"]
    model, other = SHADERS[::-1] if is_rough else SHADERS
    reason = (
        f"{model}{kept}: {_off(apart[model], tolerance, slanting)}; "
        f"{'without' if is_rough else 'with'} roughness up to {_number(errors[other], tolerance)}."
    )
    return Choice(model, errors[model], errors, reason)


def _off(errors: npt.NDArray[np.float64], tolerance: float, slanting: npt.ArrayLike | None) -> str:
    """Say in how many directions a material is off, and how far at most."""
    far = errors > tolerance
    most = f"at most {_number(float(errors.max()), tolerance)}"
    if not far.any():
        return f"within ΔE00 {tolerance:g} in all directions, {most}"
    where = "" if slanting is None or np.any(far & ~np.asarray(slanting)) else ", all slanting"
    share = max(round(100 * float(far.mean())), 1)
    return f"off by more than ΔE00 {tolerance:g} in {share} % of directions{where}, {most}"


def _number(error: float, tolerance: float) -> str:
    """Two digits, and four where two would print the error as the tolerance it isn't."""
    if not np.isfinite(error):
        return "an unknown amount"
    short = f"{error:.2f}"
    return f"{error:.4f}" if short == f"{tolerance:.2f}" else short
