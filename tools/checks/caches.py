# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure what each cache saves, and write docs/caches.md.

    python -m tools.checks.caches                   screen every task, then measure; an hour
    python -m tools.checks.caches --screen          hits, and what they would have cost
    python -m tools.checks.caches --only NAME ...   measure these caches alone

Needs the bpy module. Every task runs in a process of its own. Screening counts the hits of each
cache in each task and takes the time of what was computed: their product is what it saves at most.
Measuring then runs a cache's best tasks with all caches and without the one, in turns. On a machine
that is busy the same run takes a tenth more or less; so the clock runs for the function, too, and
what a run is compared with is its own rest: with a share f of the time inside the function, the
whole takes 1 / (1 - f) of the rest, which is the same in both. The share saved is the median of the
pairs, with its standard error.
"""

from __future__ import annotations

import argparse
import contextlib
import functools
import gc
import importlib
import importlib.util
import json
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from tools.checks import caches_page, caches_tasks

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "docs" / "data" / "caches.csv"
PAIRS = 7
FEW_PAIRS = 2
PLAIN = 0.1
"""Share saved of which a few pairs are enough."""
BEST = 2
"""Tasks in which a cache is measured: those where screening has it save most."""
LEAST = 0.02
"""Share that a cache has to save in one of the tasks at least."""


def load() -> None:
    """Make `import rough_spectra` find the repository's root."""
    spec = importlib.util.spec_from_file_location(
        "rough_spectra", ROOT / "__init__.py", submodule_search_locations=[str(ROOT)]
    )
    assert spec is not None
    assert spec.loader is not None
    sys.modules["rough_spectra"] = package = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(package)
    importlib.import_module("bpy")  # before the extension: it brings mathutils along
    package.register()
    for path in sorted([*ROOT.glob("core/**/*.py"), *ROOT.glob("addon/**/*.py")]):
        parts = path.relative_to(ROOT).with_suffix("").parts
        if parts[-1] not in {"__init__", "worker"}:
            importlib.import_module(".".join(("rough_spectra", *parts)))


def memoized() -> Any:
    """Give the list of caches."""
    return importlib.import_module("rough_spectra.core.numerics.memoized")


def function(name: str) -> Any:
    """Give what a cache's name stands for: a function that remembers, or a dictionary."""
    module, _, attribute = name.rpartition(".")
    return getattr(importlib.import_module(f"rough_spectra.{module}"), attribute)


class Forgetful(dict[Any, Any]):
    """A dictionary that gives what was put in just now and otherwise says it has nothing."""

    def __contains__(self, _key: object) -> bool:
        return False

    def get(self, _key: Any, default: Any = None) -> Any:
        """Give nothing."""
        return default

    def pop(self, key: Any, *default: Any) -> Any:
        """Give nothing, either."""
        super().pop(key, None)
        return default[0]


@contextlib.contextmanager
def instead(name: str, other: Callable[[Any], Any]) -> Iterator[None]:
    """Put something else in the place of a cache, wherever our modules hold it."""
    old = function(name)
    new = other(old)
    holders = [
        (held, key)
        for held in gc.get_referrers(old)
        if isinstance(held, dict) and "__name__" in held and held is not globals()
        for key, value in held.items()
        if value is old
    ]
    for held, key in holders:
        held[key] = new
    try:
        yield
    finally:
        for held, key in holders:
            held[key] = old


def off(cache: Any) -> Any:
    """Give what does the same as a cache, and keeps nothing."""
    return Forgetful() if isinstance(cache, dict) else cache.__wrapped__


def timed(work: Callable[[], object]) -> float:
    """Processor time, seconds."""
    start = time.process_time()
    work()
    return time.process_time() - start


def screen(task: str) -> dict[str, Any]:
    """Count hits, and time what was computed, in a warm and in a cold run of a task."""
    load()
    listed = memoized().listed
    with tempfile.TemporaryDirectory() as folder:
        run = caches_tasks.TASKS[task](Path(folder))
        run()
        run()
        gc.disable()
        whole = statistics.median(timed(run) for _ in range(3))
        # What is forgotten is counted from nothing again.
        before = {c.name: 0 if task in caches_tasks.COLD else c.hits or 0 for c in listed()}
        run()
        hits = {
            cache.name: (cache.hits or 0) - before[cache.name]
            for cache in listed()
            if cache.hits is not None
        }
        found = {}
        for name, count in hits.items():
            if count > 0:
                found[name] = [count, saved(run, name)]
        # Nobody counts what a dictionary gave: to be measured in these tasks in any case.
        found |= {name: [0, 1.0] for name, of in caches_tasks.DICTIONARIES.items() if task in of}
    return {"seconds": whole, "saves": found}


def saved(run: Callable[[], object], name: str, is_off_first: bool = True) -> float:
    """Give the share of a task's time that a cache saves, from one run with it and one without."""
    rests = {}
    for is_off in (True, False) if is_off_first else (False, True):
        spent = [0.0]
        with instead(name, functools.partial(_other, spent, is_off)):
            whole = timed(run)
        # Of a dictionary nobody can tell its part, only the whole.
        rests[is_off] = 1 / whole if spent[0] == 0 else 1 - spent[0] / whole
    return 1 - rests[True] / rests[False]


