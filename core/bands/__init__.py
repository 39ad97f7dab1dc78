# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A spectral picture from a renderer of three channels: which bands, and how good they are.

Red, green and blue never mix in it. With three bands of every albedo and every lamp in the three
channels, one picture is three bands of a spectral one.

choice        the fewest bands within a tolerance, and what is predicted of them and of plain RGB
paths         the products of spectra that light may meet
wavelengths   which of them tell most
fitting       weights, and what lamps send in the bands
restoring     from the bands back to a whole spectrum
"""

from .choice import IN_A_PASS, MOST, MOST_RAISED, Bands, Error, at, choose, rgb

__all__ = ["IN_A_PASS", "MOST", "MOST_RAISED", "Bands", "Error", "at", "choose", "rgb"]
