# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Color as arrays: L*a*b*, CIEDE2000, adaptation to another white."""
