# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender itself: shader nodes, the working space, a second Blender, saving. Nothing of spectra."""
