# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What every refusal of a measurement file has to be: one sentence that begins with the file."""

import pytest
from rough_spectra.addon.samples import readers
from rough_spectra.core.errors import InputError


def refusal(path, region=None):
    with pytest.raises(InputError) as caught:
        readers.read(path, region)
    sentence = str(caught.value)
    assert sentence.startswith(str(path))
    assert sentence.endswith(".")
    assert "\n" not in sentence
    return sentence
