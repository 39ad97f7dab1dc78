# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What tables say of their samples beside the spectrum, by key and value, for fields of `Sample`.

The keys stand in lines above a table, in its first column, or name its columns.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping
from typing import Any

from .....core.instruments import REGISTRY
from .....core.numerics.memoized import memoized
from ...sample import MOST_GLOSS_UNITS, Sample
from . import joining, name_marks, tables
from .document import Document, plain, quote
from .geometry_words import (
    EMITTED,
    EMITTING,
    device_in_text,
    geometry_of_device,
    in_text,
    instrument_of,
    is_geometry,
    is_specular,
    specular_of,
)
from .label_words import Comments
from .series import Bands

_GLOSS = "gloss units"
_USUAL_GLOSS = "60"  # degrees, of a meter with one angle; ISO 2813 begins with it
_GLOSS_KEY = re.compile(
    r"(?:gloss|gu|glossunits)(20|45|60|75|85)(?:deg(?:rees?)?|gu)?|"
    r"(20|45|60|75|85)(?:deg(?:rees?)?)?(?:gloss|gu)(?:units|gu)?"
)
_UNITS = re.compile(r"\s*(\d+(?:[.,]\d*)?)\s*(?:gu|gloss units?)?\s*", re.IGNORECASE)

_KEYS = {
    **dict.fromkeys(("device", "instrument", "instrumentname", "instrumenttype"), "device"),
    **dict.fromkeys(("instrumentmodel", "spectrophotometer", "spectrometer"), "device"),
    **dict.fromkeys(("sensor", "sensortype", "sensorname"), "device"),
    **dict.fromkeys(("geometry", "measurementgeometry", "measuringgeometry"), "geometry"),
    **dict.fromkeys(("instrumentgeometry", "opticalgeometry", "optics"), "geometry"),
    **dict.fromkeys(("aperture", "aperturesize", "measuringaperture"), "aperture"),
    **dict.fromkeys(("measurementarea", "measuringarea", "areaofview", "spotsize"), "aperture"),
    **dict.fromkeys(("illuminant", "lightsource", "illuminant1"), "illuminant"),
    **dict.fromkeys(("observer", "standardobserver", "observer1", "observerangle"), "observer"),
    **dict.fromkeys(("illuminantobserver", "illobs", "colorcondition"), "light"),
    **dict.fromkeys(("condition", "measurementcondition", "measurementmode", "mode"), "condition"),
    **dict.fromkeys(("mcondition", "mmode", "measurementconditions"), "condition"),
    **dict.fromkeys(("measuringmode", "measuremode", "filter", "uvfilter"), "condition"),
    **dict.fromkeys(("specular", "specularcomponent", "specularmode", "scisce"), "specular"),
    **dict.fromkeys(("spex", "sci", "sce", "gloss", "reflectancemode", "viewing"), "specular"),
    **dict.fromkeys(("spin", "specularincluded", "specularexcluded"), "specular"),
    **dict.fromkeys(("surface", "surfacestate"), "surface"),
    **dict.fromkeys(("aspecular", "aspecularangle", "effectangle"), "aspecular"),
    **dict.fromkeys(("angle", "measurementangle", "measuringangle"), "angle"),
    **dict.fromkeys(("viewangle", "viewingangle", "detectorangle", "thetar", "thetav"), "view"),
    **dict.fromkeys(("observationangle", "detectionangle", "reflectionangle"), "view"),
    **dict.fromkeys(("lightangle", "illuminationangle", "illuminatingangle", "thetai"), "lit"),
    **dict.fromkeys(("incidence", "incidenceangle", "angleofincidence", "incidentangle"), "lit"),
    **dict.fromkeys(("gu", "glossunits", "glossvalue", "glossunit"), _GLOSS),
    **dict.fromkeys(("sample", "samplename", "name", "sampleid", "dataname", "target"), "name"),
    # German, French and Japanese software; what stands in accents is looked up without them.
    **dict.fromkeys(("gerat", "geraet", "messgerat", "messgeraet", "appareil", "測定器"), "device"),
    **dict.fromkeys(("geometrie", "messgeometrie", "geometriedemesure", "geometria"), "geometry"),
    **dict.fromkeys(("光学系", "測定条件", "照明受光条件"), "geometry"),
    **dict.fromkeys(("blende", "messblende", "ouverture", "測定径"), "aperture"),
    **dict.fromkeys(("glanz", "glanzkomponente", "glanzanteil"), "specular"),
    **dict.fromkeys(("composantespeculaire", "speculaire", "brillance"), "specular"),
    **dict.fromkeys(("正反射", "正反射光", "正反射光処理", "正反射成分"), "specular"),
    **dict.fromkeys(("winkel", "messwinkel"), "angle"),
    **dict.fromkeys(("probe", "probenname", "echantillon", "試料", "試料名"), "name"),
    # Spanish, Italian, Portuguese, Russian and Chinese.
    **dict.fromkeys(("instrumento", "strumento", "equipo", "equipamento", "dispositivo"), "device"),
    **dict.fromkeys(
        ("espectrofotometro", "spettrofotometro", "прибор", "仪器", "仪器型号"), "device"
    ),
    **dict.fromkeys(("geometriademedicion", "геометрия", "геометрияизмерения"), "geometry"),
    **dict.fromkeys(
        ("geometriadimisura", "几何条件", "光学结构", "测量几何", "照明观察条件"), "geometry"
    ),
    **dict.fromkeys(("apertura", "abertura", "апертура", "测量口径", "口径"), "aperture"),
    **dict.fromkeys(("componenteespecular", "especular", "componentespeculare"), "specular"),
    **dict.fromkeys(("speculare", "зеркальнаясоставляющая", "镜面反射", "镜面光"), "specular"),
    **dict.fromkeys(
        ("measuremode", "modo", "modalita", "测量模式", "测量方式", "режим"), "condition"
    ),
    **dict.fromkeys(("angulo", "angolo", "угол", "角度", "测量角度"), "angle"),
    **dict.fromkeys(("muestra", "nombre", "campione", "nome", "amostra", "nom"), "name"),
    **dict.fromkeys(("образец", "название", "样品", "样品名称", "样品名", "名称"), "name"),
}
GEOMETRIES = {"geometry", "specular", "sphere", "aspecular", "angle", "view", "lit", "mentioned"}
"""Fields of `stated` from which the geometry follows."""
_OF_MEASUREMENTS = {*GEOMETRIES, "aperture", "surface", "gloss", "device", "condition"}
_OF_MEASUREMENTS |= {"illuminant", "observer", "light"}
_REMARK = re.compile(r"\s*[\[(][^\[\]()]*[\])]\s*$")
_YES, _NO = {"yes", "y", "true", "1", "on", "x"}, {"no", "n", "false", "0", "off"}
_BOTH = re.compile(r"sc[ie]|sp(?:in|ex)|i\+e|both|incl|excl", re.IGNORECASE)
_DEGREES = re.compile(r"\s*([-+\u2212]?\d{1,2}(?:[.,]\d+)?)\s*(?:°|º|deg\w*)?\s*", re.IGNORECASE)
_CONDITION = re.compile(r"\bM[0-3]\b", re.IGNORECASE)
_OBSERVER = re.compile(r"(?<![\d.])(2|10)\s*(?:°|º|deg\w*|\b)", re.IGNORECASE)
# Names of CIE illuminants: A, C, D50, D65, D75, F2 … F12 (also FL2), LED-B1.
_ILLUMINANT = re.compile(r"(?<![A-Za-z0-9])(A|C|E|D\d{2}|FL?\d{1,2}|TL84|LED-\w+)(?![A-Za-z0-9])")
_COLOR = re.compile(r"(?:cie[ _-]*)?([lab])(?:\s*\*)?\s*(?:[\[(](.*)[\])])?", re.IGNORECASE)


