# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bands and their predicted errors, against rooms solved spectrally: radiosity at 5 nm."""

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from core import bands
from core.color import color_difference
from core.errors import DomainError

NM = np.arange(380.0, 781.0, 5.0)
PRESETS = Path(__file__).resolve().parents[2] / "presets" / "colorchecker"
REC709 = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
SIDE = 4
"""Patches along each edge of a wall."""


def lobe(middle, left, right):
    """A Gaussian with two widths: Wyman, Sloan and Shirley fit the CIE's functions with such."""
    return np.exp(-0.5 * ((NM - middle) / np.where(middle > NM, left, right)) ** 2)


EYE = np.column_stack(
    [
        1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442, 16, 26.7) - 0.065 * lobe(501, 20, 26),
        0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
        1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8),
    ]
)
ALBEDOS = np.array(
    [json.loads(path.read_text("utf-8"))["values"] for path in sorted(PRESETS.glob("*.json"))]
)


def planck(kelvin):
    return (NM / 560) ** -5 / np.expm1(1.4388e7 / (NM * kelvin))


LAMPS = (
    planck(2856),  # illuminant A
    planck(6500),
    0.05 * planck(5000) + lobe(437, 4, 4) + lobe(544, 5, 5) + 0.8 * lobe(611, 4, 4),  # as F11
    0.7 * lobe(450, 10, 10) + lobe(570, 50, 60),  # a white LED
)
SODIUM = lobe(589, 3, 3)
FIGURES = ("mean", "usual")


@dataclass(eq=False)
class Room:
    """A closed box; radiosity knows nothing of bands, weights or drawn ways of light."""

    form_factors: np.ndarray
    areas: np.ndarray
    albedos: np.ndarray
    surface: np.ndarray
    lamps: np.ndarray
    lit: np.ndarray

    @property
    def shares(self):
        return np.bincount(self.surface, self.areas, len(self.albedos))

    def light(self, albedos, lamps):
        """Radiance of all patches, and of their direct light alone, each (patches, bands)."""
        rho = albedos[self.surface]
        direct = (self.lit.T @ lamps) * rho
        system = np.eye(len(rho)) - rho.T[:, :, np.newaxis] * self.form_factors
        return np.linalg.solve(system, direct.T[..., np.newaxis])[..., 0].T, direct

    def found(self, chosen):
        """ΔE00 of all patches, seen through bands."""
        step = 5.0
        whole, direct = self.light(self.albedos, self.lamps)
        taken = np.searchsorted(NM, chosen.wavelengths)
        seen, straight = self.light(self.albedos[:, taken], chosen.lights)
        shown = seen @ chosen.weights
        if chosen.direct:
            shown = (seen - straight) @ chosen.weights + direct @ EYE * step
        white = self.lamps.sum(axis=0) @ EYE * step
        labs = (color_difference.xyz_to_lab(xyz, white) for xyz in (shown, whole @ EYE * step))
        apart = color_difference.delta_e(*labs)
        return bands.Error(apart.mean(), np.quantile(apart, 0.95), apart.max())


def room(seed):
    random = np.random.default_rng(seed)
    size = random.uniform(2.5, 6, 3)
    places, normals, areas = [], [], []
    for axis in range(3):
        one, other = (a for a in range(3) if a != axis)
        for end in (0, 1):
            for u, v in np.ndindex(SIDE, SIDE):
                place, normal = np.zeros((2, 3))
                place[one], place[other] = (
                    (u + 0.5) / SIDE * size[one],
                    (v + 0.5) / SIDE * size[other],
                )
                place[axis], normal[axis] = end * size[axis], 1 - 2 * end
                places.append(place)
                normals.append(normal)
                areas.append(size[one] * size[other] / SIDE**2)
    places, normals, areas = map(np.array, (places, normals, areas))
    ways = places - places[:, np.newaxis]
    square = (ways**2).sum(axis=-1) + 1e-12
    leaving = np.maximum((ways * normals[:, np.newaxis]).sum(axis=-1), 0)
    meeting = np.maximum(-(ways * normals).sum(axis=-1), 0)
    factors = leaving * meeting / square**2 * areas
    factors /= factors.sum(axis=1, keepdims=True)  # closed: all light arrives
    count = random.integers(4, 9)
    walls = np.repeat(random.integers(0, count, 6), SIDE**2)
    patches = random.integers(0, count, len(places))
    surface = np.where(random.random(len(places)) < 0.7, walls, patches)
    lamps = np.array([LAMPS[k] for k in random.choice(4, random.integers(1, 3), replace=False)])
    lamps = lamps / (lamps @ EYE[:, 1:2]) * random.uniform(0.3, 1, (len(lamps), 1))
    lit = []
    for _ in lamps:
        ways = random.uniform(0.25, 0.75, 3) * size - places
        lit.append(np.maximum((ways * normals).sum(axis=1), 0) / (ways**2).sum(axis=1) ** 1.5)
    lit = np.array(lit)
    lit /= (lit @ areas / areas.sum())[:, np.newaxis]
    albedos = ALBEDOS[random.choice(24, count, replace=False)]
    return Room(factors, areas, albedos, surface, lamps, lit)


