# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Thousands of readings: written one after the other, not all in memory once more."""

import json
import tracemalloc

import numpy as np
import pytest
from rough_spectra.addon.blender import background_job
from rough_spectra.addon.instrument import bake
from rough_spectra.addon.readings import json_document, writers
from rough_spectra.addon.readings.document import CyclesReading, Predicted, Reading, Readings
from rough_spectra.addon.readings.writers import images
from rough_spectra.addon.support.openimageio import openimageio

BANDS = tuple(float(nm) for nm in range(400, 701, 10))
A_READING = 3000
"""Bytes that writing may take of each: what it is said to be of, and its swatch."""


def readings(count, name="Paint"):
    rng = np.random.default_rng(1)
    triple = (0.25, 0.5, 0.75)
    seen = CyclesReading(triple, triple, "D65", triple, triple)
    entries = []
    for number in range(count):
        values = tuple(rng.uniform(0, 1, len(BANDS)).round(6).tolist())
        part = Predicted("reading", "surface", "", 0.0, "D65", 2, BANDS, values, *[triple] * 3)
        about = (f"{name} {number}", "", f"{name} {number}", "", part, seen, 0.5, "", ())
        entries.append(Reading(*about))
    return Readings("Linear Rec.709", "5.2", tuple(entries))


def test_writing_takes_little_memory_of_each_reading(tmp_path):
    writers.write(readings(7), tmp_path / "few")  # what is loaded first is none of theirs
    many = readings(400)
    tracemalloc.start()
    try:
        writers.write(many, tmp_path / "many")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < len(many.entries) * A_READING


@pytest.mark.parametrize("name", ['"[]"', "line\nline", "\u2028 ", "Gr\u00fcn \U0001f9f1", "[ ]"])
@pytest.mark.parametrize("count", [0, 1, 3])
def test_the_document_is_what_pythons_own_writer_makes_of_it(name, count):
    text = json_document.to_json(readings(count, name)).decode()
    assert json.dumps(json.loads(text), indent=1, ensure_ascii=False) + "\n" == text


@pytest.mark.parametrize("count", [1, 6, 8])
def test_every_swatch_has_its_place_and_others_are_black(count, tmp_path):
    found = readings(count)
    [(_, picture)] = images.predicted(found)
    images.write(picture, tmp_path / "x.exr", tmp_path / "x.exr")
    file = openimageio().ImageInput.open(str(tmp_path / "x.exr"))
    pixels = file.read_image(openimageio().FLOAT)
    file.close()
    columns, rows = min(count, 6), -(-count // 6)
    assert pixels.shape == (16 * rows, 16 * columns, 3 + len(BANDS))
    for place in range(columns * rows):
        row, column = divmod(place, columns)
        swatch = pixels[16 * row :, 16 * column :][:16, :16]
        if place >= count:
            assert not swatch.any()
            continue
        part = found.entries[place].predicted
        expected = np.broadcast_to((*part.preview, *part.values), swatch.shape)
        np.testing.assert_allclose(swatch, expected, rtol=2**-11)


def test_a_bake_in_portions_is_that_of_one_go(make_material, monkeypatch):
    materials = [make_material(f"Paint {n}", Color=(0.2 * n, 0.5, 0.3, 1)) for n in range(1, 4)]
    surfaces = [("", material) for material in materials]
    whole = bake.bake(surfaces)
    at_once, told, prepare = [], [], bake.prepare

    def counting(part, *rest):
        at_once.append(len(part))
        return prepare(part, *rest)

    monkeypatch.setattr(bake, "prepare", counting)
    monkeypatch.setattr(bake, "AT_ONCE", 2)
    found = bake.bake(surfaces, True, lambda *numbers: told.append(numbers))
    assert at_once == [2, 1]
    assert found == whole
    assert len({entry.measured.rgb for entry in found.entries}) == 3
    shares = [done / total for done, total in told if total]
    assert shares == sorted(shares)
    assert shares[-1] == 1
    begun = [total for _, total in told].index(max(total for _, total in told))
    assert (0, 0) not in told[begun:]  # as if it began again


def test_the_end_of_a_job_is_told_however_soon_it_comes():
    """A farm's engine waits for 100 %, and a job may end between two looks at it."""

    class AtOnce(background_job.Job):
        def __init__(self):
            self.done = self.total = 0

        def poll(self):
            self.done = self.total = 3
            return True

    told = []
    AtOnce().wait(lambda *numbers: told.append(numbers))
    assert told == [(3, 3)]
