# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""No file makes its reader open another, expand anything, or climb out of its folders."""

import os
from pathlib import Path

import pytest
from rough_spectra.addon.samples import readers
from rough_spectra.addon.samples.readers.formats import cxf, spdx
from rough_spectra.addon.samples.readers.parts.document import Document
from rough_spectra.core.errors import InputError

from tools.checks import promises

FIXTURES = Path(__file__).resolve().parents[1] / "fixtures"
CXF = (FIXTURES / "cxf" / "two.cxf").read_bytes()
SPDX = (FIXTURES / "spdx" / "tile.spdx").read_bytes()
READERS = [(cxf, CXF), (spdx, SPDX)]
readers.readers()  # lists their folder, which no reader may do

LAUGHS = b"".join(
    b'<!ENTITY l%d "%s">' % (i, b"&l%d;" % (i - 1) * 10 if i else b"ha") for i in range(30)
)
DECLARED = {
    "billion laughs": b"<!DOCTYPE x [%s]>" % LAUGHS,
    "quadratic blowup": b'<!DOCTYPE x [<!ENTITY a "%s">]>' % (b"a" * 50_000),
    "external entity": b'<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]>',
    "entity from the network": b'<!DOCTYPE x [<!ENTITY a SYSTEM "http://127.0.0.1/a">]>',
    "parameter entity": b'<!DOCTYPE x [<!ENTITY % a SYSTEM "file:///etc/passwd"> %a;]>',
    "external DTD": b'<!DOCTYPE x SYSTEM "file:///etc/passwd">',
    "empty DTD": b"<!DOCTYPE x>",
}


def read(reader, data, folder):
    """Read within time, memory and the folder; return the message, empty if there is none."""
    path = folder / "a.xml"
    name = promises.short(reader)
    for look in (promises.outcome, promises.weighed):
        with promises.confined(folder):
            found = look(readers, path, data, name)
        assert list(promises.faults(name, path, len(data), found)) == []
    return found.message


def with_root(data, before=b"", inside=b""):
    """Put something before the root's tag, and something right behind it."""
    prolog = data.index(b"?>") + 2
    root = data.index(b">", prolog + data[prolog:].index(b"<")) + 1
    return data[:prolog] + before + data[prolog:root] + inside + data[root:]


@pytest.mark.parametrize("declared", DECLARED)
@pytest.mark.parametrize(("reader", "data"), READERS, ids=["cxf", "spdx"])
def test_document_types_and_entities_are_refused(tmp_path, reader, data, declared):
    assert read(reader, data, tmp_path) == ""
    for use in (b"", b"<a>&l29;</a>", b"<a>%s</a>" % (b"&a;" * 20_000)):
        hostile = with_root(data, DECLARED[declared], use)
        assert "declares a document type or entities" in read(reader, hostile, tmp_path)


@pytest.mark.parametrize(("reader", "data"), READERS, ids=["cxf", "spdx"])
def test_deep_wide_and_huge_xml_ends_soon(tmp_path, reader, data):
    deep = with_root(data, inside=b"<a b='12345'>" * 90_000 + b"</a>" * 90_000)
    assert "nested more than" in read(reader, deep, tmp_path)
    assert "more" in read(reader, with_root(data, inside=b"<a/>" * 250_000), tmp_path)
    several = b" ".join(b'a%d=""' % i for i in range(100_000))
    for inside in (
        b'<a b="%s"/>' % (b"x" * 10**6),
        b"<a %s/>" % several,
        b"<%s/>" % (b"a" * 10**6),
        b"<!--%s-->" % (b"x" * 10**6),
        b"<![CDATA[%s]]>" % (b"x" * 10**6),
        b"<?a %s?>" % (b"x" * 10**6),
        b"&#65;" * 200_000,
    ):
        read(reader, with_root(data, inside=inside), tmp_path)


@pytest.mark.parametrize(
    "name", ["", ".", "..", "../a.txt", "/etc/passwd", "a/b.txt", "a\\b.txt", "C:a.txt", "a\0.txt"]
)
def test_only_plain_names_belong_to_a_file(tmp_path, name):
    document = Document(tmp_path / "spectrum.txt", b"1")
    with pytest.raises(InputError, match="is no plain file name"):
        document.companion(name)


def test_what_belongs_to_a_file_is_opened_as_carefully(tmp_path):
    document = Document(tmp_path / "spectrum.txt", b"1")
    assert document.companion("missing.txt") is None
    (tmp_path / "beside.txt").write_bytes(b"2")
    assert document.companion("beside.txt").data == b"2"
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputError, match="this is a folder"):
        document.companion("folder")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes on this system")
def test_links_lead_to_files_only(tmp_path):
    """A link of the user's own is followed, but never to what would block or end nowhere."""
    document = Document(tmp_path / "spectrum.txt", b"1")
    os.mkfifo(tmp_path / "pipe")
    for name, target in (("pipe.txt", "pipe"), ("zero.txt", "/dev/zero")):
        (tmp_path / name).symlink_to(target)
        with pytest.raises(InputError, match="no regular file"):
            document.companion(name)
        with pytest.raises(InputError, match="no regular file"):
            readers.read(tmp_path / name)
    (tmp_path / "round.txt").symlink_to("round.txt")
    assert document.companion("round.txt") is None
    with pytest.raises(InputError, match="cannot be read"):
        readers.read(tmp_path / "round.txt")
