# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What every reader promises for any bytes at all, and how it is checked: docs/safety.md.

The fuzzer and the tests ask the same questions here. Time is that of the processor, which another
job on the machine does not lengthen; memory is what Python and numpy allocate beyond the file.
"""

from __future__ import annotations

import gc
import sys
import time
import tracemalloc
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

SECONDS = 1e-6
"""Of the processor, a byte of the file."""
SECONDS_AT_LEAST = 0.25
"""For the smallest file: imports, and messages."""
SECONDS_AT_LEAST_OF = {"spectral_exr": 1.0}
"""One color packs a thousandfold, and up to 48 MB of it are unpacked."""
MEMORY = 20
"""Bytes, a byte of the file."""
MEMORY_AT_LEAST = 2**20
"""What imports, tables and messages take, whatever the file."""
MEMORY_A_SAMPLE = 1024
"""What comes out stays: names and arrays of a sample, even if its line has few bytes."""

_SENTENCES_OF_FILES = ("preset", "library")
"""Formats in which notes are the user's own text."""


class Outcome(NamedTuple):
    """What became of a file: samples or a message, and what it took."""

    samples: list[Any]
    message: str
    seconds: float
    peak: int | None = None


def short(reader: Any) -> str:
    """Return the name of a reader's module."""
    return str(reader.__name__).rpartition(".")[2]


def outcome(readers: ModuleType, path: Path, data: bytes, wanted: str = "") -> Outcome:
    """Do what `readers.read` does once the bytes are there.

    Parameters
    ----------
    readers
        The package ``addon.samples.readers``.
    path
        What messages name.
    data
        The file.
    wanted
        The one reader to ask after all have sniffed; without it the first that takes the file.
    """
    error_type = readers.InputError
    samples, message = [], ""
    # What all tests before left behind is looked through at any moment, and takes half a second.
    gc.disable()
    start = time.process_time()
    document = readers.Document(path, data)
    try:
        for reader in readers.readers():
            if reader.sniff(document) and wanted in ("", short(reader)):
                samples = reader.read(document)
                break
    except error_type as error:
        message = str(error)
    finally:
        seconds = time.process_time() - start
        gc.enable()
    return Outcome(samples, message, seconds)


def weighed(readers: ModuleType, path: Path, data: bytes, wanted: str = "") -> Outcome:
    """Do the same and measure its peak of memory; reading then takes several times longer."""
    tracemalloc.start()
    try:
        found = outcome(readers, path, data, wanted)
        return found._replace(peak=tracemalloc.get_traced_memory()[1])
    finally:
        tracemalloc.stop()


def faults(name: str, path: Path, size: int, found: Outcome) -> Iterator[str]:
    """Yield each promise that an outcome breaks.

    Parameters
    ----------
    name
        The reader's module.
    path, size
        The file's path and its bytes.
    found
        What became of it; time counts only where memory was not measured.
    """
    if found.message:
        yield from _faults_of_message(path, found.message)
    for sample in found.samples:
        yield from _faults_of_sample(name, sample)
    if found.peak is not None:
        if found.peak > memory_allowed(size, len(found.samples)):
            yield f"memory: {found.peak} bytes for a file of {size}"
    elif found.seconds > seconds_allowed(name, size):
        yield f"time: {found.seconds:.2f} s for {size} bytes"


def seconds_allowed(name: str, size: int) -> float:
    """Return how long a file of so many bytes may take."""
    return max(SECONDS * size, SECONDS_AT_LEAST_OF.get(name, SECONDS_AT_LEAST))


def memory_allowed(size: int, samples: int) -> int:
    """Return how many bytes of memory a file of so many bytes and samples may take."""
    return MEMORY * size + MEMORY_AT_LEAST + MEMORY_A_SAMPLE * samples


def _faults_of_message(path: Path, message: str) -> Iterator[str]:
    # A file that belongs to this one is named itself; it stands in the same folder or above.
    if not message.startswith((str(path), f"{path.parent}/", f"{path.parent.parent}/")):
        yield f"message: it does not begin with the file's name: {message!r}"
    if not message.isprintable():
        yield f"message: it is not one printable line: {message!r}"
    if not message.endswith("."):
        yield f"message: it is no sentence: {message!r}"


def _faults_of_sample(name: str, sample: Any) -> Iterator[str]:
    nm, values = sample.wavelengths, sample.values
    if not (nm.size == values.size >= 2 and (nm[1:] > nm[:-1]).all()):
        yield f"sample: its wavelengths do not increase: {nm}"
    if not abs(values).max() < float("inf"):
        yield "sample: a value is not finite"
    if not sample.name:
        yield "sample: it has no name"
    if name in _SENTENCES_OF_FILES:
        return
    for sentence in (*sample.notes, *sample.altered):
        kinds = set(map(unicodedata.category, sentence))  # a no-break space of the file may stay
        if kinds & {"Cc", "Zl", "Zp"} or not sentence.endswith("."):
            yield f"sample: this is no sentence: {sentence!r}"


class Strayed(BaseException):
    """A reader touched something else than its file; no reader's `except` may stop it."""


@contextmanager
def confined(folder: Path) -> Iterator[None]:
    """Let nothing be opened but files of a folder and of the one above; no network, no processes.

    The latter is where a library keeps what its chapters share.

    Python's own audit events tell: they also see what C code of the standard library does. Modules
    that are imported on the way may be read, and leave no bytecode.
    """
    global _allowed
    if not _hooked:
        sys.addaudithook(_audit)
        _hooked.append(True)
    _allowed = folder.resolve()
    writes_bytecode, sys.dont_write_bytecode = not sys.dont_write_bytecode, True
    try:
        yield
    finally:
        sys.dont_write_bytecode = not writes_bytecode
        _allowed = None


_hooked: list[bool] = []
_allowed: Path | None = None
_REFUSED = ("socket.", "subprocess.", "os.", "shutil.", "ctypes.", "urllib.", "pickle.")
_LOOKS = ("os.listdir", "os.scandir", "os.putenv", "os.fspath")
_CODE = (".py", ".pyc", ".so", ".pyd")


def _audit(event: str, arguments: tuple[Any, ...]) -> None:
    if _allowed is None:
        return
    if event == "open":
        path, mode = arguments[0], arguments[1] or "r"
        if isinstance(path, int) or str(path).endswith(_CODE):
            return
        file = Path(str(path)).resolve()
        if file.parent not in (_allowed, _allowed.parent) or set(mode) & set("wxa+"):
            raise Strayed(f"opened {path!r} with {mode!r}")
    elif event in ("os.listdir", "os.scandir"):
        # Imports list the folders of sys.path, and finding the readers lists theirs.
        asks = str(sys._getframe(1).f_code.co_filename)
        if "importlib" not in asks and "pkgutil" not in asks:
            where = Path(str(arguments[0] or ".")).resolve()
            if where not in (_allowed, _allowed.parent):
                raise Strayed(f"listed {where}")
    elif event.startswith(_REFUSED) and event not in _LOOKS:
        raise Strayed(f"{event} {arguments!r}")
