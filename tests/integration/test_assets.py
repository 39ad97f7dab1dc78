# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Asset libraries: built by a real second Blender, appended as by the Asset Browser, checked."""

import tempfile
from dataclasses import replace
from math import degrees

import bpy
import numpy as np
import pytest
from rough_spectra.addon.assets import build, catalogs, plan, previews
from rough_spectra.addon.interface.operators import build_assets
from rough_spectra.addon.material import preferences, storage
from rough_spectra.addon.samples import library as user_library
from rough_spectra.addon.samples import presets
from rough_spectra.core.errors import CancelledError, InputError, OutputError

from tests.desktop import other_extension
from tests.integration.support import contents, rgb_material, spectrum_csv

OTHERS = "# mine\nVERSION 1\n\n11111111-2222-3333-4444-555555555555:Metal/Rusty:Metal-Rusty\n"
NAMES = [
    "ColorChecker 14 Green σ 0°",
    "ColorChecker 14 Green σ 35.5°",
    "Brick σ 0°",
    "Brick σ 35.5°",
]
SENTENCE = "does nobody any harm"


@pytest.fixture(scope="module")
def library(tmp_path_factory, extension):
    """A folder with a catalog of somebody else's and an asset library of ours."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    rgb_material("Brick σ 0°")  # the name of an asset, in the user's file
    folder = tmp_path_factory.mktemp("assets")
    (folder / catalogs.FILE_NAME).write_text(OTHERS, encoding="utf-8")
    chosen = [plan.of_name("14"), plan.of_name("everyday/brick")]
    noted = replace(chosen[1].sample, notes=(SENTENCE,))
    assets = plan.assets([chosen[0], replace(chosen[1], sample=noted)], [0, 35.5], 63)
    counts = []
    settings = build.Settings(read_at="0:45a")
    built = build.build(assets, folder, settings, progress=lambda *count: counts.append(count))
    assert [material.name for material in bpy.data.materials] == ["Brick σ 0°"]
    assert [scene.name for scene in bpy.data.scenes] == ["Scene"]
    assert counts[-1][1] in (0, 4)
    return built


@pytest.fixture
def appended(library, extension):
    """The materials in an empty file, come there as from the Asset Browser."""

    def appended(link=False):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        path = str(library.blend)
        with bpy.data.libraries.load(path, link=link, assets_only=True) as (there, wanted):
            wanted.materials = sorted(there.materials)
        return {material.name: material for material in wanted.materials}

    return appended


def picture(material):
    size = tuple(material.preview.image_size)
    pixels = np.empty(size[0] * size[1] * 4, np.float32)
    material.preview.image_pixels_float.foreach_get(pixels)
    return pixels.reshape(size[1], size[0], 4)


def test_the_library_has_every_sample_at_every_sigma(library, appended):
    assert library.blend.name == "rough-spectra.blend"
    assert library.count == 4
    assert library.warnings == {}
    assert set(appended()) == set(NAMES)
    assert {path.name for path in library.blend.parent.iterdir()} == {
        library.blend.name,
        catalogs.FILE_NAME,
    }
    assert not bpy.data.objects


@pytest.mark.parametrize("link", [False, True])
def test_a_dragged_asset_passes_the_check(library, appended, main, tmp_path, link):
    found = appended(link)
    for name in NAMES:
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
        mesh.materials.append(found[name])
        bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    words = [word for name in NAMES for word in ("--object", name)]
    result = main("check", "--blend", path, "--max-delta-e", 0.01, *words)
    assert result.status == 0, result.err
    assert "0 of 4 materials exceed" in result.err


def test_an_asset_carries_its_spectrum(appended):
    found = appended()
    brick = storage.load(found["Brick σ 35.5°"])
    bundled = presets.load("everyday/brick")
    assert brick.sample.values.tolist() == bundled.values.tolist()
    assert (brick.sample.source, brick.sample.lab) == (bundled.source, bundled.lab)
    assert degrees(brick.sigma) == pytest.approx(35.5)
    assert brick.read_at == "0:45a"
    assert brick.sample.sigma_source == plan.CHOSEN
    assert found["Brick σ 35.5°"].node_tree.nodes.keys() == ["Material Output", "Principled BSDF"]


def test_an_asset_says_what_it_is(library, appended):
    ids = {
        line.split(":")[1]: line.split(":")[0]
        for line in library.catalogs.read_text("utf-8").splitlines()
        if line.count(":") == 2 and not line.startswith("#")
    }
    asset = appended()["Brick σ 35.5°"].asset_data
    assert asset.catalog_id == ids["Rough Spectra/Everyday"]
    assert (asset.author, asset.license) == ("Rough Spectra", "CC0-1.0")
    assert asset.copyright.startswith("Physically Based database")
    assert {tag.name for tag in asset.tags} == {"Rough Spectra", "Everyday", "σ 35.5°", "reading"}
    lines = asset.description.splitlines()
    assert lines[0] == f"σ 35.5°: {plan.CHOSEN}"
    assert lines[1].startswith("Predicted ΔE00: 0.00 at 0°:45°a, over all angles mean 0.")
    assert lines[2].startswith("Gloss: Estimate, not measured: none")
    assert lines[3].startswith("Source: Physically Based database")
    assert lines[4] == SENTENCE


def test_previews_are_balls_that_show_the_roughness(appended):
    """Where the sun grazes, a smooth ball fades like a cosine and a rough one does not."""
    found = appended()
    smooth, rough = (picture(found[f"ColorChecker 14 Green σ {s}°"]) for s in ("0", "35.5"))
    assert smooth.shape == (previews.PIXELS, previews.PIXELS, 4)
    assert smooth[0, 0].tolist() == [0, 0, 0, 0]
    middle = previews.PIXELS // 2
    assert smooth[middle, middle, 3] == 1
    assert smooth[middle, middle, 1] > 1.3 * max(smooth[middle, middle, [0, 2]])
    # Along the diagonal from the light's side, as shares of the brightest.
    diagonal = np.arange(previews.PIXELS)
    lines = [
        np.where(image[::-1][diagonal, diagonal, 3] == 1, image[::-1][diagonal, diagonal, 1], 0)
        for image in (smooth, rough)
    ]
    lit = [line / line.max() for line in lines]
    assert lines[0].argmax() < middle  # the light comes from above and from the left
    assert lit[1][25] > lit[0][25] + 0.02


def test_catalogs_of_others_stay(library):
    text = library.catalogs.read_text("utf-8")
    assert text.startswith(OTHERS)
    added = text.removeprefix(OTHERS).splitlines()
    assert [line.split(":")[1] for line in added] == [
        "Rough Spectra",
        "Rough Spectra/ColorChecker",
        "Rough Spectra/Everyday",
    ]


def test_catalogs_are_the_same_everywhere_and_added_once(tmp_path):
    path = tmp_path / catalogs.FILE_NAME
    first = catalogs.merge(path, ["ColorChecker"])
    assert first.ids == {"ColorChecker": "dc760637-7bcb-55bd-a3bf-009c2879030f"}
    path.write_text(first.text, "utf-8")
    assert catalogs.merge(path, ["ColorChecker"]) == first
    moved = first.text.replace(":Rough Spectra/ColorChecker:", ":Charts/Mine:")
    path.write_text(moved, "utf-8")
    assert catalogs.merge(path, ["ColorChecker"]) == catalogs.Merged(moved, first.ids)
    own = "VERSION 1\n99999999-2222-3333-4444-555555555555:Rough Spectra/ColorChecker:x"
    path.write_text(own, "utf-8")
    again = catalogs.merge(path, ["ColorChecker"])
    assert again.ids["ColorChecker"].startswith("99999999")
    assert again.text.startswith(own + "\n")


@pytest.mark.parametrize(("data", "part"), [(b"VERSION 2\n", "VERSION 2"), (b"\xff\xfe", "UTF-8")])
def test_a_catalog_file_that_is_not_understood_is_left_alone(tmp_path, data, part):
    (tmp_path / catalogs.FILE_NAME).write_bytes(data)
    with pytest.raises(InputError, match=part):
        build.build(plan.assets([plan.of_name("14")], [10], 63), tmp_path)
    assert contents(tmp_path) == {catalogs.FILE_NAME: data}


def test_titles_make_one_catalog_each():
    assert catalogs.title("colorchecker") == "ColorChecker"
    assert catalogs.title("my/paints: 2024") == "My paints 2024"
    assert catalogs.title(" ") == "Other"


def test_names_are_distinct_fit_and_keep_their_sigma():
    [green] = [plan.of_name("14")]
    long = replace(green.sample, name="ä" * 100)
    twice = [replace(green, sample=long), replace(green, sample=long)]
    names = [asset.name for asset in plan.assets(twice, [10, 10, 20.5], 63)]
    assert len(names) == len(set(names)) == 4
    assert all(len(name.encode()) <= 63 for name in names)
    assert {name.rpartition(" σ ")[2] for name in names} == {"10°", "20.5°"}


def test_a_sample_keeps_its_own_sigma_where_none_is_chosen(tmp_path):
    [brick] = plan.assets([plan.of_name("everyday/brick")], [], 63)
    assert degrees(brick.sigma) == pytest.approx(20)
    assert brick.sample.sigma_source.startswith("Estimate")
    assert brick.name == "Brick"  # nothing to tell apart by σ
    [again] = plan.assets([plan.of_name("everyday/brick")], [20], 63)
    assert again.sample.sigma_source == brick.sample.sigma_source
    path = spectrum_csv(tmp_path / "paper.csv", "paper")
    with pytest.raises(InputError, match="'paper': it has no σ of its own; say which"):
        plan.assets(plan.of_file(path), [], 63)
    assert plan.assets(plan.of_file(path), [5], 63)[0].catalog == "Paper"


@pytest.mark.parametrize("sigma", [-1, 60.5, float("nan")])
def test_an_impossible_sigma_is_refused(sigma):
    with pytest.raises(InputError, match="give 0 to 60 degrees"):
        plan.assets([plan.of_name("14")], [sigma], 63)


def test_stopping_leaves_nothing(tmp_path, monkeypatch):
    temporary = tmp_path / "temporary"  # other processes have theirs in the usual one
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))

    def stop(_done, _total):
        raise KeyboardInterrupt

    with pytest.raises(CancelledError, match="nothing was written"):
        build.build(plan.assets([plan.of_name("14")], [10], 63), tmp_path / "new", progress=stop)
    assert list(tmp_path.iterdir()) == [temporary]
    assert list(temporary.glob("rough-spectra-*")) == []


def test_wheels_of_other_extensions_stay(blender, tmp_path):
    """The second Blender is started as the user's, and shares the folder of their extensions."""
    user = tmp_path / "user"
    package = other_extension.build(tmp_path)
    built = blender(
        f"""
        package = load_extension()
        package.register()
        bpy.ops.extensions.package_install_files(
            filepath={str(package)!r}, repo="user_default", enable_on_install=True
        )
        build = importlib.import_module("rough_spectra.addon.assets.build")
        plan = importlib.import_module("rough_spectra.addon.assets.plan")
        from pathlib import Path
        assets = plan.assets([plan.of_name("everyday/brick")], [10], 63)
        built = build.build(assets, Path({str(tmp_path / "library")!r}))
        print()
        print(json.dumps([built.count, importlib.import_module("tiny_wheel").ANSWER]))
        package.unregister()
        """,
        BLENDER_USER_RESOURCES=str(user),
    )
    assert built == [1, 42]
    found = list(user.glob(f"extensions/.local/lib/*/site-packages/{other_extension.MODULE}.py"))
    assert len(found) == 1


