# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts of users and of files, where a terminal or a spreadsheet would carry them out.

`out`, `tell`, `inform` and `close` are all that prints; `to_cell` is for the tables that are
written, and `from_cell` undoes it when they are read.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field

from .streams import flush_blender

ESCAPED = "escaped"
"""What a table says of its cells if `to_cell` made them."""

CELLS = "ROUGH_SPECTRA_CELLS"
"""Keyword with which a CGATS file says so."""

# Controls, what ends a line or turns its direction, half a surrogate pair.
_UNSEEN = r"\x00-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff\ud800-\udfff"
_CONTROL = re.compile(f"[{_UNSEEN}]")
_NOT_IN_CELLS = re.compile(rf"[\\{_UNSEEN}]|^\s|\s$")
_FORMULA = re.compile(r"\s*['=+\-@\uff1d\uff0b\uff0d\uff20]")
_ESCAPE = re.compile(r"\\(?:(\\)|x([0-9a-f]{2})|u([0-9a-f]{4}))")


def printable(text: str) -> str:
    r"""Return a text as a terminal may show it: control characters as in ``\x1b``."""
    return _CONTROL.sub(_escape, text)


@dataclass
class Said:
    """What a command says, for who wants it otherwise than as lines.

    Parameters
    ----------
    quiet
        Whether `inform` is silent.
    engine
        Whose lines tell the progress: "openjd", or empty for people.
    share
        Where the work under way begins and ends in all of it, from 0 to 1.
    keeps_rows
        Whether `out` keeps its rows here instead of printing them.
    rows, sentences
        What `out`, and what `tell` and `inform` were given.
    """

    quiet: bool = False
    keeps_rows: bool = False
    engine: str = ""
    share: tuple[float, float] = (0.0, 1.0)
    rows: list[tuple[str, ...]] = field(default_factory=list)
    sentences: list[str] = field(default_factory=list)


_said: ContextVar[Said | None] = ContextVar("said", default=None)


@contextmanager
def listening(said: Said) -> Iterator[None]:
    """Let what the block says go by `said`."""
    before = _said.set(said)
    try:
        yield
    finally:
        _said.reset(before)


def heard() -> Said:
    """Give what the innermost `listening` goes by."""
    return _said.get() or Said()


def out(*columns: str) -> None:
    """Print a result, its columns separated by tabs."""
    said = _said.get()
    if said is not None:
        said.rows.append(columns)
        if said.keeps_rows:
            return
    print("\t".join(map(printable, columns)))


def close(result: str) -> None:
    """Print what a program is to read last, on standard output."""
    flush_blender()
    print(printable(result), flush=True)


def tell(sentence: str) -> None:
    """Say something beside the results that has to be known, on standard error."""
    _keep(sentence)
    flush_blender()
    print(printable(sentence), file=sys.stderr)


def inform(sentence: str) -> None:
    """Say the same of what went well; with --quiet nobody hears it."""
    if heard().quiet:
        _keep(sentence)
    else:
        tell(sentence)


def _keep(sentence: str) -> None:
    said = _said.get()
    if said is not None:
        said.sentences.append(sentence)


def to_cell(text: str) -> str:
    r"""Return a text for a cell of a table.

    Control characters, the backslash and white space at the ends become escapes such as ``\x1b``.
    An apostrophe stands before ``= + - @``, by which a spreadsheet knows a formula, and before
    another apostrophe.
    """
    text = _NOT_IN_CELLS.sub(_escape, text)
    return f"'{text}" if _FORMULA.match(text) else text


def from_cell(cell: str) -> str:
    """Return the text that `to_cell` made a cell of."""
    return _ESCAPE.sub(_unescape, cell.removeprefix("'"))


def _escape(found: re.Match[str]) -> str:
    if found[0] == "\\":
        return "\\\\"
    code = ord(found[0])
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}"


def _unescape(found: re.Match[str]) -> str:
    return found[1] or chr(int(found[2] or found[3], 16))
