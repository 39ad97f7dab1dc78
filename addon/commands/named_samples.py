# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples by what the command line calls them: a preset, a sample of the library, a file's."""

from __future__ import annotations

from pathlib import Path

from ...core.errors import InputError
from ..samples import sets
from ..samples.sample import Sample

_FILE_AND_SAMPLE = "#"
HELP = "a preset or library sample, a measurement file, or FILE#NAME for a sample of it"


def one(named: str) -> Sample:
    """Find the one sample that is called so.

    Raises
    ------
    InputError
        If there is none, or a file has several.
    """
    found = some(named)
    if len(found) > 1:
        path = Path(found[0].source)
        names = ", ".join([sample.name for sample in found][:5])
        msg = (
            f"{path} has {len(found)} samples; name one as FILE{_FILE_AND_SAMPLE}NAME, of: {names}."
        )
        raise InputError(msg)
    return found[0]


def some(named: str) -> list[Sample]:
    """Find the sample that is called so, or all of a file.

    Raises
    ------
    InputError
        If there is none.
    """
    from .. import api

    # A name may hold the sign itself, as a file's may: what is there decides.
    places = [i for i, sign in enumerate(named) if sign == _FILE_AND_SAMPLE]
    for end in (len(named), *places):
        if not Path(named[:end]).is_file():
            continue
        samples, wanted = api.read(named[:end]), named[end + 1 :]
        if not wanted:
            return samples
        matching = [s for s in samples if s.name == wanted]
        if not matching:
            matching = [s for name, s in sets.by_name(samples).items() if name == wanted]
        if matching:
            return matching[:1]
        names = ", ".join([sample.name for sample in samples][:5])
        msg = (
            f"{named[:end]} has no sample {wanted!r}; name one as FILE{_FILE_AND_SAMPLE}NAME, of: "
            f"{names}."
        )
        raise InputError(msg)
    try:
        return [api.find(named)]
    except InputError as error:
        msg = f"{named!r} is no file, and no sample either: {error}"
        raise InputError(msg) from error
