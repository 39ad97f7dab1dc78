# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a bake writes, read back by other means than wrote it."""

import csv
import hashlib
import itertools
import json

import bpy
import numpy as np
import pytest
from rough_spectra.addon.support import shown_text

from tests.integration.support import ODD_NAME, ROOT, contents, rgb_material, spectrum_csv
from tests.json_schema import allowed

ENDINGS = (
    "json",
    "predicted.csv",
    "measured.csv",
    "predicted.cgats.txt",
    "measured.cgats.txt",
    "predicted-1.spectral.exr",
    "predicted-2.spectral.exr",
    "measured.exr",
)
SPECTRAL = "predicted.spectral.exr"
HALF = 2**-11  # relative rounding of a half float of 11 significant bits


def rows_of(path):
    """Comments, and rows as dictionaries, by Python's own csv module."""
    lines = path.read_text(encoding="utf-8").splitlines()
    comments = list(itertools.takewhile(lambda line: line.startswith("#"), lines))
    return comments, list(csv.DictReader(lines[len(comments) :]))


def cgats_words(line):
    """Split at tabs outside quotation marks; a doubled mark inside stands for one."""
    words, word, quoted = [], "", False
    for index, mark in enumerate(line):
        if mark == '"':
            quoted = not quoted
            if quoted and index and line[index - 1] == '"':
                word += mark
        elif mark == "\t" and not quoted:
            words.append(word)
            word = ""
        else:
            word += mark
    assert not quoted, f"quotation mark left open: {line}"
    return [*words, word]


def cgats_tables(path):
    """Parse CGATS.17: a list of (keywords, field names, rows)."""
    lines = path.read_text(encoding="utf-8").splitlines()
    assert lines.pop(0) == "CGATS.17"
    tables, keywords, fields, rows, section = [], {}, [], [], ""
    for line in lines:
        if line in ("BEGIN_DATA_FORMAT", "BEGIN_DATA"):
            section = line
        elif line == "END_DATA":
            tables.append((keywords, fields, rows))
            keywords, fields, rows, section = {}, [], [], ""
        elif line == "END_DATA_FORMAT":
            section = ""
        elif section == "BEGIN_DATA_FORMAT":
            fields += cgats_words(line)
        elif section == "BEGIN_DATA":
            rows.append(cgats_words(line))
        elif line:
            keyword, value = cgats_words(line)
            keywords[keyword] = value
    assert not keywords
    return tables


def exr(path):
    """Pixels, names of channels and attributes, by OpenImageIO."""
    bpy.utils.expose_bundled_modules()
    import OpenImageIO

    image = OpenImageIO.ImageInput.open(str(path))
    spec = image.spec()
    pixels = image.read_image(OpenImageIO.FLOAT)
    attributes = {attribute.name: attribute.value for attribute in spec.extra_attribs}
    image.close()
    return pixels, list(spec.channelnames), attributes | {"format": str(spec.format)}


def predicted(bake):
    return [entry for entry in bake.document["readings"] if entry["predicted"]]


def by_material(bake):
    return {entry["material"]: entry for entry in bake.document["readings"]}


def test_a_bake_writes_these_files_and_no_others(baked):
    assert sorted(baked.files) == sorted(f"chart.{ending}" for ending in ENDINGS)
    assert "wrote" in baked.result.err
    assert all(name in baked.result.err for name in baked.files)


def test_the_same_bake_twice_gives_the_same_bytes(baked, scene_file, run, tmp_path):
    names = [entry["material"] for entry in baked.document["readings"] if not entry["surface"]]
    words = [word for name in names for word in ("--material", name)]
    base = tmp_path / "again" / "chart"
    result = run("bake", "--blend", scene_file, "--output", base, "--object", "Panel", *words)
    assert result.status == 0
    assert contents(base.parent) == baked.files


def test_a_bake_leaves_the_blend_file_as_it_was(scene, main, tmp_path):
    before = scene.read_bytes()
    folder = set(tmp_path.iterdir())
    assert main("bake", "--blend", scene, "--output", tmp_path / "out/x").status == 0
    assert main("check", "--blend", scene).status == 0
    assert scene.read_bytes() == before
    assert set(tmp_path.iterdir()) - folder == {tmp_path / "out"}


