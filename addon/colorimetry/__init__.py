# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From spectra to colors: tristimulus values, illuminants, RGB spaces, what a difference means."""
