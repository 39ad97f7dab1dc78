# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ordinates of JCAMP-DX tables: AFFN, PAC, SQZ, DIF and DUP, decoded line by line.

The forms are those of McDonald and Wilks, "JCAMP-DX: A Standard Form for Exchange of Infrared
Spectra in Computer Readable Form", Applied Spectroscopy 42 (1988). Letters stand for a sign and
the first digit: ``@A…Ia…i`` begin a value (SQZ), ``%J…Rj…r`` a difference to the value before
(DIF), and ``S…Zs`` how often the value or the difference stands in all (DUP).
"""

from __future__ import annotations

import math
import re
from array import array

from .document import Document, quote

_TOKEN = re.compile(
    r"(?P<number>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]\d+)?)"
    r"|(?P<letter>[@A-Za-z%])(?P<digits>\d*\.?\d*)"
    r"|(?P<missing>\?)"
    r"|(?P<other>[^\s,;])"
)

_PLAIN = re.compile(r"[-+.\d \t]+")


def _digits(positive: str, negative: str) -> dict[str, str]:
    found = {letter: str(i) for i, letter in enumerate(positive)}
    return found | {letter: f"-{i}" for i, letter in enumerate(negative, start=1)}


_SQZ = _digits("@ABCDEFGHI", "abcdefghi")
_DIF = _digits("%JKLMNOPQR", "jklmnopqr")
_DUP = {letter: str(i) for i, letter in enumerate("STUVWXYZs", start=1)}

# A line of the format has at most 80 characters, but none of the digits may run away.
_LONGEST_NUMBER = 40
# DUP makes many points of three bytes. No measured spectrum is so even that it has more points than
# these and than three in five bytes; the densest known have two in five.
_FREE_POINTS = 100_000


class Ordinates:
    """The ordinates of one table ``(X++(Y..Y))``, fed line by line.

    Parameters
    ----------
    document
        The file, for messages and for its size.

    Attributes
    ----------
    values
        Ordinates before YFACTOR; NaN for ``?``.
    abscissas
        Of each line: its number, X before XFACTOR as it is written, and the index of the ordinate
        that it belongs to.
    """

    def __init__(self, document: Document) -> None:
        self.values = array("d")
        self.abscissas: list[tuple[int, str, int]] = []
        self._document = document
        self._most = max(_FREE_POINTS, len(document.data) * 3 // 5)
        self._ends_in_difference = False

    def feed(self, line: int, text: str) -> None:
        """Decode one line.

        Raises
        ------
        InputError
            It does not begin with X, holds something else than the forms above, or contradicts the
            last ordinate of the line before.
        """
        if not text.strip() or (not self._ends_in_difference and self._plain(line, text)):
            return
        tokens = _TOKEN.finditer(text)
        first = next(tokens, None)
        if first is None:
            return
        if first["number"] is None:
            raise self._fault(line, f"{quote(text)} does not begin with an abscissa")
        start = len(self.values)
        begun = False
        check = self._ends_in_difference
        self.abscissas.append((line, first["number"], start - 1 if check else start))
        difference: float | None = None
        for token in tokens:
            letter = token["letter"] or ""
            if letter in _DUP:
                if not begun:
                    raise self._fault(line, f"{quote(token[0])} repeats nothing")
                self._repeat(line, token, difference)
                continue
            difference = None
            if letter in _DIF:
                if not begun:
                    raise self._fault(line, "a difference stands where a value has to begin")
                difference = self._number(line, _DIF[letter] + token["digits"])
                self._append(line, self.values[-1] + difference)
            else:
                value = self._value(line, token)
                if check:
                    self._compare(line, value)
                else:
                    self._append(line, value)
            begun, check = True, False
            self._ends_in_difference = difference is not None

    def _plain(self, line: int, text: str) -> bool:
        """Decode a line with nothing but numbers and spaces, the most frequent form, at once."""
        if not _PLAIN.fullmatch(text):
            return False
        fields = text.split()
        try:
            _, *found = map(float, fields)
        except ValueError:
            return False  # packed: signs stand between the numbers
        if len(self.values) + len(found) > self._most:
            return False
        self.abscissas.append((line, fields[0], len(self.values)))
        self.values.extend(found)
        return True

    def _value(self, line: int, token: re.Match[str]) -> float:
        if token["missing"]:
            return math.nan
        if token["number"]:
            return self._number(line, token["number"])
        letter = token["letter"] or ""
        if letter not in _SQZ:
            raise self._fault(line, f"{quote(token[0])} is no form of an ordinate")
        return self._number(line, _SQZ[letter] + token["digits"])

    def _repeat(self, line: int, token: re.Match[str], difference: float | None) -> None:
        count = self._number(line, _DUP[token["letter"]] + token["digits"])
        if count != int(count):
            raise self._fault(line, f"{quote(token[0])} is no number of repetitions")
        if len(self.values) + count > self._most:
            raise self._fault(line, f"{quote(token[0])} makes more points than a spectrum has")
        for _ in range(int(count) - 1):
            self.values.append(self.values[-1] + (difference or 0.0))

    def _compare(self, line: int, value: float) -> None:
        last = self.values[-1]
        # Differences are whole numbers, for which the sums are exact; where a program wrote
        # decimals, their rounding stays below this.
        if not abs(value - last) <= 1e-9 * max(1.0, abs(last)):
            raise self._fault(
                line,
                f"the checkpoint {value:.12g} contradicts the last ordinate {last:.12g} of the "
                "line before; one of the two lines is damaged",
            )

    def _append(self, line: int, value: float) -> None:
        if len(self.values) >= self._most:
            raise self._fault(line, "there are more points than a spectrum has")
        self.values.append(value)

    def _number(self, line: int, digits: str) -> float:
        if len(digits) <= _LONGEST_NUMBER:
            try:
                return float(digits)
            except ValueError:
                pass
        raise self._fault(line, f"{quote(digits)} is not a number")

    def _fault(self, line: int, what: str) -> Exception:
        return self._document.error(f"line {line}", f"{what}; export the file again")


class Pairs:
    """The points of a table ``(XY..XY)``, fed line by line.

    Attributes
    ----------
    x, y
        Before XFACTOR and YFACTOR.
    lines
        The line of each point.
    """

    _DECIMAL_COMMAS = re.compile(r"\s*[-+]?\d+,\d+\s*[,;]\s+[-+]?\d+,\d+\s*")
    _SEPARATOR = re.compile(r"[,;\s]+")

    def __init__(self, document: Document) -> None:
        self.x = array("d")
        self.y = array("d")
        self.lines = array("L")
        self._document = document

    def feed(self, line: int, text: str) -> None:
        """Decode one line.

        Raises
        ------
        InputError
            It does not hold pairs of numbers.
        """
        if self._DECIMAL_COMMAS.fullmatch(text):
            fields = text.replace(", ", " ").replace(";", " ").replace(",", ".").split()
        else:
            fields = [field for field in self._SEPARATOR.split(text) if field]
        if len(fields) % 2:
            raise self._document.error(
                f"line {line}", "an x without its y; export the file again with pairs on a line"
            )
        for first, second in zip(fields[::2], fields[1::2], strict=True):
            self.x.append(self._number(line, first))
            self.y.append(math.nan if second == "?" else self._number(line, second))
            self.lines.append(line)

    def _number(self, line: int, text: str) -> float:
        try:
            if "_" not in text:
                return float(text)
        except ValueError:
            pass
        raise self._document.error(
            f"line {line}", f"{quote(text)} is not a number; export the file again"
        )
