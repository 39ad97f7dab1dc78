# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fuzz the readers, guided by coverage, until a promise of docs/safety.md breaks.

    python3 dev.py fuzz [--minutes 10] [--jobs 2] [READER ...]

Each reader runs in a process of its own with the test fixtures as seeds. The smallest input of each
kind that breaks a promise is written to build/fuzz/<reader>/found/ with the reason beside it, and
the run goes on; once mended, it belongs into tests/fixtures/fuzz/<reader>/. What reached new code
is kept for the next run. At the end, each reader's worst time and memory over all of it are told.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import subprocess
import sys
import time
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from tools.checks import promises
from tools.run.run_command_line import ROOT, load_extension

FIXTURES = ROOT / "tests" / "fixtures"
OUT = ROOT / "build" / "fuzz"
ITSELF = (sys.executable, "-m", "tools.checks.fuzz")

LONGEST = 64 * 1024
_EACH = 16  # tracemalloc makes reading several times slower, so one input in so many is weighed
# Files that a reader looks for in the folder of its own, and how they have to be called.
_BESIDE = {"usgs": ("usgs/*Wavelengths*", ""), "envi_library": ("envi_library/*.sli", "fuzzed.sli")}
_MOST_WORDS = 2000  # of a dictionary


def main(arguments: Sequence[str]) -> int:
    """Fuzz the readers named, or all of them, and say what was found."""
    parser = argparse.ArgumentParser(prog="dev.py fuzz", description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=10.0, help="in all, over all readers")
    parser.add_argument("--jobs", type=int, default=2, help="readers fuzzed at once")
    parser.add_argument("readers", nargs="*", metavar="READER", help="of samples/readers/formats")
    options = parser.parse_args(arguments)
    readers = _load()
    names = [promises.short(module) for module in readers.readers()]
    wanted = options.readers or names
    unknown = [name for name in wanted if name not in names]
    if unknown:
        parser.error(f"there is no reader {unknown[0]!r}; choose from {', '.join(names)}")
    each = max(10, round(options.minutes * 60 * options.jobs / len(wanted)))
    print(f"{len(wanted)} readers, {each} s each, {options.jobs} at once", flush=True)
    seeds = _seeds(readers)
    failed = []
    waiting = list(wanted)
    running: dict[str, subprocess.Popen[bytes]] = {}
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
    from rough_spectra.addon.samples import readers

    readers.readers()  # lists their folder, which no reader may do
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
                found.setdefault(promises.short(reader), []).append(path)
                break
    return found


def _start(name: str, seeds: list[Path], seconds: int) -> subprocess.Popen[bytes]:
    folder = OUT / name
    corpus = folder / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    (folder / "found").mkdir(exist_ok=True)
    for i, seed in enumerate(seeds):
        (corpus / f"seed-{i}-{seed.name}").write_bytes(seed.read_bytes())
    pattern, called = _BESIDE.get(name, ("", ""))
    for beside in FIXTURES.glob(pattern) if pattern else ():
        (folder / (called or beside.name)).write_bytes(beside.read_bytes())
    words = _dictionary([seed.read_bytes() for seed in seeds])
    (folder / "words").write_text(words, encoding="ascii")
    with (folder / "log").open("wb") as log:
        return subprocess.Popen(
            [
                *(*ITSELF, "--child", name, str(corpus), "-dict=words"),
                *(f"-max_total_time={seconds}", f"-max_len={LONGEST}", "-timeout=60"),
                *("-rss_limit_mb=1024", f"-artifact_prefix={folder}/found/"),
            ],
            cwd=ROOT,
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=subprocess.STDOUT,
        )


def _dictionary(files: list[bytes]) -> str:
    """Return the words and tags of files, as libFuzzer splices them into others."""
    words = {word for data in files for word in re.findall(rb"[ -~]{2,}?(?=[\s,;<>\"=:]|$)", data)}
    kept = sorted((word for word in words if len(word) <= 64), key=lambda word: (len(word), word))
    lines = ("".join(f"\\x{byte:02x}" for byte in word) for word in kept[:_MOST_WORDS])
    return "".join(f'"{line}"\n' for line in lines)


