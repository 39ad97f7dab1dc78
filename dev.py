#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every developer command of Rough Spectra: `python3 dev.py --help`.

Needs a Python of any version from 3.9 on to start. It finds the Pythons that Blender's LTS versions
stand on and makes environments of its own in .venv/ with pinned versions, so nothing has to be
installed or activated beforehand.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from tools.environment import core_package, environments, package, side_by_side, wheels
from tools.environment.environments import Environment
from tools.environment.errors import SetupError
from tools.environment.side_by_side import Result, Step

ROOT = Path(__file__).resolve().parent
BUILD = ROOT / "build"
CACHE = ROOT / ".cache"

UNUSABLE = 2
INTERRUPTED = 130

BLENDER_5_2 = Environment(
    ROOT, "bpy-5.2", ("3.13",), "Blender 5.2 LTS as a module, about 400 MB to fetch, once"
)
BLENDER_4_5 = Environment(
    ROOT, "bpy-4.5", ("3.11",), "Blender 4.5 LTS as a module, about 400 MB to fetch, once"
)
TOOLS = Environment(
    ROOT, environments.TOOLS, ("3.13", "3.11"), "ruff, mypy, matplotlib and mkdocs, once"
)
CHART = Environment(
    ROOT,
    "chart",
    ("3.13", "3.11"),
    "Mitsuba and LuxCore, which the chart compares with, about 200 MB to fetch, once",
)
FUZZ = Environment(ROOT, "fuzz", ("3.13", "3.11"), "atheris, the fuzzer of the readers, once")
TABLES = Environment(
    ROOT, "tables", ("3.13", "3.11"), "numba, for the tools that trace the tables that ship, once"
)
FARM = Environment(
    ROOT,
    "farm",
    ("3.13", "3.11"),
    "openjd-cli and a JavaScript engine, which run the bundles for render farms, once",
)
BLENDERS = {"5.2": BLENDER_5_2, "4.5": BLENDER_4_5}

NO_PYTHON = (
    "Neither Python 3.13 (for Blender 5.2 LTS) nor Python 3.11 (for Blender 4.5 LTS) was found "
    "among those that run: install one of them, for instance from python.org, with "
    "'pyenv install 3.13' or with 'uv python install 3.13', and run the same command again."
)


def say(sentence: str) -> None:
    """Tell the user what is going on, in order with what child processes print."""
    print(sentence, flush=True)


# Environments ------------------------------------------------------------------------------------


def prepare_blenders(wanted: Sequence[str]) -> dict[str, Environment]:
    """Prepare the Blender versions asked for and return those whose Python exists."""
    ready = {name: BLENDERS[name] for name in wanted if environments.prepare(BLENDERS[name], say)}
    if not ready and len(wanted) == len(BLENDERS):
        raise SetupError(NO_PYTHON)
    return ready


def prepare_blender() -> Environment:
    """Prepare one Blender, the newest whose Python exists."""
    for environment in BLENDERS.values():
        if environments.prepare(environment, say):
            return environment
    raise SetupError(NO_PYTHON)


def prepare_tools() -> Environment:
    """Prepare ruff, mypy and the rest."""
    if not environments.prepare(TOOLS, say):
        raise SetupError(NO_PYTHON)
    return TOOLS


def missing(name: str) -> str:
    """Say that a Blender version is left out, and what to install."""
    python = BLENDERS[name].versions[0]
    return (
        f"Blender {name} was not tested: no Python {python} that runs was found; install it, for "
        f"instance with 'pyenv install {python}' or 'uv python install {python}'."
    )


# Children ----------------------------------------------------------------------------------------


def call(command: Sequence[str | Path], cwd: Path | None = ROOT, **extra: str) -> int:
    """Run a child with our streams and return its exit status; `extra` adds to its environment."""
    sys.stdout.flush()
    words = [str(word) for word in command]
    return subprocess.run(words, cwd=cwd, env={**os.environ, **extra}, check=False).returncode


def module(environment: Environment, name: str, *arguments: str | Path) -> list[str | Path]:
    """Return the command that runs a module of an environment."""
    return [environment.python, "-m", name, *arguments]


def script(name: str) -> Path:
    """Return a script of the repository or say that it isn't there."""
    path = ROOT / name
    if not path.is_file():
        raise SetupError(f"{name} does not exist in this version of the repository yet.")
    return path