def test_json_says_what_it_holds(baked):
    document = baked.document
    assert document["format"] == "rough-spectra-readings"
    assert document["schema"] == 2
    assert document["blender"] == bpy.app.version_string
    assert document["working_space"] == "Linear Rec.709"
    assert document["instrument"] == "45a:0"
    assert (document["shard"], document["shards"]) == (1, 1)
    assert {"values", "wavelengths", "xyz", "measured"} <= set(document["units"])
    assert document["aperture"]
    differences = [entry["delta_e_00"] for entry in document["readings"] if entry["predicted"]]
    assert document["largest_delta_e_00"] == max(differences) <= 0.05


def test_json_keeps_predicted_and_measured_under_keys_of_their_own(baked):
    assert len(predicted(baked)) == 5
    for entry in baked.document["readings"]:
        assert "wavelengths" not in entry["measured"]
        assert set(entry["measured"]) == {"rgb", "spread", "illuminant", "xyz", "lab", "colors"}
        if entry["predicted"]:
            assert "rgb" not in entry["predicted"]
            assert len(entry["predicted"]["values"]) == len(entry["predicted"]["wavelengths"])


def test_json_tells_the_node_and_how_its_color_was_derived(baked, scene_file):
    bpy.ops.wm.open_mainfile(filepath=str(scene_file))
    for entry in baked.document["readings"]:
        material = bpy.data.materials[entry["material"]]
        node, derivation = entry["node"], entry["derivation"]
        if entry["material"] == "Patterned":  # its surface is a sum of two shaders
            assert node is derivation is None
            continue
        shader = next(n for n in material.node_tree.nodes if n.type == "BSDF_DIFFUSE")
        assert (node["name"], node["shader"], node["gloss"]) == (shader.name, "diffuse", None)
        assert node["color"] == list(shader.inputs["Color"].default_value)[:3]
        assert node["roughness"] == shader.inputs["Roughness"].default_value
        if not entry["predicted"]:
            assert derivation is None
            continue
        assert (derivation["state"], derivation["reasons"]) == ("fresh", [])
        assert derivation["color"] == pytest.approx(node["color"], abs=1e-7)
        assert derivation["delta_e_instrument"] == pytest.approx(entry["delta_e_00"], abs=0.05)
        told = {"virtual instrument": "45a:0", "illuminant": entry["predicted"]["illuminant"]}
        assert told.items() <= derivation["settings"].items()


def test_json_has_the_albedo_behind_each_reading(baked):
    from rough_spectra.core import reading

    for part in (entry["predicted"] for entry in predicted(baked)):
        sigma = np.radians(part["sigma_degrees"])
        read = reading.from_albedo(np.array(part["albedo"]), sigma, part["model"], "45a:0")
        assert read == pytest.approx(part["values"], abs=2e-6)
        assert part["instrument"] == "45a:0"


def test_json_has_colors_in_the_spaces_that_pipelines_exchange(baked):
    import colour

    spaces = {"Linear Rec.2020": "ITU-R BT.2020", "ACEScg": "ACEScg"}
    for entry in baked.document["readings"]:
        parts = (
            (entry["measured"], "rgb"),
            (entry["node"], "color"),
            (entry["predicted"], "preview"),
        )
        for part, own in parts:
            if part is None:
                continue
            assert set(part["colors"]) == {"Linear Rec.709", *spaces}
            assert part["colors"]["Linear Rec.709"] == pytest.approx(part[own], abs=2e-6)
            for name, theirs in spaces.items():
                matrix = colour.matrix_RGB_to_RGB("ITU-R BT.709", theirs, "Bradford")
                # Blender's own Rec.709, above all that of 4.5, has fewer digits.
                assert part["colors"][name] == pytest.approx(matrix @ part[own], abs=5e-5)


def test_the_schema_describes_the_document_and_nothing_else(baked):
    schema = json.loads((ROOT / "addon/readings/readings.schema.json").read_text("utf-8"))
    assert allowed(schema, baked.document)
    for spoil in (
        lambda document: document["readings"][0]["predicted"].pop("albedo"),
        lambda document: document["readings"][0]["node"].update(color=[0.5, 0.5]),
        lambda document: document["readings"][0]["predicted"]["colors"].update(ACEScg="white"),
        lambda document: document["readings"][0].update(more=1),
    ):
        document = json.loads(json.dumps(baked.document))
        spoil(document)
        assert not allowed(schema, document)


