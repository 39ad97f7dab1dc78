# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured BRDFs of RGL's material database (.bsdf), with spectra: a set of angles.

The whole BRDF is more than a sample holds. What 45°/0° and multi-angle instruments would read of it
is taken from it; see `parts.measured_brdf`.
"""

from __future__ import annotations

import numpy as np

from .....core.instruments import REGISTRY
from .....core.numerics.arrays import Array
from ...sample import Sample
from ..parts import series, tensor_file
from ..parts.document import Document, quote
from ..parts.measured_brdf import MeasuredBrdf

NAME = "measured BRDF of RGL (.bsdf)"
ENDINGS = ("bsdf",)
PRIORITY = 100

_FIELDS = {
    "phi_i": 1,
    "theta_i": 1,
    "wavelengths": 1,
    "ndf": 2,
    "sigma": 2,
    "vndf": 4,
    "spectra": 5,
}
"""What is needed, and how many dimensions it has."""
_READINGS = ("45a:0", "45as-15", "45as15", "45as25", "45as75", "45as110")
"""45as45 is 45a:0 again: each is the mean over the sample's azimuths."""
_TURNS = 16
"""Azimuths of an anisotropic sample that a reading is the mean of."""
_MEAN = "The sample is anisotropic: each reading is a mean over azimuths, as if it were turned."
_TAKEN = "The readings were taken from a whole measured BRDF, between its directions."


def sniff(document: Document) -> bool:
    """Return whether the file begins as tensor files do."""
    return document.head.startswith(tensor_file.MAGIC)


def read(document: Document) -> list[Sample]:
    """Return the readings of the instruments that look from single directions.

    Raises
    ------
    InputError
        It is damaged, holds no spectra, or an array is not what a BRDF needs.
    """
    fields = tensor_file.fields(document)
    if "spectra" not in fields and "rgb" in fields:
        raise document.error(
            "", "it holds red, green and blue instead of spectra; download the spectral file"
        )
    for name, dimensions in _FIELDS.items():
        found = fields.get(name)
        if found is None:
            raise document.error("", f"it has no field {quote(name)}; download the file again")
        if found.ndim != dimensions or found.dtype.kind != "f" or min(found.shape[-2:]) < 1:
            raise document.error(f"field {quote(name)}", _IMPOSSIBLE)
    nm, brdf = fields["wavelengths"].astype(np.float64), _brdf(document, fields)
    samples = []
    for name in _READINGS:
        with np.errstate(all="ignore"):  # what is no number is refused below
            values = _reading(brdf, name)
        place = f"at {name}"
        found_bands = series.bands(
            nm, values, f"{document.path}, {place}", lambda band: f"wavelength {band + 1}"
        )
        samples.append(
            Sample(
                name=document.path.stem.removesuffix("_spec"),
                wavelengths=found_bands.wavelengths,
                values=found_bands.values,
                kind="reading",
                quantity="π times the BRDF",
                instrument=name,
                geometry=name,
                source=str(document.path),
                altered=(_TAKEN, *(() if brdf.is_isotropic else (_MEAN,)), *found_bands.altered),
            )
        )
    return samples


_IMPOSSIBLE = "its type or shape is not that of a measured BRDF; download the file again"


def _brdf(document: Document, fields: dict[str, np.ndarray]) -> MeasuredBrdf:
    """Return the BRDF of arrays that fit together."""
    phi, theta = fields["phi_i"], fields["theta_i"]
    lights = (len(phi), len(theta))
    fits = fields["vndf"].shape[:2] == lights == fields["spectra"].shape[:2]
    fits = fits and fields["spectra"].shape[2] == len(fields["wavelengths"])
    tables = (fields[name] for name in ("ndf", "sigma", "vndf", "spectra"))
    if not fits or any(min(table.shape[-2:]) < 2 for table in tables):
        raise document.error("", _IMPOSSIBLE)
    for name in ("phi_i", "theta_i"):
        if not np.isfinite(fields[name]).all() or (np.diff(fields[name]) <= 0).any():
            raise document.error(
                f"field {quote(name)}", "its angles do not increase; download the file again"
            )
    jacobian = fields.get("jacobian")
    brdf = MeasuredBrdf(
        phi=phi,
        theta=theta,
        normals=fields["ndf"],
        area=fields["sigma"],
        visible=fields["vndf"],
        spectra=fields["spectra"],
        divided=jacobian is None or bool(jacobian.flat[0]),
    )
    if brdf.symmetries not in (1, 2, 4):
        raise document.error(
            "field 'phi_i'",
            f"it covers one part in {brdf.symmetries} of all azimuths, and one, two or four are "
            "known; download the file again",
        )
    return brdf


def _reading(brdf: MeasuredBrdf, name: str) -> Array:
    instrument = REGISTRY[name]
    apart = np.radians(instrument.azimuth)
    turns = (
        [0.0] if brdf.is_isotropic else ((np.arange(_TURNS) + 0.5) * (2 * np.pi / _TURNS)).tolist()
    )
    readings = [
        brdf.factors(
            _direction(instrument.light.tilt, turn), _direction(instrument.view.tilt, turn + apart)
        )
        for turn in turns
    ]
    mean: Array = np.mean(readings, axis=0)
    return mean


def _direction(tilt: float, azimuth: float) -> Array:
    angle = np.radians(tilt)
    flat = np.sin(angle)
    return np.array([flat * np.cos(azimuth), flat * np.sin(azimuth), np.cos(angle)])
