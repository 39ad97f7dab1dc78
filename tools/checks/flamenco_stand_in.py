# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A stand-in for what Flamenco 3's manager and workers do with a job type.

The manager gives a script `author.Task`, `author.Command` and a job with `addTask`; a task has
`addCommand` and `addDependency` (its page "Job Types" and the scripts that it brings). A worker
replaces variables such as {blender} and runs a command of the type "exec", once all that its task
depends on has ended well.
"""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

_API = """
const made = [];
const author = {
  Task(name, type) {
    if (typeof name !== "string" || typeof type !== "string") throw "a task has a name and a type";
    const task = { name, type, commands: [], dependencies: [] };
    return {
      task,
      addCommand(command) { task.commands.push(command); },
      addDependency(other) { task.dependencies.push(other.task.name); },
    };
  },
  Command(name, parameters) { return { name, parameters }; },
};
const job = { settings: SETTINGS, addTask(task) { made.push(task.task); } };
"""
_RUN = "compileJob(job); JSON.stringify({ type: JOB_TYPE, tasks: made })"

_CODE = "import quickjs, sys; print(quickjs.Context().eval(sys.stdin.read()))"

KINDS = {"string", "int32", "float", "bool"}
"""Of settings, by the manager's schema `AvailableJobSetting`."""


def compiled(python: Path, script: Path, settings: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Give the tasks that a job type makes of settings.

    Parameters
    ----------
    python
        Interpreter of an environment that has quickjs.
    script
        The job type.
    settings
        What the user chose.

    Raises
    ------
    ValueError
        If the job type declares its settings in a way that the manager does not take, or leaves
        one out that was given.
    """
    api = _API.replace("SETTINGS", json.dumps(settings))
    source = "\n".join((api, script.read_text(encoding="utf-8"), _RUN))
    done = subprocess.run(
        [str(python), "-c", _CODE], input=source, capture_output=True, text=True, check=True
    )
    told = json.loads(done.stdout)
    declared = {each["key"]: each for each in told["type"]["settings"]}
    if not settings.keys() <= declared.keys():
        raise ValueError(f"it has no settings {sorted(settings.keys() - declared.keys())}")
    wrong = [key for key, each in declared.items() if each["type"] not in KINDS]
    if wrong or not told["type"]["label"]:
        raise ValueError(f"settings of no known type: {wrong}")
    tasks: list[dict[str, Any]] = told["tasks"]
    return tasks


def run(tasks: list[dict[str, Any]], variables: Mapping[str, str]) -> list[int]:
    """Run the tasks as a worker does; exit statuses of those that ran."""
    done: dict[str, int] = {}
    for task in tasks:
        if any(done.get(name) != 0 for name in task["dependencies"]):
            continue
        for command in task["commands"]:
            if command["name"] != "exec":
                raise ValueError(f"a worker's command {command['name']!r} is not known here")
            words = [command["parameters"]["exe"], *command["parameters"]["args"]]
            words = [_filled(word, variables) for word in words]
            done[task["name"]] = subprocess.run(words, check=False).returncode
    return list(done.values())


def _filled(word: str, variables: Mapping[str, str]) -> str:
    return re.sub(r"{(\w+)}", lambda found: variables.get(found[1], found[0]), word)
