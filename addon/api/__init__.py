# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts may rely on: names and arguments here change only with a note in the changelog.

From a file to files:

    read, find → request → assign → state, renew, keep → bake → write
    read, find → emissivity → write_emissivity
    materials → export, for other renderers
    spectral_picture → write_picture, picture_image; picture_verdict
    picture_lights → relight → write_picture; thermal_picture → write_thermal;
    infrared_picture → write_infrared

σ is in radians, wavelengths in nanometers, reflectance from 0 to 1, colors in the scene-linear RGB
of the open file. Whatever the caller can mend is a `RoughSpectraError` whose text says where and
how; nothing was changed or written then. The page "Scripts" of the manual tells how to import this
module, and has a whole script.

The examples are run as tests, with the names of this module, `bpy`, `Path` and `radians`.
"""

from __future__ import annotations

from ...core.cycles.gloss_estimate import GlossEstimate
from ...core.emissivity import Filter
from ...core.errors import (
    CancelledError,
    DomainError,
    InputError,
    MaterialError,
    OutputError,
    RoughSpectraError,
)
from ...core.estimate import Estimate
from ...core.gloss import Gloss
from ...core.gloss_readings import GlossReadings
from ..export.entry import Entry
from ..export.kept import Loss
from ..export.write import Exported
from ..instrument.adjustment import Adjusted
from ..instrument.spot import Spot
from ..laboratory.experiment import Measured
from ..laboratory.kinds import RoughSample
from ..matching.assess import Differences
from ..matching.compare import Apart, Comparison
from ..matching.metamerism import InLight
from ..matching.request import Request
from ..matching.solution import Solution
from ..material.settled import Settled
from ..material.state import State
from ..picture.infrared import InfraredPicture
from ..picture.picture import SpectralPicture
from ..picture.pixel import Pixel
from ..picture.relight import Lights
from ..picture.thermal import ThermalPicture
from ..picture.verdict import Verdict
from ..readings.document import Reading, Readings, SpotRead
from ..readings.emission import Emissivity, InBand
from ..samples.palette import Row
from ..samples.sample import Sample
from ..textures.wanted import Made
from .assigning import assign, match_by_measuring, request
from .comparing import compare, metamerism
from .emitting import emissivity, read_filter, write_emissivity
from .exporting import export, export_losses
from .infrared import infrared_picture, thermal_picture, write_infrared, write_thermal
from .lamps import measured_light, picture_lights, relight
from .measuring import bake, gloss, spots, write
from .pictures import picture_image, picture_pixel, picture_verdict, spectral_picture, write_picture
from .rough_surfaces import make_texture, measure_rough, rough_sample, texture_material
from .samples import estimate, estimate_gloss, find, gloss_readings, nearest, palette, presets, read
from .upkeep import differences, keep, materials, paused, renew, settle, state

__all__ = [
    "Adjusted",
    "Apart",
    "CancelledError",
    "Comparison",
    "Differences",
    "DomainError",
    "Emissivity",
    "Entry",
    "Estimate",
    "Exported",
    "Filter",
    "Gloss",
    "GlossEstimate",
    "GlossReadings",
    "InBand",
    "InLight",
    "InfraredPicture",
    "InputError",
    "Lights",
    "Loss",
    "Made",
    "MaterialError",
    "Measured",
    "OutputError",
    "Pixel",
    "Reading",
    "Readings",
    "Request",
    "RoughSample",
    "RoughSpectraError",
    "Row",
    "Sample",
    "Settled",
    "Solution",
    "SpectralPicture",
    "Spot",
    "SpotRead",
    "State",
    "ThermalPicture",
    "Verdict",
    "assign",
    "bake",
    "compare",
    "differences",
    "emissivity",
    "estimate",
    "estimate_gloss",
    "export",
    "export_losses",
    "find",
    "gloss",
    "gloss_readings",
    "infrared_picture",
    "keep",
    "make_texture",
    "match_by_measuring",
    "materials",
    "measure_rough",
    "measured_light",
    "metamerism",
    "nearest",
    "palette",
    "paused",
    "picture_image",
    "picture_lights",
    "picture_pixel",
    "picture_verdict",
    "presets",
    "read",
    "read_filter",
    "relight",
    "renew",
    "request",
    "rough_sample",
    "settle",
    "spectral_picture",
    "spots",
    "state",
    "texture_material",
    "thermal_picture",
    "write",
    "write_emissivity",
    "write_infrared",
    "write_picture",
    "write_thermal",
]
