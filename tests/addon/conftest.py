# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A fresh Blender with the extension for each test, and what several tests need to make."""

from pathlib import Path

import bpy
import numpy as np
import pytest
from rough_spectra.addon.matching import solve
from rough_spectra.addon.samples import readers
from rough_spectra.addon.samples.sample import Sample
from rough_spectra.addon.support.colour_science import colour

FIXTURES = Path(__file__).resolve().parents[1] / "fixtures"


@pytest.fixture(autouse=True)
def _fresh_blender(empty_file):
    """Every test begins with an empty file."""


@pytest.fixture
def make_material():
    """Make a material by hand: a node of the given type linked to the output, sockets set."""

    def make(name="Material", node="ShaderNodeBsdfDiffuse", **sockets):
        material = bpy.data.materials.new(name)
        material.use_fake_user = True  # what nothing uses counts as deleted
        if material.node_tree is None:
            material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        output = tree.nodes.new("ShaderNodeOutputMaterial")
        shader = tree.nodes.new(node)
        tree.links.new(shader.outputs[0], output.inputs["Surface"])
        for socket, value in sockets.items():
            shader.inputs[socket.replace("_", " ")].default_value = value
        return material

    return make


@pytest.fixture(scope="session")
def colorchecker():
    """The 24 patches, straight from colour-science, as albedos."""
    patches = colour().SDS_COLOURCHECKERS["ColorChecker N Ohta"]
    return [
        Sample(name, np.array(sd.wavelengths), np.array(sd.values), "albedo")
        for name, sd in patches.items()
    ]


@pytest.fixture(scope="session")
def nix():
    """Every sample of the Nix exports, by file name: readings of rough surfaces."""
    return {
        path.stem: sample
        for path in sorted((FIXTURES / "nix").glob("*.csv"))
        for sample in readers.read(path)
    }


@pytest.fixture(scope="session")
def request_for():
    """Make a request with σ in degrees, for the published model unless another is named."""

    def make(sample, degrees=30.0, **settings):
        settings.setdefault("model", "two-bounce")
        return solve.Request(sample, float(np.radians(degrees)), **settings)

    return make


@pytest.fixture
def set_working_space():
    """Switch the file's working space as the user would; skip where Blender has only one."""

    def switch(name):
        if not hasattr(bpy.ops.wm, "set_working_color_space") or bpy.app.version < (5, 0, 0):
            pytest.skip("working spaces came with Blender 5.0")
        bpy.ops.wm.set_working_color_space(convert_colors=True, working_space=name)
        assert bpy.data.colorspace.working_space == name

    return switch
