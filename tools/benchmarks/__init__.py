# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What things cost: beside a peer or a copy in the same run, or as they grow."""
