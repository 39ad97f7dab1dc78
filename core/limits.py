# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Limits and defaults that formulas, files and the interface share; each is stated here alone.

Blender reads this at its start: nothing here may import numpy.
"""

import math

LARGEST_SIGMA_DEGREES = 90.0
"""Largest roughness σ, degrees, of the formulas of the core, as they were published."""

LARGEST_SIGMA = math.radians(LARGEST_SIGMA_DEGREES)
"""The same in radians."""

MATCHED_SIGMA_DEGREES = 60.0
"""Largest roughness σ, degrees, at which the model that materials are matched to holds: forms,
files and menus take no more."""

MATCHED_SIGMA = math.radians(MATCHED_SIGMA_DEGREES)
"""The same in radians."""


TOLERANCE = 1.0
"""Largest color difference from the reference, ΔE00, that a simpler model may have, unless the user
sets another."""

TOLERANCES = (0.05, 20.0)
"""Smallest and largest tolerance that can be set, ΔE00."""

REPEATABILITY = 0.001
"""Standard deviation of repeated readings, as a share of the reading, unless the user sets another:
makers of spectrophotometers promise some 0.1 % for a white tile."""

SPOT_DIAMETER = 8.0
"""Millimeters that an instrument sees of a surface unless told otherwise: the medium aperture of
common spectrophotometers."""

E308_NM = (360.0, 780.0)
"""First and last wavelength of the weights of ASTM E308."""

EYE_NM = (380.0, 780.0)
"""Wavelengths that the eye sees, as the CIE tabulates its daylight."""

COLOR_NM = (400.0, 700.0)
"""Wavelengths that have to be measured: without them the color of a sample is a guess."""


def sigma_fault(degrees: float) -> str:
    """Say why no material has a roughness σ in degrees, as the end of a sentence; empty if nothing.

    Examples
    --------
    >>> sigma_fault(30.0)
    ''
    >>> sigma_fault(-5.0)
    'σ is -5°; give 0 to 60 degrees.'
    >>> sigma_fault(75.0)
    'σ is 75°, and materials are matched up to 60°; give 0 to 60 degrees.'
    """
    if 0 <= degrees <= MATCHED_SIGMA_DEGREES:
        return ""
    most = f"{MATCHED_SIGMA_DEGREES:g}"
    beyond = f", and materials are matched up to {most}°" if degrees > 0 else ""
    return f"σ is {degrees:g}°{beyond}; give 0 to {most} degrees."
