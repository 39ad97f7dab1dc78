# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials for other renderers, each solved for the lobe of the renderer that shows it.

entry       one material for one target, and how far off it is
solve       from requests to entries; no Blender data here
spaces      RGB that renderers take
names       names that every renderer takes, and what is said of a material in a file
targets     the renderers, one file each
materials   what materials of Blender's are to be elsewhere
usd_job     USD, by Blender's own exporter in a second Blender: usd_worker
write       all of it into files, whole or not at all
kept        what Blender's own exporters make of materials
"""
