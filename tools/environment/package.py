# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension zip: what ships, put together by Blender's own builder."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from . import archives
from .errors import SetupError

MANIFEST = "blender_manifest.toml"
SHIPPED_FILES = ("__init__.py", MANIFEST, "LICENSE", "README.md")
CODE_FOLDERS = ("core", "addon")
SHIPPED_FOLDERS = (*CODE_FOLDERS, "presets", "farm")
NEVER_SHIPPED = shutil.ignore_patterns("__pycache__", "*.pyc", ".*", "*~", "*.orig", "*.rej")


def version(root: Path) -> str:
    """Return the extension's version from its manifest."""
    path = root / MANIFEST
    match = re.search(r'^version = "([^"]+)"', path.read_text(encoding="utf-8"), re.M)
    if match is None:
        raise SetupError(f'{path} has no line version = "...": add it.')
    return match[1]


def stage(
    root: Path,
    target: Path,
    files: Sequence[str] = SHIPPED_FILES,
    folders: Sequence[str] = SHIPPED_FOLDERS,
) -> None:
    """Copy what ships, without the wheels, into a fresh folder."""
    for name in (*files, *folders):
        if not (root / name).exists():
            raise SetupError(f"{root / name} is missing, but it ships: put it back from git.")
    if target.exists():
        shutil.rmtree(target)
    target.mkdir(parents=True)
    for name in files:
        shutil.copy2(root / name, target / name)
    for name in folders:
        shutil.copytree(root / name, target / name, ignore=NEVER_SHIPPED)


def build(
    root: Path,
    python: Path,
    wheels: Sequence[Path],
    staging: Path,
    output: Path,
    website: str = "",
) -> None:
    """Build and validate the zip.

    Blender's builder takes files in the order the disk returns them. Sorted again, with fixed
    dates, equal content gives equal bytes.

    Parameters
    ----------
    root
        Root of the repository.
    python
        Interpreter that has the bpy module.
    wheels
        The wheels that ship.
    staging
        Folder to gather the files in; made anew.
    output
        The zip to write.
    website
        Of the project, for the manifest, which the extensions platform wants; empty leaves it as
        it is.
    """
    stage(root, staging)
    if website:
        _name_website(staging / MANIFEST, website)
    (staging / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy2(wheel, staging / "wheels" / wheel.name)
    output.parent.mkdir(parents=True, exist_ok=True)
    built = staging.with_name(f"{staging.name}.zip")
    _builder(python, "build", "--source-dir", str(staging), "--output-filepath", str(built))
    files = archives.read(built)
    archives.write(output, {name: files[name] for name in sorted(files)})
    built.unlink()
    _builder(python, "validate", str(output))


def has_website(root: Path) -> bool:
    """Return whether the manifest itself names the project's website."""
    text = (root / MANIFEST).read_text(encoding="utf-8")
    return re.search(r"^website = ", text, re.M) is not None


def _name_website(manifest: Path, website: str) -> None:
    if re.fullmatch(r"https?://[^\s\"\\]+", website) is None:
        raise SetupError(f"{website!r} is no website: give an address such as https://example.org.")
    text = manifest.read_text(encoding="utf-8")
    text = re.sub(r"^website = .*\n", "", text, flags=re.M)
    line = f'website = "{website}"'
    text = re.sub(r"^maintainer = ", lambda found: f"{line}\n{found[0]}", text, count=1, flags=re.M)
    manifest.write_text(text, encoding="utf-8")


def builder(python: Path) -> Path:
    """Return Blender's extension builder inside the bpy module."""
    code = "import importlib.util as u; print(u.find_spec('bpy').submodule_search_locations[0])"
    where = subprocess.run([str(python), "-c", code], capture_output=True, text=True, check=False)
    if where.returncode != 0:
        raise SetupError(f"{python} has no bpy module: run 'python3 dev.py setup'.")
    pattern = "*/scripts/addons_core/bl_pkg/cli/blender_ext.py"
    found = sorted(Path(where.stdout.strip()).glob(pattern))
    if not found:
        raise SetupError(f"The bpy module of {python} carries no extension builder ({pattern}).")
    return found[0]


def _builder(python: Path, verb: str, *arguments: str) -> None:
    command = [str(python), str(builder(python)), verb, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        said = (done.stdout + done.stderr).strip()
        raise SetupError(f"Blender's extension builder refuses to {verb}: {said}")