def tool(python: str | Path, name: str, *arguments: str | Path) -> list[str | Path]:
    """Return the command that runs a script of tools/: as a module, so that it finds the others."""
    script(name)
    return [python, "-m", name.removesuffix(".py").replace("/", "."), *arguments]


# Commands ----------------------------------------------------------------------------------------


def test_blenders(ready: dict[str, Environment], arguments: Sequence[str]) -> list[Step]:
    """Describe pytest over each bpy module; one screen and one desktop Blender do for one of them.

    What runs in the desktop Blender is the same, whichever bpy module the tests stand on.
    """
    steps = [test_blender(name, environment, arguments) for name, environment in ready.items()]
    alone = {"ROUGH_SPECTRA_BLENDER": ""}
    return steps[:1] + [replace(s, settings={**s.settings, **alone}) for s in steps[1:]]


def test_blender(name: str, environment: Environment, arguments: Sequence[str]) -> Step:
    """Describe pytest over a bpy module, away from the user's settings and the other's files.

    Temporary files need no care: pytest makes a folder of its own for each run.
    """
    wheels.ensure(ROOT, environment.python)
    own = {
        "BLENDER_USER_RESOURCES": CACHE / f"blender-user-{name}",
        "HYPOTHESIS_STORAGE_DIRECTORY": CACHE / f"hypothesis-{name}",
    }
    for folder in own.values():
        folder.mkdir(parents=True, exist_ok=True)
    cache = f"cache_dir={CACHE / f'pytest-{name}'}"
    pytest = module(environment, "pytest", "--durations=10", "-o", cache, *arguments)
    settings = {key: str(folder) for key, folder in own.items()}
    if sys.stdout.isatty():
        settings["PY_COLORS"] = "1"  # for one whose output is kept until its turn
    return Step(f"tests, Blender {name}", pytest, ROOT, settings)


def lint() -> list[Step]:
    """Describe both halves of ruff."""
    ruff = module(prepare_tools(), "ruff")
    return [
        Step("lint (ruff check)", [*ruff, "check"], ROOT),
        Step("layout (ruff format)", [*ruff, "format", "--check"], ROOT),
    ]


def types() -> list[Step]:
    """Describe the check of types, over a copy of what ships, named as Blender names it.

    The extension's relative imports climb to its package, and a clone's folder may have any name.
    In one go with the tools, which import the extension: it is read once.
    """
    # No cache: it once kept complaining of a module that had been added since.
    config = ("--config-file", ROOT / "pyproject.toml", "--cache-dir", os.devnull)
    shipped = CACHE / "types"
    package.stage(ROOT, shipped / "rough_spectra", ["__init__.py"], package.CODE_FOLDERS)
    named = ("-p", "rough_spectra.core", "-p", "rough_spectra.addon", "-p", "tools", "-m", "dev")
    mypy = module(prepare_tools(), "mypy", *config, *named)
    return [Step("types (mypy)", mypy, shipped, {"MYPYPATH": str(ROOT)})]


def command_test(options: argparse.Namespace) -> int:
    """Run the tests over each Blender, lint, layout and types, side by side on several cores."""
    wanted = options.only or [*BLENDERS, "lint", "types"]
    names = [name for name in BLENDERS if name in wanted]
    ready = prepare_blenders(names)
    if "lint" in wanted or "types" in wanted:
        prepare_tools()
    tested = test_blenders(ready, options.arguments)
    checked = [*(lint() if "lint" in wanted else []), *(types() if "types" in wanted else [])]
    ran = side_by_side.run([*tested, *checked], side_by_side.cores(), say)
    strict = bool(os.environ.get("CI")) or bool(options.only)
    left_out = [
        Result(f"tests, Blender {name}", missing(name), failed=strict)
        for name in names
        if name not in ready
    ]
    results = [*ran[: len(tested)], *left_out, *ran[len(tested) :]]
    say("\n=== summary")
    for each in results:
        say(f"{each.seconds:7.1f} s  {each.name}: {each.result}")
    failed = sum(each.failed for each in results)
    say(f"{failed} of {len(results)} steps failed." if failed else "All steps passed.")
    return 1 if failed else 0


