# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures of spectral images: against the core in double precision, and against Cycles."""

import math

import numpy as np
import pytest
from rough_spectra.addon.blender import working_space
from rough_spectra.addon.instrument import measure
from rough_spectra.addon.samples.readers.parts import spectral_channels
from rough_spectra.addon.support import png
from rough_spectra.addon.support.openimageio import openimageio
from rough_spectra.addon.textures import convert, material
from rough_spectra.addon.textures.wanted import Wanted
from rough_spectra.core import reading
from rough_spectra.core.errors import (
    CancelledError,
    DomainError,
    InputError,
    MaterialError,
    OutputError,
)

NM = np.arange(400, 701, 20)
SIGMA = math.radians(30)
HALF = 2.0**-11
"""Relative rounding of half floats; below 2^-14 it is 2^-25 flat."""


def readings(width=60, height=37, seed=0):
    """Smooth spectra that vary over the surface, shape (height, width, bands)."""
    random = np.random.default_rng(seed)
    level, slope = random.uniform(0.1, 0.6, (2, height, width, 1))
    return (level + 0.3 * slope * np.sin(NM / 70)).astype(np.float32)


def write_exr(path, values, names, form="float", **attributes):
    oiio = openimageio()
    height, width, count = values.shape
    spec = oiio.ImageSpec(width, height, count, form)
    spec.channelnames = tuple(names)
    for name, value in attributes.items():
        spec.attribute(name, value)
    if "tile" in attributes:
        spec.tile_width = spec.tile_height = attributes["tile"]
    out = oiio.ImageOutput.create("openexr")
    assert out.open(str(path), spec), out.geterror()
    assert out.write_image(np.ascontiguousarray(values)), out.geterror()
    assert out.close()
    return path


def fichet(path, values, form="float", **attributes):
    return write_exr(path, values, [f"T.{nm},000000nm" for nm in NM], form, **attributes)


def write_envi(path, values, interleave="bsq", code=4, order=0, **more):
    """A cube by numpy alone."""
    form = np.dtype("<>"[order] + {1: "u1", 2: "i2", 3: "i4", 4: "f4", 5: "f8", 12: "u2"}[code])
    axes = {"bsq": (2, 0, 1), "bil": (0, 2, 1), "bip": (0, 1, 2)}[interleave]
    height, width, bands = values.shape
    entries = {
        "samples": width,
        "lines": height,
        "bands": bands,
        "header offset": 16,
        "data type": code,
        "interleave": interleave,
        "byte order": order,
        "wavelength units": "Nanometers",
        "wavelength": "{" + ",\n ".join(map(str, NM)) + "}",
    }
    entries |= {key.replace("_", " "): value for key, value in more.items()}
    lines = [f"{key} = {value}" for key, value in entries.items() if value is not None]
    path.with_suffix(".hdr").write_text("ENVI\n" + "\n".join(lines) + "\n")
    numbers = np.ascontiguousarray(values.transpose(axes)).astype(form)
    path.write_bytes(bytes(16) + numbers.tobytes())
    return path


def pixels(path):
    image = openimageio().ImageInput.open(str(path))
    spec = image.spec()
    found = image.read_image(openimageio().FLOAT)
    image.close()
    return np.asarray(found).reshape(spec.height, spec.width, -1), spec


def make(source, target, space=None, **settings):
    settings.setdefault("sigma", SIGMA)
    space = space or working_space.current()
    return convert.Conversion(source, target, Wanted(**settings), space).finish()


def expected(values, instrument="45a:0", illuminant="D65"):
    """Albedo in RGB by the core, in double precision and all at once."""
    rho = reading.to_albedo(values.astype(np.float64), SIGMA, "surface", instrument)
    return rho @ working_space.current().rgb_weights(NM.astype(float), illuminant)


def near(found, wanted):
    """Whether half floats hold what is wanted: their rounding, and that of single precision."""
    return np.abs(found - wanted).max() <= HALF * np.abs(wanted).max() + 3e-6


@pytest.mark.parametrize(("instrument", "illuminant"), [("45a:0", "D65"), ("di:8", "A")])
def test_albedo_is_that_of_the_core(tmp_path, instrument, illuminant):
    values = readings()
    source = fichet(tmp_path / "wall.exr", values)
    made = make(source, tmp_path / "out.exr", instrument=instrument, illuminant=illuminant)
    found, spec = pixels(made.path)
    assert spec.format.basetype == openimageio().HALF
    assert near(found, expected(values, instrument, illuminant))
    assert made.mean.values == pytest.approx(values.mean(axis=(0, 1)), rel=1e-5)
    assert made.infeasible == 0


