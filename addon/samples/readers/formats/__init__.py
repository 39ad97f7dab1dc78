# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One module a file format; what each owes: see `addon/samples/readers/__init__.py`."""
