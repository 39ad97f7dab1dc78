# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What goniometers measured, as sets of angles: RGL's measured BRDFs, and tables of directions."""

import struct
from pathlib import Path

import numpy as np
import pytest
from rough_spectra.addon.samples import readers

from tests.input.refused import refusal

FIXTURES = Path(__file__).resolve().parents[1] / "fixtures" / "rgl_bsdf"

# Of Mitsuba 3.9's plugin `measured`, scalar_spectral: π eval / cos θ, of the anisotropic sample the
# mean over 16 azimuths from 11.25° on, with light at 45° and view in the same plane.
MITSUBA = {
    "even": {
        "45a:0": [0.397928, 0.51344, 0.929465, 0.400954],
        "45as-15": [0.765901, 1.062246, 1.128224, 0.845798],
        "45as15": [0.425897, 0.564246, 0.849659, 0.615907],
        "45as25": [0.409568, 0.539933, 0.876915, 0.524181],
        "45as75": [0.646932, 0.632762, 1.060856, 0.581847],
        "45as110": [1.574679, 1.27189, 1.984101, 1.323261],
    },
    "brushed": {
        "45a:0": [0.720962, 0.768514, 0.715395, 0.937871],
        "45as-15": [1.284196, 1.255572, 1.28974, 1.414917],
        "45as15": [0.872245, 0.821099, 0.792088, 1.002885],
        "45as25": [0.795474, 0.788325, 0.748725, 0.96203],
        "45as75": [0.841707, 0.897446, 0.818692, 1.049934],
        "45as110": [1.496221, 1.584866, 1.410009, 1.764312],
    },
}


@pytest.mark.parametrize("name", MITSUBA)
def test_rgl_reads_what_mitsuba_evaluates(name):
    (sample,) = readers.read(FIXTURES / f"{name}_spec.bsdf")
    assert sample.name == name
    assert sample.instrument == "45a:0"
    assert {reading.instrument for reading in sample.readings} == MITSUBA[name].keys()
    for reading in sample.readings:
        assert reading.wavelengths.tolist() == [400.0, 475.0, 550.0, 625.0]
        # Mitsuba computes in single precision.
        np.testing.assert_allclose(reading.values, MITSUBA[name][reading.instrument], rtol=3e-6)
    anisotropic = any("anisotropic" in sentence for sentence in sample.altered)
    assert anisotropic == (name == "brushed")


def test_damaged_rgl_is_refused_wherever_it_is_cut_or_changed(tmp_path):
    whole = (FIXTURES / "even_spec.bsdf").read_bytes()
    path = tmp_path / "cut.bsdf"
    for end in (*range(12, 400, 7), len(whole) - 1):
        path.write_bytes(whole[:end])
        refusal(path)
    at = whole.index(b"theta_i") + 7
    for changed, part in (
        (whole[:12] + b"\x02" + whole[13:], "version 2.0"),
        (whole[:14] + struct.pack("<I", 2**31) + whole[18:], "2147483648 fields"),
        # Of 2^61 numbers, whose bytes overflow 64 bits.
        (whole[: at + 11] + struct.pack("<Q", 2**61) + whole[at + 19 :], "behind the end"),
        (whole.replace(b"spectra", b"spektra"), "'spectra'"),
        (whole.replace(b"\x07\x00spectra", b"\x03\x00rgb....", 1), "field"),
    ):
        path.write_bytes(changed)
        assert part in refusal(path)


TABLE = """wavelength (nm),theta_i,phi_i,theta_r,phi_r,BRDF (1/sr)
450,45,0,0,0,0.10
450,0,0,45,90,0.12
450,-45,0,30,0,0.13
450,30,0,45,0,0.14
450,60,0,30,0,0.15
550,45.3,0,0,0,0.20
550,45,20,30,200,0.23
550,45,350,30,-10,0.24
"""


def test_tables_of_directions_become_sets(tmp_path):
    path = tmp_path / "felt.csv"
    path.write_text(TABLE)
    (sample,) = readers.read(path)
    found = {r.instrument: (r.values / np.pi).round(9).tolist() for r in sample.readings}
    # 45/0 in both orders; 30° beyond the normal by the sign and by the azimuths; toward the light.
    assert found == {"45a:0": [0.11, 0.20], "45as15": [0.13, 0.23], "45as75": [0.14, 0.24]}
    assert sample.instrument == "45a:0"
    assert any("multiplied by π" in sentence for sentence in sample.altered)
    assert any("2 directions were averaged" in sentence for sentence in sample.altered)


def test_without_azimuths_only_the_normal_is_known(tmp_path):
    path = tmp_path / "felt.csv"
    path.write_text(
        "wavelength nm;theta i;theta r;f_r\n450;45;0;0,1\n450;45;30;0,3\n550;0;45;0,2\n"
    )
    (sample,) = readers.read(path)
    assert sample.others == ()
    assert (sample.values / np.pi).round(9).tolist() == [0.1, 0.2]
    path.write_text("wavelength nm;theta i;theta r;f_r\n450;30;0;0,1\n550;30;0;0,2\n")
    assert "'phi_i' and 'phi_r'" in refusal(path)
    path.write_text("wavelength,BRDF\n450,0.1\n550,0.2\n")
    assert "BRDF" in refusal(path)
