# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool that holds models against goniometers, on files made here: none is shipped."""

import csv
import itertools
import sys

import numpy as np
import pytest

from core import surface
from tools.checks import check_goniometer, goniometer_data
from tools.checks.goniometer_data import GoniometerError, Material


def write_points(path, factor):
    """Write what NIST's file has of factor(θi, θr, Δφ), also with the light on the other side."""
    lines = [[*goniometer_data.POINTS_HEAD, "f_r12/f_r11"]]
    for light, view, turn in itertools.product((0, 30, -60), (0, 25, 50, 75), (0, 45, 90, 180)):
        # Azimuths are of where light comes from and goes to: a negative θ is the other side.
        apart = np.radians(turn if light >= 0 else 180 - turn)
        value = factor(*np.abs(np.radians([light, view])), apart) / np.pi
        lines.append([0.532, light, 10, view, 10 + turn, value, 0.01])
        lines.append([1.064, light, 10, view, 10 + turn, 9.0, 0.01])
    with path.open("w", encoding="utf-8", newline="") as out:
        csv.writer(out).writerows(lines)


def test_points_are_read_with_their_azimuth_and_up_to_60_degrees(tmp_path):
    write_points(tmp_path / "PTFE.data.csv", lambda light, view, apart: 1 + light + view + apart)
    (material,) = goniometer_data.load(tmp_path)
    assert material.name == "sintered PTFE at 532 nm"
    assert material.angles.shape[1] == 3 * 3 * 4
    np.testing.assert_allclose(material.factor, 1 + material.angles.sum(axis=0), rtol=1e-12)
    assert material.toward_light().angles[2].max() == pytest.approx(np.pi / 2)


def test_models_find_the_surface_that_was_measured(tmp_path):
    write_points(
        tmp_path / "PTFE.data.csv",
        lambda *three: float(surface.reflectance([0.7], *three, np.radians(30))[0]),
    )
    (material,) = goniometer_data.load(tmp_path)
    fits = {model: check_goniometer.fit(material, model) for model in check_goniometer.MODELS}
    assert fits["surface"].sigma == 30
    assert fits["surface"].error < 1e-4 < fits["closure"].error < fits["lambert"].error


def test_a_lobe_is_found_where_one_is():
    angles = goniometer_data.grid()
    factor = 0.4 + 0.9 * check_goniometer.gloss(angles, 0.3)
    material = Material("shiny", "here", angles, factor)
    plain = check_goniometer.fit(material, "lambert")
    glossy = check_goniometer.fit(material, "lambert", with_gloss=True)
    assert glossy.error < 1e-6 < plain.error
    assert (glossy.weight, glossy.width) == pytest.approx((0.9, 0.3))
    matte = Material("matte", "here", angles, np.full(angles.shape[1], 0.4))
    assert check_goniometer.fit(matte, "lambert", with_gloss=True).error < 1e-12


def test_the_lobe_loses_no_light_that_fresnel_and_masking_do_not_take():
    """Facets of any width cover the level area: ∫ D cos dω = 1, here with F = 1 and no masking."""
    nodes, weights = np.polynomial.legendre.leggauss(200)
    lean = (nodes + 1) * np.pi / 4
    width = 0.5
    # Looking along the half vector's mirror, light and view meet at the facet's normal.
    d = check_goniometer.gloss(np.stack((lean, lean, np.zeros_like(lean))), width)
    hidden = 1 + 2 * check_goniometer._shadow(np.cos(lean), width * width)
    facets = d * hidden * 4 * np.cos(lean) ** 2 / (np.pi * check_goniometer._F0)
    total = np.sum(facets * np.cos(lean) * 2 * np.pi * np.sin(lean) * weights) * np.pi / 4
    assert total == pytest.approx(1, rel=1e-6)