def _tell(name: str, status: int) -> bool:
    """Print the end of one reader's run; returns whether it broke a promise."""
    folder = OUT / name
    lines = (folder / "log").read_text(encoding="utf-8", errors="replace").splitlines()
    done = [line for line in lines if line.startswith("Done ")]
    inputs = done[-1].split()[1] if done else "?"
    command = [*ITSELF, "--weigh", name]
    weighed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    told = weighed.stdout.strip() or weighed.stderr.strip().splitlines()[-1]
    print(f"{name}: {inputs} inputs; {told}", flush=True)
    found = [path for path in sorted((folder / "found").iterdir()) if path.suffix != ".txt"]
    for path in found:
        reason = path.with_name(path.name + ".txt")
        last = reason.read_text("utf-8").splitlines()[-1] if reason.exists() else "see the log"
        print(f"    {path}: {last}", flush=True)
    return bool(found) or status != 0 or weighed.returncode != 0


def child(name: str, arguments: list[str]) -> None:
    """Run libFuzzer over one reader."""
    import atheris

    with atheris.instrument_imports(include=["rough_spectra"]):
        readers = _load()
    path = Path.cwd() / "fuzzed"
    smallest: dict[str, int] = {}
    count = 0

    def once(data: bytes) -> None:
        nonlocal count
        count += 1
        reason = _broken(readers, name, path, data, weigh=count % _EACH == 0)
        if reason:
            _keep(smallest, data, reason)

    atheris.Setup([sys.argv[0], *arguments], once)
    atheris.Fuzz()


def _keep(smallest: dict[str, int], data: bytes, reason: list[str]) -> None:
    """Write the input if it is the smallest of its kind."""
    # "message: what is wrong: ...", or "ErrorType in file, line 5: ...".
    parts = reason[0].split(": ")[: 2 if reason[0][0].islower() else 1]
    kind = hashlib.sha256(re.sub(r" [\d.]+ ", " ", ": ".join(parts)).encode()).hexdigest()[:12]
    if len(data) < smallest.get(kind, LONGEST + 1):
        smallest[kind] = len(data)
        Path("found", kind).write_bytes(data)
        Path("found", f"{kind}.txt").write_text("\n".join(reversed(reason)), "utf-8")


def _broken(readers: Any, name: str, path: Path, data: bytes, *, weigh: bool) -> list[str]:
    """Return what broke a promise and where from, or nothing."""
    look = promises.weighed if weigh else promises.outcome
    try:
        with promises.confined(path.parent):
            for _ in range(3):  # the first may have imported something, or collected garbage
                found = look(readers, path, data, name)
                faults = list(promises.faults(name, path, len(data), found))
                if not faults:
                    return []
    except (Exception, promises.Strayed) as error:
        frame = traceback.extract_tb(error.__traceback__)[-1]
        reason = f"{type(error).__name__} in {frame.filename}, line {frame.lineno}: {error}"
        return [reason, traceback.format_exc()]
    return faults


def weigh(name: str) -> None:
    """Print the worst time and memory over all inputs that are kept, without instruments."""
    readers = _load()
    path = Path.cwd() / "fuzzed"
    slowest = heaviest = 0.0
    smallest: dict[str, int] = {}
    broken, kept = 0, sorted(Path("corpus").iterdir())
    for file in kept:
        data = file.read_bytes()
        reason = _broken(readers, name, path, data, weigh=False)
        reason = reason or _broken(readers, name, path, data, weigh=True)
        if reason:
            broken += 1
            _keep(smallest, data, reason)
            continue
        fast = min(promises.outcome(readers, path, data, name).seconds for _ in range(2))
        full = promises.weighed(readers, path, data, name)
        allowed = promises.memory_allowed(len(data), len(full.samples))
        slowest = max(slowest, fast)
        heaviest = max(heaviest, (full.peak or 0) / allowed)
    print(
        f"{len(kept)} kept for what they reached; of these the slowest takes {1000 * slowest:.1f} "
        f"ms, the heaviest {100 * heaviest:.0f} % of the memory allowed"
        + (f", {broken} break a promise" if broken else "")
    )
    sys.exit(int(bool(broken)))


if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        os.chdir(OUT / sys.argv[2])
        child(sys.argv[2], sys.argv[3:])
    elif sys.argv[1:2] == ["--weigh"]:
        os.chdir(OUT / sys.argv[2])
        weigh(sys.argv[2])
    else:
        sys.exit(main(sys.argv[1:]))