def test_json_is_read_back_whole(baked):
    from rough_spectra.addon.readings import json_document

    found = json_document.from_json(baked.path("json"))
    assert json_document.to_json(found) == baked.files["chart.json"]
    assert found.entries[0].predicted.colors["ACEScg"] == tuple(
        baked.document["readings"][0]["predicted"]["colors"]["ACEScg"]
    )


def test_json_is_read_back_as_samples(baked, main, tmp_path):
    from rough_spectra.addon.matching import solve
    from rough_spectra.addon.material import storage
    from rough_spectra.addon.samples import readers

    samples = {sample.name: sample for sample in readers.read(baked.path("json"))}
    predicted = [entry for entry in baked.document["readings"] if entry["predicted"]]
    assert len(predicted) > 3
    for entry in predicted:
        part = entry["predicted"]
        name = ": ".join(text for text in (entry["surface"], entry["material"]) if text)
        reading, albedo = samples.pop(name), samples.pop(f"{name} (albedo)")
        assert (reading.kind, albedo.kind) == ("reading", "albedo")
        assert reading.values.tolist() == part["values"]
        assert albedo.values.tolist() == part["albedo"]
        for sample in (reading, albedo):
            assert sample.wavelengths.tolist() == part["wavelengths"]
            assert sample.sigma_degrees == part["sigma_degrees"]
        assert (reading.instrument, reading.lab) == (entry["instrument"], tuple(part["lab"]))
    assert samples == {}
    # Materials that are made of the reading and of the albedo are predicted to read the same again.
    names = ("Alpha", "Alpha (albedo)")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for name in names:
        rgb_material(name)
    [part] = [e["predicted"] for e in predicted if (e["material"], e["surface"]) == ("Alpha", "")]
    words = ("--by-name", baked.path("json"), "--model", part["model"])
    assert main("assign", *words, "--output", tmp_path / "again.blend").status == 0
    for name in names:
        again = solve.target_reading(storage.load(bpy.data.materials[name]))
        assert again == pytest.approx(part["values"], abs=1e-6)


def test_prediction_is_the_stored_spectrum_where_that_is_a_reading(baked):
    part = by_material(baked)[ODD_NAME]["predicted"]
    assert part["kind"] == "reading"
    assert part["wavelengths"] == [400 + 10 * band for band in range(31)]
    assert part["values"] == pytest.approx([0.2 + 0.01 * band for band in range(31)], abs=1e-6)


def test_lab_of_another_illuminant_and_observer_is_said_to_be_such(baked):
    entry = by_material(baked)["Beta"]
    assert (entry["predicted"]["illuminant"], entry["predicted"]["observer"]) == ("A", 10)
    assert entry["measured"]["illuminant"] == "A"
    _, rows = rows_of(baked.path("predicted.csv"))
    row = next(row for row in rows if row["material"] == "Beta")
    assert (row["illuminant"], row["observer"]) == ("A", "10")


def test_surface_of_an_object_is_measured_without_a_spectrum(baked):
    found = {entry["material"]: entry for entry in baked.document["readings"] if entry["surface"]}
    assert set(found) == {"Alpha", "Plain"}
    assert {entry["surface"] for entry in found.values()} == {"Panel"}
    plain = found["Plain"]
    assert plain["predicted"] is None
    assert plain["delta_e_00"] is None
    # A Diffuse BSDF without roughness is Lambertian: it reads its own color.
    assert plain["measured"]["rgb"] == pytest.approx([0.2, 0.4, 0.6], abs=2e-6)
    assert plain["measured"]["spread"] == pytest.approx([0, 0, 0], abs=1e-6)
    [flat] = [
        e for e in baked.document["readings"] if (e["material"], e["surface"]) == ("Alpha", "")
    ]
    assert flat["spot"] is None
    rgb = found["Alpha"]["measured"]["rgb"]
    assert rgb == pytest.approx(flat["measured"]["rgb"], abs=2e-6)
    spot = found["Alpha"]["spot"]
    assert (spot["diameter"], spot["covered"], spot["is_alone"]) == (8, 1, True)
    assert spot["point"] == pytest.approx([2 / 3, 1 / 3, 0], abs=1e-5)
    assert spot["normal"] == pytest.approx([0, 0, 1], abs=1e-5)
    assert spot["spread_95"] < 0.01


