# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public function of the core has an example, and the examples are true.

They are written as in the module itself: its names are known, and numpy is `np`.
"""

import doctest
import importlib
import inspect
import pkgutil
import re
from pathlib import Path

import numpy as np
import pytest

import core


def public_functions():
    """Give the functions that a module of the core defines and others may call."""
    for found in pkgutil.walk_packages(core.__path__, "core."):
        module = importlib.import_module(found.name)
        for name, value in vars(module).items():
            own = getattr(value, "__module__", "") == module.__name__
            if own and not name.startswith("_") and inspect.isroutine(inspect.unwrap(value)):
                yield pytest.param(module, value, id=f"{module.__name__}.{name}")


FUNCTIONS = [*public_functions()]


def run_example(text, names, name):
    example = doctest.DocTestParser().get_doctest(text, names, name, None, 0)
    said = []
    doctest.DocTestRunner(verbose=False).run(example, out=said.append)
    assert not said, "".join(said)


@pytest.mark.parametrize(("module", "function"), FUNCTIONS)
def test_the_example_of(module, function):
    text = inspect.getdoc(function) or ""
    assert "\nExamples\n--------\n>>> " in text, "give it an example that runs"
    run_example(text, vars(module) | {"np": np}, function.__name__)


def test_the_example_of_the_page_for_scripts():
    page = Path(core.__file__).parents[1] / "docs" / "scripting.md"
    [text] = re.findall(r"```pycon\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    run_example(text, {}, page.name)


def test_the_core_has_functions():
    assert len(FUNCTIONS) > 60