def field_of(key: str) -> str:
    """Return the field that a key names, or nothing.

    ``"light"`` is illuminant and observer; ``"gloss units 60"`` and its like, ``"aspecular"``,
    ``"angle"``, ``"lit"`` and ``"view"``, the angles of both, become fields in `finish`. What
    stands in brackets behind a key, such as a unit, counts for nothing.
    """
    plain = _plain(key)
    gloss = _GLOSS_KEY.fullmatch(plain)
    if gloss:
        return f"{_GLOSS} {gloss[1] or gloss[2]}"
    bare = _REMARK.sub("", key)
    return _KEYS.get(plain) or (_KEYS.get(_plain(bare), "") if bare != key else "")


def _plain(key: str) -> str:
    """Return the letters and digits of a key, small and without accents, of any script."""
    if not key.isascii():
        key = unicodedata.normalize("NFKD", key)
        key = "".join(char for char in key if not unicodedata.combining(char))
    return re.sub(r"[\W_]", "", key.lower())


@memoized(maxsize=1024)
def stated(key: str, value: str) -> Mapping[str, Any]:
    """Return the fields of `Sample` that one key and its value give, none if it is not known.

    `finish` turns all of a sample's fields into arguments.
    """
    value = value.strip().strip('"').strip()
    field = field_of(key)
    if not value or not field or (field in GEOMETRIES and tables.is_missing(value)):
        return {}
    if field == "light":
        return light(value)
    if field == "observer":
        found = _OBSERVER.search(value)
        return {"observer": int(found[1])} if found else {}
    if field == "condition":
        condition = _CONDITION.search(value)
        if condition:
            return {"condition": condition[0].upper()}
        return {"geometry": value} if is_geometry(value) else _specular(specular_of(value))
    if field == "specular" and _UNITS.fullmatch(value) and "gloss" in key.lower():
        field = _GLOSS  # a column "Gloss" has one or the other
    if field == "specular":
        return _stated_specular(key, value)
    if field == "device":
        if value in REGISTRY:
            return {"geometry": value}
        return {field: value, **_of_device(value)}
    if field == "geometry" and name_marks.angle_of(value) is not None:
        return {"angle": value}
    return {field: value}