def test_the_file_says_what_made_it(tmp_path):
    source = fichet(tmp_path / "wall.exr", readings())
    made = make(source, tmp_path / "out.exr", instrument="di:8", illuminant="A")
    _, spec = pixels(made.path)
    told = {name: spec.getattribute(f"roughSpectra:{name}") for name in
            ("sigmaDegrees", "instrument", "illuminant", "model", "source", "holds")}  # fmt: skip
    assert told.pop("sigmaDegrees") == pytest.approx(30)
    assert told == {
        "instrument": "di:8",
        "illuminant": "A",
        "model": "surface",
        "source": "wall.exr",
        "holds": "albedo",
    }


@pytest.mark.parametrize("form", ["half", "float"])
@pytest.mark.parametrize("attributes", [{}, {"compression": "piz"}, {"tile": 16}])
def test_however_an_exr_is_stored(tmp_path, form, attributes):
    values = readings()
    source = fichet(tmp_path / "wall.exr", values, form, **attributes)
    found, _ = pixels(make(source, tmp_path / "out.exr").path)
    read = values.astype(np.float16) if form == "half" else values
    assert near(found, expected(read))


@pytest.mark.parametrize("interleave", ["bsq", "bil", "bip"])
@pytest.mark.parametrize(("code", "order", "scale"), [
    (1, 0, 250), (2, 0, 1e4), (2, 1, 1e4), (3, 0, 1e6), (4, 1, None), (5, 0, 100), (12, 0, 65e3),
])  # fmt: skip
def test_however_a_cube_is_stored(tmp_path, interleave, code, order, scale):
    stored = readings() * (scale or 1)
    if code not in (4, 5):
        stored = np.round(stored)
    path = write_envi(
        tmp_path / "wall.img", stored, interleave, code, order, reflectance_scale_factor=scale
    )
    found, _ = pixels(make(path, tmp_path / "out.exr").path)
    assert near(found, expected(stored / (scale or 1)))


def test_a_cube_by_its_header_in_micrometers_backwards_with_bad_bands(tmp_path):
    values = readings()
    nm = np.concatenate((NM, [1000, 2500]))[::-1]
    more = np.concatenate((values, np.full((*values.shape[:2], 2), np.nan)), axis=2)[..., ::-1]
    path = write_envi(
        tmp_path / "wall.dat",
        more,
        wavelength="{" + ", ".join(f"{each / 1000:g}" for each in nm) + "}",
        wavelength_units="Micrometers",
        bbl="{0, 0, " + ", ".join("1" * NM.size) + "}",
    )
    found, _ = pixels(make(path.with_suffix(".hdr"), tmp_path / "out.exr").path)
    assert near(found, expected(values))


@pytest.mark.parametrize("names", [
    [f"R_{nm}nm" for nm in NM], [f"{nm - 10}.00-{nm + 10}.00nm" for nm in NM],
])  # fmt: skip
def test_other_names_of_channels(tmp_path, names):
    values = readings()
    source = write_exr(tmp_path / "wall.exr", values, names)
    found, _ = pixels(make(source, tmp_path / "out.exr").path)
    assert near(found, expected(values))


def test_names_of_channels():
    assert spectral_channels.parse("wall.T.545,0nm").layer == "wall"
    assert spectral_channels.plain("reflectance (545.5 nm)") == 545.5
    assert spectral_channels.plain("T.545,0nm") is None
    assert spectral_channels.plain("545nmish") is None


@pytest.mark.parametrize("degrees", [0, 20, 45])
def test_cycles_reads_of_every_pixel_what_was_measured(tmp_path, degrees):
    """A texture of one color in a render; and the texels against Cycles' formula."""
    from rough_spectra.core import cycles

    values = np.broadcast_to(readings(1, 1), (4, 4, NM.size))
    source = fichet(tmp_path / "even.exr", values)
    made = make(source, tmp_path / "even-out.exr", sigma=math.radians(degrees), holds="color")
    wall = material.make(made, "Wall")
    [[[mean, spread]]] = measure.measure([wall])
    wanted = values[0, 0] @ working_space.current().rgb_weights(NM.astype(float), "D65")
    assert mean == pytest.approx(wanted, rel=2 * HALF)
    assert spread.max() < 1e-6

    values = readings()
    made = make(fichet(tmp_path / "wall.exr", values), tmp_path / "out.exr", holds="color",
                sigma=math.radians(degrees))  # fmt: skip
    found, _ = pixels(made.path)
    read = cycles.reflectance(found.astype(float), made.roughness, math.pi / 4, 0, 0)
    wanted = values @ working_space.current().rgb_weights(NM.astype(float), "D65")
    assert near(read, wanted)
    assert (made.roughness > 0) == (degrees > 0)


