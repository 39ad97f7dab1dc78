# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is said of broken or dangerous XML, the same for every format that is made of it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from .document import Document


@contextmanager
def faults_named(document: Document) -> Iterator[None]:
    """Turn what the parser raises inside the block into one sentence with its place.

    Raises
    ------
    InputError
        The XML declares a document type or entities, is broken, or names an unknown encoding.
    """
    from xml.etree.ElementTree import ParseError

    from defusedxml.common import DefusedXmlException

    try:
        yield
    except DefusedXmlException:
        raise document.error(
            "", "its XML declares a document type or entities, which are not read; remove them"
        ) from None
    except ParseError as error:
        line, column = error.position
        raise document.error(
            f"line {line}, column {column + 1}", "the XML is broken; export it again"
        ) from None
    except (LookupError, ValueError):
        raise document.error("line 1", "the encoding it declares is not known; use UTF-8") from None
