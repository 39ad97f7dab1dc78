# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What dev.py stands on: interpreters, environments, the trimmed wheel and the extension zip.

Standard library only and free of syntax newer than Python 3.9: any Python that a machine starts
with must be able to run it.
"""