def test_pattern_and_glow_of_a_hand_made_material_are_measured(baked):
    measured = by_material(baked)["Patterned"]["measured"]
    # Blender's checker is .8 and .2; the emission adds its strength over a radiance of 1.
    assert np.array(measured["rgb"]) == pytest.approx(np.full(3, 0.5 + 0.25), abs=1e-3)
    assert np.array(measured["spread"]) == pytest.approx(np.full(3, 0.3), abs=1e-3)


def test_csv_of_one_grid_reads_back_through_our_own_reader(scene_file, main, tmp_path):
    from rough_spectra.addon.samples import readers

    words = ("--material", "Alpha", "--material", "Beta", "--material", "Delta")
    base = tmp_path / "x"
    result = main("bake", "--blend", scene_file, "--output", base, "--predicted-only", *words)
    assert result.status == 0
    samples = readers.read(tmp_path / "x.predicted.csv")
    from rough_spectra.addon.matching import solve
    from rough_spectra.addon.material import storage

    assert [sample.name for sample in samples] == [
        "ColorChecker 14 Green",
        "ColorChecker 05 Blue flower",
        "ColorChecker 20 Neutral 8 (.23 D)",
    ]
    for sample, name in zip(samples, words[1::2], strict=True):
        wanted = solve.target_reading(storage.load(bpy.data.materials[name]))
        assert sample.kind == "reading"
        assert sample.instrument == "45a:0"
        assert np.abs(sample.values - wanted).max() <= 0.5e-6 * 1.001


@pytest.mark.parametrize("name", [ODD_NAME, "#FF8800", " # 2"])
def test_a_name_like_a_comment_reads_back_too(name, scene_file, main, tmp_path):
    from rough_spectra.addon.samples import readers

    bpy.ops.wm.open_mainfile(filepath=str(scene_file))
    bpy.data.materials[ODD_NAME].name = name
    words = ("--material", name, "--predicted-only", "--output", tmp_path / "x")
    assert main("bake", *words).status == 0
    (sample,) = readers.read(tmp_path / "x.predicted.csv")
    assert sample.name == "paper"


def test_the_table_and_the_document_have_the_albedos_that_are_open(main, tmp_path):
    from dataclasses import replace

    from rough_spectra.addon.matching.solve import Request
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.readings import json_document
    from rough_spectra.addon.samples import presets
    from rough_spectra.core import feasible

    green, white = (presets.load(f"colorchecker/{name}") for name in ("14-green", "19-white-9-5"))
    samples = {
        "As read": replace(green, kind="reading"),
        "By a sphere": replace(green, kind="reading", instrument="di:8"),
        "Known": replace(green, kind="albedo"),
        "Too bright": replace(white, kind="reading", values=white.values * 1.3),
    }
    derive.assign(
        [
            (rgb_material(name), Request(sample, 0.5, "two-bounce"))
            for name, sample in samples.items()
        ]
    )
    words = [word for name in samples for word in ("--material", name)]
    assert main("bake", "--predicted-only", "--output", tmp_path / "x", *words).status == 0
    _, rows = rows_of(tmp_path / "x.predicted.csv")
    lowest, highest = (
        [name for name in rows[0] if name.startswith(f"albedo {end} ")] for end in ("min", "max")
    )
    assert len(lowest) == len(highest) == green.wavelengths.size
    entries = json_document.from_json(tmp_path / "x.json").entries
    for row, entry, sample in zip(rows, entries, samples.values(), strict=True):
        found = feasible.albedo_range(sample.values, "two-bounce", sample.instrument)
        low, high = found.lowest, found.highest
        if sample.kind == "albedo":
            low = high = sample.values
        if entry.material == "Too bright":
            assert {row[name] for name in (*lowest, *highest)} == {""}
            assert entry.predicted.albedo_lowest == entry.predicted.albedo_highest == ()
            continue
        for columns, told, expected in (
            (lowest, entry.predicted.albedo_lowest, low),
            (highest, entry.predicted.albedo_highest, high),
        ):
            # Six digits are kept.
            np.testing.assert_allclose(told, expected, rtol=0, atol=0.51e-6)
            np.testing.assert_allclose(
                [float(row[name]) for name in columns], told, rtol=0, atol=1e-9
            )


