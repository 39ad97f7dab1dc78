# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that give materials their colors, and look at textures before, in a second Blender.

A color that is a texture has to be seen to be scaled, which takes some seconds: meanwhile the user
goes on, and ESC stops. Where there is no texture, nothing runs in the background.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ....core.errors import MaterialError, RoughSpectraError
from . import background, common

if TYPE_CHECKING:
    from ...matching.request import Request
    from ...matching.solution import Solution


class Work(NamedTuple):
    """What such an operator does.

    Parameters
    ----------
    materials
        Those that get a color.
    shader
        Which node it is for, as of `shader_nodes.find`; None for the setting of each.
    act
        Does it, and says so in one sentence, given the materials and what their textures look like.
    does
        Whether there is anything to do.
    """

    materials: Sequence[Any]
    shader: str | None
    act: Callable[[Sequence[Any], Mapping[Any, Any]], str]
    does: bool = True


def assignment(
    context: Any,
    scope: str,
    wanted: Callable[[Any | None], tuple[Request, str]],
    tell: Callable[[list[tuple[Any, Solution]], Request], str],
) -> Work:
    """Say how to assign to all materials in scope, or to none.

    Parameters
    ----------
    context
        Blender's.
    scope
        Of `AssignOptions`.
    wanted
        Gives request and shader for the active material, or for None. It is asked when the textures
        are seen: the material's settings may have changed meanwhile.
    tell
        Says in one sentence what was assigned.

    Raises
    ------
    RoughSpectraError
        If there is nothing to assign to, or nothing can be.
    """
    from ...material import derive

    active = common.active_material(context)
    request, shader = wanted(active)
    if scope != "SELECTED" and active is None:
        assigned = partial(common.assign_in_scope, context, scope, request, shader)
        return Work([], shader, lambda _materials, _looked: tell(assigned(), request))

    def act(materials: Sequence[Any], looked: Mapping[Any, Any]) -> str:
        request, shader = wanted(materials[0])
        pairs = [(material, request) for material in materials]
        solutions = derive.assign(pairs, shader, looked=looked)
        return tell(list(zip(materials, solutions, strict=True)), request)

    return Work(common.materials_in_scope(context, scope), shader, act)


class LooksFirst(background.InBackground):
    """What these operators share; each says what its work is."""

    stopped = "Looking at textures was stopped; nothing was changed"

    def work(self, context: Any) -> Work:
        """Say what is to be done.

        Raises
        ------
        RoughSpectraError
            If it cannot be.
        """
        raise NotImplementedError

    def execute(self, context: Any) -> set[str]:
        """Do it at once where there is no texture, else once the second Blender has seen them."""
        from ...material import textures

        try:
            self._work = self.work(context)
            self._seen = textures.to_look_at(self._work.materials, self._work.shader)
            if not self._seen:
                sentence = self._work.act(self._work.materials, {})
        except RoughSpectraError as error:
            common.report_error(self, error)
            return {"CANCELLED"}
        if self._seen:
            return super().execute(context)
        self.report({"INFO"}, sentence)
        return {"FINISHED"} if self._work.does else {"CANCELLED"}

    def start(self, _context: Any) -> Any:
        """Start the second Blender."""
        from ...blender import texture_colors

        # Materials may not outlive an undo, while the user goes on.
        self._uids = [material.session_uid for material in self._work.materials]
        self._seen_uids = [material.session_uid for material, _ in self._seen]
        return texture_colors.Look([socket for _, socket in self._seen])

    def state(self, done: int, total: int) -> str:
        """Say how many textures are seen."""
        return rpt_("Looking at textures: {done} of {total}").format(done=done, total=total)

    def finish(self, job: Any) -> str:
        """Give the materials their colors."""
        there = {material.session_uid: material for material in bpy.data.materials}
        if not there.keys() >= {*self._uids}:
            msg = "A material was removed while its texture was looked at; nothing was changed."
            raise MaterialError(msg)
        seen = zip(self._seen_uids, job.colors(), strict=True)
        looked = {there[uid]: colors for uid, colors in seen}
        return self._work.act([there[uid] for uid in self._uids], looked)
