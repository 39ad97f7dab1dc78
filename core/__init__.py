# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The physics of rough spectral surfaces, on numpy arrays alone.

Angles are radians, wavelengths nanometers, and the last axis of a spectrum is its bands.
"""
