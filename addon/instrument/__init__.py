# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The virtual spectrophotometer: real Cycles renders of flat samples, in a Blender of its own."""
