# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever happens to a file on its way: samples that are valid, or one InputError, and soon."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rough_spectra.addon.samples import readers
from rough_spectra.addon.samples.readers.parts.document import Document
from rough_spectra.addon.samples.sample import BRIGHTEST, DEEPEST_NOISE
from rough_spectra.core.errors import InputError

from tests import pace
from tools.checks import growth

BY_READER = growth.by_reader(readers)
FIXTURES = [path for paths in BY_READER.values() for path in paths]
EXAMPLES = 2400 // len(BY_READER)  # a reader, shared by its fixtures
SLOW = 200  # paces; a reader takes a twentieth of one, so only a hang comes near

# Bytes that mean something to a reader, beside all others.
TOKENS = [b"\n", b"\r", b",", b";", b"\t", b'"', b"#", b"-", b".", b"%", b"\0", b"\xff", b"nan"]
TOKENS += [b"1e999", b"{", b"[", b"sep=|\n", b"# units: percent\n", b"\xff\xfe", b"9" * 400]
PIECES = st.one_of(st.sampled_from(TOKENS), st.binary(max_size=8))


@st.composite
def mutated(draw, data):
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(data)))
        cut = draw(st.sampled_from([0, 1, 1, 5, 50, len(data)]))
        data = data[:at] + draw(PIECES) + data[at + cut :]
    return data


def read(path, data):
    """Do what `readers.read` does once the bytes are there."""
    document = Document(path, data)
    for reader in readers.readers():
        if reader.sniff(document):
            return reader.read(document)
    return []


def read_or_refuse(path, data):
    """Read, and look at the samples or at the refusal: any other exception fails the test."""
    try:
        samples = read(path, data)
    except InputError as error:
        sentence, samples = str(error), []
    else:
        sentence = f"{path.name}: read."
    assert path.name in sentence
    assert sentence.endswith(".")
    assert sentence.isprintable()
    for sample in samples:
        assert sample.name
        assert (np.diff(sample.wavelengths) > 0).all()
        assert np.isfinite(sample.values).all()
        visible = sample.values[(sample.wavelengths >= 380) & (sample.wavelengths <= 780)]
        assert ((visible >= DEEPEST_NOISE) & (visible <= BRIGHTEST)).all()


def test_every_reader_is_among_them():
    assert all(BY_READER.values())


@pytest.mark.parametrize("path", FIXTURES, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_no_mutation_brings_anything_but_an_input_error(path):
    among = next(paths for paths in BY_READER.values() if path in paths)

    @settings(
        max_examples=max(10, EXAMPLES // len(among)),
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )
    @given(data=mutated(path.read_bytes()))
    def mutate(data):
        with pace.at_most(SLOW):
            read_or_refuse(path, data)

    mutate()


@given(st.binary(max_size=300))
@settings(max_examples=300, deadline=None)
def test_noise_brings_nothing_but_an_input_error(data):
    read_or_refuse(Path("noise.csv"), data)


@pytest.mark.parametrize("mark", [b'"', b"1", b",", b"1,", b" 1", b"a ", b"\n", b"#:", b"50 %"])
def test_a_long_line_of_one_thing_takes_no_longer_than_its_length(mark):
    data = b"wavelength,R\n400,0.5\n" + mark * (2**19 // len(mark))
    # Half a megabyte: about 10 paces; anything quadratic takes thousands.
    with pace.at_most(SLOW), pytest.raises(InputError):
        read(Path("long.csv"), data)