def test_fine_wavelengths_keep_their_digits(main, tmp_path):
    from rough_spectra.addon.matching.solve import Request
    from rough_spectra.addon.material import derive
    from rough_spectra.addon.samples import readers

    lines = ["wavelength,fine"]
    lines += [f"{380 + 20 * band / 3 + 0.0001},{0.3}" for band in range(61)]
    lines += ["780.00012,0.3", "780.00013,0.3"]
    source = tmp_path / "fine.csv"
    source.write_text("\n".join(lines), encoding="utf-8")
    sample = readers.read(source)[0]
    derive.assign([(rgb_material("Fine"), Request(sample, 0.1))])
    assert main("bake", "--predicted-only", "--output", tmp_path / "x").status == 0
    (found,) = readers.read(tmp_path / "x.predicted.csv")
    assert np.array_equal(found.wavelengths, sample.wavelengths)
    ((_, fields, _),) = cgats_tables(tmp_path / "x.predicted.cgats.txt")
    assert [float(name[11:]) for name in fields if name.startswith("SPECTRAL_NM")] == list(
        sample.wavelengths
    )


def test_csv_headers_say_units_illuminant_observer_instrument_aperture(baked):
    for ending in ("predicted.csv", "measured.csv"):
        comments, rows = rows_of(baked.path(ending))
        text = "\n".join(comments)
        for word in ("units: fraction", "D65/2°", "instrument: 45a:0", "aperture:", "nm"):
            assert word in text
        assert len(rows) == (5 if ending == "predicted.csv" else 7)


def test_csv_agrees_with_json(baked):
    _, rows = rows_of(baked.path("predicted.csv"))
    for row, entry in zip(rows, predicted(baked), strict=True):
        part = entry["predicted"]
        assert shown_text.from_cell(row["material"]) == entry["material"]
        for nm, value in zip(part["wavelengths"], part["values"], strict=True):
            assert float(row[f"{nm:g} nm"]) == value
        empty = [key for key, cell in row.items() if key.endswith(" nm") and not cell]
        # Of each band that the sample lacks the value and two albedos.
        assert len(empty) == 3 * (81 - len(part["wavelengths"]))
    _, rows = rows_of(baked.path("measured.csv"))
    for row, entry in zip(rows, baked.document["readings"], strict=True):
        assert [float(row[key]) for key in "RGB"] == entry["measured"]["rgb"]
        found = row["delta_e_00"]
        assert (float(found) if found else None) == entry["delta_e_00"]


def test_no_table_or_image_mixes_predicted_and_measured(baked):
    assert not any(" nm" in line for line in rows_of(baked.path("measured.csv"))[1][0])
    for _, fields, _ in cgats_tables(baked.path("measured.cgats.txt")):
        assert not any(field.startswith("SPECTRAL") for field in fields)
    assert exr(baked.path("measured.exr"))[1] == ["R", "G", "B"]
    comments, rows = rows_of(baked.path("predicted.csv"))
    assert "predicted" in comments[1]
    assert "R" not in rows[0]


def test_cgats_is_one_table_with_columns_for_what_differs(baked):
    """Measurement software takes the first table of a file and leaves the others."""
    for part in ("predicted", "measured"):
        [(keywords, fields, rows)] = cgats_tables(baked.path(f"{part}.cgats.txt"))
        assert int(keywords["NUMBER_OF_FIELDS"]) == len(fields) == len(set(fields))
        assert int(keywords["NUMBER_OF_SETS"]) == len(rows)
        assert all(len(row) == len(fields) for row in rows)
        assert keywords["MEASUREMENT_GEOMETRY"] == "45a:0"
        assert "Illumination" not in keywords["MEASUREMENT_SOURCE"]
        for row in rows:
            told, entry = dict(zip(fields, row, strict=True)), baked.document["readings"]
            data = entry[int(row[0]) - 1][part]
            assert told["ROUGH_SPECTRA_ILLUMINANT"] == data["illuminant"]
            if part == "predicted":
                assert told["ROUGH_SPECTRA_OBSERVER"] == str(data["observer"])
    # Two grids, of 5 and of 10 nm: all of them are told at 10 nm.
    assert len(rows) == len(baked.document["readings"])
    text = baked.path("predicted.cgats.txt").read_text("utf-8")
    declared = {line.split("\t")[1] for line in text.splitlines() if line.startswith("KEYWORD\t")}
    assert {'"ROUGH_SPECTRA_ILLUMINANT"', '"ROUGH_SPECTRA_OBSERVER"'} <= declared


