# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A .blend that did not fit on the disk is not taken for whole, on a real small disk."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import bpy
import pytest
from rough_spectra.addon.blender import blend_file

TESTS = Path(__file__).resolve().parents[1]
SIZE = 1 << 20

ON_A_FULL_DISK = f"""
import json, os, sys
sys.path.insert(0, {str(TESTS)!r})
import conftest
import bpy
from pathlib import Path
from rough_spectra.addon.blender import blend_file
from rough_spectra.core.errors import OutputError

folder = Path(sys.argv[1])
target, ballast = folder / "a.blend", folder / "ballast"
found = []
for compressed in (False, True):
    source = Path(sys.argv[2]) / "source.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(source), compress=compressed, check_existing=False)
    size = source.stat().st_size
    for share in (0.0, 0.3, 0.7, 0.95):
        old = source.read_bytes()[:5000]  # of the same kind
        target.write_bytes(old)
        disk = os.statvfs(folder)
        room = int(share * size)
        ballast.write_bytes(bytes(disk.f_bavail * disk.f_frsize - room))
        try:
            blend_file.save(target)
            said = "saved"
        except OutputError as error:
            said = str(error)
        names = sorted(path.name for path in folder.iterdir())
        found.append([compressed, said, target.read_bytes() == old, names])
        ballast.unlink()
    blend_file.save(target)
    # Blender stores addresses, which compress a little differently each time.
    found.append([compressed, "room", abs(target.stat().st_size - size) < 0.01 * size, []])
    for path in list(folder.iterdir()):
        path.unlink()
print(json.dumps(found))
"""


def has_small_disks():
    """Whether a child may mount a file system of its own, which ends with it."""
    if sys.platform != "linux" or shutil.which("unshare") is None:
        return False
    words = ["unshare", "--mount", "mount", "-t", "tmpfs", "none", "/mnt"]
    return subprocess.run(words, capture_output=True, check=False).returncode == 0


@pytest.mark.skipif(not has_small_disks(), reason="may not mount a small file system")
def test_a_full_disk_is_told_and_leaves_the_old_file(tmp_path):
    disk = tmp_path / "disk"
    disk.mkdir()
    child = [disk, sys.executable, "-c", ON_A_FULL_DISK, disk, tmp_path]
    mounted = f'mount -t tmpfs -o size={SIZE} none "$1" && shift && exec "$@"'
    done = subprocess.run(
        ["unshare", "--mount", "sh", "-c", mounted, "sh", *child],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
    )
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    assert len(found) == 10
    for compressed, said, is_as_wanted, names in found:
        assert is_as_wanted, (compressed, said)
        if said != "room":
            assert names == ["a.blend", "ballast"]
            assert "a.blend cannot be saved (" in said
            # Blender's own word for it is "Success", or of a file that was not found.
            assert "disk" in said.partition(");")[0], said


@pytest.mark.parametrize("compressed", [False, True])
def test_no_part_of_a_blend_is_whole(compressed, tmp_path):
    bpy.data.meshes.new("large").from_pydata([(i, 0, 0) for i in range(200_000)], [], [])
    bpy.data.meshes["large"].use_fake_user = True
    path = tmp_path / "a.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=compressed)
    whole = path.read_bytes()
    assert whole.startswith(b"BLENDER") != compressed
    assert blend_file.is_whole(path)
    for length in (
        0,
        1,
        3,
        7,
        8,
        9,
        20,
        1000,
        len(whole) // 2,
        *range(len(whole) - 80, len(whole)),
    ):
        path.write_bytes(whole[:length])
        assert not blend_file.is_whole(path), length
    if compressed:
        # Somebody freed the disk while it was written: the end is there, and a piece is not.
        path.write_bytes(whole[: len(whole) // 3] + whole[len(whole) // 2 :])
        assert not blend_file.is_whole(path)


@pytest.mark.parametrize("compressed", [False, True])
def test_a_blend_stays_compressed_or_not(compressed, tmp_path):
    path = tmp_path / "a.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=compressed)
    for target in (path, tmp_path / "b.blend"):
        blend_file.save(target)
        assert target.read_bytes().startswith(b"BLENDER") != compressed