@pytest.fixture(scope="module")
def rooms():
    return [room(seed) for seed in range(20)]


@pytest.fixture(scope="module")
def seen():
    """What is chosen for a room, and what is found with it; several tests ask for the same."""

    @cache
    def look(place, count, direct=False):
        chosen = bands.choose(
            *(NM, place.albedos, place.lamps, EYE, 0.0),
            most=count,
            shares=place.shares,
            direct=direct,
        )
        assert len(chosen.wavelengths) == count
        return chosen, place.found(chosen)

    return look


@pytest.mark.parametrize("count", [3, 6, 9])
def test_what_is_predicted_is_found_in_closed_rooms(rooms, seen, count):
    ratios = []
    for each in rooms:
        chosen, found = seen(each, count)
        ratios.append([getattr(chosen.error, what) / getattr(found, what) for what in FIGURES])
        assert chosen.error.largest > found.largest / 3
    ratios = np.array(ratios)
    within = ((ratios < 1.5) & (ratios > 1 / 1.5)).sum(axis=0)
    # 95 % of a room's 96 patches leave five: what they show is a matter of chance.
    assert (within >= (18, 16)).all(), ratios.round(2)
    assert ratios.min() > 1 / 3


def test_bands_are_worth_their_passes(rooms, seen):
    """Each three more leave less than half of the error, over some rooms."""
    means = [np.mean([seen(each, count)[1].mean for each in rooms]) for count in (3, 6, 9)]
    assert means[1] < 0.35 < means[0]
    assert means[2] < means[1] / 2


def test_direct_light_apart_is_better(rooms, seen):
    together, apart = (
        np.mean([seen(each, 6, exact)[1].mean for each in rooms[:8]]) for exact in (False, True)
    )
    assert apart < together


def test_an_ordinary_picture_is_predicted_too(rooms):
    ratios = []
    for each in rooms:
        to_rgb = np.linalg.inv(REC709)
        sent = np.maximum(each.lamps @ EYE @ to_rgb.T * 5, 0)
        light = each.lamps.sum(axis=0)
        white = light @ EYE @ to_rgb.T
        colors = np.clip((each.albedos * light) @ EYE @ to_rgb.T / white, 0, 1)
        error = bands.rgb(NM, each.albedos, each.lamps, EYE, colors, REC709, shares=each.shares)
        whole, _ = each.light(each.albedos, each.lamps)
        shown, _ = each.light(colors, sent)
        labs = (
            color_difference.xyz_to_lab(xyz, light @ EYE * 5)
            for xyz in (shown @ REC709.T, whole @ EYE * 5)
        )
        ratios.append(error.mean / color_difference.delta_e(*labs).mean())
    ratios = np.array(ratios)
    assert ((ratios < 1.5) & (ratios > 1 / 1.5)).sum() >= 18, ratios.round(2)


@pytest.mark.parametrize("count", [3, 6, 9, 24])
def test_a_white_furnace_is_neutral(count):
    for lamps in (LAMPS[:1], LAMPS[:2], (LAMPS[0], SODIUM)):
        lamps = np.array(lamps)
        chosen = bands.choose(NM, ALBEDOS, lamps, EYE, 0.0, most=count)
        assert len(chosen.wavelengths) == count
        assert chosen.lights @ chosen.weights == pytest.approx(lamps @ EYE * 5, rel=1e-9)
        assert (chosen.lights >= 0).all()


@pytest.mark.parametrize("count", [3, 6, 9, 12])
def test_one_surface_without_interreflection_is_exact(count):
    for lamp in (*LAMPS, SODIUM):
        chosen = bands.choose(NM, ALBEDOS, [lamp], EYE, 0.0, most=count, direct=True, enclosed=0.0)
        assert chosen.error.largest < 1e-9
        [alone] = (bands.choose(NM, [ALBEDOS[5]], [lamp], EYE, 0.0, most=count, enclosed=0.0),)
        assert alone.error.largest < 0.05


def test_weights_that_raise_noise_are_refused():
    lamps = np.array(LAMPS)
    free = bands.choose(NM, ALBEDOS, lamps[2:3], EYE, 0.0, most=9, most_raised=9.0)
    for limit in (0.2, 0.02, 0.0):
        held = bands.choose(NM, ALBEDOS, lamps[2:3], EYE, 0.0, most=9, most_raised=limit)
        assert held.raised <= limit
        parts = held.weights * held.lights[0][:, np.newaxis]
        assert (np.abs(parts).sum(axis=0) <= (1 + limit + 1e-9) * parts.sum(axis=0)).all()
        # What is kept quiet is less exact, but no less than straight lines between the bands.
        assert held.error.mean < 3 * max(free.error.mean, 0.1)


