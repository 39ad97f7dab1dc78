# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Find a Python of a given version that really runs.

A name on PATH proves nothing: version managers put shims there that fail unless their version is
selected. So every candidate is run once and asked who it is before it is trusted.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

PROBE = """
import json, platform, sys, sysconfig
print(json.dumps({
    "path": getattr(sys, "_base_executable", None) or sys.executable,
    "version": platform.python_version(),
    "plain": platform.python_implementation() == "CPython"
             and not sysconfig.get_config_var("Py_GIL_DISABLED"),
}))
"""
PROBE_SECONDS = 20


@dataclass(frozen=True)
class Interpreter:
    """A Python that has been run: where it is and its full version."""

    path: Path
    version: str


def probe(candidate: Path) -> Interpreter | None:
    """Run a candidate and return what it says it is, or None when it is no usable CPython.

    A virtual environment answers with the interpreter it was made from, so that ours never stand
    on one that may be deleted. Free-threaded builds are refused: bpy has no wheels for them.
    """
    try:
        answer = subprocess.run(
            [str(candidate), "-I", "-c", PROBE],
            capture_output=True,
            text=True,
            check=True,
            timeout=PROBE_SECONDS,
            stdin=subprocess.DEVNULL,
        )
        said = json.loads(answer.stdout)
    except (OSError, subprocess.SubprocessError, ValueError):
        return None
    if not said["plain"]:
        return None
    return Interpreter(Path(said["path"]), said["version"])


def candidates(version: str, environ: Mapping[str, str], home: Path) -> Iterator[Path]:
    """Yield the places where a Python of this version may be, the likeliest first."""
    names = [f"python{version}", "python3", "python"]
    if sys.platform == "win32":
        names = ["python.exe", f"python{version}.exe"]
    if sys.version_info[:2] == tuple(map(int, version.split("."))):
        yield Path(sys.executable)
    search = [Path(entry) for entry in environ.get("PATH", "").split(os.pathsep) if entry]
    for name in names:
        yield from (folder / name for folder in search)
    for folder in _managed(version, environ, home):
        yield from (folder / name for name in names)


def _managed(version: str, environ: Mapping[str, str], home: Path) -> Iterator[Path]:
    """Yield the folders in which pyenv, uv and the installers keep their interpreters."""
    pyenv = Path(environ.get("PYENV_ROOT") or home / ".pyenv")
    for versions in (pyenv / "versions", pyenv / "pyenv-win" / "versions"):
        for installed in _newest_first(versions, f"{version}.*"):
            yield from (installed / "bin", installed)
    data = Path(environ.get("XDG_DATA_HOME") or home / ".local" / "share")
    uv_homes = [data / "uv" / "python"]
    if environ.get("UV_PYTHON_INSTALL_DIR"):
        uv_homes.insert(0, Path(environ["UV_PYTHON_INSTALL_DIR"]))
    if environ.get("APPDATA"):
        uv_homes.append(Path(environ["APPDATA"]) / "uv" / "python")
    for uv_home in uv_homes:
        for installed in _newest_first(uv_home, f"cpython-{version}.*"):
            yield from (installed / "bin", installed)
    if environ.get("LOCALAPPDATA"):
        programs = Path(environ["LOCALAPPDATA"]) / "Programs" / "Python"
        yield programs / f"Python{version.replace('.', '')}"
    yield Path("/Library/Frameworks/Python.framework/Versions") / version / "bin"
    yield from (Path("/opt/homebrew/bin"), Path("/usr/local/bin"), Path("/usr/bin"))


def _newest_first(folder: Path, pattern: str) -> list[Path]:
    """Sort by the numbers in the name: 3.13.10 comes before 3.13.9."""

    def numbers(path: Path) -> list[int]:
        words = "".join(c if c.isdigit() else " " for c in path.name).split()
        return [int(word) for word in words]

    return sorted(folder.glob(pattern), key=numbers, reverse=True)


def find(
    version: str, environ: Mapping[str, str] | None = None, home: Path | None = None
) -> Interpreter | None:
    """Return the first working interpreter of a version such as "3.13", or None."""
    environ = os.environ if environ is None else environ
    home = Path.home() if home is None else home
    tried: set[Path] = set()
    for candidate in candidates(version, environ, home):
        if candidate in tried or not candidate.is_file():
            continue
        tried.add(candidate)
        found = probe(candidate)
        if found is not None and found.version.startswith(f"{version}."):
            return found
    return None