def _of_device(value: str) -> dict[str, Any]:
    """Return what stands beside the name of a device, as in ``Ci7800, SPIN``."""
    geometry, specular = in_text(value)
    return ({"geometry": geometry} if geometry else {}) | _specular(specular)


def mentioned(text: str) -> Mapping[str, Any]:
    """Return the geometry and specular component, or the device, that free text mentions.

    As `stated` does.
    """
    geometry, specular = in_text(text)
    if specular and not geometry and not is_specular(text):
        return {"specular": specular, "mentioned": text.strip(" :")}  # a word may be a name's
    if geometry or specular:
        return ({"geometry": geometry} if geometry else {}) | _specular(specular)
    device = device_in_text(text)
    return {"device": device} if device else {}


def of_mention(text: str, geometry: str, specular: str) -> str:
    """Return the note on a sphere that follows from a word in a text; empty where it does not."""
    if not text or geometry or specular != specular_of(text):
        return ""
    return (
        f"That it is a sphere's reading, {specular}, follows from {quote(plain(text))}; if it is "
        "not, state the geometry in the file."
    )


def measured_by(pairs: Iterable[tuple[str, str]]) -> dict[str, Any]:
    """Return geometry, specular component, condition and device that keys and texts of a file say.

    Formats with keywords of their own ask for what theirs leave open: what a key names counts, and
    else what a text mentions. The fields are those of `stated`.
    """
    own: dict[str, Any] = {}
    free: dict[str, Any] = {}
    for key, value in pairs:
        for name, content in stated(key, value).items():
            if name in _HOW:
                own.setdefault(name, content)
        for name, content in mentioned(value).items():
            free.setdefault(name, content)
    return own if own.keys() & GEOMETRIES else free | own


