# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What every wing needs of the machine: files that appear whole, locks, the doors to libraries."""
