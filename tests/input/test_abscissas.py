# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables whose first column is no wavelength in nm, and others that were once read wrong."""

import numpy as np
import pytest
from rough_spectra.addon.samples import readers
from rough_spectra.core.errors import InputError

NM = np.array([400.0, 500.0, 600.0, 700.0])
H_C_OVER_E = 6.62607015e-34 * 299792458 / 1.602176634e-19  # exact since 2019, eV m


def read(tmp_path, text, name="wall.csv"):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return readers.read(path)


def table(head, numbers):
    rows = (f"{x!r},{value}" for x, value in zip(numbers, (0.125, 0.25, 0.5, 0.75), strict=True))
    return "\n".join((head, *rows, ""))


@pytest.mark.parametrize(
    ("head", "numbers"),
    [
        ("wavenumber (cm-1),brick", 1e7 / NM),
        ("Wavenumber,brick", 1e7 / NM),
        ("cm^-1,brick", 1e7 / NM),
        ("1/cm,brick", 1e7 / NM),
        ("ν [cm⁻¹],brick", 1e7 / NM),
        ("# wavelength_unit: cm-1\nx,brick", 1e7 / NM),
        ("x,brick\ncm-1,%", 1e7 / NM),
        ("Frequency (THz),brick", 299792.458 / NM),
        ("THz,brick", 299792.458 / NM),
        ("Energy (eV),brick", H_C_OVER_E * 1e9 / NM),
        ("photon energy [eV],brick", H_C_OVER_E * 1e9 / NM),
        ("Wavelength (Å),brick", NM * 10),
        ("wavelength in angstrom,brick", NM * 10),
        ("wavelength (um),brick", NM / 1000),
        ("wavelength_um,brick", NM / 1000),
        ("energy_eV,brick", H_C_OVER_E * 1e9 / NM),
        ("frequency_THz,brick", 299792.458 / NM),
        ("Wellenzahl,brick", 1e7 / NM),
        ("cm^{-1},brick", 1e7 / NM),
        ("inverse cm,brick", 1e7 / NM),
        ("Ångström,brick", NM * 10),
        ("# X units: THz\nx,brick", 299792.458 / NM),
        ("# frequencies in THz\nx,brick", 299792.458 / NM),
        ("X Units,THz\nx,brick", 299792.458 / NM),
        ("XUNITS: 1/cm\nx,brick", 1e7 / NM),
        ("Frequency,brick\nTHz,%", 299792.458 / NM),
        ("E,brick\n(eV),%", H_C_OVER_E * 1e9 / NM),
        ("wavelength (m),brick", NM * 1e-9),
        ("lambda,brick\nm,%", NM * 1e-9),
        ("Wavelength [pm],brick", NM * 1000),
        ("wavelength (mm),brick", NM * 1e-6),
        ("frequency (PHz),brick", 299.792458 / NM),
        ("frequency (GHz),brick", 299792458.0 / NM),
        ("frequency [Hz],brick", 299792458e9 / NM),
        ("energy (meV),brick", H_C_OVER_E * 1e12 / NM),
        ("wavenumber (m-1),brick", 1e9 / NM),
        ("# wavelength_unit: m\nx,brick", NM * 1e-9),
    ],
)
def test_what_is_stated_becomes_nanometers(tmp_path, head, numbers):
    (sample,) = read(tmp_path, table(head, numbers.tolist()))
    np.testing.assert_allclose(sample.wavelengths, NM, atol=1e-6)
    scale = 100 if "%" in head else 1
    np.testing.assert_allclose(sample.values * scale, [0.125, 0.25, 0.5, 0.75], rtol=1e-15)
    assert sample.name == "brick"


@pytest.mark.parametrize(
    ("head", "numbers"),
    [
        ("name,{} THz", 299792.458 / NM),
        ("name,R{} cm-1", 1e7 / NM),
        ("name,{}cm⁻¹", 1e7 / NM),
        ("name,{} (1/cm)", 1e7 / NM),
        ("name,{} cm^-1 (SCI)", 1e7 / NM),
        ("name,{} Å", NM * 10),
        ("name,{} eV", H_C_OVER_E * 1e9 / NM),
        ("Frequency (THz),{}", 299792.458 / NM),
        ("Wavenumber (cm-1),{}", 1e7 / NM),
        ("Wavelength (Å),{}", NM * 10),
        ("Photon energy (eV),{}", H_C_OVER_E * 1e9 / NM),
        ("Wavelength (µm),{}", NM / 1000),
        ("# wavelength_unit: eV\nname,{}", H_C_OVER_E * 1e9 / NM),
        ("X units: THz\nname,{}", 299792.458 / NM),
    ],
)
def test_bands_across_are_converted_as_those_down(tmp_path, head, numbers):
    above, _, column = head.rpartition(",")
    columns = [column.format(f"{number:.9g}") for number in numbers.tolist()]
    (sample,) = read(tmp_path, ",".join([above, *columns]) + "\nbrick,0.125,0.25,0.5,0.75\n")
    np.testing.assert_allclose(sample.wavelengths, NM, rtol=1e-7)
    assert sample.values.tolist() == [0.125, 0.25, 0.5, 0.75]
    assert sample.name == "brick"