def test_what_reads_more_than_white_is_told_and_kept(tmp_path):
    values = readings()
    values[:5, :4] = 1.1
    made = make(fichet(tmp_path / "wall.exr", values), tmp_path / "out.exr")
    found, _ = pixels(made.path)
    white = float(reading.white_reading(SIGMA, "surface"))
    assert made.infeasible == 20 / (37 * 60)
    assert found[0, 0] == pytest.approx(1.1 / white, rel=1e-3)
    assert any("0.9% of the pixels read more than white facets" in note for note in made.notes)


def test_red_green_and_blue(tmp_path):
    """A gray is as exact as its 8 bits: sRGB's own curve, decoded and inverted."""
    gray = np.full((4, 3, 3), 188, np.uint8)
    (tmp_path / "scan.png").write_bytes(png.encode(gray))
    made = make(tmp_path / "scan.png", tmp_path / "out.exr")
    linear = ((188 / 255 + 0.055) / 1.055) ** 2.4
    wanted = reading.to_albedo([linear], SIGMA, "surface")[0]
    found, _ = pixels(made.path)
    assert found == pytest.approx(wanted, rel=2 * HALF)
    assert made.mean is None
    assert any("each channel was taken for a band" in note for note in made.notes)
    linear_exr = write_exr(tmp_path / "scan.exr", np.full((4, 3, 3), linear), "RGB")
    found, _ = pixels(make(linear_exr, tmp_path / "out.exr").path)
    assert found == pytest.approx(wanted, rel=2 * HALF)


def test_a_color_of_the_scanner_keeps_its_hue_in_a_wider_space(tmp_path, set_working_space):
    set_working_space("ACEScg")
    source = write_exr(tmp_path / "scan.exr", np.full((2, 2, 3), [0.5, 0.2, 0.1]), "RGB")
    found, _ = pixels(make(source, tmp_path / "out.exr", sigma=0.0).path)
    from mathutils import Color

    wanted = Color((0.5, 0.2, 0.1)).from_rec709_linear_to_scene_linear()
    assert found[0, 0] == pytest.approx(np.array(wanted), abs=1e-3)


def broken(tmp_path, kind):
    values = readings()
    image = tmp_path / "wall.img"
    if kind == "nan":
        values[30, 5, 7] = np.nan
        return fichet(tmp_path / "wall.exr", values)
    if kind == "radiance":
        return write_exr(tmp_path / "wall.exr", values, [f"S0.{nm},0nm" for nm in NM])
    if kind == "few bands":
        return write_exr(tmp_path / "wall.exr", values[..., :4], [f"T.{nm},0nm" for nm in NM[:4]])
    if kind == "no channels":
        return write_exr(tmp_path / "wall.exr", values[..., :2], ["U", "V"])
    if kind == "cut":
        path = fichet(tmp_path / "wall.exr", values)
        path.write_bytes(path.read_bytes()[:-20000])
        return path
    if kind == "no image":
        (tmp_path / "wall.exr").write_text("hello")
        return tmp_path / "wall.exr"
    if kind == "ignored":
        values[2, 3] = -999
        return write_envi(image, values, data_ignore_value=-999)
    settings = {
        "no wavelengths": {"wavelength": None},
        "other count": {"wavelength": "{400, 500}"},
        "unit": {"wavelength_units": "Index"},
        "twice": {"wavelength": "{" + ", ".join(map(str, [400, *NM[:-1]])) + "}"},
        "complex": {"data_type": 6},
        "interleave": {"interleave": "bxq"},
        "short": {"lines": 99},
        "whole": {"data_type": 12},
        "scale": {"reflectance_scale_factor": "many"},
        "zero": {"reflectance_scale_factor": "0"},
        "negative": {"samples": -3},
        "library": {"file_type": "ENVI Spectral Library"},
    }
    if kind == "alone":
        path = write_envi(image, values)
        path.unlink()
        return path.with_suffix(".hdr")
    base = {"interleave": "bsq"} | settings[kind]
    path = write_envi(image, values)
    text = path.with_suffix(".hdr").read_text()
    for key, value in base.items():
        lines = [
            line for line in text.split("\n") if not line.startswith(key.replace("_", " ") + " =")
        ]
        text = "\n".join(lines)
        if key == "wavelength":
            text = text[: text.index(",\n")].rsplit("\n", 1)[0] if ",\n" in text else text
            text = "\n".join(line for line in text.split("\n") if not line.strip(" ,}").isdigit())
        if value is not None:
            text += f"\n{key.replace('_', ' ')} = {value}"
    path.with_suffix(".hdr").write_text(text)
    return path


