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
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
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


class Manager:
    """What a manager answers over HTTP, and the jobs that it was given.

    Its job types are scripts; a job is taken if it has what the manager's schema `SubmittedJob`
    asks for and settings that its type declares.
    """

    def __init__(self, scripts: Mapping[str, Path]) -> None:
        self.scripts = scripts
        self.jobs: list[dict[str, Any]] = []
        self.asked: list[str] = []

    def answer(self, path: str, job: dict[str, Any] | None) -> tuple[int, dict[str, Any]]:
        """Give status and content of an answer."""
        self.asked.append(path)
        kind = path.removeprefix("/api/v3/jobs/type/")
        if path == "/api/v3/version":
            return 200, {"name": "Flamenco", "version": "3.7", "shortversion": "3.7"}
        if kind in self.scripts:
            return 200, {"name": kind, "etag": "one", "settings": []}
        if path != "/api/v3/jobs" or job is None:
            return 404, {"code": 404, "message": "no such thing"}
        fault = self._fault(job)
        if fault:
            return 400, {"code": 400, "message": fault}
        self.jobs.append(job)
        return 200, {**job, "id": f"job-{len(self.jobs)}", "status": "queued"}

    def _fault(self, job: dict[str, Any]) -> str:
        needed = {"name": str, "type": str, "priority": int, "submitter_platform": str}
        for key, kind in needed.items():
            if not isinstance(job.get(key), kind):
                return f"{key} is missing or of another type"
        if job["type"] not in self.scripts:
            return "job type unknown"
        if job.get("type_etag", "one") != "one":
            return "the job type was changed"
        declared = re.findall(r'key: "(\w+)"', self.scripts[job["type"]].read_text("utf-8"))
        unknown = job.get("settings", {}).keys() - set(declared)
        return f"unknown settings {sorted(unknown)}" if unknown else ""


@contextmanager
def serving(manager: Manager) -> Iterator[str]:
    """Serve a manager on a port of this machine; gives its address."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self._send(*manager.answer(self.path, None))

        def do_POST(self) -> None:
            length = int(self.headers["Content-Length"])
            self._send(*manager.answer(self.path, json.loads(self.rfile.read(length))))

        def _send(self, status: int, content: dict[str, Any]) -> None:
            data = json.dumps(content).encode()
            self.send_response(status)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

        def log_message(self, *_: Any) -> None:
            """Print nothing."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_address[1]}"
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