def test_samples_that_are_called_by_small_numbers_stay_columns(tmp_path):
    rows = "".join(f"{nm / 1000:g},0.125,0.25\n" for nm in NM.tolist())
    samples = read(tmp_path, "wavelength (µm),1,2\n" + rows)
    assert [(sample.name, sample.values[0]) for sample in samples] == [("1", 0.125), ("2", 0.25)]
    np.testing.assert_allclose(samples[0].wavelengths, NM, atol=1e-6)


@pytest.mark.parametrize(
    ("head", "numbers", "said"),
    [
        ("Frequency,brick", 299792.458 / NM, "a frequency or an energy without its unit"),
        *(
            (f"{head},brick", 299792.458 / NM, "a frequency or an energy without its unit")
            for head in ("nu", "ν", "freq", "Frequenz", "fréquence", "周波数")
        ),
        ("energy,brick", H_C_OVER_E * 1e9 / NM, "a frequency or an energy without its unit"),
        ("energy (keV),brick", NM, "in a unit that is not known"),
        ("photon energy in kJ/mol (kJ),brick", NM, "in a unit that is not known"),
        ("frequency (MHz),brick", NM, "in a unit that is not known"),
        ("Raman shift (cm-1),brick", 1e7 / NM, "a Raman shift"),
        ("x,brick", 1e7 / NM, "14285.7 to 25000, have no unit"),
        ("wavelength,brick", NM * 10, "4000 to 7000, have no unit"),
        ("wavelength (nm),brick\n1/cm,-", NM, "disagree"),
        ("wavelength (um),brick\nnm,-", NM, "disagree"),
    ],
)
def test_what_is_no_wavelength_is_refused(tmp_path, head, numbers, said):
    with pytest.raises(InputError, match=r"wall\.csv") as caught:
        read(tmp_path, table(head, numbers.tolist()))
    assert said in str(caught.value)


def test_far_infrared_that_says_its_unit_is_read(tmp_path):
    (sample,) = read(tmp_path, table("wavelength (nm),brick", [8000, 10000, 12000, 14000]))
    assert sample.wavelengths.tolist() == [8000, 10000, 12000, 14000]


def test_the_index_that_pandas_writes_is_no_sample(tmp_path):
    for first in ("", "Unnamed: 0"):
        text = f"{first},wavelength,brick\n0,400,0.125\n1,500,0.25\n2,600,0.5\n"
        (sample,) = read(tmp_path, text)
        assert (sample.name, sample.values.tolist()) == ("brick", [0.125, 0.25, 0.5])


def test_spectral_evolution_with_channels_before_the_wavelengths(tmp_path):
    text = (
        "Comment:\nMeasurement: REFLECTANCE\nColumns [5]:\nData:\n"
        "Chan.#\tWvl\tRad. (Ref.)\tRad. (Target)\tReflect. %\n"
        "0\t400\t1\t0.5\t50.0\n1\t500\t1\t0.25\t25.0\n2\t600\t1\t0.5\t50.0\n"
    )
    (sample,) = read(tmp_path, text, "wall_00012.sed")
    assert (sample.name, sample.values.tolist()) == ("wall_00012", [0.5, 0.25, 0.5])
    assert sample.wavelengths.tolist() == [400, 500, 600]


@pytest.mark.parametrize(
    ("title", "quantity"),
    [("Log(1/R)", "absorbance"), ("Transmittance [%]", "transmittance"), ("K/S", "Kubelka-Munk")],
)
def test_a_title_that_names_another_quantity_counts(tmp_path, title, quantity):
    with pytest.raises(InputError, match=rf"line 1: the values are {quantity}"):
        read(tmp_path, table(f"{title}\nwavelength,Sample 1", NM.tolist()))


def test_three_columns_without_names_that_vanish_are_a_camera(tmp_path):
    nm = np.arange(400, 701, 20)
    lobes = np.exp(-(((nm - np.array([[650], [560], [480]])) / 25) ** 2))
    lobes[lobes < 1e-3] = 0
    rows = [f"{x} " + " ".join(f"{v:.4f}" for v in lobe) for x, lobe in zip(nm, lobes.T)]  # noqa: B905
    with pytest.raises(InputError, match="sensitivities of a camera"):
        read(tmp_path, "\n".join(rows), "camera.txt")


def test_the_sentence_does_not_contradict_itself(tmp_path):
    with pytest.raises(InputError, match="found one column") as caught:
        read(tmp_path, "0804016U1- ", "0804016U1.TCM")
    assert "found spaces" not in str(caught.value)