def _other(spent: list[float], is_off: bool, old: Any) -> Any:
    """Give a cache, or what it would be without, that adds up the time inside."""
    inner = off(old) if is_off else old
    if isinstance(inner, dict):
        return inner

    def called(*args: Any, **options: Any) -> Any:
        start = time.process_time()
        try:
            return inner(*args, **options)
        finally:
            spent[0] += time.process_time() - start

    return called


def measure(task: str, names: list[str], pairs: int) -> dict[str, Any]:
    """Give the share of a task's time that each of some caches saves, and its standard error."""
    load()
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        run = caches_tasks.TASKS[task](Path(folder))
        run()
        run()
        gc.disable()
        for name in names:
            gc.collect()
            shares = []
            for number in range(pairs):
                shares.append(saved(run, name, is_off_first=number % 2 == 0))
                if number + 1 == FEW_PAIRS and min(shares) > PLAIN:
                    break
            middle = statistics.median(shares)
            # The median's standard error, from the median distance to it.
            apart = statistics.median(abs(share - middle) for share in shares)
            found[name] = [middle, 1.4826 * 1.2533 * apart / len(shares) ** 0.5]
            print(f"{task:>40} {name:<60} {middle:7.2%} ± {found[name][1]:.2%}", file=sys.stderr)
    return found


def child(*words: str) -> Any:
    """Run this file in another process, and read what it prints last."""
    command = [sys.executable, "-m", "tools.checks.caches", *words]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True, cwd=ROOT)
    return json.loads(done.stdout.splitlines()[-1])


def main() -> None:
    """Screen, measure, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--task", help="in this process, one of the tasks")
    parser.add_argument("--only", nargs="+", default=[], help="names of caches")
    parser.add_argument("--screen", action="store_true")
    parser.add_argument("--page", action="store_true", help="write the page from what was measured")
    parser.add_argument("--tasks", nargs="+", default=list(caches_tasks.TASKS))
    parser.add_argument("--pairs", type=int, default=PAIRS)
    parser.add_argument("--screened", type=Path, help="where screening's results lie")
    options = parser.parse_args()
    if options.page:
        page()
        return
    if options.task:
        if options.screen:
            print("\n" + json.dumps(screen(options.task)), flush=True)
        else:
            print("\n" + json.dumps(measure(options.task, options.only, options.pairs)), flush=True)
        memoized().clear_all()
        sys.modules["rough_spectra"].unregister()
        return
    if options.screened and options.screened.exists():
        screened = json.loads(options.screened.read_text("utf-8"))
    else:
        screened = {task: child("--task", task, "--screen") for task in options.tasks}
        if options.screened:
            options.screened.write_text(json.dumps(screened, indent=1), "utf-8")
    best = ranked(screened)
    for name, places in best.items():
        for task, (hits, share) in places:
            print(f"{name:<62} {task:<36} {hits:>7} hits {share:7.1%}")
    if options.screen:
        return
    wanted: dict[str, list[str]] = {}
    for name, places in best.items():
        if not options.only or name in options.only:
            for task, _ in places[:BEST]:
                wanted.setdefault(task, []).append(name)
    measured: dict[str, dict[str, list[float]]] = {}
    for task, names in wanted.items():
        of = child("--task", task, "--pairs", str(options.pairs), "--only", *names)
        for name, share in of.items():
            measured.setdefault(name, {})[task] = share
    keep(measured)
    page()


def ranked(screened: dict[str, Any]) -> dict[str, list[tuple[str, list[float]]]]:
    """Give for each cache the tasks that hit it, those first where it saves most."""
    found: dict[str, list[tuple[str, list[float]]]] = {}
    for task, result in screened.items():
        for name, numbers in result["saves"].items():
            found.setdefault(name, []).append((task, numbers))
    for places in found.values():
        places.sort(key=lambda place: -place[1][1])
    return dict(sorted(found.items()))


def keep(measured: dict[str, dict[str, list[float]]]) -> None:
    """Write the best share of each cache into the table, beside those that were there."""
    rows = {}
    if KEPT.exists():
        for line in KEPT.read_text("utf-8").splitlines()[1:]:
            rows[line.split(",")[0]] = line
    for name, places in measured.items():
        task, (share, error) = max(places.items(), key=lambda place: place[1][0])
        rows[name] = f'{name},"{task}",{100 * share:.1f},{max(100 * error, 0.05):.1f}'
    lines = [
        "cache,task,share saved (%),standard error (%)",
        *(rows[name] for name in sorted(rows)),
    ]
    KEPT.write_text("\n".join([*lines, ""]), "utf-8")


def page() -> None:
    """Write the manual's page of all caches that there are."""
    load()
    ours = [cache for cache in memoized().listed() if cache.name.startswith(("core.", "addon."))]
    caches_page.write({cache.name: (function(cache.name), cache.limit) for cache in ours})
    sys.modules["rough_spectra"].unregister()


if __name__ == "__main__":
    main()
