# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A spectral picture of the scene by ordinary renders of three bands each, in a second Blender.

find_colors    where colors stand in materials, lamps and world
color_spectra  what spectra they stand for
colors         what was found of both
places         where a color stands, and names of datablocks
scene_copy     a copy of the open file for the second Blender
passes         the renders: which bands, and what each color is in them
direct_light   whether direct light has renders of its own
worker         the script of the second Blender, which sets colors and renders
render         asks for it, and puts the renders together
channels       what was rendered, on the disk
spectra        the spectrum of each pixel
picture        the picture that comes of it, beside the ordinary one
settings       how a scene's picture is rendered from the interface
images         the last picture as images of the open file
last_verdict   the last verdict on a scene of it
of_file        what is kept in memory as long as a file is open
pixel          what a pixel of it is
exr_file       pixels as a file
files          the picture as a file and as Blender's image
verdict        whether RGB is enough, by small pictures, and if not, what is
groups         each lamp's light apart
relight        other lamps in a picture of which that was rendered
relit          other lamps while the user watches: an image of the open file
lamp_sliders   what sets them in the interface
frames         pictures of a range of frames
infrared       what a camera sees of lamps in the infrared, with infrared_wanted, infrared_light,
               infrared_scene and infrared_file
cameras        what cameras for the infrared are unless told otherwise
camera_images  what they saw last, as images of the open file
through_undo   images stay where undo goes back to a file without them
thermal        what a thermal camera sees, with thermal_worker and thermal_file
"""
