# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two samples, with their settings, side by side."""

from __future__ import annotations

from collections.abc import Sequence

from ..matching import compare as matching_compare
from ..matching import metamerism as matching_metamerism
from ..matching.compare import Comparison
from ..matching.metamerism import LIGHTS, InLight
from ..matching.request import Request
from ..samples.sample import Sample
from .assigning import request


def compare(first: Sample | Request, second: Sample | Request) -> Comparison:
    """Tell how far two samples are apart, as measured and as the albedos behind.

    Parameters
    ----------
    first, second
        What is compared. A sample alone stands for `request(sample)`.

    Returns
    -------
    `measured` between what the virtual instrument reads, `albedos` between the albedos, and
    `roughness`, for each of the two what its roughness does: from its albedo to its reading. Each
    has `delta_e_00`; `delta_l`, `delta_a` and `delta_b`, second less first; `delta_ab`; and
    `shift`, the distance in a*b* once both have the luminance of the first. `interreflection` is
    the share of each one's reading that met more than one facet.

    Raises
    ------
    DomainError
        Model, illuminant, observer or virtual instrument differ, or a spectrum does not cover the
        visible range.

    Examples
    --------
    >>> green = find("green")
    >>> smooth, rough = (request(green, radians(degrees), kind="albedo") for degrees in (0, 45))
    >>> found = compare(smooth, rough)
    >>> round(found.measured.delta_e_00, 1), round(found.albedos.delta_e_00, 1)
    (7.9, 0.0)
    >>> round(found.measured.shift, 1), round(found.interreflection[1], 2)
    (3.0, 0.1)
    """
    pair = (request(what) if isinstance(what, Sample) else what for what in (first, second))
    return matching_compare.compare(*pair)


def metamerism(
    first: Sample | Request, second: Sample | Request, lights: Sequence[str] = LIGHTS
) -> list[InLight]:
    """Tell how far two materials that match under D65 are apart in other lights.

    Parameters
    ----------
    first, second
        What is compared. A sample alone stands for `request(sample)`.
    lights
        Illuminants, as in `request`.

    Returns
    -------
    D65, then each of the lights: its name, `light`; `delta_e_00`, how far they are apart there; and
    `index`, the special metamerism index of CIE 15:2004 with the correction of ISO 18314-4:2024:
    the part of the difference that D65 does not show.

    Raises
    ------
    DomainError
        A light is not known, or a spectrum does not cover the visible range.

    Examples
    --------
    >>> _, lamp = metamerism(find("brick"), find("dark skin"), ["A"])
    >>> lamp.light, round(lamp.delta_e_00, 1), round(lamp.index, 1)
    ('A', 5.9, 0.9)
    """
    one, other = (request(x) if isinstance(x, Sample) else x for x in (first, second))
    return list(matching_metamerism.compare(one, other, lights))
