# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The libraries that ship: colour-science without its reports, tests and examples, and defusedxml.

The wheel of colour-science on the package index is 9 MB and unpacks to 88, of which 80 are coverage
reports. The repacked one carries a build tag, so that nobody takes it for the original of the same
version. defusedxml, 25 kB, ships as its authors made it.
"""

from __future__ import annotations

import base64
import csv
import hashlib
import io
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from . import archives
from .errors import SetupError

DROPPED_FOLDERS = frozenset({"htmlcov", "tests", "examples"})
BUILD_TAG = "1"
COLOUR, DEFUSEDXML = "colour-science", "defusedxml"
_PYTHONS = {COLOUR: "py3", DEFUSEDXML: "py2.py3"}


@dataclass(frozen=True)
class Pin:
    """A release on the package index."""

    name: str
    version: str
    sha256: str

    @property
    def upstream(self) -> str:
        """File name on the package index."""
        return f"{self._stem}-{_PYTHONS[self.name]}-none-any.whl"

    @property
    def trimmed(self) -> str:
        """File name of the repacked wheel."""
        return f"{self._stem}-{BUILD_TAG}-{_PYTHONS[self.name]}-none-any.whl"

    @property
    def recipe(self) -> str:
        """What the bytes of the trimmed wheel follow from."""
        return f"{self.sha256} build {BUILD_TAG} without {' '.join(sorted(DROPPED_FOLDERS))}"

    @property
    def _stem(self) -> str:
        return f"{self.name.replace('-', '_')}-{self.version}"


def pin(root: Path, name: str = COLOUR) -> Pin:
    """Read a pinned release from requirements/wheels.txt."""
    path = root / "requirements" / "wheels.txt"
    pattern = rf"^{name}==(?P<version>\S+)\s+--hash=sha256:(?P<sha256>[0-9a-f]{{64}})"
    match = re.search(pattern, path.read_text(encoding="utf-8"), re.M)
    if match is None:
        raise SetupError(
            f"{path} has no line '{name}==VERSION --hash=sha256:...': put it back from git."
        )
    return Pin(name, match["version"], match["sha256"])


def shipped(root: Path, python: Path) -> tuple[Path, ...]:
    """Return all wheels that ship, in wheels/, getting what is not there.

    Parameters
    ----------
    root
        Root of the repository.
    python
        Interpreter whose pip downloads what .cache/ does not have yet.
    """
    trimmed = ensure(root, python)
    wanted = pin(root, DEFUSEDXML)
    target = root / "wheels" / wanted.upstream
    if not (target.is_file() and _sha256(target) == wanted.sha256):
        shutil.copyfile(_download(root, python, wanted), target)
    return trimmed, target


def ensure(root: Path, python: Path) -> Path:
    """Return colour-science's trimmed wheel in wheels/, making it unless it is there and whole.

    Parameters
    ----------
    root
        Root of the repository.
    python
        Interpreter whose pip downloads the original where .cache/ does not have it yet.
    """
    wanted = pin(root)
    target = root / "wheels" / wanted.trimmed
    note = root / ".cache" / f"{wanted.trimmed}.made"
    if target.is_file() and note.is_file():
        made = f"{wanted.recipe}\n{_sha256(target)}\n"
        if note.read_text(encoding="utf-8") == made:
            return target
    source = _download(root, python, wanted)
    trim(source, target)
    note.write_text(f"{wanted.recipe}\n{_sha256(target)}\n", encoding="utf-8")
    return target


def trim(source: Path, target: Path) -> None:
    """Repack a wheel without its dropped folders, with a build tag and a RECORD that fits."""
    files = archives.read(source)
    kept = {name: files[name] for name in sorted(files) if not DROPPED_FOLDERS & set(_parts(name))}
    info = next(name.split("/")[0] for name in kept if name.endswith(".dist-info/WHEEL"))
    wheel, record = f"{info}/WHEEL", f"{info}/RECORD"
    kept[wheel] = _with_build_tag(kept[wheel])
    del kept[record]
    kept[record] = _record(kept, record)
    archives.write(target, kept)


def record_row(name: str, content: bytes) -> list[str]:
    """Return a file's line of RECORD, as the wheel format (PEP 376 and 427) spells hashes."""
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=")
    return [name, f"sha256={digest.decode('ascii')}", str(len(content))]


def _parts(name: str) -> tuple[str, ...]:
    return tuple(name.split("/")[:-1])


def _with_build_tag(wheel: bytes) -> bytes:
    """Add `Build:` after the last header, before the blank line that some writers leave."""
    text = wheel.decode("utf-8").rstrip("\n")
    return f"{text}\nBuild: {BUILD_TAG}\n".encode()


def _record(files: dict[str, bytes], record: str) -> bytes:
    rows = [record_row(name, content) for name, content in files.items()]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([*rows, [record, "", ""]])
    return text.getvalue().encode("utf-8")


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _download(root: Path, python: Path, wanted: Pin) -> Path:
    """Let pip fetch the original and check its hash; a file that already fits is kept."""
    folder = root / ".cache"
    source = folder / wanted.upstream
    if source.is_file() and _sha256(source) == wanted.sha256:
        return source
    folder.mkdir(exist_ok=True)
    command = [str(python), "-m", "pip", "download", "--quiet", "--disable-pip-version-check"]
    command += ["--no-deps", "--only-binary=:all:", "--require-hashes"]
    with tempfile.TemporaryDirectory(dir=folder) as fresh:
        # The line of this wheel alone: nothing else is fetched on the way.
        requirement = Path(fresh, "requirement.txt")
        requirement.write_text(
            f"{wanted.name}=={wanted.version} --hash=sha256:{wanted.sha256}\n", encoding="utf-8"
        )
        command += ["--dest", fresh, "--requirement", str(requirement)]
        if subprocess.run(command, check=False).returncode != 0:
            raise SetupError(
                f"{wanted.name} {wanted.version} could not be downloaded (pip says why above): "
                "check the connection to the package index and run the same command again."
            )
        Path(fresh, wanted.upstream).replace(source)
    return source
