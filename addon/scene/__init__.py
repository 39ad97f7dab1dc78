# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene's lights, and the directions in which the camera sees its materials.

What a lamp sends, where that is known, is told by `light_spectra`, and what it keeps in the .blend
by `chosen_light`, to analyses as to spectral pictures.
"""
