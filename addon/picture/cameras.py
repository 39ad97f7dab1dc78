# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What cameras for the infrared are unless told otherwise. Imports nothing, for the settings."""

NEAR = 700.0, 1000.0
"""Band of a camera that sees lamps, nanometers."""
THERMAL = 8000.0, 14000.0
"""Band of a camera that sees heat, nanometers."""
LONGEST = 100_000.0
"""Of a band that the interface offers."""
AMBIENT = 293.15
"""Kelvin of what has no temperature of its own."""
EMISSIVITY = 0.95
"""Of what nothing is known of in the infrared."""
HOTTEST = 20_000.0
"""Kelvin that are taken for a temperature at most."""
TEMPERATURE = "rough_spectra_temperature"
"""Custom property of an object, or attribute of its mesh's vertices: its temperature, kelvin."""