def command_build(_options: argparse.Namespace) -> int:
    """Build the extension zip and have Blender validate it."""
    python = prepare_blender().python
    output = BUILD / f"rough_spectra-{package.version(ROOT)}.zip"
    shipped = wheels.shipped(ROOT, python)
    package.build(ROOT, python, shipped, BUILD / "stage" / "rough_spectra", output)
    size = output.stat().st_size / 1e6
    say(f"Built {output} ({size:.1f} MB), accepted by Blender's own validator.")
    return 0


def command_release(options: argparse.Namespace) -> int:
    """Build what a release has: the zip for the extensions platform, and the core as a wheel."""
    if not options.website and not package.has_website(ROOT):
        raise SetupError(
            "The extensions platform wants the project's website, and the manifest names none: "
            "add --website ADDRESS."
        )
    python = prepare_blender().python
    folder = BUILD / "release"
    shutil.rmtree(folder, ignore_errors=True)
    output = folder / f"rough_spectra-{package.version(ROOT)}.zip"
    staging = BUILD / "stage" / "rough_spectra"
    shipped = wheels.shipped(ROOT, python)
    package.build(ROOT, python, shipped, staging, output, options.website or "")
    wheel = core_package.build(ROOT, BUILD / "stage")
    shutil.copy2(wheel, folder / wheel.name)
    made = sorted(path for path in folder.iterdir() if path.is_file())
    sums = [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}" for path in made]
    (folder / "SHA256SUMS").write_text("\n".join(sums) + "\n", encoding="utf-8")
    for line in sums:
        say(line)
    say(f"Made {folder}; the zip is accepted by Blender's own validator.")
    return 0


def command_run(arguments: Sequence[str]) -> int:
    """Run the extension's command line in the caller's folder."""
    # What a verb prints may be piped on: set-up talks elsewhere.
    with contextlib.redirect_stdout(sys.stderr):
        python = prepare_blender().python
    command = [str(python), str(script("tools/run/run_command_line.py")), *arguments]
    if sys.platform != "win32":
        # Give our place to the child, so that a signal to this process reaches the work itself.
        os.execv(command[0], command)
    return call(command, cwd=None)


def command_demo(_options: argparse.Namespace) -> int:
    """Make the demo scene, its readings and its pictures in build/demo."""
    blender, tools = prepare_blender(), prepare_tools()
    wheels.ensure(ROOT, blender.python)
    output = BUILD / "demo"
    output.mkdir(parents=True, exist_ok=True)
    status = call(tool(blender.python, "tools/demo/demo.py", output))
    return status or call(tool(tools.python, "tools/demo/contact_sheet.py", output))


def command_bench(options: argparse.Namespace) -> int:
    """Measure speed against copies and peers."""
    return call(tool(prepare_blender().python, "tools/benchmarks/bench.py", *options.arguments))


def command_figures(options: argparse.Namespace) -> int:
    """Draw the figures of the manual."""
    return call(tool(prepare_tools().python, "tools/manual/figures.py", *options.arguments))


def command_chart(_options: argparse.Namespace) -> int:
    """Measure cost and error of every model, shortcut and peer, and draw the chart into docs/."""
    blender, tools = prepare_blender(), prepare_tools()
    wheels.ensure(ROOT, blender.python)
    command = module(blender, "tools.chart.chart", "--draw", tools.python)
    try:
        if environments.prepare(CHART, say):
            command += ["--peers", CHART.python]
    except SetupError as error:
        say(f"{error} The chart is made without the renderers it compares with.")
    return call(command)


def command_fuzz(options: argparse.Namespace) -> int:
    """Fuzz the readers of measurement files; what breaks one is kept in build/fuzz/."""
    if not environments.prepare(FUZZ, say):
        raise SetupError(NO_PYTHON)
    return call(tool(FUZZ.python, "tools/checks/fuzz.py", *options.arguments))


def command_farm(options: argparse.Namespace) -> int:
    """Run the bundles for render farms by the engines' own programs."""
    if not environments.prepare(FARM, say):
        raise SetupError(NO_PYTHON)
    blender = prepare_blender()
    wheels.ensure(ROOT, blender.python)
    return call(tool(blender.python, "tools/checks/check_farm.py", *options.arguments))


def command_tables(options: argparse.Namespace) -> int:
    """Run a tool of tools/tables, which trace and make the tables that ship."""
    if not options.arguments:
        raise SetupError(
            "Name a tool of tools/tables and its arguments, for instance "
            "'python3 dev.py tables trace_surfaces FOLDER'."
        )
    name, *rest = options.arguments
    command = tool(TABLES.python, f"tools/tables/{name}.py", *rest)
    if not environments.prepare(TABLES, say):
        raise SetupError(NO_PYTHON)
    return call(command)