def test_a_folder_that_is_a_file_is_refused_before_anything_starts(tmp_path):
    (tmp_path / "file").write_text("x")
    with pytest.raises(OutputError, match="is a file; choose another folder"):
        build.build(plan.assets([plan.of_name("14")], [10], 63), tmp_path / "file")


def test_a_folder_becomes_a_library_of_the_preferences_once(tmp_path, extension):
    libraries = bpy.context.preferences.filepaths.asset_libraries
    before = len(libraries)
    try:
        assert build.add_to_preferences(tmp_path).startswith("Rough Spectra")
        assert build.add_to_preferences(tmp_path / "." / "") is None
        assert len(libraries) == before + 1
    finally:
        libraries.remove(libraries[-1])


def test_bad_words_on_the_command_line_write_nothing(main, tmp_path):
    output = tmp_path / "library"
    for words, part in (
        (["--collection", "colorcheker"], "no collection 'colorcheker'"),
        (["--preset", "no such thing"], "no such thing"),
        (["--file", tmp_path / "none.csv"], "none.csv"),
        (["--sigma", "95"], "σ is 95°"),
    ):
        result = main("assets", "--output", output, *words)
        assert result.status == 2
        assert part in result.sentence
    assert not output.exists()


def test_the_verb_says_where_the_materials_read_right(main, tmp_path):
    words = ("--preset", "14 green", "--sigma", "30", "--read-at", "45as75")
    assert main("assets", "--output", tmp_path, *words).status == 0
    [blend] = tmp_path.glob("*.blend")
    with bpy.data.libraries.load(str(blend), assets_only=True) as (there, wanted):
        wanted.materials = there.materials
    [material] = wanted.materials
    assert material.rough_spectra.read_at == "45as75"
    assert "at 45°:as75°, over all" in material.asset_data.description


