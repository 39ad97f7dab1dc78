# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The chart of cost against error: every model, shortcut and peer on the same work."""