def of_remarks(pairs: Iterable[tuple[str, str]]) -> dict[str, Any]:
    """Return arguments for `Sample` that keys and texts of a file give, as `finish` does.

    For formats that have no place of their own for the geometry: where nothing says it, the
    instrument is the one that is assumed, with the note on it.
    """
    found = finish(measured_by(pairs))
    notes = found.pop("notes", ())
    if "instrument" not in found:
        found["instrument"], note = instrument_of("")
        notes = (*notes, note)
    return {**found, "notes": notes}


_UNSAID = instrument_of("")[1]
_HOW = {*GEOMETRIES, "condition", "device"}


def light(text: str) -> dict[str, Any]:
    """Return illuminant and observer of words such as ``"10°/D65"``."""
    found: dict[str, Any] = {}
    illuminant = _ILLUMINANT.search(text)
    observer = _OBSERVER.search(text.replace(illuminant[0], "") if illuminant else text)
    if illuminant:
        found["illuminant"] = illuminant[0]
    if observer:
        found["observer"] = int(observer[1])
    return found


def color_columns(header: list[str]) -> tuple[list[int], dict[str, Any]]:
    """Return the columns of L*, a*, b*, none unless all are there, and their illuminant.

    The first of each counts: L also begins LCh, and more of them belong to further illuminants.
    """
    columns: dict[str, int] = {}
    said: dict[str, Any] = {}
    for i, label in enumerate(header):
        match = _COLOR.fullmatch(label.strip())
        if match and match[1].lower() not in columns:
            columns[match[1].lower()] = i
            said.update(light(match[2] or ""))
    return ([columns[c] for c in "lab"], said) if len(columns) == 3 else ([], {})


def finish(fields: dict[str, Any]) -> dict[str, Any]:
    """Return arguments for `Sample`: the instrument and its note follow from the geometry."""
    found = dict(fields)
    notes = _take_gloss(found)
    _take_angle(found)
    geometry, specular = found.get("geometry", ""), found.get("specular", "")
    # A sphere's, and not one of both readings.
    sphere = "d/8" if found.pop("sphere", "") else ""
    if follows := of_mention(found.pop("mentioned", ""), geometry, specular):
        notes.insert(0, follows)
    device = found.get("device", "")
    of_device = "" if geometry or specular or sphere else geometry_of_device(device)
    if of_device:
        notes.insert(0, f"The geometry {of_device} is that of the device {quote(device)}.")
    if geometry or specular or sphere or of_device:
        known = geometry or sphere or of_device
        found["instrument"], note, found["specular"] = _instrument(known, specular)
        notes = [note, *notes] if note else notes
    if notes:
        found["notes"] = tuple(notes)
    return found


def _take_angle(found: dict[str, Any]) -> None:
    """Turn an angle that is stated by itself into words of the geometry."""
    aspecular, angle = found.pop("aspecular", ""), found.pop("angle", "")
    lit, view = found.pop("lit", ""), found.pop("view", "")
    if lit and not (aspecular or angle):
        of_light, of_view = _DEGREES.fullmatch(lit), _DEGREES.fullmatch(view)
        words = f"light at {lit}, view at {view or 'an angle that is not said'}"
        if of_light and of_view:
            words = f"{of_light[1]}:{of_view[1]} directional".replace("\u2212", "-")
        found.setdefault("geometry", words)
        return
    said = aspecular or angle or view
    if not said:
        return
    degrees = name_marks.aspecular_of(said)
    if degrees is None and aspecular:
        degrees = name_marks.angle_of(said)
    words = f"{joining.ANGLE}{said}" if degrees is None else f"45as{degrees}"
    geometry = found.get("geometry", "")
    if degrees is None:
        found["geometry"] = f"{geometry}, {words}" if geometry else words
    else:
        found["geometry"] = f"{words}, {geometry}" if geometry else words