@pytest.mark.parametrize("collection", ["everyday", "*"])
def test_the_operator_says_what_is_wrong_with_sigma(extension, tmp_path, collection):
    with pytest.raises(RuntimeError, match="give degrees with blanks between them"):
        bpy.ops.rough_spectra.build_assets(
            directory=str(tmp_path), collection=collection, sigmas="ten"
        )
    assert list(tmp_path.iterdir()) == []


def test_all_are_the_presets_and_the_users_own(extension, tmp_path, monkeypatch):
    monkeypatch.setattr(preferences, "user_folder", lambda: tmp_path)
    wall = replace(presets.load("plaster"), name="My wall")
    heat = replace(wall, name="My wall, warm", kind="emissivity")
    user_library.add([wall, heat], "walls", tmp_path)
    user_library.contents(tmp_path)
    items = build_assets.collection_items(None, None)
    assert [(name, label) for name, label, _ in items] == [
        ("*", "All"),
        ("colorchecker", "ColorChecker (Bundled)"),
        ("everyday", "Everyday (Bundled)"),
        ("walls", "Walls (Yours)"),
    ]
    chosen = plan.of_all(tmp_path)
    # An emissivity has no color, of which no material is made.
    assert len(chosen) == len(presets.names()) + 1
    assert (chosen[-1].sample.name, chosen[-1].catalog) == ("My wall", "Walls")
