# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One verb of the command line a module: SUMMARY, DESCRIPTION, add_arguments and run."""
