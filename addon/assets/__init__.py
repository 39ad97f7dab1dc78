# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender asset libraries of measured materials, made in a Blender of its own."""
