# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheels that ship are small, honest about themselves, and what the tests run with."""

import base64
import csv
import hashlib
import importlib.metadata
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

from tools.environment import archives, wheels
from tools.environment.errors import SetupError

ROOT = Path(__file__).resolve().parents[2]
# 88 MB unpacked before; design: "1.7 MB and 6.9 MB unpacked".
MOST_BYTES, MOST_BYTES_UNPACKED = 1.8e6, 7.2e6


@pytest.fixture(scope="module")
def wheel():
    return wheels.ensure(ROOT, Path(sys.executable))


def record_of(files):
    name = next(name for name in files if name.endswith(".dist-info/RECORD"))
    return name, list(csv.reader(files[name].decode("utf-8").splitlines()))


def test_reports_tests_and_examples_are_gone(wheel):
    names = zipfile.ZipFile(wheel).namelist()
    folders = {folder for name in names for folder in name.split("/")[:-1]}
    assert not folders & {"htmlcov", "tests", "examples"}
    assert "colour/__init__.py" in names
    assert any(name.endswith("/licenses/LICENSE") for name in names)


def test_size(wheel):
    entries = zipfile.ZipFile(wheel).infolist()
    assert wheel.stat().st_size < MOST_BYTES
    assert sum(entry.file_size for entry in entries) < MOST_BYTES_UNPACKED


def test_record_names_every_file_with_its_hash_and_size(wheel):
    files = archives.read(wheel)
    own_name, rows = record_of(files)
    assert sorted(row[0] for row in rows) == sorted(files)
    for name, digest, size in rows:
        if name == own_name:
            assert (digest, size) == ("", "")
            continue
        kind, _, text = digest.partition("=")
        assert kind == "sha256"
        padded = text + "=" * (-len(text) % 4)
        assert base64.urlsafe_b64decode(padded) == hashlib.sha256(files[name]).digest()
        assert int(size) == len(files[name])


def test_build_tag_stands_in_name_and_metadata(wheel):
    assert wheel.name == "colour_science-0.4.7-1-py3-none-any.whl"
    files = archives.read(wheel)
    text = next(files[name] for name in files if name.endswith(".dist-info/WHEEL")).decode()
    assert "\nBuild: 1\n" in text
    assert "\n\n" not in text


def test_manifest_names_the_wheels():
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))
    shipped = wheels.shipped(ROOT, Path(sys.executable))
    assert manifest["wheels"] == [f"./wheels/{wheel.name}" for wheel in shipped]


def test_defusedxml_ships_as_its_authors_made_it_and_as_the_tests_use_it():
    wanted = wheels.pin(ROOT, wheels.DEFUSEDXML)
    wheel = wheels.shipped(ROOT, Path(sys.executable))[1]
    assert hashlib.sha256(wheel.read_bytes()).hexdigest() == wanted.sha256
    assert importlib.metadata.version("defusedxml") == wanted.version
    for name in ("bpy-4.5.txt", "bpy-5.2.txt"):
        lines = (ROOT / "requirements" / name).read_text(encoding="utf-8").splitlines()
        assert f"defusedxml=={wanted.version}" in lines


def test_a_damaged_copy_is_replaced_from_the_cache(tmp_path):
    whole = wheels.shipped(ROOT, Path(sys.executable))
    for folder in ("requirements", ".cache", "wheels"):
        (tmp_path / folder).mkdir()
    (tmp_path / "requirements/wheels.txt").write_bytes(
        (ROOT / "requirements/wheels.txt").read_bytes()
    )
    for name in (wheels.COLOUR, wheels.DEFUSEDXML):
        upstream = wheels.pin(ROOT, name).upstream
        (tmp_path / ".cache" / upstream).write_bytes((ROOT / ".cache" / upstream).read_bytes())
    (tmp_path / "wheels" / whole[1].name).write_bytes(b"PK")
    made = wheels.shipped(tmp_path, Path(sys.executable))
    assert [path.read_bytes() for path in made] == [path.read_bytes() for path in whole]


def test_this_environment_has_exactly_what_ships(wheel):
    """No scipy and no matplotlib either: Blender has none, so passing with them proves nothing."""
    installed = importlib.metadata.distribution("colour-science")
    shipped = {row[0] for row in record_of(archives.read(wheel))[1] if row[0].startswith("colour/")}
    # pip's own record of the installation adds the byte-compiled files.
    present = {path.as_posix() for path in installed.files if path.suffix != ".pyc"}
    assert shipped == {name for name in present if name.startswith("colour/")}
    names = {found.name for found in importlib.metadata.distributions()}
    assert not names & {"scipy", "matplotlib"}


def small_wheel(path):
    info = "thing-1.dist-info"
    files = {
        "thing/__init__.py": b"",
        "thing/tests/test_it.py": b"assert True\n",
        "thing/latests.py": b"",
        f"{info}/WHEEL": b"Wheel-Version: 1.0\nTag: py3-none-any\n\n",
        f"{info}/RECORD": b"thing/__init__.py,,\n",
    }
    archives.write(path, files)
    return path


def test_equal_input_gives_equal_bytes_whatever_its_order_and_dates(tmp_path):
    source = small_wheel(tmp_path / "a.whl")
    files = archives.read(source)
    with zipfile.ZipFile(tmp_path / "b.whl", "w") as other:
        for name in reversed(files):
            other.writestr(zipfile.ZipInfo(name, (2020, 5, 17, 1, 2, 4)), files[name])
    for name in ("a", "b"):
        wheels.trim(tmp_path / f"{name}.whl", tmp_path / f"{name}-trimmed.whl")
    assert (tmp_path / "a-trimmed.whl").read_bytes() == (tmp_path / "b-trimmed.whl").read_bytes()


def test_only_whole_folder_names_are_dropped(tmp_path):
    wheels.trim(small_wheel(tmp_path / "a.whl"), tmp_path / "b.whl")
    assert [n for n in archives.read(tmp_path / "b.whl") if n.startswith("thing/")] == [
        "thing/__init__.py",
        "thing/latests.py",
    ]


def test_damaged_wheel_is_made_again(tmp_path, wheel):
    """From the original in .cache/, so this needs no network."""
    for folder in ("requirements", ".cache", "wheels"):
        (tmp_path / folder).mkdir()
    pinned = wheels.pin(ROOT)
    for name in ("requirements/wheels.txt", f".cache/{pinned.upstream}"):
        (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    broken = tmp_path / "wheels" / pinned.trimmed
    broken.write_bytes(wheel.read_bytes()[:1000])
    made = wheels.ensure(tmp_path, Path(sys.executable))
    assert made == broken
    assert made.read_bytes() == wheel.read_bytes()


def test_missing_pin_says_what_to_do(tmp_path):
    (tmp_path / "requirements").mkdir()
    (tmp_path / "requirements" / "wheels.txt").write_text("colour-science\n", encoding="utf-8")
    with pytest.raises(SetupError, match=r"wheels\.txt has no line .* from git"):
        wheels.pin(tmp_path)


def test_failed_write_leaves_the_old_file(tmp_path):
    target = tmp_path / "x.zip"
    archives.write(target, {"a": b"old"})
    with pytest.raises(TypeError):
        archives.write(target, {"a": b"new", "b": None})
    assert archives.read(target) == {"a": b"old"}
    assert list(tmp_path.iterdir()) == [target]
