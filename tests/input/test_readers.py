# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The registry of formats, and files that no format can help."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from rough_spectra.addon.samples import endings, readers
from rough_spectra.addon.samples.readers.parts import document
from rough_spectra.core.errors import InputError

ROOT = Path(__file__).resolve().parents[2]
FIXTURES = ROOT / "tests" / "fixtures"


def refusal(path):
    with pytest.raises(InputError) as caught:
        readers.read(path)
    sentence = str(caught.value)
    assert Path(path).name.replace("\0", "\\0") in sentence
    assert sentence.endswith(".")
    assert "\n" not in sentence
    return sentence


def test_every_module_keeps_the_protocol_and_the_general_one_comes_last():
    found = readers.readers()
    assert {reader.__name__.rpartition(".")[2] for reader in found} == {
        path.stem
        for path in (ROOT / "addon" / "samples" / "readers" / "formats").glob("*.py")
        if path.stem != "__init__"
    }
    for reader in found:
        assert isinstance(reader.NAME, str)
        assert all(ending == ending.lower() for ending in reader.ENDINGS)
        assert callable(reader.sniff)
        assert callable(reader.read)
    priorities = [reader.PRIORITY for reader in found]
    assert priorities == sorted(priorities, reverse=True)
    assert found[-1].__name__.endswith(".delimited")
    assert found[-1].NAME.startswith("table with wavelengths")


def test_endings_are_told_without_importing_and_the_manual_lists_them():
    found = {ending for reader in readers.readers() for ending in reader.ENDINGS}
    assert endings.endings() == sorted(found)
    rows = [
        f"| {reader.NAME} | {', '.join(f'`.{ending}`' for ending in reader.ENDINGS)} |"
        for reader in sorted(readers.readers(), key=lambda reader: reader.NAME.casefold())
    ]
    manual = (ROOT / "docs" / "formats.md").read_text(encoding="utf-8")
    assert "\n".join(["|---|---|", *rows, ""]) in manual


@pytest.mark.parametrize("ending", [".txt", ".exr", ".json", ""])
def test_content_decides_and_not_the_ending(tmp_path, ending):
    for source in ("nix/brick.csv", "delimited/bake-style.csv"):
        path = tmp_path / f"sample{ending}"
        path.write_bytes((FIXTURES / source).read_bytes())
        found, expected = readers.read(path), readers.read(FIXTURES / source)
        assert [s.values.tolist() for s in found] == [s.values.tolist() for s in expected]


def test_readers_need_neither_blender_nor_colour_science():
    script = (
        "import sys, runpy; runpy.run_path(sys.argv[1]);"
        "import rough_spectra.addon.samples.presets as p;"
        "p.load('14'); print(sorted({'bpy', 'colour', 'OpenImageIO'} & set(sys.modules)))"
    )
    command = [sys.executable, "-c", script, str(ROOT / "tests" / "conftest.py")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_missing_file_folder_and_odd_names(tmp_path):
    assert "no such file" in refusal(tmp_path / "missing.csv")
    (tmp_path / "folder").mkdir()
    assert "this is a folder" in refusal(tmp_path / "folder")
    (tmp_path / "file").write_text("400,0.5\n410,0.5\n")
    assert "no such file" in refusal(tmp_path / "file" / "inside.csv")
    assert "cannot be read" in refusal("null\0.csv")
    assert "cannot be read" in refusal(tmp_path / ("long" * 200))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes on this system")
def test_a_pipe_is_refused_instead_of_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    assert "no regular file" in refusal(tmp_path / "pipe")


def test_no_permission(tmp_path, monkeypatch):
    path = tmp_path / "locked.csv"
    path.write_text("400,0.5\n410,0.5\n")

    # Not by chmod: an administrator, as in many containers, may read everything.
    def refuse(self):
        raise PermissionError(13, "Permission denied", str(self))

    monkeypatch.setattr(Path, "read_bytes", refuse)
    assert "no permission" in refusal(path)


@pytest.mark.parametrize("data", [b"", b" \r\n\t\n"])
def test_empty(tmp_path, data):
    (tmp_path / "empty.csv").write_bytes(data)
    assert "empty" in refusal(tmp_path / "empty.csv")


@pytest.mark.parametrize(
    ("data", "part"),
    [
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "byte 9 is zero"),
        (b"wavelength,R\n400,0.5\n410,\x07\n", "line 3 holds the control character 0x07"),
        (b"\xff\xfe4\x000\x000\x00,", "UTF-16 breaks off at byte"),
        (b"once upon a time\n", "no format recognizes it"),
        (b"<xml><a>400 0.5</a></xml>", "no format recognizes it"),
        (b"# only\n# comments\n", "no format recognizes it"),
        (b"\xef\xbb\xbf", "no format recognizes it"),
    ],
)
def test_not_a_measurement(tmp_path, data, part):
    (tmp_path / "junk.csv").write_bytes(data)
    sentence = refusal(tmp_path / "junk.csv")
    assert part in sentence
    assert "export the reflectance as a table" in sentence


def test_too_large_is_refused_before_it_is_read(tmp_path, monkeypatch):
    monkeypatch.setattr(document, "LARGEST_FILE", 2**20)
    monkeypatch.setattr(Path, "read_bytes", lambda self: pytest.fail("was read"))
    with (tmp_path / "large.csv").open("wb") as file:
        file.truncate(2**20 + 1)
    assert "more than the 1 MB" in refusal(tmp_path / "large.csv")
