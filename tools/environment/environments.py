# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Virtual environments inside the repository, ready or made anew.

An environment is ready when its stamp names the pins it was made from. The stamp is the last thing
written and the first thing removed, so an interrupted set-up, even a killed one, is noticed.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from . import interpreters, wheels
from .errors import SetupError

STAMP = "rough-spectra-ready.json"
TOOLS = "tools"
PIP = "pip==24.2"  # where an interpreter brings none along for its environments

Say = Callable[[str], None]


@dataclass(frozen=True)
class Environment:
    """One virtual environment: its name and the Python versions it may stand on, best first."""

    root: Path
    name: str
    versions: tuple[str, ...]
    about: str

    @property
    def folder(self) -> Path:
        """Where it is."""
        return self.root / ".venv" / self.name

    @property
    def requirements(self) -> Path:
        """The pins: exact versions of all that gets installed."""
        return self.root / "requirements" / f"{self.name}.txt"

    @property
    def python(self) -> Path:
        """Its interpreter."""
        inside = ("Scripts", "python.exe") if sys.platform == "win32" else ("bin", "python")
        return self.folder.joinpath(*inside)

    @property
    def has_wheels(self) -> bool:
        """Whether the wheels that ship belong in it."""
        return self.name != TOOLS

    def pins(self) -> str:
        """Return a hash of everything that decides what is installed."""
        text = self.requirements.read_text(encoding="utf-8")
        if self.has_wheels:
            text += wheels.pin(self.root).recipe
        return hashlib.sha256(text.encode("utf-8")).hexdigest()

    def is_ready(self) -> bool:
        """Whether it was made whole from the present pins and its interpreter still exists."""
        try:
            stamp = json.loads((self.folder / STAMP).read_text(encoding="utf-8"))
            pins, interpreter = stamp["pins"], Path(stamp["interpreter"])
        except (OSError, ValueError, KeyError, TypeError):
            return False
        return pins == self.pins() and interpreter.exists() and self.python.exists()


def interpreter_for(environment: Environment) -> interpreters.Interpreter | None:
    """Return the interpreter that the environment would be made with, or None."""
    for version in environment.versions:
        found = interpreters.find(version)
        if found is not None:
            return found
    return None


def prepare(environment: Environment, say: Say, install: Callable[..., None] | None = None) -> bool:
    """Make the environment unless it is ready; return False when no interpreter fits.

    Parameters
    ----------
    environment
        What to prepare.
    say
        Receives plain sentences about what is being done.
    install
        Fills the new environment; pip with the pinned requirements unless given.
    """
    if environment.is_ready():
        return True
    interpreter = interpreter_for(environment)
    if interpreter is None:
        return False
    with _alone(environment, say):
        if not environment.is_ready():
            _make(environment, interpreter, say, install or _install)
    return True


def _make(
    environment: Environment,
    interpreter: interpreters.Interpreter,
    say: Say,
    install: Callable[..., None],
) -> None:
    folder = environment.folder
    stamp = folder / STAMP
    if folder.exists():
        reason = "its pins or its Python changed" if stamp.exists() else "its set-up broke off"
        say(f"Making .venv/{environment.name} again: {reason}.")
        stamp.unlink(missing_ok=True)
        shutil.rmtree(folder)
    say(
        f"Setting up .venv/{environment.name} with Python {interpreter.version} "
        f"({interpreter.path}): {environment.about}."
    )
    _create(folder, interpreter, environment.python)
    install(environment, say)
    part = stamp.with_suffix(".part")
    content = {"pins": environment.pins(), "interpreter": str(interpreter.path)}
    part.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
    part.replace(stamp)
    say(f".venv/{environment.name} is ready.")


def _create(folder: Path, interpreter: interpreters.Interpreter, python: Path) -> None:
    """Create the empty environment with a pip of its own.

    Linux distributions ship Pythons without ensurepip. Those get pip from the interpreter's own.
    """
    base = [str(interpreter.path), "-m"]
    made = _child([*base, "venv", str(folder)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if made.returncode == 0:
        return
    shutil.rmtree(folder, ignore_errors=True)
    bare = _child([*base, "venv", "--without-pip", str(folder)], stdout=subprocess.PIPE)
    pip = [*base, "pip", "--python", str(python), "install", "--quiet", PIP]
    if bare.returncode != 0 or _child(pip).returncode != 0:
        raise SetupError(
            f"{interpreter.path} cannot make a virtual environment in {folder}: install its venv "
            "module (on Debian and Ubuntu the package python3-venv) and check that the disk has "
            "room."
        )


def _install(environment: Environment, say: Say) -> None:
    _pip(environment, "--requirement", str(environment.requirements))
    if environment.has_wheels:
        wheel = wheels.ensure(environment.root, environment.python)
        say(f"Installing {wheel.name}, the trimmed wheel that ships in the extension.")
        # Its metadata asks for numpy 2, but it also runs on the numpy 1.26 of Blender 4.5.
        _pip(environment, "--no-deps", str(wheel))


def _pip(environment: Environment, *arguments: str) -> None:
    command = [str(environment.python), "-m", "pip", "install", "--quiet", "--no-input"]
    command += ["--disable-pip-version-check", *arguments]
    if _child(command).returncode != 0:
        raise SetupError(
            f"pip could not fill .venv/{environment.name} (it says why above): check the "
            "connection to the package index and the room on the disk, then run the same command "
            "again."
        )


def _child(
    command: Sequence[str], stdout: int | None = None, stderr: int | None = None
) -> subprocess.CompletedProcess[bytes]:
    """Run a child that holds our lock too.

    Otherwise a pip that outlives a killed dev.py would go on writing into the folder that the next
    dev.py clears away.
    """
    return subprocess.run(command, stdout=stdout, stderr=stderr, close_fds=False, check=False)


@contextlib.contextmanager
def _alone(environment: Environment, say: Say) -> Iterator[None]:
    """Hold the environment's lock; the system lets it go once we and our children have ended."""
    environment.folder.parent.mkdir(parents=True, exist_ok=True)
    with open(environment.folder.with_name(f"{environment.name}.lock"), "a+b") as handle:
        os.set_inheritable(handle.fileno(), True)
        if not _lock(handle, wait=False):
            say(f"Another dev.py is setting up .venv/{environment.name}: waiting for it.")
            _lock(handle, wait=True)
        yield


if sys.platform == "win32":
    import msvcrt

    def _lock(handle: IO[bytes], wait: bool) -> bool:
        """Take the lock; msvcrt gives up waiting after ten seconds, so ask again."""
        handle.seek(0)
        while True:
            try:
                msvcrt.locking(handle.fileno(), msvcrt.LK_LOCK if wait else msvcrt.LK_NBLCK, 1)
            except OSError:
                if not wait:
                    return False
            else:
                return True

else:
    import fcntl

    def _lock(handle: IO[bytes], wait: bool) -> bool:
        """Take the lock; without waiting, return whether it was free."""
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
        except BlockingIOError:
            return False
        return True
