# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that give materials their colors, and look at textures before, in a second Blender.

A color that is a texture has to be seen to be scaled, which takes some seconds: meanwhile the user
goes on, and ESC stops. Where there is no texture, nothing runs in the background.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ....core.errors import MaterialError, RoughSpectraError
from . import background, common, giving, targets

if TYPE_CHECKING:
    from ...matching.solution import Solution
    from ...samples.sample import Sample


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
    operator: Any,
    context: Any,
    sample: Sample,
    tell: Callable[[list[tuple[Any, Solution]]], str] | None = None,
    sigma: float | None = None,
) -> Work:
    """Say how to assign a sample by an operator's `AssignOptions`, to all that is meant or nothing.

    Parameters
    ----------
    operator, context
        Ours, and Blender's.
    sample
        A measured one.
    tell
        Says in one sentence what was assigned; None for the usual one.
    sigma
        Radians, as of `giving.assign_sample`.

    Raises
    ------
    RoughSpectraError
        If there is nothing to assign to.
    """
    aimed = targets.aim(context, operator.scope)
    told = operator.properties.is_property_set("shader")
    # Objects may not outlive an undo either.
    bare = [thing.session_uid for thing in aimed.bare]

    def act(materials: Sequence[Any], looked: Mapping[Any, Any]) -> str:
        there = {thing.session_uid: thing for thing in bpy.data.objects}
        still = [there[uid] for uid in bare if uid in there]
        now = aimed._replace(materials=list(materials), bare=still)
        assigned = giving.assign_sample(operator, now, sample, looked, sigma)
        return giving.told_of(operator, assigned, sample) if tell is None else tell(assigned)

    return Work(aimed.materials, operator.shader if told else None, act)


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
