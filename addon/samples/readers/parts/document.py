# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A file on its way to a reader: its bytes, and its text decoded once."""

from __future__ import annotations

import codecs
import os
import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from .....core.errors import InputError
from ....support import user_files

LARGEST_FILE = user_files.LARGEST
HEAD = 2**16  # how much a sniffer sees; metadata before a table is a few kB at most

OTHER_QUANTITIES = {
    "emission": "emission (the spectrum of a light source)",
    "emissivity": "emissivity",
    "transmittance": "transmittance (light through the sample)",
    "absorbance": "absorbance (a logarithm)",
    "counts": "raw detector counts",
    "radiance": "radiance",
    "irradiance": "irradiance",
}

# Never part of text. Tab, line feed, form feed, return and the DOS end-of-file mark are.
_CONTROL = re.compile("[\x00-\x08\x0e-\x19\x1b-\x1f\x7f-\x9f]")


@dataclass(frozen=True)
class Document:
    """One whole file in memory.

    Parameters
    ----------
    path
        As the user gave it: messages repeat it.
    data
        The bytes.
    region
        Of an image, the rectangle to read, in pixels from the top left: x, y, width, height. None
        for all of it.
    """

    path: Path
    data: bytes
    region: tuple[int, int, int, int] | None = None

    @property
    def head(self) -> bytes:
        """The first bytes, for sniffers of binary formats."""
        return self.data[:HEAD]

    @property
    def head_text(self) -> str:
        """The first characters, for sniffers of text formats; empty when this is not text."""
        return self._decoded[0][:HEAD]

    @property
    def text(self) -> str:
        r"""The whole text with ``\n`` between lines.

        Raises
        ------
        InputError
            The file is not text.
        """
        text, fault = self._decoded
        if fault:
            raise self.error("", f"this is not text: {fault}; export the measurement as text")
        return text

    @property
    def json_head(self) -> str:
        """As `head_text`, for sniffers of JSON; see `json_text`."""
        return self._plain[0][:HEAD]

    @property
    def json_text(self) -> str:
        r"""The whole text with ``\n`` between lines, and with the control characters of names.

        JSON allows U+007F to U+009F as they are, and its parser refuses the others.

        Raises
        ------
        InputError
            The file is not text.
        """
        text, fault = self._plain
        if fault:
            raise self.error("", f"this is not text: {fault}; save it as UTF-8")
        return text

    @property
    def fault(self) -> str:
        """Why this is not text, or an empty string."""
        return self._decoded[1]

    def companion(self, name: str) -> Document | None:
        """Open another file that belongs to this one; None if it is not there.

        It stands in the same folder, or else in the one above: libraries keep what all their
        chapters share there.

        Parameters
        ----------
        name
            A file name without any folder: nothing outside the two folders can be reached.

        Raises
        ------
        InputError
            The name has a folder in it, or the file is there and cannot be read.
        """
        if not name or name in (".", "..") or set(name) & set("/\\:\0"):
            raise self.error("", f"{quote(name)} is no plain file name; put that file beside it")
        for folder in self.folders():
            if os.path.exists(folder / name):  # unlike Path.exists, False where looking is denied
                return open_document(folder / name)
        return None

    def folders(self) -> tuple[Path, Path]:
        """Return the folder of this file and the one above it."""
        folder = self.path.absolute().parent
        return folder, folder.parent

    def not_reflectance(self, place: str, quantity: str) -> InputError:
        """Return the error that refuses another quantity by its name.

        Parameters
        ----------
        place
            Where the file says so, such as ``"line 3, key Y-UNITS"``.
        quantity
            A key of `OTHER_QUANTITIES`, or words for anything else.
        """
        what = OTHER_QUANTITIES.get(quantity, quantity)
        return self.error(
            place, f"the values are {what}, not reflectance; export the reflectance of the surface"
        )

    def error(self, place: str, sentence: str) -> InputError:
        """Return the error that names this file and a place in it (either may be all there is)."""
        where = f"{self.path}, {place}" if place else str(self.path)
        return InputError(f"{where}: {sentence}.")

    @cached_property
    def _decoded(self) -> tuple[str, str]:
        """The text or why it is none: of a table, control characters make it none."""
        text, fault = self._plain
        control = _CONTROL.search(text)
        if control:
            line = text.count("\n", 0, control.start()) + 1
            return "", f"line {line} holds the control character 0x{ord(control[0]):02x}"
        return text, fault

    @cached_property
    def _plain(self) -> tuple[str, str]:
        wide = _utf_16(self.data)
        if wide:
            try:
                text = self.data.decode(wide)
            except UnicodeDecodeError as error:
                return "", f"its UTF-16 breaks off at byte {error.start + 1}"
        else:
            zero = self.data.find(b"\0")
            if zero >= 0:
                return "", f"byte {zero + 1} is zero"
            try:
                text = self.data.decode("utf-8-sig")
            except UnicodeDecodeError:
                # Older instruments' software writes µ, ° and umlauts in Latin-1, and on Windows
                # dashes and quotation marks where Latin-1 has controls. Five bytes are neither.
                text = self.data.decode("cp1252", errors="replace")
        return text.replace("\r\n", "\n").replace("\r", "\n"), ""


def _utf_16(data: bytes) -> str:
    """Return the name of the two-byte encoding that a file has, or nothing.

    Some programs leave the byte order mark away. What is mostly digits and delimiters then has
    zeros at every other byte, which no other text has anywhere.
    """
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    head = data[:256]
    pairs = len(head) // 2
    for name, zeros, others in (
        ("utf-16-le", head[1::2], head[0::2]),
        ("utf-16-be", head[0::2], head[1::2]),
    ):
        if pairs > 1 and zeros.count(0) > 0.75 * pairs and not others.count(0):
            return name
    return ""


def open_document(
    path: str | os.PathLike[str], region: tuple[int, int, int, int] | None = None
) -> Document:
    """Read a file whole; the region is that of the document.

    Raises
    ------
    InputError
        It is missing, a folder, something else than a file, empty, larger than `LARGEST_FILE`, or
        the system refuses to read it.
    """
    file = Path(path)
    data = user_files.read(file, LARGEST_FILE)
    if not data or data.isspace():
        raise InputError(f"{file}: the file is empty; export the measurement again.")
    return Document(file, data, region)


def quote(text: str) -> str:
    """Return a piece of a file fit for a sentence: short, printable, in quotation marks."""
    return repr(text if len(text) <= 40 else text[:39] + "…")


def plain(text: str) -> str:
    """Return a piece of a file fit for a note: one line without control characters."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())
