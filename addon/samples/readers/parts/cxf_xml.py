# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pieces of a CxF3 document that matter, one by one.

Nothing else is built, so that a large or hostile file costs little. Names of elements are compared
without their namespace, whose prefix every writer chooses differently.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from .document import Document
from .xml_faults import faults_named

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

_WHOLE = ("FileInformation", "Object", "ColorSpecification")
_PIECE = 2**16  # bytes that are parsed at a time
_LONG_TAG = re.compile(rb"<[^<>!?][^<>]{65536}")  # its attributes would take a lot of memory
_BYTES_AN_ELEMENT = 8
"""The shortest in use is ``<L>5</L>``. An element takes 90 bytes of memory."""
_DEEPEST = 50  # levels; the standard's own elements reach about ten


def parts(document: Document) -> Iterator[Element]:
    """Yield the root as it begins, then what describes the file, objects and specifications, whole.

    Raises
    ------
    InputError
        The XML is broken, has too many elements, is nested too deep, or declares a document type
        or entities.
    """
    from defusedxml.ElementTree import DefusedXMLParser

    if _LONG_TAG.search(document.data):
        raise document.error("", "one of its XML tags is longer than 64 kB; export it again")
    ends = document.data.count(b"</") + document.data.count(b"<\0/")  # also in UTF-16
    elements = document.data.count(b"<") - ends
    if elements > 8 + len(document.data) // _BYTES_AN_ELEMENT:
        raise document.error("", "it has more elements than measurements need; export it again")
    target = _Target(document)
    parser = DefusedXMLParser(target=target, forbid_dtd=True)
    with faults_named(document):
        for start in range(0, len(document.data), _PIECE):
            parser.feed(document.data[start : start + _PIECE])
            yield from target.taken()
        parser.close()
        yield from target.taken()


class _Target:
    """Builds trees of what is wanted only: all else passes by and costs little."""

    def __init__(self, document: Document) -> None:
        from xml.etree.ElementTree import TreeBuilder

        self._builder = TreeBuilder
        self._document = document
        self._depth = self._inside = 0
        self._ready: list[Element] = []

    def taken(self) -> list[Element]:
        """Return what has become whole since the last time."""
        ready, self._ready = self._ready, []
        return ready

    def start(self, name: str, attributes: dict[str, str]) -> None:
        self._depth += 1
        if self._depth > _DEEPEST:
            raise self._document.error("", f"its XML is nested more than {_DEEPEST} levels deep")
        if self._inside or name.rpartition("}")[2] in _WHOLE:
            if not self._inside:
                self._tree = self._builder()
            self._inside += 1
            self._tree.start(name, attributes)
        elif self._depth == 1:
            root = self._builder()
            root.start(name, attributes)
            root.end(name)
            self._ready.append(root.close())

    def data(self, text: str) -> None:
        if self._inside:
            self._tree.data(text)

    def end(self, name: str) -> None:
        self._depth -= 1
        if self._inside:
            self._tree.end(name)
            self._inside -= 1
            if not self._inside:
                self._ready.append(self._tree.close())

    def close(self) -> None:
        """End the document, as the parser asks."""


def tag(element: Element) -> str:
    """Return an element's name without its namespace."""
    return str(element.tag).rpartition("}")[2]
