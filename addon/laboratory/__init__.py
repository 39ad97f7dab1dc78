# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The virtual laboratory: rough samples as meshes, measured in Cycles as flat ones are.

kinds       the samples that can be made, and what each needs
height_map  a user's own surface, from an image or a profilometer's file
experiment  measure a mesh: albedos, a spot, its spread over places, its noise
readings    from a spectrum to albedos, and what was measured as a table
place       put a sample into a scene
worker      the script inside a second Blender
"""
