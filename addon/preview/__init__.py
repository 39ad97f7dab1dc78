# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures in the panel: colors side by side, spectra and angles, drawn with numpy alone.

raster, text, glyphs   pixels and letters
theme                  colors of the interface, made readable
figures                data → picture; knows no Blender
data                   what a material's figures show
icons                  pictures that a panel can draw
"""