def test_cgats_holds_fractions_under_the_names_that_mean_so(baked):
    [(_, fields, rows)] = cgats_tables(baked.path("predicted.cgats.txt"))
    start = fields.index(next(name for name in fields if name.startswith("SPECTRAL_NM")))
    bands = [float(name.removeprefix("SPECTRAL_NM")) for name in fields[start:]]
    assert bands == [400 + 10 * number for number in range(31)]
    found = {int(row[0]): row for row in rows}
    for number, entry in enumerate(baked.document["readings"], 1):
        part = entry["predicted"]
        if not part:
            assert number not in found
            continue
        assert shown_text.from_cell(found[number][1]) == entry["material"]
        own = dict(zip(part["wavelengths"], part["values"], strict=True))
        read = [float(cell) for cell in found[number][start:]]
        assert read == pytest.approx([own[nm] for nm in bands], abs=1e-9)


def test_argyllcms_takes_all_of_it(main, tmp_path):
    """Its tools convert the predictions, and compute the same Lab from the spectra."""
    import shutil
    import subprocess

    from rough_spectra.addon import api

    if shutil.which("txt2ti3") is None:
        pytest.skip("ArgyllCMS is not installed (Debian's package argyll)")
    models, pairs = ("surface", "two-bounce"), []
    for number, name in enumerate(api.presets("colorchecker")[:12]):
        sample = api.find(name)
        bands = slice(None, 71, 2)  # 380 to 730 nm in steps of 10
        wavelengths, values = sample.wavelengths[bands], sample.values[bands]
        sample = api.Sample(name, wavelengths, values, "reading")
        wanted = api.request(sample, 0.35, model=models[number % 2], illuminant="D50")
        pairs.append((rgb_material(name), wanted))
    api.assign(pairs)
    words = ("--predicted-only", "--format", "cgats", "--output", tmp_path / "chart")
    assert main("bake", *words).status == 0

    def tool(*words):
        done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout + done.stderr

    ours = "chart.predicted.cgats.txt"
    assert "exactly one table" not in tool("txt2ti3", ours, "theirs")
    assert "NUMBER_OF_SETS 12" in (tmp_path / "theirs.ti3").read_text("latin-1")
    tool("spec2cie", "theirs.ti3", "computed.ti3")
    told = tool("colverify", "-v", ours, "computed.ti3")
    assert "No of test patches = 12" in told
    [peak] = (line for line in told.splitlines() if "Total errors" in line)
    # 0.018: its weights at 10 nm are its own.
    assert float(peak.partition("peak = ")[2].partition(",")[0]) <= 0.05


def test_cgats_of_the_measurement_agrees_with_json(baked):
    found = {}
    for keywords, fields, rows in cgats_tables(baked.path("measured.cgats.txt")):
        assert int(keywords["NUMBER_OF_FIELDS"]) == len(fields)
        found |= {int(row[0]): [float(cell) for cell in row[-6:]] for row in rows}
    for number, entry in enumerate(baked.document["readings"], 1):
        assert found[number] == entry["measured"]["xyz"] + entry["measured"]["lab"]


def test_spectral_exr_follows_the_layout(baked):
    groups = {}
    for entry in predicted(baked):
        groups.setdefault(tuple(entry["predicted"]["wavelengths"]), []).append(entry)
    for number, (wavelengths, entries) in enumerate(groups.items(), 1):
        pixels, channels, attributes = exr(baked.path(f"predicted-{number}.spectral.exr"))
        bands = [f"T.{nm:.6f}nm".replace(".", ",").replace("T,", "T.") for nm in wavelengths]
        assert channels == ["R", "G", "B", *bands]
        assert attributes["spectralLayoutVersion"] == "1.0"
        assert attributes["compression"] == "zip"
        assert attributes["format"] == "half"
        assert attributes["DateTime"] == "1970:01:01 00:00:00"
        middle = pixels[8, 8::16]
        wanted = [e["predicted"]["preview"] + e["predicted"]["values"] for e in entries]
        assert middle.shape == (len(entries), len(channels))
        assert np.abs(middle - wanted).max() <= HALF
        assert np.ptp(pixels[:16, :16], axis=(0, 1)).max() == 0


def test_channel_names_are_those_of_the_paper(baked):
    _, channels, _ = exr(baked.path("predicted-1.spectral.exr"))
    assert "T.400,000000nm" in channels


