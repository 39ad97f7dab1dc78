# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of rough surfaces, and what becomes of them in a material.

image      what an image is to the rest: pixels with a band axis, a few lines at a time
envi       cubes of spectral cameras, as ENVI writes them
picture    spectral OpenEXR, and red, green and blue
wanted     what to make of an image, and what was made
convert    from an image of readings to a texture of albedo or color
products   over the bands of many pixels
exr_file   what is written
material   the material of such a texture
"""
