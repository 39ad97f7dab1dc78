# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What holds our answers to renders, to the solver and to the promises of the readers."""
