# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fuzz the readers, guided by coverage: no crash, no hang, no memory beyond a multiple of the file.

    python3 dev.py fuzz [--minutes 10] [--jobs 2] [READER ...]

Each reader runs in a process of its own with the test fixtures as seeds. An input that breaks a
promise is written to build/fuzz/<reader>/; once mended, it belongs into tests/fixtures/fuzz/.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
import tracemalloc
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from run_command_line import ROOT, load_extension

FIXTURES = ROOT / "tests" / "fixtures"
OUT = ROOT / "build" / "fuzz"

SECONDS = 1.0
"""What 1 MB may take; inputs are smaller, and the machine may be busy with another job."""
MEMORY = 20
"""Bytes a byte of the file."""
MEMORY_AT_REST = 2**20
"""What imports, tables and messages take, whatever the file."""
LONGEST = 64 * 1024
_EACH = 16  # tracemalloc makes reading several times slower, so one input in so many is weighed


def main(arguments: Sequence[str]) -> int:
    """Fuzz the readers named, or all of them, and say what was found."""
    parser = argparse.ArgumentParser(prog="dev.py fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=10.0, help="in all, over all readers")
    parser.add_argument("--jobs", type=int, default=2, help="readers fuzzed at once")
    parser.add_argument("readers", nargs="*", metavar="READER", help="modules of addon/readers")
    options = parser.parse_args(arguments)
    readers = _load()
    names = [module.__name__.rpartition(".")[2] for module in readers.readers()]
    wanted = options.readers or names
    unknown = [name for name in wanted if name not in names]
    if unknown:
        parser.error(f"there is no reader {unknown[0]!r}; choose from {', '.join(names)}")
    each = max(10, round(options.minutes * 60 * options.jobs / len(wanted)))
    print(f"{len(wanted)} readers, {each} s each, {options.jobs} at once", flush=True)
    seeds = _seeds(readers)
    failed = []
    waiting, running = list(wanted), {}
    while waiting or running:
        while waiting and len(running) < options.jobs:
            name = waiting.pop(0)
            running[name] = _start(name, seeds.get(name, []), each)
        time.sleep(0.2)
        for name in [name for name, process in running.items() if process.poll() is not None]:
            if _tell(name, running.pop(name).returncode):
                failed.append(name)
    print(f"broken: {', '.join(failed)}" if failed else "no promise was broken", flush=True)
    return int(bool(failed))


def _load() -> Any:
    load_extension()
    from rough_spectra.addon import readers

    return readers


def _seeds(readers: Any) -> dict[str, list[Path]]:
    """Sort the fixtures and presets by the reader that takes them."""
    found: dict[str, list[Path]] = {}
    files = [path for path in FIXTURES.rglob("*") if path.is_file()]
    for path in [*files, *sorted((ROOT / "presets").glob("*/*.json"))[:3]]:
        data = path.read_bytes()
        if not data or len(data) > LONGEST:
            continue
        document = readers.Document(path, data)
        for reader in readers.readers():
            if reader.sniff(document):
                found.setdefault(reader.__name__.rpartition(".")[2], []).append(path)
                break
    return found


def _start(name: str, seeds: list[Path], seconds: int) -> subprocess.Popen[bytes]:
    folder = OUT / name
    corpus = folder / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    for i, seed in enumerate(seeds):
        (corpus / f"seed-{i}-{seed.name}").write_bytes(seed.read_bytes())
    with (folder / "log").open("wb") as log:
        return subprocess.Popen(
            [
                *(sys.executable, __file__, "--child", name, str(corpus)),
                *(f"-max_total_time={seconds}", f"-max_len={LONGEST}", "-timeout=10"),
                *("-rss_limit_mb=1024", f"-artifact_prefix={folder}/found-"),
            ],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
        )


def _tell(name: str, status: int) -> bool:
    """Print the end of one reader's run; returns whether it broke a promise."""
    folder = OUT / name
    lines = (folder / "log").read_text(encoding="utf-8", errors="replace").splitlines()
    done = [line for line in lines if line.startswith("Done ")]
    inputs = done[-1].split()[1] if done else "?"
    reached = len(list((folder / "corpus").iterdir()))
    if status == 0:
        print(f"{name}: {inputs} inputs, {reached} kept for what they reached", flush=True)
        return False
    shown = [line for line in lines if "Error" in line or "ERROR" in line or "Exception" in line]
    print(f"{name}: broken ({'; '.join(shown[-2:])}); see {folder}", flush=True)
    return True


def child(name: str, arguments: list[str]) -> None:
    """Run libFuzzer over one reader."""
    import atheris

    with atheris.instrument_imports(include=["rough_spectra"]):
        readers = _load()
        modules = {m.__name__.rpartition(".")[2]: m for m in readers.readers()}
        from rough_spectra.core.errors import InputError
    reader = modules[name]
    count = 0

    def once(data: bytes) -> None:
        nonlocal count
        count += 1
        weighed = count % _EACH == 0
        if weighed:
            tracemalloc.start()
        start = time.perf_counter()
        document = readers.Document(Path("fuzzed"), data)
        try:
            # Nobody's sniffer may raise, whatever the file.
            if [m for m in modules.values() if m.sniff(document) and m is reader]:
                for sample in reader.read(document):
                    assert sample.wavelengths.size == sample.values.size
        except InputError as error:
            if not str(error).startswith("fuzzed"):
                raise AssertionError(f"the message names no file: {error}") from error
        seconds = time.perf_counter() - start
        if weighed:
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            allowed = MEMORY * len(data) + MEMORY_AT_REST
            assert peak <= allowed, f"MemoryError: {peak} bytes for a file of {len(data)}"
        else:
            assert seconds < SECONDS, f"TimeoutError: {seconds:.1f} s for {len(data)} bytes"

    atheris.Setup([sys.argv[0], *arguments], once)
    atheris.Fuzz()


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        child(sys.argv[2], sys.argv[3:])
    else:
        sys.exit(main(sys.argv[1:]))
