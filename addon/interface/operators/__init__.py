# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators, one a file: thin wrappers over plain functions that scripts can call too."""
