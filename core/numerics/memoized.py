# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that is remembered: one way to do it, one list of all, one way to forget it.

`memoized` is for functions of anything, `remembered` for functions of directions, and `kept` is a
dictionary for who looks up and puts in by hand. `listed` shows what there is, `clear_all` forgets
it.

Remember only what is keyed by all that it depends on. What each cache saves is measured by
`tools/checks/caches.py`, which switches one off at a time; one that saves nothing is to go.

Numpy is imported by no more than what needs it: this is loaded when Blender starts.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, wraps
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

if TYPE_CHECKING:
    from functools import _CacheInfo, _lru_cache_wrapper

    from .arrays import Array

    Directions = Callable[[Array, Array, Array], tuple[Array, ...]]
    """A function of θi, θr and Δφ that depends on nothing else."""

FEW = 256
"""Directions up to which results are remembered."""

_SETS = 32
"""Sets of directions that are remembered of one function, the latest."""

_Result = TypeVar("_Result")
_Value = TypeVar("_Value")

_ROOT = __name__.removesuffix("core.numerics.memoized")


class Listed(NamedTuple):
    """What a cache holds now.

    Parameters
    ----------
    name
        Module from the extension's root, and the function in it.
    hits, misses
        Since the start or since it was cleared; None where they are not counted.
    entries, limit
        How many there are, and how many there may be; None without a limit.
    """

    name: str
    hits: int | None
    misses: int | None
    entries: int
    limit: int | None


class _Cache(NamedTuple):
    info: Callable[[], _CacheInfo | int]
    clear: Callable[[], None]


_caches: dict[str, _Cache] = {}


def memoized(
    maxsize: int | None = 128,
) -> Callable[[Callable[..., _Result]], _lru_cache_wrapper[_Result]]:
    """Let a function remember its results: `functools.lru_cache`, on the list of all caches.

    Parameters
    ----------
    maxsize
        Results that are kept, the latest; None for all, where there can be but a few.

    Examples
    --------
    >>> @memoized(maxsize=8)
    ... def double(number):
    ...     return 2 * number
    >>> double(3), double(3), double.cache_info().hits
    (6, 6, 1)
    """

    def decorate(function: Callable[..., _Result]) -> _lru_cache_wrapper[_Result]:
        return _wrapped(function, _name(function), maxsize)

    return decorate


def remembered(function: Directions) -> Directions:
    """Let a function of θi, θr and Δφ remember its results, which are read-only then.

    While σ is dragged a material is computed at every step for the same few directions, and most of
    the time of so few goes into calling numpy. Of many directions nothing is kept: there the time
    goes into the numbers, and keeping them costs memory.

    Examples
    --------
    >>> import numpy as np
    >>> def sums(light, view, azimuth):
    ...     return (light + view + azimuth,)
    >>> of_few = remembered(sums)
    >>> of_few(np.ones(2), np.ones(2), np.zeros(2))[0].tolist()
    [2.0, 2.0]
    >>> of_few(np.ones(2), np.ones(2), np.zeros(2))[0].flags.writeable
    False
    """
    import numpy as np

    def compute(*keys: Any) -> tuple[Array, ...]:
        """Of the bytes of the three, their shapes and their types."""
        angles = zip(keys[:3], keys[3:6], keys[6:], strict=True)
        found = function(*(np.frombuffer(data, of).reshape(shape) for data, shape, of in angles))
        for array in found:
            array.setflags(write=False)
        return found

    of_bytes = _wrapped(compute, _name(function), _SETS)

    @wraps(function)
    def of_arrays(light: Array, view: Array, azimuth: Array) -> tuple[Array, ...]:
        shapes = light.shape, view.shape, azimuth.shape
        # Of angles that broadcast against each other, the results are what would be kept.
        alike = shapes[0] == shapes[1] == shapes[2]
        if (light.size if alike else prod(np.broadcast_shapes(*shapes))) > FEW:
            return function(light, view, azimuth)
        kinds = light.dtype.str, view.dtype.str, azimuth.dtype.str  # the order of bytes, too
        return of_bytes(light.tobytes(), view.tobytes(), azimuth.tobytes(), *shapes, *kinds)

    return of_arrays


def kept(module: str, name: str) -> dict[Any, Any]:
    """Give a dictionary that is on the list of all caches.

    Parameters
    ----------
    module
        `__name__` of the one that has it.
    name
        Of the variable there.

    Examples
    --------
    >>> known = kept("addon.example", "known")
    >>> known["answer"] = 42
    >>> [cache.entries for cache in listed() if cache.name == "addon.example.known"]
    [1]
    """
    entries: dict[Any, Any] = {}
    enlist(module, name, entries.__len__, entries.clear)
    return entries


def enlist(module: str, name: str, size: Callable[[], int], clear: Callable[[], None]) -> None:
    """Put on the list what is kept otherwise, such as icons that Blender holds.

    Parameters
    ----------
    module, name
        As with `kept`.
    size
        Gives how many entries there are.
    clear
        Forgets them.

    Examples
    --------
    >>> icons = [7, 8]
    >>> enlist("addon.example", "icons", icons.__len__, icons.clear)
    >>> clear_all("addon.example")
    >>> icons
    []
    """
    _caches[f"{module.removeprefix(_ROOT)}.{name}"] = _Cache(size, clear)


def listed() -> list[Listed]:
    """Return what every cache of the modules loaded so far holds, by name.

    Examples
    --------
    >>> @memoized(maxsize=4)
    ... def half(number):
    ...     return number / 2
    >>> half(2), half(2)
    (1.0, 1.0)
    >>> [cache[1:] for cache in listed() if cache.name.endswith("half")]
    [(1, 1, 1, 4)]
    """
    found = []
    for name, cache in sorted(_caches.items()):
        info = cache.info()
        if isinstance(info, int):
            found.append(Listed(name, None, None, info, None))
        else:
            found.append(Listed(name, info.hits, info.misses, info.currsize, info.maxsize))
    return found


def clear_all(beginning: str = "") -> None:
    """Forget everything, or what the caches hold whose names begin so: "addon.".

    Examples
    --------
    >>> known = kept("addon.example", "known")
    >>> known["answer"] = 42
    >>> clear_all("addon.example")
    >>> known
    {}
    """
    for name, cache in list(_caches.items()):
        if name.startswith(beginning):
            cache.clear()


def _wrapped(
    function: Callable[..., _Result], name: str, maxsize: int | None
) -> _lru_cache_wrapper[_Result]:
    wrapper = lru_cache(maxsize=maxsize)(function)
    _caches[name] = _Cache(wrapper.cache_info, wrapper.cache_clear)
    return wrapper


def _name(function: Callable[..., Any]) -> str:
    return f"{function.__module__.removeprefix(_ROOT)}.{function.__qualname__}"