def _take_gloss(found: dict[str, Any]) -> list[str]:
    """Turn gloss units by angle into the field `gloss`; return what is to be said of them."""
    notes = []
    units: dict[float, float] = {}
    for key in [key for key in found if key.startswith(_GLOSS)]:
        said = found.pop(key)
        if tables.is_missing(said):
            continue
        angle = key.removeprefix(_GLOSS).strip()
        match = _UNITS.fullmatch(said)
        value = float(match[1].replace(",", ".")) if match else -1.0
        if not 0.0 <= value <= MOST_GLOSS_UNITS:
            where = f" at {angle}°" if angle else ""
            notes.append(f"The gloss{where}, {quote(said)}, cannot be gloss units; left out.")
            continue
        if not angle:
            angle = _USUAL_GLOSS
            notes.append(f"The gloss units have no angle; {angle}° is taken, as is usual.")
        if units.setdefault(float(angle), value) != value:
            notes.append(f"The gloss at {angle}° stands twice; {quote(said)} was left out.")
    if units:
        found["gloss"] = tuple(units.items())
    return notes


@memoized(maxsize=256)
def _instrument(geometry: str, specular: str) -> tuple[str, str, str]:
    """Return instrument, note and specular component: tables repeat them in each row."""
    specular = specular or specular_of(geometry)
    # Only spheres can leave specular light out or let it in.
    return (*instrument_of(geometry or "d/8", specular), specular)


def make(
    document: Document,
    said: Comments,
    fields: dict[str, Any],
    found: Bands,
    *,
    name: str,
    position: str,
    notes: tuple[str, ...] = (),
) -> Sample:
    """Return a sample with what comments and keys say of it.

    Comments come first, but for how it was measured: there they stand for all samples of the file,
    and what is said of one of them counts more.
    """
    device = said.texts.get("device", "")
    known = finish(({"device": device} if device else {}) | _measured(said, fields) | fields)
    known.pop("name", None)
    notes = notes + known.pop("notes", ())
    if "instrument" not in known and said.kind == "reading":
        notes = (_UNSAID, *notes)
    texts: dict[str, Any] = {"source": str(document.path), **known, **said.texts}
    texts |= {"device": known["device"]} if "device" in known else {}
    if said.kind == "emissivity":
        texts |= {"quantity": "emissivity", "instrument": EMITTING}
        notes = (*notes, EMITTED)
    return Sample(
        name=name,
        wavelengths=found.wavelengths,
        values=found.values,
        kind=said.kind,
        position=position,
        notes=notes,
        altered=found.altered,
        **texts,
    )


def _measured(said: Comments, fields: dict[str, Any]) -> dict[str, Any]:
    """Return what comments say of the measurement, nothing of what a sample's own geometry says."""
    if said.measured is None:
        said.measured = _of_comments(said)
    found = said.measured
    if fields.keys() & GEOMETRIES:
        found = {key: value for key, value in found.items() if key not in GEOMETRIES}
    return found


def name_in_comments(said: Comments) -> str:
    """Return what comments call the only sample of a file, or an empty string."""
    return next((value for key, value in said.others if field_of(key) == "name"), "")


def _of_comments(said: Comments) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in said.others:
        if field_of(key).partition(" ")[0] in _OF_MEASUREMENTS:
            found |= stated(key, value)
    if not found.keys() & GEOMETRIES:
        for key, value in said.others:
            mark = " " if key.endswith(("\t", ";", ",")) else ": "
            found |= mentioned(f"{key}{mark}{value}") if not field_of(key) else {}
    return found


def _stated_specular(key: str, value: str) -> dict[str, Any]:
    """Return what a key such as "Specular component", "SCI" or "specular excluded" says."""
    said = specular_of(value) or specular_of(f"specular {value}")
    asked = specular_of(key.replace("_", " "))
    if not said and asked and value.lower() in _YES | _NO:
        said = asked if value.lower() in _YES else {"SCI": "SCE", "SCE": "SCI"}[asked]
    if not said and not asked:  # "Glanz: aus", "componente speculare: esclusa", "镜面反射: 不包含"
        said = specular_of(f"{key} {value}")
    if said:
        return _specular(said)
    return {"sphere": value} if _BOTH.search(value) else {}


def _specular(found: str) -> dict[str, Any]:
    return {"specular": found, "mentioned": ""} if found else {}  # said, whatever a remark says
