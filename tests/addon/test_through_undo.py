# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures that were rendered stay through undo and redo, as the render result does."""

from functools import partial

import bpy
import numpy as np
import pytest
from rough_spectra.addon.picture import files, images, through_undo

NAME = "Held"


@pytest.fixture
def step():
    """Push a step; gives the functions of Blender that go back and forth."""
    window = bpy.data.window_managers[0].windows[0]
    with bpy.context.temp_override(window=window, screen=window.screen):
        bpy.ops.ed.undo_push(message="begin")
        yield bpy.ops.ed


@pytest.fixture
def pixels():
    found = np.ones((2, 3, 4), np.float32)
    found[..., 0] = np.arange(6).reshape(2, 3) / 8
    return found


def put(pixels):
    return images.replace(NAME, partial(files.image_of, pixels, NAME))


def shown(image):
    return np.array(image.pixels[:]).reshape(2, 3, 4)


def test_a_picture_that_came_amid_the_users_steps_stays(step, pixels):
    bpy.data.materials.new("Before")
    step.undo_push(message="before")
    put(pixels)
    bpy.data.materials.new("After")
    step.undo_push(message="after")
    for back in (step.undo, step.undo, step.redo, step.redo):
        back()
        found = images.find(NAME)
        assert found is not None
        np.testing.assert_array_equal(shown(found), pixels)
        assert [image.get("rough_spectra") for image in bpy.data.images].count(NAME) == 1
    assert "After" in bpy.data.materials


def test_what_the_user_removed_does_not_come_back(step, pixels):
    put(pixels)
    step.undo_push(message="picture")
    bpy.data.images.remove(images.find(NAME))
    step.undo_push(message="removed")
    bpy.data.materials.new("After")
    step.undo_push(message="after")
    step.undo()
    assert images.find(NAME) is None
    step.undo()
    np.testing.assert_array_equal(shown(images.find(NAME)), pixels)  # the removal is undone


def test_the_newest_picture_is_the_one_that_stays(step, pixels):
    put(pixels)
    step.undo_push(message="first")
    put(1 - pixels)
    bpy.data.materials.new("After")
    step.undo_push(message="after")
    step.undo()
    np.testing.assert_array_equal(shown(images.find(NAME)), 1 - pixels)


def test_another_file_forgets(pixels):
    put(pixels)
    assert through_undo._images.get()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert not through_undo._images.get()
