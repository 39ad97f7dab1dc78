# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How the core treats its arguments: precision is kept as given, domains are checked.

numpy 1.26 and numpy 2 promote scalars differently; deciding the precision here, once, makes the
same call return the same dtype under both.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import DomainError

Array = npt.NDArray[Any]

_LARGEST_ANGLE = np.pi / 2 * (1 + 4 * float(np.finfo(np.float32).eps))
"""π/2 and four of float32's last places: np.float32(np.pi / 2) lies above π/2 by half of one. It is
the limit in float64 too, because such an angle often meets a float64 spectrum."""


def precision(*values: npt.ArrayLike) -> np.dtype[Any]:
    """Choose the dtype of a computation: float32 if every array given is float32, else float64.

    Python and numpy scalars adapt to the arrays; they decide only where no array is given.

    Examples
    --------
    >>> precision(np.ones(3, np.float32), 0.5).name
    'float32'
    >>> precision(np.ones(3, np.float32), np.ones(3)).name
    'float64'
    """
    dtypes = [value.dtype for value in values if isinstance(value, np.ndarray) and value.ndim > 0]
    if not dtypes:
        dtypes = [value.dtype for value in values if isinstance(value, (np.ndarray, np.generic))]
    single = bool(dtypes) and all(dtype == np.float32 for dtype in dtypes)
    return np.dtype(np.float32 if single else np.float64)


def spectrum(values: npt.ArrayLike, what: str) -> Array:
    """Give `values` as an array with a band axis, float32 kept and all else float64.

    Raises
    ------
    DomainError
        If `values` has no band axis.

    Examples
    --------
    >>> spectrum([0, 1], "the albedo").dtype.name
    'float64'
    >>> spectrum(np.ones(2, np.float32), "the albedo").dtype.name
    'float32'
    """
    array = np.asarray(values)
    if array.ndim == 0:
        msg = f"{what} is a single number; give an array whose last axis is the bands."
        raise DomainError(msg)
    return array if array.dtype == np.float32 else array.astype(np.float64, copy=False)


def polar_angle(angle: npt.ArrayLike, what: str, dtype: np.dtype[Any]) -> Array:
    """Check that a polar angle lies in [0, π/2] and keep its tangent positive.

    np.float32(np.pi / 2) lies above π/2 and has the tangent -2.3e7; such angles are moved to the
    largest value of their precision that is not above π/2. NaN passes.

    Examples
    --------
    >>> polar_angle([0.0, 0.5], "theta_i", np.dtype(np.float64)).tolist()
    [0.0, 0.5]
    >>> single = polar_angle(np.float32(np.pi / 2), "theta_i", np.dtype(np.float32))
    >>> float(np.float32(np.pi / 2)) > np.pi / 2 > float(single)
    True
    """
    array = np.asarray(angle, dtype=dtype)
    half_pi = dtype.type(np.pi / 2)
    _check_range(array, what)
    if float(half_pi) > np.pi / 2:
        half_pi = np.nextafter(half_pi, dtype.type(0))
    return np.asarray(np.minimum(array, half_pi))


def slope_deviation(sigma: npt.ArrayLike, dtype: np.dtype[Any]) -> Array:
    """Check that the roughness σ lies in [0, π/2] radians. NaN passes.

    Examples
    --------
    >>> slope_deviation([0.0, 0.5], np.dtype(np.float64)).tolist()
    [0.0, 0.5]
    """
    array = np.asarray(sigma, dtype=dtype)
    _check_range(array, "the roughness sigma")
    return array


def _check_range(array: Array, what: str) -> None:
    outside = (array < 0) | (array > _LARGEST_ANGLE)
    if np.count_nonzero(outside):
        worst = float(array[outside].flat[0])
        msg = (
            f"{what} holds {worst:.6g} rad ({np.degrees(worst):.4g}°), outside 0 to π/2; "
            "angles are radians, so convert degrees with numpy.radians."
        )
        raise DomainError(msg)