def command_screenshots(options: argparse.Namespace) -> int:
    """Take the manual's pictures in the window of a desktop Blender."""
    status = command_build(options)
    zips = sorted(BUILD.glob("rough_spectra-*.zip"))
    if status:
        return status
    arguments = ("--zip", zips[-1], *options.arguments)
    return call(tool(sys.executable, "tools/manual/screenshots.py", *arguments))


def command_docs(_options: argparse.Namespace) -> int:
    """Build the manual into site/; a dead link fails."""
    script("mkdocs.yml")
    site = ROOT / "site"
    return call(
        module(prepare_tools(), "mkdocs", "build", "--strict", "--site-dir", site),
        NO_MKDOCS_2_WARNING="1",  # an advertisement of some thirty lines
    )


def command_setup(_options: argparse.Namespace) -> int:
    """Prepare every environment and do nothing else."""
    ready = prepare_blenders(list(BLENDERS))
    prepare_tools()
    for name, environment in BLENDERS.items():
        if name in ready:
            wheels.ensure(ROOT, environment.python)
            say(f"Blender {name}: {environment.python}")
        else:
            say(missing(name).replace("was not tested", "is left out"))
    say(f"Tools: {TOOLS.python}")
    return 0


COMMANDS = {
    "setup": (command_setup, "prepare the environments, nothing else"),
    "demo": (command_demo, "make the demo scene, its readings and its pictures"),
    "test": (command_test, "tests over both Blender LTS versions, lint, layout and types"),
    "build": (command_build, "build and validate the extension zip"),
    "release": (command_release, "build and validate all that a release has"),
    "docs": (command_docs, "build the manual into site/"),
    "figures": (command_figures, "draw the figures of the manual"),
    "bench": (command_bench, "measure speed"),
    "screenshots": (command_screenshots, "take the manual's pictures in a desktop Blender"),
    "tables": (command_tables, "run a tool that traces or makes a table that ships"),
    "farm": (command_farm, "run the bundles for render farms, by the engines' own programs"),
    "fuzz": (command_fuzz, "fuzz the readers of measurement files"),
    "chart": (command_chart, "measure cost against error, peers included, and draw the chart"),
}
TAKES_ARGUMENTS = {
    "test": "pytest",
    "bench": "tools/benchmarks/bench.py",
    "figures": "tools/manual/figures.py",
    "farm": "tools/checks/check_farm.py",
    "fuzz": "tools/checks/fuzz.py",
    "screenshots": "tools/manual/screenshots.py",
    "tables": "the tool named first",
}


def parser() -> argparse.ArgumentParser:
    """Describe the command line."""
    top = argparse.ArgumentParser(prog="dev.py", description="Rough Spectra's developer commands.")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, (function, about) in COMMANDS.items():
        epilog = None
        if name in TAKES_ARGUMENTS:
            epilog = f"Other arguments go to {TAKES_ARGUMENTS[name]}."
        sub = commands.add_parser(name, help=about, description=function.__doc__, epilog=epilog)
        sub.set_defaults(function=function)
        if name == "release":
            sub.add_argument(
                "--website", metavar="ADDRESS", help="of the project, for the manifest"
            )
        if name == "test":
            sub.add_argument(
                "--only",
                action="append",
                choices=[*BLENDERS, "lint", "types"],
                help="just this step; may be given several times",
            )
    commands.add_parser("run", help="the extension's command line: run VERB ... (run --help)")
    return top


def main(argv: Sequence[str]) -> int:
    """Run one command and return its exit status."""
    if argv and argv[0] == "run":
        return command_run(argv[1:])
    top = parser()
    options, rest = top.parse_known_args(argv)
    if rest and options.command not in TAKES_ARGUMENTS:
        top.error(f"unrecognized arguments: {' '.join(rest)}")
    options.arguments = rest
    status: int = options.function(options)
    return status


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except SetupError as error:
        print(error, file=sys.stderr)
        sys.exit(UNUSABLE)
    except OSError as error:
        print(f"dev.py cannot go on: {error}", file=sys.stderr)
        sys.exit(UNUSABLE)
    except KeyboardInterrupt:
        print("Interrupted.", file=sys.stderr)
        sys.exit(INTERRUPTED)
