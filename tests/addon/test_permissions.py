# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that may not be replaced are refused; those that may keep owner, group, mode and links."""

import json
import os
import stat
import subprocess
import sys
import textwrap
from pathlib import Path

import bpy
import numpy as np
import pytest
from rough_spectra.addon.assets import build
from rough_spectra.addon.blender import blend_file
from rough_spectra.addon.readings import writers
from rough_spectra.addon.readings.document import Readings
from rough_spectra.addon.samples import library_files, readers
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.support import atomic_files
from rough_spectra.core.errors import OutputError

pytestmark = pytest.mark.skipif(os.name == "nt", reason="modes, owners and pipes of POSIX")

TESTS = Path(__file__).resolve().parents[1]
NOBODY = 65534
as_root = pytest.mark.skipif(
    os.name == "nt" or os.geteuid() != 0, reason="only root can become somebody else"
)


def save_blend(path):
    blend_file.save(path)


def write_result(path):
    with atomic_files.publication() as files:
        files.write(path, b"new")


def write_bake(path):
    writers.write(Readings("Linear Rec.709", "5", ()), path.with_suffix(""), ())


def add_to_library(path):
    bands = np.arange(400.0, 701, 10)
    level = 0.1 + len(path.read_bytes()) / 1e4 if path.is_file() else 0.1  # one that is new
    sample = Sample("added", bands, np.full(bands.size, level), "reading")
    library_files.add([sample], path.stem, path.parent)


WRITERS = {
    "blend": (save_blend, "a.blend"),
    "result": (write_result, "a.csv"),
    "bake": (write_bake, "a.json"),
    "library": (add_to_library, "a.json"),
}


@pytest.fixture(params=WRITERS)
def written(request, tmp_path):
    """A way to write, and a file that was written in this way."""
    write, name = WRITERS[request.param]
    path = tmp_path / "out" / name
    write(path)
    return write, path


def mode(path):
    return stat.S_IMODE(path.lstat().st_mode)


def test_an_existing_file_keeps_its_mode(written):
    write, path = written
    for given in (0o600, 0o640, 0o664):
        path.chmod(given)
        before = path.stat().st_ino
        write(path)
        assert path.stat().st_ino != before
        assert mode(path) == given


@as_root
def test_an_existing_file_keeps_owner_and_group(written):
    write, path = written
    os.chown(path, NOBODY, 12345)
    path.chmod(0o660)
    write(path)
    assert (path.stat().st_uid, path.stat().st_gid, mode(path)) == (NOBODY, 12345, 0o660)


def test_what_nobody_may_write_is_refused(written):
    """A user is refused by the system's own answer; root too, since it was meant so."""
    write, path = written
    path.chmod(0o444)
    before = path.read_bytes()
    with pytest.raises(OutputError, match=r"a\.\w+ is write-protected; permit writing"):
        write(path)
    assert (path.read_bytes(), mode(path)) == (before, 0o444)
    assert not [left for left in path.parent.iterdir() if left.name.endswith(".part")]


def test_a_link_is_followed_and_stays_one(written, tmp_path):
    write, path = written
    real = tmp_path / "elsewhere" / "real"
    real.parent.mkdir()
    path.rename(real)
    real.chmod(0o600)
    path.symlink_to(Path("..", "elsewhere", "real"))
    before = real.stat().st_ino
    write(path)
    assert path.is_symlink()
    assert real.stat().st_ino != before
    assert mode(real) == 0o600
    real.chmod(0o400)
    with pytest.raises(OutputError, match="write-protected"):
        write(path)


def test_what_is_no_file_is_refused(written, tmp_path):
    write, path = written
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for place, word in (
        (None, "a device or a pipe"),
        (pipe, "a device or a pipe"),
        (Path(os.devnull), "a device or a pipe"),
        (tmp_path / "nothing", "not there"),
    ):
        path.unlink()
        if place is None:
            os.mkfifo(path)
        else:
            path.symlink_to(place)
        before = os.lstat(path)
        with pytest.raises(OutputError, match=word):
            write(path)
        assert os.path.samestat(os.lstat(path), before)


