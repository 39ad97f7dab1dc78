# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of measured spectra in, samples out, whatever the file's name ends with.

A format is one module of `formats/`, and nothing else has to know of it:

    NAME = "Nix export"                             what messages call it
    ENDINGS = ("csv",)                              of its files' names: a hint, for the drop list
    PRIORITY = 100                                  who is asked first; specific formats above 0
    def sniff(document: Document) -> bool           by content; quick, and never raises
    def read(document: Document) -> list[Sample]    raises InputError, nothing else
    REGIONS = True                                  only where it reads `Document.region`
    SETS = True                                     only where files say what belongs together
    def emission(document: Document)                only where it reads light, see `light_source`

What several formats share is in `parts/`.
"""

from __future__ import annotations

import os
from typing import Protocol

from ....core.errors import InputError
from ....core.numerics.memoized import memoized
from ...support import discovery
from ..sample import Sample
from . import formats
from .parts.document import Document, open_document

__all__ = ["Document", "Reader", "formats", "open_document", "read", "readers"]


class Reader(Protocol):
    """What a module of this package offers."""

    NAME: str
    ENDINGS: tuple[str, ...]
    PRIORITY: int

    def sniff(self, document: Document) -> bool:
        """Return whether the content looks like this format."""

    def read(self, document: Document) -> list[Sample]:
        """Return the samples of the file, in its order."""


def read(
    path: str | os.PathLike[str], region: tuple[int, int, int, int] | None = None
) -> list[Sample]:
    """Return all samples of a file, in the file's order.

    Parameters
    ----------
    path
        Any file; the format follows from its content.
    region
        Of a spectral image, the rectangle of pixels whose mean is the sample: x, y, width, height,
        counted from the top left. None takes the whole image; other files have no regions.

    Raises
    ------
    InputError
        The file cannot be opened, no format recognizes it, or the one that does finds a fault.
    """
    from .parts import joining, unsaid  # apart: both and the formats are too much for one step

    document = open_document(path, region)
    for reader in readers():
        if reader.sniff(document):
            if region is not None and not getattr(reader, "REGIONS", False):
                raise document.error("", f"a {reader.NAME} has no regions; leave the region out")
            samples = reader.read(document)
            if not samples:
                raise document.error("", f"this {reader.NAME} holds no sample; export one with it")
            if getattr(reader, "SETS", False):
                return samples
            samples = joining.joined([unsaid.told(sample) for sample in samples])
            return unsaid.by_file_name(samples, document.path.stem)
    raise _unrecognized(document)


@memoized(maxsize=None)
def readers() -> tuple[Reader, ...]:
    """Return the format modules in the order in which they are asked."""
    # The module's name breaks ties, so that the order never depends on the file system.
    found = discovery.modules(formats.__name__, formats.__path__)
    return tuple(sorted(found, key=lambda module: (-module.PRIORITY, module.__name__)))


def _unrecognized(document: Document) -> InputError:
    fault = f"it is not text ({document.fault}) and " if document.fault else ""
    return document.error(
        "",
        f"{fault}no format recognizes it; export the reflectance as a table with wavelengths "
        "(CSV), as CGATS or as CxF3",
    )
