# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The published model with 50 digits: what both our forms and the textbook's are held against."""

import math
from decimal import Decimal, localcontext

import numpy as np

DIGITS = 50
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097")


def with_digits(function):
    def run(*arguments):
        with localcontext() as context:
            context.prec = DIGITS
            return function(*arguments)

    return run


def sin_cos(angle):
    """Sine and cosine of a Decimal by their series."""
    angle = angle % (2 * PI)
    sine = cosine = Decimal(0)
    term, order = Decimal(1), 0
    while abs(term) > Decimal(10) ** -(DIGITS + 5):
        cosine += term
        term = term * angle / (order + 1)
        sine += term
        term = -term * angle / (order + 2)
        order += 2
    return sine, cosine


def below_right_angle(angle):
    """Give the largest number of its precision that is not above π/2, or the angle itself."""
    limit = type(angle)(np.pi / 2)
    if float(limit) > math.pi / 2:
        limit = np.nextafter(limit, type(angle)(0))
    return min(angle, limit)


def coefficients(sigma):
    s2 = (sigma if isinstance(sigma, Decimal) else Decimal(float(sigma))) ** 2
    return 1 - s2 / 2 / (s2 + Decimal("0.33")), Decimal("0.17") * s2 / (s2 + Decimal("0.13"))


@with_digits
def factors(theta_i, theta_r, delta_phi, sigma):
    """F1, F2 and the size of the largest term of F1, from the paper's equations 30 and 31."""
    light, view = (Decimal(float(below_right_angle(t))) for t in (theta_i, theta_r))
    alpha, beta = max(light, view), min(light, view)
    s2 = Decimal(float(sigma)) ** 2
    _, cos_phi = sin_cos(Decimal(float(delta_phi)))
    sin_beta, cos_beta = sin_cos(beta)
    sin_half, cos_half = sin_cos((alpha + beta) / 2)
    f1, f2 = coefficients(sigma)
    c2 = sin_cos(alpha)[0] - ((2 * beta / PI) ** 3 if cos_phi < 0 else 0)
    c2 *= Decimal("0.45") * s2 / (s2 + Decimal("0.09"))
    c3 = Decimal("0.125") * s2 / (s2 + Decimal("0.09")) * (4 * alpha * beta / PI**2) ** 2
    terms = (
        f1,
        cos_phi * c2 * sin_beta / cos_beta,
        (1 - abs(cos_phi)) * c3 * sin_half / cos_half,
    )
    f2 *= 1 - cos_phi * (2 * beta / PI) ** 2
    return float(sum(terms)), float(f2), float(max(abs(term) for term in terms))


@with_digits
def albedo(reading, sigma):
    """Give the root of f1 ρ + f2 ρ² = r; with 50 digits the textbook form has enough to lose."""
    f1, f2 = coefficients(sigma)
    r = Decimal(float(reading))
    if f2 < Decimal("1e-20"):
        # The series of the root: what is left out is of the order of f2².
        return float(r / f1 - f2 * r * r / f1**3)
    return float((-f1 + (f1 * f1 + 4 * f2 * r).sqrt()) / (2 * f2))


@with_digits
def largest_sigma(peak):
    """Give the σ at which white facets read `peak`, by bisection."""
    low, high = Decimal(0), PI / 2
    for _ in range(130):
        middle = (low + high) / 2
        low, high = (
            (middle, high) if sum(coefficients(middle)) > Decimal(float(peak)) else (low, middle)
        )
    return float(low)