def test_measured_image_shows_what_was_measured(baked):
    pixels, _, attributes = exr(baked.path("measured.exr"))
    entries = baked.document["readings"]
    rows = -(-len(entries) // 6)
    assert pixels.shape == (16 * rows, 96, 3)
    swatches = pixels[8::16, 8::16].reshape(-1, 3)
    wanted = [entry["measured"]["rgb"] for entry in entries]
    assert np.abs(swatches[: len(entries)] - wanted).max() <= HALF
    assert not swatches[len(entries) :].any()
    assert "spectralLayoutVersion" not in attributes
    assert attributes["DateTime"] == "1970:01:01 00:00:00"


def test_one_grid_makes_one_spectral_image_named_plainly(scene_file, main, tmp_path):
    words = ("--material", "Alpha", "--predicted-only", "--format", "exr")
    assert main("bake", "--blend", scene_file, "--output", tmp_path / "x", *words).status == 0
    assert set(contents(tmp_path)) == {"x.json", f"x.{SPECTRAL}"}


def test_without_a_measurement_there_are_no_measured_files(scene_file, main, tmp_path):
    words = ("--material", "Alpha", "--predicted-only")
    assert main("bake", "--blend", scene_file, "--output", tmp_path / "x", *words).status == 0
    assert not [name for name in contents(tmp_path) if "measured" in name]


@pytest.mark.parametrize("shards", [2, 3])
def test_merged_parts_equal_the_whole_byte_for_byte(shards, scene_file, main, tmp_path, baked):
    """Seven surfaces, and two materials among three shards, so that one part is empty."""
    names = ["Alpha", "Beta", ODD_NAME, "Delta", "Patterned"]
    names = names if shards == 2 else names[:3:2]
    words = [word for name in names for word in ("--material", name)]
    words += ["--object", "Panel"] if shards == 2 else []
    common = ("bake", "--blend", scene_file, *words, "--output")
    for number in range(1, shards + 1):
        result = main(*common, tmp_path / "parts/chart", "--shard", f"{number}/{shards}")
        assert result.status == 0
    parts = sorted((tmp_path / "parts").iterdir())
    assert [part.name for part in parts] == [
        f"chart.part-{number}-of-{shards}.json" for number in range(1, shards + 1)
    ]
    assert main("merge", *reversed(parts), "--output", tmp_path / "merged/chart").status == 0
    if shards == 2:
        whole = baked.files
    else:
        assert main(*common, tmp_path / "whole/chart").status == 0
        whole = contents(tmp_path / "whole")
    assert contents(tmp_path / "merged") == whole


def test_a_second_bake_leaves_nothing_of_the_first_and_all_of_others(baked, main, tmp_path):
    """A measurement may be called as our files are: what we did not write stays."""
    source = baked.path("json")
    assert main("merge", source, "--output", tmp_path / "x").status == 0
    assert len(contents(tmp_path)) == len(ENDINGS)
    others = {
        "x.measured.cgats.txt": (tmp_path / "x.measured.cgats.txt")
        .read_bytes()
        .replace(b"Rough Spectra ", b"i1Profiler "),
        "x.predicted-3.spectral.exr": b"no image",
        "x.measured.csv.bak": b"# creator: Rough Spectra 0",
        "x.part-1-of-2.json": source.read_bytes(),
        "x2.measured.csv": b"# creator: Rough Spectra 0",
    }
    for name, content in others.items():
        (tmp_path / name).write_bytes(content)
    assert main("merge", source, "--output", tmp_path / "x", "--format", "csv").status == 0
    left = contents(tmp_path)
    assert {name: left.pop(name) for name in others} == others
    assert set(left) == {"x.json", "x.predicted.csv", "x.measured.csv"}


def test_a_file_of_the_first_bake_that_is_protected_stops_the_second(baked, main, tmp_path):
    assert main("merge", baked.path("json"), "--output", tmp_path / "x").status == 0
    (tmp_path / "x.measured.exr").chmod(0o444)
    before = contents(tmp_path)
    words = ("merge", baked.path("json"), "--output", tmp_path / "x", "--format", "csv")
    result = main(*words)
    assert result.status == 2
    assert "x.measured.exr is write-protected" in result.sentence
    assert contents(tmp_path) == before


def test_images_name_who_is_where(baked):
    _, _, attributes = exr(baked.path("predicted-1.spectral.exr"))
    names = attributes["ImageDescription"].partition("left: ")[2].split("; ")
    assert [name.partition(" (")[0] for name in names] == ["Alpha", "Beta", "Delta", "Alpha"]
    models = [e["predicted"]["model"] for e in baked.document["readings"] if e["predicted"]]
    assert all(name.rpartition(" (")[2][:-1] in models for name in names)


def test_bytes_do_not_depend_on_the_folder(baked, scene_file, main, tmp_path):
    moved = tmp_path / "other" / "named otherwise.blend"
    moved.parent.mkdir()
    moved.write_bytes(scene_file.read_bytes())
    words = ("--predicted-only", "--format", "csv")
    hashes = set()
    for number, blend in enumerate((scene_file, moved)):
        base = tmp_path / str(number) / "x"
        assert main("bake", "--blend", blend, "--output", base, *words).status == 0
        hashes.add(hashlib.sha256(repr(sorted(contents(base.parent).items())).encode()).digest())
    assert len(hashes) == 1


def test_spectrum_helper_writes_what_the_reader_reads(tmp_path):
    from rough_spectra.addon.samples import readers

    samples = readers.read(spectrum_csv(tmp_path / "a.csv", "one", "two"))
    assert [sample.name for sample in samples] == ["one", "two"]


def test_reading_does_not_depend_on_the_neighbors(main, tmp_path):
    for name in ("Left", "Right"):
        tree = rgb_material(name).node_tree
        shader = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
        generated = tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"]
        tree.links.new(generated, shader.inputs["Color"])
    base = tmp_path / "x"
    words = ("bake", "--output", base, "--format", "csv", "--material", "Right")
    found = []
    for more in ((), ("--material", "Left")):
        assert main(*words, *more).status == 0
        found.append(json.loads((tmp_path / "x.json").read_bytes())["readings"][0])
    assert found[0]["measured"] == found[1]["measured"]


def test_a_spot_is_where_the_options_say(scene, main, tmp_path):
    bpy.ops.wm.open_mainfile(filepath=str(scene))
    empty = bpy.data.objects.new("Here", None)
    empty.location, empty.rotation_euler = (0.2, 0.7, -0.1), (0, 0.1, 0)
    bpy.context.scene.collection.objects.link(empty)
    bpy.ops.wm.save_mainfile()
    words = ("--blend", scene, "--object", "Panel", "--read-at", "45a:0", "--read-at", "di:8")
    common = (*words, "--spot-diameter", "40", "--output", tmp_path / "x")
    assert main("bake", *common, "--at", "Here", "--keep-neighbors").status == 0
    document = json.loads((tmp_path / "x.json").read_text(encoding="utf-8"))
    assert [entry["instrument"] for entry in document["readings"]] == ["45a:0", "di:8"]
    assert document["aperture"].endswith("; on objects a spot of 40 mm")
    for entry in document["readings"]:
        assert (entry["surface"], entry["material"]) == ("Panel", "Plain")
        spot = entry["spot"]
        assert spot["point"] == pytest.approx([0.2 + 0.1 * np.tan(0.1), 0.7, 0], abs=1e-4)
        assert (spot["diameter"], spot["is_alone"]) == (40, False)
    _, rows = rows_of(tmp_path / "x.measured.csv")
    assert [row["spot_mm"] for row in rows] == ["40", "40"]
    assert [row["spot_filled"] for row in rows] == ["1.0000", "1.0000"]


def test_a_spot_that_is_nowhere_is_refused(scene_file, main, tmp_path):
    words = ("bake", "--blend", scene_file, "--output", tmp_path / "x")
    for given, said in (
        (("--at", "Panel"), "are of an object; name it with --object."),
        (("--object", "Panel", "--at", "Nobody"), "'Nobody'"),
        (("--object", "Panel", "--at", "Bare"), "does not meet object 'Panel'"),
        (("--object", "Panel", "--vertex-group", "Seam"), "no vertex group 'Seam'; it has none."),
        (("--object", "Panel", "--spot-diameter", "0"), "is 0 mm; give more than 0."),
    ):
        result = main(*words, *given)
        assert result.status == 2
        assert said in result.err
    words = ("check", "--blend", scene_file, "--object", "Panel", "--spot-diameter", "4000")
    result = main(*words)
    assert result.status == 2
    assert "half is the least" in result.err