def test_an_asset_library_is_refused_before_it_is_built(tmp_path):
    blend = tmp_path / "rough-spectra.blend"
    blend.write_bytes(b"old")
    blend.chmod(0o444)
    with pytest.raises(OutputError, match="write-protected"):
        build.Build([], tmp_path)


def test_a_bake_is_refused_before_it_measures(tmp_path):
    for name in ("x.json", "x.measured.csv", "x.predicted-2.spectral.exr"):
        (tmp_path / name).write_bytes(b"old")
        writers.check(tmp_path / "x")
        (tmp_path / name).chmod(0o444)
        with pytest.raises(OutputError, match=f"{name} is write-protected"):
            writers.check(tmp_path / "x")
        (tmp_path / name).unlink()
    (tmp_path / "x.other.csv").write_bytes(b"of somebody else")
    (tmp_path / "x.other.csv").chmod(0o444)
    writers.check(tmp_path / "x")


@as_root
def test_a_user_is_refused_what_is_anothers_and_does_not_open_it_to_another_group(tmp_path):
    """As an ordinary user: modules are imported before, since root's may not be readable."""
    out = tmp_path / "out"
    out.mkdir()
    for name, uid, gid, bits in (
        ("foreign.csv", 0, 0, 0o644),
        ("group.csv", 0, NOBODY, 0o664),
        ("own.csv", NOBODY, 12345, 0o660),
    ):
        (out / name).write_bytes(b"old")
        os.chown(out / name, uid, gid)
        (out / name).chmod(bits)
    code = f"""
        import json, os, sys
        sys.path.insert(0, {str(TESTS)!r})
        import conftest
        from pathlib import Path
        from rough_spectra.addon.support.atomic_files import publication
        from rough_spectra.core.errors import OutputError
        os.chmod(".", 0o777)
        os.setgroups([])
        os.setgid({NOBODY})
        os.setuid({NOBODY})
        found = {{}}
        for name in sorted(os.listdir(".")):
            try:
                with publication() as files:
                    files.write(Path(name), b"new")
                found[name] = oct(os.stat(name).st_mode & 0o777)
            except OutputError as error:
                found[name] = str(error)
        print(json.dumps(found))
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)],
        cwd=out,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    found = json.loads(done.stdout or done.stderr)
    assert "foreign.csv is write-protected" in found["foreign.csv"]
    assert (out / "foreign.csv").read_bytes() == b"old"
    assert found["group.csv"] == "0o664"
    assert (out / "group.csv").read_bytes() == b"new"
    # Its group cannot be kept, and the group that it gets instead was not allowed to read.
    assert found["own.csv"] == "0o600"


def test_a_private_blend_is_private_while_it_is_written(tmp_path, monkeypatch):
    path = tmp_path / "a.blend"
    blend_file.save(path)
    path.chmod(0o600)
    umask = os.umask(0o022)
    os.umask(umask)
    seen = []
    whole = blend_file.is_whole

    def look(part):
        seen.append(mode(part))
        return whole(part)

    monkeypatch.setattr(blend_file, "is_whole", look)
    blend_file.save(path)
    assert seen == [0o600]
    assert os.umask(umask) == umask


def test_a_linked_blend_keeps_its_older_versions_beside_the_real_one(tmp_path):
    bpy.context.preferences.filepaths.save_version = 1
    real, link = tmp_path / "deep" / "real.blend", tmp_path / "link.blend"
    blend_file.save(real)
    link.symlink_to(real)
    assert blend_file.save(link) == real
    assert {path.name for path in real.parent.iterdir()} == {"real.blend", "real.blend1"}
    assert set(tmp_path.iterdir()) == {real.parent, link}


def test_a_linked_library_file_is_read_where_it_lies(tmp_path):
    elsewhere = tmp_path / "elsewhere.json"
    add_to_library(tmp_path / "library" / "a.json")
    (tmp_path / "library" / "a.json").rename(elsewhere)
    (tmp_path / "library" / "a.json").symlink_to(elsewhere)
    library_files.rename("a/added", "other", tmp_path / "library")
    assert [sample.name for sample in readers.read(elsewhere)] == ["other"]
