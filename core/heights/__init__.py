# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rough surfaces as shapes: heights over a plane, and meshes of them, periodic both ways.

field       heights on a grid, and what a profilometer says of them
spectral    random surfaces of Gaussian heights: one scale, or many
grains      spheres that fell on each other
grooves     V-grooves of either slope law
mesh        facets of any of these
"""

from .field import HeightField
from .grains import grains
from .grooves import LAWS, Grooves, grooves
from .mesh import Mesh, mesh_of_field, mesh_of_grooves
from .spectral import gaussian, multiscale

__all__ = [
    "LAWS",
    "Grooves",
    "HeightField",
    "Mesh",
    "gaussian",
    "grains",
    "grooves",
    "mesh_of_field",
    "mesh_of_grooves",
    "multiscale",
]
