# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The experiment that the 2007 report planned: what was read of rough samples against the models.

surfaces    what is held against the models: surfaces, materials and what was read of them
meshes      surfaces of the laboratory: rough meshes, measured in grays
colored     the same with the colors of a chart, judged
judge       the models' predictions, and σ and albedo inferred back
results     what `judge` found, as tables that can be read again
tables      the same in words and Markdown
figures     and as pictures
page        all of it as files
"""
