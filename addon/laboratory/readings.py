# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From a spectrum to the facets of a rough sample, and what was measured of it as a table."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from math import degrees, radians

from ...core import models, reading, vcavity
from ...core.errors import DomainError
from ...core.numerics.arrays import Array
from ..matching import surface_spectra
from ..matching.request import Request
from ..samples.sample import Sample
from ..support.version import version
from .experiment import Measured
from .kinds import KINDS, RoughSample

MODEL = models.TARGET
"""What the table's prediction is made by, and what finds the facets' albedo behind a reading."""

HEADER = ("albedo", "reflectance", "noise", "spread", "noise_of_a_spot", "predicted")


def facets(sample: Sample) -> Sample:
    """Give the albedo of facets of a measured material.

    Parameters
    ----------
    sample
        Of kind "albedo"; or a reading, whose roughness is taken out, where it has one.

    Raises
    ------
    DomainError
        If it reads more than white facets do, as with fluorescence or gloss.
    """
    if sample.kind == "albedo":
        return sample
    request = Request(sample, radians(sample.sigma_degrees or 0.0), MODEL)
    with surface_spectra.naming(sample):
        albedo = surface_spectra.albedos([request], MODEL)[0]
        if albedo.max() > 1:
            at = sample.wavelengths[albedo.argmax()]
            msg = (
                f"at {at:g} nm it reads more than white facets do, which no surface of facets can; "
                "take another sample."
            )
            raise DomainError(msg)
    return replace(sample, kind="albedo", values=albedo, lab=None, xyz=None)


def predict(rough: RoughSample, measured: Measured) -> tuple[Array, str]:
    """Predict what was measured, from σ: grooves by the solver, all else by `MODEL`.

    Returns
    -------
    Reflectance factors, shape (n,), and what they were predicted by.
    """
    if rough.law is not None and rough.asked is not None:
        found = vcavity.reading_from_albedo(measured.albedos, rough.asked, slopes=rough.law)
        return found, f"the solver of V-grooves, slope law {rough.law}"
    steepest = models.find(MODEL).largest_sigma
    sigma = min(rough.sigma, radians(steepest))
    by = f"the model {MODEL}" + (f" at {steepest:g} degrees" if sigma < rough.sigma else "")
    return reading.from_albedo(measured.albedos, sigma, MODEL, "45a:0"), by


def to_csv(rough: RoughSample, measured: Measured, wavelengths: Array | None = None) -> bytes:
    """Give the table: comment lines that say what was measured, a header, a row an albedo.

    Parameters
    ----------
    rough, measured
        The sample, and what was found.
    wavelengths
        Of the albedos, nanometers, where they are a spectrum.
    """
    mesh, kind = rough.mesh, KINDS[rough.kind]
    asked = "as it came" if rough.asked is None else f"{degrees(rough.asked):g} degrees"
    predicted, by = predict(rough, measured)
    comments = (
        f"creator: Rough Spectra {version()}",
        f"sample: {kind.title}, seed {rough.seed}, {kind.length} {rough.length:g}",
        f"sigma: {asked}; Rdq {mesh.rdq:.5g} (atan {degrees(rough.sigma):.3f} degrees), "
        f"Sdq {mesh.sdq:.5g}, of {len(mesh.faces)} facets",
        "instrument: 45a:0, rendered by Cycles, all bounces",
        f"spot: {measured.spot:g} of a period of {mesh.period[0]:g} x {mesh.period[1]:g}",
        "units: fraction (reflectance factor, 1 = perfect white diffuser)",
        "noise: standard error; spread: standard deviation over places of the spot, without noise",
        f"predicted: by {by}",
    )
    text = io.StringIO()
    text.writelines(f"# {line}\n" for line in comments)
    table = csv.writer(text, lineterminator="\n")
    table.writerow(HEADER if wavelengths is None else ("wavelength_nm", *HEADER))
    columns = (
        measured.albedos,
        measured.reflectance,
        measured.noise,
        measured.spread,
        measured.spot_noise,
        predicted,
    )
    for number, row in enumerate(zip(*columns, strict=True)):
        cells = [f"{value:.6f}" for value in row]
        table.writerow(cells if wavelengths is None else [f"{wavelengths[number]:g}", *cells])
    return text.getvalue().encode()