def test_rusinkiewicz_vectors_give_light_and_view_back():
    angles = goniometer_data.grid()[:, 1:]
    half, difference = np.split(goniometer_data.rusinkiewicz(angles), 2, axis=1)
    np.testing.assert_allclose(np.linalg.norm(half, axis=1), 1, rtol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(difference, axis=1), 1, rtol=1e-12)
    # The light is the difference vector turned by the half vector; the view is its mirror image.
    lean = np.arctan2(half[:, 0], half[:, 2])
    for sign, polar in ((1, angles[0]), (-1, angles[1])):
        upright = difference[:, 2] * np.cos(lean) - sign * difference[:, 0] * np.sin(lean)
        np.testing.assert_allclose(upright, np.cos(polar), atol=1e-12)
    # Between light and view lies twice the angle between light and half vector.
    between = np.cos(angles[0]) * np.cos(angles[1])
    between += np.sin(angles[0]) * np.sin(angles[1]) * np.cos(angles[2])
    np.testing.assert_allclose(2 * difference[:, 2] ** 2 - 1, between, atol=1e-12)


def test_a_network_is_two_hidden_layers_and_an_exponential():
    layers = [
        (np.eye(6), np.full(6, -0.5)),
        (np.ones((6, 2)), np.zeros(2)),
        (np.array([[1.0, 0.0, 2.0], [0.0, 1.0, 0.0]]), np.array([0.0, 0.1, 0.0])),
    ]
    found = goniometer_data.network(layers, np.array([[1.0, 0.0, 0.0, 0.0, 0.0, 0.75]]))
    np.testing.assert_allclose(found, np.expm1([[0.75, 0.85, 1.5]]))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda folder: folder / "none", "is no folder"),
        (lambda folder: folder, "holds none of"),
        (lambda folder: put(folder, "PTFE.data.csv", "a,b\n1,2\n"), "no table of points"),
        (
            lambda folder: put(folder, "PTFE.data.csv", ",".join(goniometer_data.POINTS_HEAD)),
            "holds no points",
        ),
        (
            lambda folder: put(
                folder, "PTFE.data.csv", ",".join(goniometer_data.POINTS_HEAD) + "\nx,1,1,1,1,1\n"
            ),
            "no table of points",
        ),
    ],
)
@pytest.mark.filterwarnings("ignore:loadtxt")
def test_what_can_not_be_read_is_one_sentence(tmp_path, capsys, make, words):
    assert check_goniometer.main([str(make(tmp_path))]) == 2
    out, error = capsys.readouterr()
    assert out == ""
    assert words in error
    assert error.count("\n") == 1


def test_networks_without_their_library_are_one_sentence(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(GoniometerError, match="install h5py"):
        goniometer_data.load(put(tmp_path, "merl.zip", "no zip"))


def put(folder, name, text):
    (folder / name).write_text(text, encoding="utf-8")
    return folder


def test_the_page_s_table_is_its_data():
    text = check_goniometer.DATA.read_text(encoding="utf-8")
    rows = list(csv.DictReader(text.splitlines()[1:]))
    lines = check_goniometer.TABLE.read_text(encoding="utf-8").splitlines()
    told = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[4:]]
    middle = told.pop()
    assert len(told) * len(check_goniometer.CASES) * len(check_goniometer.MODELS) == len(rows)
    for place, case in enumerate(check_goniometer.CASES):
        errors = {model: [] for model in check_goniometer.MODELS}
        for name, source, *cells in told:
            of_case = {
                row["model"]: row
                for row in rows
                if (row["material"], row["from"], row["case"]) == (name, source, case)
            }
            for model, of_model in errors.items():
                of_model.append(100 * float(of_case[model]["error"]))
            numbers = " / ".join(f"{values[-1]:.1f}" for values in errors.values())
            degrees = float(of_case["surface"]["sigma_degrees"])
            assert cells[place] == f"{numbers} at {degrees:.0f}°"
        medians = " / ".join(f"{np.median(values):.1f}" for values in errors.values())
        assert middle[2 + place] == f"**{medians}**"
