# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that hold spectra often enough, and are not read: each is refused by its name.

They are known by their first bytes. Whoever opens one learns what it is and how to get a file that
is read, instead of which byte was not text.
"""

from __future__ import annotations

from ...sample import Sample
from ..parts.document import Document

NAME = "file that has to be exported first"
ENDINGS: tuple[str, ...] = ()
PRIORITY = 50

_TABLE = "save the sheet with the spectra as CSV"
_KNOWN: tuple[tuple[bytes, bytes, str, str], ...] = (
    (b"PK\x03\x04", b"xl/", "a spreadsheet (.xlsx)", _TABLE),
    (b"PK\x03\x04", b"opendocument.spreadsheet", "a spreadsheet (.ods)", _TABLE),
    (b"PK\x03\x04", b"Index/", "a spreadsheet of Numbers", _TABLE),
    (b"PK\x03\x04", b"", "an archive (ZIP)", "unpack it and open what is in it"),
    (b"PK\x05\x06", b"", "an archive (ZIP) with nothing in it", "pack it again"),
    (
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        b"",
        "a document of Microsoft Office, such as a spreadsheet (.xls)",
        _TABLE,
    ),
    (b"\x1f\x8b", b"", "packed with gzip", "unpack it and open what was in it"),
    (b"BZh", b"", "packed with bzip2", "unpack it and open what was in it"),
    (b"\xfd7zXZ\0", b"", "packed with xz", "unpack it and open what was in it"),
    (b"7z\xbc\xaf\x27\x1c", b"", "an archive (7z)", "unpack it and open what is in it"),
    (b"Rar!\x1a\x07", b"", "an archive (RAR)", "unpack it and open what is in it"),
    (
        b"\x0a\x0a\xfe\xfe",
        b"",
        "a Bruker OPUS file",
        "save it in OPUS as a data point table or as JCAMP-DX, over nm and in reflectance",
    ),
    (
        b"\x89HDF\r\n\x1a\n",
        b"",
        "an HDF5 file, as MATLAB and hyperspectral cameras write them",
        "export the spectra as CSV",
    ),
    (b"MATLAB 5.0 MAT-file", b"", "a MATLAB file", "export the spectra as CSV"),
    (b"SIMPLE  =", b"", "a FITS file", "export the spectra as CSV"),
    (b"%PDF-", b"", "a PDF document", "export the numbers as CSV"),
    (b"SQLite format 3\0", b"", "a database (SQLite)", "export the spectra as CSV or CxF3"),
)
"""First bytes, bytes among the first that tell more, what it is, and the remedy."""


def sniff(document: Document) -> bool:
    """Return whether it begins as one of them."""
    return any(document.head.startswith(first) for first, *_ in _KNOWN)


def read(document: Document) -> list[Sample]:
    """Refuse it.

    Raises
    ------
    InputError
        Always; the sentence says what it is and what to do.
    """
    for first, among, what, remedy in _KNOWN:
        if document.head.startswith(first) and (not among or among in document.data):
            raise document.error("", f"this is {what}, which is not read; {remedy}")
    raise document.error("", "this is not read; export the spectra as CSV")
