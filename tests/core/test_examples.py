# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public function of the core has an example, and the examples are true.

They are written as in the module itself: its names are known, and numpy is `np`.
"""

import doctest
import importlib
import inspect
import pkgutil

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


@pytest.mark.parametrize(("module", "function"), FUNCTIONS)
def test_the_example_of(module, function):
    text = inspect.getdoc(function) or ""
    assert "\nExamples\n--------\n>>> " in text, "give it an example that runs"
    names = vars(module) | {"np": np}
    example = doctest.DocTestParser().get_doctest(text, names, function.__name__, None, 0)
    said = []
    doctest.DocTestRunner(verbose=False).run(example, out=said.append)
    assert not said, "".join(said)


def test_the_core_has_functions():
    assert len(FUNCTIONS) > 60