@pytest.mark.parametrize("label", ["{}", "REFL_{}", "refl_{}nm"])
def test_more_names_of_bands_in_cgats(tmp_path, label):
    fields = " ".join(label.format(nm) for nm in (400, 500, 600, 700))
    text = (
        f"CGATS.17\nNUMBER_OF_FIELDS 5\nBEGIN_DATA_FORMAT\nSAMPLE_ID {fields}\nEND_DATA_FORMAT\n"
        "NUMBER_OF_SETS 1\nBEGIN_DATA\n7 0.125 0.25 0.5 0.75\nEND_DATA\n"
    )
    (sample,) = read(tmp_path, text, "wall.txt")
    assert sample.wavelengths.tolist() == NM.tolist()
    assert sample.values.tolist() == [0.125, 0.25, 0.5, 0.75]


@pytest.mark.parametrize(
    "head",
    [
        *(
            "x,reflectance_percent",
            "x,R_pct",
            "x,Reflexion in Prozent",
            "x,Reflectance(percentage)",
        ),
        *("# scale: 0-100\nx,R", "# in %\nx,R", "# Einheit: %\nx,R", "# units: Prozent\nx,R"),
        *("Photometric mode: %R\nx,R", "# values in percent\nx,R"),
    ],
)
def test_percent_that_is_dark_is_percent_in_every_spelling(tmp_path, head):
    (sample,) = read(tmp_path, table(head, NM.tolist()))
    assert sample.values.tolist() == [0.00125, 0.0025, 0.005, 0.0075]


@pytest.mark.parametrize(
    "head", ["x,50 % gray", "x,10_pct_gray", "# title: paint 5 % gray\nx,wall"]
)
def test_percent_of_something_else_is_no_scale(tmp_path, head):
    (sample,) = read(tmp_path, table(head, NM.tolist()))
    assert sample.values.tolist() == [0.125, 0.25, 0.5, 0.75]


@pytest.mark.parametrize(
    ("head", "said"),
    [
        *(
            (f"x,{name}", "absorbance")
            for name in ("A", "log10(1/R)", "-log R", "吸光度", "density")
        ),
        *((f"x,{name}", "transmittance") for name in ("T", "透過率")),
        ("x,OD", "optical density"),
        ("x,KS", "Kubelka-Munk"),
        ("x,k (1/mm)", "coefficients"),
        ("# absorbance\nx,wall", "absorbance"),
        ("# y: log 1/R\nx,wall", "absorbance"),
        ("# mode: transmittance\nx,wall", "transmittance"),
        ("# values are transmittance\nx,wall", "transmittance"),
        ("Photometric mode: Abs\nx,wall", "absorbance"),
        ("Title,K/S of dyed cotton\nx,wall", "Kubelka-Munk"),
    ],
)
def test_another_quantity_is_refused_wherever_it_is_named(tmp_path, head, said):
    with pytest.raises(InputError, match=said):
        read(tmp_path, table(head, NM.tolist()))


def test_letters_beside_each_other_or_below_reflectance_are_samples(tmp_path):
    (sample,) = read(tmp_path, table("# Reflectance of tiles\nx,A", NM.tolist()))
    assert sample.name == "A"
    path = tmp_path / "two.csv"
    path.write_text("x,A,T\n400,0.1,0.2\n500,0.1,0.2\n")
    assert [sample.name for sample in readers.read(path)] == ["A", "T"]


@pytest.mark.parametrize(
    ("head", "cells"),
    [("name,unit", "ink,%"), ("Probe,Einheit", "ink,Prozent"), ("name,Y units", "ink,%R")],
)
def test_a_column_tells_the_unit_of_each_row(tmp_path, head, cells):
    text = f"{head},400 nm,500 nm\n{cells},0.6,0.8\npaper,fraction,0.6,0.8\n"
    ink, paper = read(tmp_path, text)
    assert (ink.values.tolist(), paper.values.tolist()) == ([0.006, 0.008], [0.6, 0.8])
    text = "name,geometry,unit,wavelength,value\n" + "".join(
        f"ink,d/8 SCE,%,{nm},{value}\n" for nm, value in ((400, 0.6), (500, 0.8))
    )
    [ink] = read(tmp_path, text)
    assert ink.values.tolist() == [0.006, 0.008]


def test_rows_of_another_quantity_are_left_out_and_told(tmp_path):
    head = "name,quantity,400 nm,500 nm\n"
    rows = "ink,reflectance,0.6,0.8\nink,absorbance,0.1,0.2\nink transmittance,,0.6,0.8\n"
    [ink] = read(tmp_path, head + rows)
    assert ink.values.tolist() == [0.6, 0.8]
    assert "line 3 on absorbance" in ink.notes[-1]
    assert "line 4 on transmittance" in ink.notes[-1]
    with pytest.raises(InputError, match="line 2: the values are absorbance"):
        read(tmp_path, head + "ink,absorbance,0.1,0.2\n")