@pytest.mark.parametrize(
    ("kind", "sentence"),
    [
        ("nan", "has no reflectance at pixel 5, 30: 'T.540,000000nm' is not a number there"),
        ("radiance", "holds radiance (channels S0)"),
        ("few bands", "of the color unmeasured"),
        ("no channels", "has the channels U, V, and neither R, G and B nor wavelengths"),
        ("cut", "is damaged from line"),
        ("no image", "cannot be read as an image or as an ENVI cube"),
        ("ignored", "has no reflectance at pixel 3, 2: '400 nm' is not a number there"),
        ("no wavelengths", "has no 'wavelength' of its bands"),
        ("other count", "lists 2 wavelengths of 16 bands"),
        ("unit", "has wavelengths in 'index'"),
        ("twice", "has two bands at 400 nm"),
        ("complex", "has numbers of the type 6"),
        ("interleave", "has the interleave 'bxq'"),
        ("short", "copy the cube again"),
        ("whole", "no 'reflectance scale factor'"),
        ("scale", "has a 'reflectance scale factor' that is no number"),
        ("zero", "has 0 for a reflectance of 1"),
        ("negative", "has no readable 'samples'"),
        ("library", "is a spectral library"),
        ("alone", "is a header without its file of numbers"),
    ],
)
def test_what_cannot_be_read_is_one_sentence_and_nothing_is_written(tmp_path, kind, sentence):
    source = broken(tmp_path, kind)
    target = tmp_path / "out.exr"
    target.write_bytes(b"old")
    before = sorted(path.name for path in tmp_path.iterdir())
    with pytest.raises(InputError) as raised:
        make(source, target)
    assert sentence in str(raised.value)
    assert str(raised.value).startswith(str(source.with_suffix("")))
    assert target.read_bytes() == b"old"
    assert sorted(path.name for path in tmp_path.iterdir()) == before


def test_where_it_may_not_be_written(tmp_path):
    source = fichet(tmp_path / "wall.exr", readings())
    with pytest.raises(OutputError, match="is the image itself"):
        make(source, source)
    with pytest.raises(OutputError, match=r"ends in \.exr"):
        make(source, tmp_path / "out.png")


def test_what_nobody_can_make(tmp_path):
    with pytest.raises(DomainError, match="σ is 80°"):
        Wanted(math.radians(80))
    with pytest.raises(DomainError, match="holds albedo or color"):
        Wanted(0.1, holds="heights")
    made = make(fichet(tmp_path / "wall.exr", readings()), tmp_path / "out.exr")
    with pytest.raises(MaterialError, match="holds albedo"):
        material.make(made)


def test_an_interrupt_leaves_what_was_there(tmp_path):
    source = fichet(tmp_path / "wall.exr", readings())

    def interrupt(_done, _total):
        raise KeyboardInterrupt

    conversion = convert.Conversion(
        source, tmp_path / "out.exr", Wanted(SIGMA), working_space.current()
    )
    with pytest.raises(CancelledError, match="nothing was written"):
        conversion.finish(interrupt)
    assert [path.name for path in tmp_path.iterdir()] == ["wall.exr"]


def test_blocks_add_up_to_the_whole(tmp_path, monkeypatch):
    """However many lines are held at once, the file is the same to the last bit."""
    source = fichet(tmp_path / "wall.exr", readings())
    whole, _ = pixels(make(source, tmp_path / "whole.exr").path)
    monkeypatch.setattr(convert, "_NUMBERS_AT_ONCE", 1)
    parts, _ = pixels(make(source, tmp_path / "parts.exr").path)
    assert (parts == whole).all()
