# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From a request to the color and roughness of a shader that reads the same. No Blender here."""
