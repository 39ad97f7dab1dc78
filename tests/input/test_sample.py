# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A sample that exists is valid; what is not is refused in one sentence."""

import numpy as np
import pytest
from rough_spectra.addon.samples.sample import Sample, check_spectrum
from rough_spectra.core.errors import InputError

NM = [400.0, 410.0, 420.0]
nan, inf = float("nan"), float("inf")


def test_arrays_are_float64_and_cannot_be_written():
    given = np.array([0.1, 0.2, 0.3], dtype=np.float32)
    sample = Sample("chalk", np.array([400, 410, 420]), given, "reading")
    assert sample.wavelengths.dtype == sample.values.dtype == np.float64
    with pytest.raises(ValueError, match="read-only"):
        sample.values[0] = 0.5
    assert sample.values.tolist() == given.tolist()


def test_the_givers_array_stays_the_givers():
    given = np.array([0.1, 0.2, 0.3])
    sample = Sample("chalk", NM, given, "reading")
    given[0] = 0.9
    assert sample.values[0] == 0.1


def test_a_sample_refuses_what_check_spectrum_refuses():
    with pytest.raises(InputError, match=r"^clay\.csv, line 5: .*below 0"):
        Sample("clay", NM, [0.1, -0.1, 0.1], "reading", source="clay.csv", position="line 5")
    with pytest.raises(InputError, match="kind is 'color'"):
        Sample("clay", NM, [0.1, 0.1, 0.1], "color")


@pytest.mark.parametrize("values", [[-0.05, 0.5, 1.2], [0.0, -1e-9, 4.0]])
def test_what_an_instrument_can_print_is_kept(values):
    sample = Sample("clay", NM, values, "reading")
    assert sample.values.tolist() == values
    assert sample.reflectance.tolist() == [max(value, 0.0) for value in values]
    albedo = Sample("clay", NM, values, "albedo")
    assert albedo.values.tolist() == values
    assert albedo.reflectance.tolist() == [min(max(value, 0.0), 1.0) for value in values]


def test_noise_that_no_color_sees_is_no_fault():
    sample = Sample("clay", [350.0, 500.0, 2500.0], [-0.4, 0.5, 7.0], "reading")
    assert sample.values.tolist() == [-0.4, 0.5, 7.0]


def test_an_unknown_instrument_is_refused():
    with pytest.raises(InputError, match=r"clay: the instrument '30:0' is not known; .*45a:0"):
        Sample("clay", NM, [0.1, 0.1, 0.1], "reading", instrument="30:0")


@pytest.mark.parametrize("values", [[0.0, 0.5, 1.0], [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])
def test_both_ends_of_the_range_belong_to_it(values):
    _, fractions = check_spectrum(NM, values, "here")
    assert fractions.tolist() == values


@pytest.mark.parametrize(
    ("wavelengths", "values", "parts"),
    [
        ([], [], ["no band"]),
        ([400], [0.5], ["only one band", "at least two"]),
        ([400, 410], [0.5], ["2 wavelengths", "1 values"]),
        ([[400, 410]], [[0.5, 0.5]], ["one value a wavelength"]),
        (NM, [0.5, nan, 0.5], ["410 nm", "band 2", "NaN"]),
        (NM, [0.5, 0.5, inf], ["420 nm", "band 3", "infinite"]),
        (NM, [0.5, -inf, 0.5], ["410 nm", "-infinite"]),
        (NM, [-0.0501, 0.5, 0.5], ["400 nm", "-0.0501", "below 0"]),
        (NM, [0.5, 0.5, 4.0000001], ["420 nm", "4.0000001", "times white", "percent"]),
        (NM, [50.0, 60.0, 70.0], ["400 nm", "50", "percent", "column name"]),
        ([400, 420, 410], [0.5] * 3, ["410 nm at band 3", "420 nm at band 2", "sort"]),
        ([400, 400, 410], [0.5] * 3, ["400 nm", "twice", "band 1", "band 2", "keep one"]),
        ([400, nan, 420], [0.5] * 3, ["band 2", "NaN"]),
        ([nan, 410, 420], [0.5] * 3, ["band 1", "NaN"]),
        ([400, 410, inf], [0.5] * 3, ["band 3", "infinite"]),
        ([0.4, 0.5, 0.6], [0.5] * 3, ["0.4 to 0.6", "micrometers"]),
        ([-10, 410, 420], [0.5] * 3, ["-10 at band 1", "cannot be a wavelength"]),
        ([5, 410, 420], [0.5] * 3, ["5 at band 1", "cannot be a wavelength"]),
        ([400, 410, 1e9], [0.5] * 3, ["1000000000 at band 3", "cannot be a wavelength"]),
    ],
)
def test_each_fault_has_its_sentence(wavelengths, values, parts):
    with pytest.raises(InputError) as caught:
        check_spectrum(wavelengths, values, "chalk.csv, line 3")
    sentence = str(caught.value)
    assert sentence.startswith("chalk.csv, line 3: ")
    assert sentence.endswith(".")
    assert "\n" not in sentence
    assert ". " not in sentence
    for part in parts:
        assert part in sentence


def test_the_readers_own_words_for_a_place_are_used():
    with pytest.raises(InputError, match=r"410 nm at line 13 follows 420 nm at line 12"):
        check_spectrum([400, 420, 410], [0.5] * 3, "x", lambda band: f"line {band + 11}")


def test_an_emissivity_is_kept_as_stated_and_computed_as_what_is_not_emitted():
    stated = [0.2, 1.01, -0.02]
    sample = Sample("sand", [8000.0, 9000.0, 10000.0], stated, "emissivity")
    assert sample.values.tolist() == stated
    assert sample.reflectance.tolist() == [0.8, 0.0, 1.0]
    with pytest.raises(InputError, match=r"half of the emissivities are above 95.*percent"):
        Sample("sand", [8000.0, 9000.0, 10000.0], [94.0, 95.0, 96.0], "emissivity")


def test_a_kind_is_changed_by_who_knows_better_but_never_the_quantity():
    reading = Sample("clay", NM, [0.1, 0.1, 0.1], "reading")
    assert reading.taken_as("albedo").kind == "albedo"
    assert reading.taken_as("reading") is reading
    warm = Sample("clay", NM, [0.9, 0.9, 0.9], "emissivity")
    assert warm.taken_as("emissivity") is warm
    with pytest.raises(InputError, match="holds emissivity, and cannot be taken as a reading"):
        warm.taken_as("reading")
    with pytest.raises(InputError, match="holds a reading, and cannot be taken as emissivity"):
        reading.taken_as("emissivity")
