# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `dev.py` starts, and what measures, checks and makes; run from the root, as modules."""
