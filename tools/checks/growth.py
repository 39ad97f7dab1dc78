# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Blow up each fixture in many ways and see how time and memory of its reader grow.

    .venv/bpy-5.2/bin/python -m tools.checks.growth [READER ...]

Prints the worst seconds and the worst peak of memory of each reader over files of 1 MB. The tests
do the same to fewer and smaller files (tests/input/test_growth.py).
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tools.checks import promises
from tools.run.run_command_line import ROOT, load_extension

FIXTURES = ROOT / "tests" / "fixtures"

SIZE = 10**6

_WEIGHED = 8  # of each reader, the slowest: tracing memory makes reading several times slower

_TOKEN = re.compile(rb"[^\s,;\"<>=]+")
_TAG = re.compile(rb"<([A-Za-z][\w:.]*)[^<>]*>")
_STUFF = [
    b"a",
    b"9",
    b",",
    b";",
    b"\t",
    b" ",
    b"\n",
    b'"',
    b"\0",
    b"\xff",
    b"0.5 ",
    b"0,5\n",
    b"#\n",
]
_STUFF += [b"[", b'{"a":', b"(", b"<a>", b"<a/>", b"<!-- -->", b"&amp;", b"x='' ", b"A B\n", b"-"]


def by_reader(readers: Any) -> dict[str, list[Path]]:
    """Return all fixtures but the fuzzer's, and one preset, by the reader that takes them."""
    found: dict[str, list[Path]] = {promises.short(reader): [] for reader in readers.readers()}
    files = [path for path in sorted(FIXTURES.rglob("*")) if path.is_file()]
    files = [
        path for path in files if path.suffix != ".md" and FIXTURES / "fuzz" not in path.parents
    ]
    for path in [*files, *sorted((ROOT / "presets" / "colorchecker").glob("*.json"))[:1]]:
        data = path.read_bytes()
        document = readers.Document(path, data)
        for reader in readers.readers():
            if data and reader.sniff(document):
                found[promises.short(reader)].append(path)
                break
    return found


def grown(data: bytes, size: int = SIZE, places: int = 1000) -> Iterator[tuple[str, bytes]]:
    """Yield names and files of about `size` bytes that are made of one small file.

    Parameters
    ----------
    data
        The small file.
    size
        Bytes wanted.
    places
        How many lines, words and tags of the file are repeated, spread evenly over it.
    """
    yield "the whole", data * (size // len(data))
    yield "one line", data.replace(b"\r", b"\n").replace(b"\n", b" ") * (size // len(data))
    wide = _repeated(data, size, 0, len(data))
    if b"\n" in data:  # each line as many times: columns grow, not rows
        times = size // len(data)
        wide = b"\n".join(line * times for line in data.split(b"\n"))
    yield "each line", wide
    lines = [(match.start(), match.end()) for match in re.finditer(rb"[^\n]*\n", data)]
    for start, end in _spread(lines, places):
        yield f"the line {data[start:end][:40]!r}", _repeated(data, size, start, end)
    tokens = [match.span() for match in _TOKEN.finditer(data)]
    for start, end in _spread(tokens, places):
        name = f"the word {data[start:end][:40]!r}"
        yield name, _repeated(data, size, start, end)
        yield f"{name} with what follows", _repeated(data, size, start, end + 1)
    for start, end in _spread(_elements(data), places):
        yield f"the element {data[start:end][:40]!r}", _repeated(data, size, start, end)
    for match in _spread(list(_TAG.finditer(data)), places):
        yield f"the tag {match[0][:40]!r}, nested", _repeated(data, size, *match.span())
    middle = len(data) // 2
    for at in (0, middle, data.find(b"\n", middle) + 1, len(data)):
        for stuff in _STUFF:
            name = f"{stuff!r} at {at}"
            yield name, data[:at] + stuff * (size // len(stuff)) + data[at:]
    for width in (1, 2, 4, 8, 16, 64):
        for at in _spread(list(range(0, len(data) - width, width)), places // 8 + 1):
            yield f"{width} bytes at {at}", _repeated(data, size, at, at + width)


def _repeated(data: bytes, size: int, start: int, end: int) -> bytes:
    piece = data[start:end]
    return data[:start] + piece * (size // max(len(piece), 1)) + data[end:]


def _spread(found: list[Any], places: int) -> list[Any]:
    """Return at most so many, evenly spread, the first and the last among them."""
    if len(found) <= places:
        return found
    last = len(found) - 1
    return [found[round(i * last / max(places - 1, 1))] for i in range(places)]


def _elements(data: bytes) -> list[tuple[int, int]]:
    """Return where the elements of XML begin and end, one of each name."""
    found: dict[bytes, tuple[int, int]] = {}
    for match in _TAG.finditer(data):
        if match[0].endswith(b"/>"):
            found.setdefault(match[1], match.span())
            continue
        close = b"</" + match[1] + b">"
        end = data.find(close, match.end())
        if end >= 0:
            found.setdefault(match[1], (match.start(), end + len(close)))
    return list(found.values())


def main(arguments: list[str]) -> int:
    """Print the worst of each reader and how it came about; the status says if a promise broke."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--size", type=int, default=SIZE, help="bytes of each file")
    parser.add_argument("--fixtures", type=int, default=2, help="of each reader")
    parser.add_argument("readers", nargs="*", metavar="READER", help="of samples/readers/formats")
    options = parser.parse_args(arguments)
    load_extension()
    from rough_spectra.addon.samples import readers

    broken = False
    for name, paths in by_reader(readers).items():
        if not options.readers or name in options.readers:
            broken |= _measure(readers, name, paths[: options.fixtures], options.size)
    return int(broken)


def _measure(readers: Any, name: str, paths: list[Path], size: int) -> bool:
    """Print one reader's worst; returns whether it broke a promise."""
    took = []
    broken = []
    for path in paths:
        for way, data in grown(path.read_bytes(), size, places=2):
            seconds = promises.outcome(readers, path, data).seconds / len(data)
            took.append((seconds, f"{path.name}: {way}", path, data))
            took = sorted(took, key=lambda one: -one[0])[:_WEIGHED]
    again = [promises.outcome(readers, path, data) for _, _, path, data in took]
    slowest = max(
        (min(one[0], found.seconds / len(one[3])), one[1])
        for one, found in zip(took, again, strict=True)
    )
    heaviest = (0.0, "")
    for _, way, path, data in took:
        found = promises.weighed(readers, path, data)
        heaviest = max(heaviest, ((found.peak or 0) / len(data), way))
        broken += [f"{way}: {fault}" for fault in promises.faults(name, path, len(data), found)]
    print(f"{name}: {1e6 * slowest[0]:.2f} s/MB ({slowest[1]}), ", end="")
    print(f"{heaviest[0]:.1f} times its size ({heaviest[1]})", flush=True)
    for fault in broken:
        print(f"    {fault[:300]}", flush=True)
    return bool(broken)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