def test_fewest_within_a_tolerance():
    lamps = np.array(LAMPS[:1])
    counts = {}
    for tolerance in (5.0, 1.0, 0.3, 0.05):
        chosen = bands.choose(NM, ALBEDOS, lamps, EYE, tolerance)
        assert chosen.enough
        assert chosen.error.usual <= tolerance
        counts[tolerance] = len(chosen.wavelengths)
        if counts[tolerance] > 3:
            fewer = bands.choose(NM, ALBEDOS, lamps, EYE, tolerance, most=counts[tolerance] - 3)
            assert not fewer.enough
            assert fewer.error.usual > tolerance
    assert sorted(counts.values()) == list(counts.values())
    assert counts[0.05] > counts[5.0]


def test_equal_scenes_get_equal_bands():
    first, second = (bands.choose(NM, ALBEDOS, LAMPS[1:2], EYE, 0.2) for _ in range(2))
    assert np.array_equal(first.weights, second.weights)
    assert first.error == second.error
    brighter = bands.choose(NM, ALBEDOS, 7 * np.array(LAMPS[1:2]), EYE, 0.2)
    assert brighter.wavelengths.tolist() == first.wavelengths.tolist()
    assert brighter.error.mean == pytest.approx(first.error.mean, rel=1e-6)


def test_infrared_has_bands_for_any_sensor():
    """A sensor of one channel from 700 to 2500 nm, judged in percent of white."""
    nm = np.arange(700.0, 2501.0, 10.0)
    random = np.random.default_rng(3)
    bumps = np.exp(-(((nm - random.uniform(700, 2500, (12, 1))) / 200) ** 2))
    albedos = random.dirichlet(np.ones(12), 6) @ bumps * 2
    albedos = np.clip(albedos, 0, 1)
    sensor = np.exp(-(((nm - 1500) / 300) ** 2))[:, np.newaxis]
    lamp = (nm / 1000) ** -5 / np.expm1(1.4388e7 / (nm * 2856))
    chosen = bands.choose(nm, albedos, [lamp], sensor, 0.5, metric="relative")
    assert chosen.enough
    assert ((chosen.wavelengths > 900) & (chosen.wavelengths < 2300)).all()
    taken = np.searchsorted(nm, chosen.wavelengths)
    once = albedos[:, np.newaxis] * albedos
    truth = (once * lamp) @ sensor * 10
    shown = (once[..., taken] * chosen.lights[0]) @ chosen.weights
    white = lamp @ sensor * 10
    assert np.abs(shown / white - truth / white).max() < 0.02


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"albedos": [[1.2] * NM.size]}, "An albedo is 1.2"),
        ({"lights": [[-1.0] * NM.size]}, "A lamp sends -1"),
        ({"lights": [[0.0] * NM.size]}, "Nothing is seen"),
        ({"albedos": [[0.5] * 7]}, "albedos have the shape"),
        ({"albedos": [[np.nan] * NM.size]}, "no number"),
        ({"observer": EYE[:, :2]}, "ΔE00 needs X, Y and Z"),
        ({"enclosed": 1.5}, "enclosed part"),
        ({"shares": [1.0, 2.0]}, "one number a surface"),
        ({"metric": "nonsense"}, "metric"),
    ],
)
def test_what_cannot_be_is_refused(change, words):
    asked = {
        "wavelengths": NM,
        "albedos": ALBEDOS[:1],
        "lights": [LAMPS[0]],
        "observer": EYE,
    } | change
    with pytest.raises(DomainError, match=words):
        bands.choose(**asked)


def test_a_lamp_without_blue_has_bands():
    """Of a sodium line Z is nothing to the 10° observer: a picture is still X and Y."""
    eye, line = EYE.copy(), np.where(np.abs(NM - 590) < 4, 1.0, 0.0)
    eye[NM > 560, 2] = 0
    assert (line @ eye)[2] == 0
    for found in (
        bands.choose(NM, ALBEDOS, [line], eye, tolerance=1.0),
        bands.at(NM, [450.0, 550.0, 590.0], ALBEDOS, [line], eye),
    ):
        seen = ALBEDOS[:, np.searchsorted(NM, found.wavelengths)] * found.lights[0] @ found.weights
        assert np.abs(seen[:, 2]).max() < 1e-4 * seen[:, 1].max()
    truth = ALBEDOS * line @ eye * 5
    assert seen[:, :2] == pytest.approx(truth[:, :2], rel=0.02)
