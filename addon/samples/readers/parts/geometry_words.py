# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What files say about an instrument's geometry, as one of the instruments that are computed.

Light and view may change places: readings of the models obey Helmholtz reciprocity, so 8°:di reads
what di:8° reads. A geometry that is not among them gets the nearest one and a sentence about it.
"""

from __future__ import annotations

import re

from .....core.instruments import HEMISPHERE, REGISTRY, Instrument
from .document import quote

ASSUMED = "45a:0"
"""Where a file says nothing: the geometry of most portable instruments, and of ISO 13655."""

EMITTING = "di:8"
"""Of emissivities: 1 - ε is what a sphere around the sample reads, whatever measured it."""

EMITTED = "Emissivity is taken as seen from near the normal: 1 - ε is what a sphere reads (di:8°)."
"""The note that says so."""

_OTHER = "is not among the instruments"
NO_ANGLE = "does not name an angle"
_LONGEST = 200  # characters of a description that are looked at
_NUMBER = r"([-+]?\d+(?:[.,]\d+)?)"
_RING = r"(annular|a|circumferential|c|ring|directional|x)?"
_BETWEEN = r"\s*[:/]\s*"
_PAIR = re.compile(rf"(?<![\w.]){_NUMBER}\s*{_RING}{_BETWEEN}{_NUMBER}\s*{_RING}(?![\w./])")
_ASPECULAR = re.compile(rf"\bas\s*{_NUMBER}|{_NUMBER}\s*as\s*{_NUMBER}|aspecular\D*?{_NUMBER}")
_DIFFUSE = r"(?:d|diffuse|h|hemispherical)\s*(i|e)?"
_SPHERE = re.compile(
    rf"(?<![\w.]){_DIFFUSE}{_BETWEEN}{_NUMBER}\s?(i|e)?(?![\w.])|"
    rf"(?<![\w.]){_NUMBER}{_BETWEEN}{_DIFFUSE}(?![a-z0-9])|"
    rf"\bd(i|e)?({_NUMBER[1:-1]})(i|e)?(?![\w.])"
)
_INCIDENCE = re.compile(rf"\bi\w*\s*[=:]?\s*{_NUMBER}\W{{1,5}}e\w*\s*[=:]?\s*{_NUMBER}")
_DIFFUSE_BOTH = re.compile(r"(?<!\w)(?:d|diffuse)\s*[:/]\s*(?:d|diffuse)(?!\w)")
# Integrating spheres in Spanish, Portuguese, Italian, Russian and Chinese.
_SPHERES = r"esfera (?:de )?integra|sfera (?:di )?integra|сфер\w* интегр|интегр\w* сфер|积分球"
_HEMISPHERE = re.compile(
    r"hemispher|\bdhr\b|\bsphere\b|\bspherical\b|\bdiffuse\b|ulbricht|kugel\b|\bsph[èe]re\b|積分球|"
    rf"{_SPHERES}"
)
_ONE_DIRECTION = re.compile(r"direction\w*\W*hemi|hemi\w*\W*direction|\bdhr\b")
_RING_WORD = re.compile(r"annul|circumferen|\bring\b")
_SIDE_WORD = re.compile(r"\bdirectional\b|unidirectional|\bone[- ]sided?\b")

# In English, German, French and Japanese; makers' abbreviations may have a ring of "_" around them.
_SPECULAR = r"spec(?:ular(?:ity)?|\.)?\W*(?:component\W*|light\W*|reflection\W*)?(?:is\W*)?"
_GLANZ, _BRILLANT, _MIRROR = (
    r"glanz(?:anteil)?\W*",
    r"(?:brillan\w*|sp[ée]culaire)\W*",
    "正反射光?(?:成分)?を?",
)
# Spanish, Portuguese, Italian, Russian and Chinese.
_ROMANCE = r"(?:e?specular[ei]?|reflexi[óo]n especular|brillo)\W*(?:est[áa]\W*)?"
_WITH = (
    rf"{_ROMANCE}incl[uú]|зеркальн\w*(?:\W+\w+)?\W+включ|"
    r"(?<!不)(?<!不包)含镜面|镜面[反射光分量]*\W*(?<!不)包?含"
)
_WITHOUT = (
    rf"{_ROMANCE}(?:exclu|esclus)|(?:sin|sem|senza)\W*(?:componente\W*)?e?specular|"
    r"зеркальн\w*(?:\W+\w+)?\W+исключ|"
    r"без\W+зеркальн|不包?含镜面|镜面[反射光分量]*\W*(?:排除|除|不包?含)|排除镜面"
)
# "SCI-FI POSTER" and "spin-coated" go on behind a hyphen; "SCI" of a measurement does not.
_NO_PART = r"(?![A-Za-z]|[-\u2010\u2011\u2013.'\u2019&][A-Za-z]|[\s_](?:FI|fi)(?![A-Za-z]))"
_INCLUDED = re.compile(
    rf"(?<![a-z])(?:sci|r?spin|rsin|spi|i\+e){_NO_PART}|(?<![a-z]){_SPECULAR}incl|incl\w*\W*specular|"
    rf"{_GLANZ}(?:ein|inkl)|\b(?:mit|inkl\w*)\W*glanz|{_BRILLANT}inclu|{_MIRROR}含|{_WITH}"
)
_EXCLUDED = re.compile(
    rf"(?<![a-z])(?:sce|r?spex|rsex|spe){_NO_PART}|(?<![a-z]){_SPECULAR}(?:excl|not incl|removed)|"
    rf"excl\w*\W*specular|without\W*specular|gloss trap\W*open|"
    rf"{_GLANZ}(?:aus|exkl)|\bohne\W*glanz|glanzfalle|{_BRILLANT}exclu|{_MIRROR}除|{_WITHOUT}"
)
_MENTIONED = re.compile(
    r"(?<![\w./:,-])(?:d[ie]?\s*[:/]\s*[08][ie]?|[08]\s*[:/]\s*d[ie]?|45[acx]?\s*[:/]\s*0[acx]?|"
    r"0\s*/\s*45[acx]?|r?\d\das[-+]?\d{1,3}|as[-+]?\d{2,3}|aspecular\D{0,12}?[-+]?\d{2,3}|"
    r"diffuse\s*[:/]?\s*[08]|bidirectional\s+\d\d?\s*[:/]\s*\d\d?|i\s*=\s*\d\d?\W{1,3}e\s*=\s*\d\d?|"
    r"(?:di8|de8|dhr|ulbricht\w*|integrating sphere|integrationskugel|積分球)|"
    rf"sph[èe]re int[ée]grante|sph[èe]re d.int[ée]gration|(?:{_SPHERES})\\w*|"
    r"(?:direction\w*\W*hemispher\w*|hemispher\w*\W*direction\w*))(?![\w/:]|\.\d)"
)
# Capitals alone, and words with what they belong to: "sci" may be part of a name, as "SPIN COATED".
_SPECULAR_WORDS = re.compile(
    rf"(?<![A-Za-z])(?:SCI|SCE|R?SPIN(?!\W+[A-Z]{{2}})|R?SPEX|RSIN|RSEX){_NO_PART}|"
    r"[Ss]pec(?:ular(?:ity)?|\.)\W*(?:component\W*|light\W*)?(?:is\W*)?(?:not )?(?:[Ii]n|[Ee]x)cl|"
    r"[Gg]lanz(?:anteil)?\W*(?:ein|aus|inkl|exkl)|\b(?:mit|ohne)\W*Glanz|Glanzfalle|"
    r"(?:[Bb]rillan\w*|[Ss]p[ée]culaire)\W*(?:in|ex)clu|正反射|"
    rf"(?i:{_WITH}|{_WITHOUT})"
)


def instrument_of(text: str, specular: str = "") -> tuple[str, str]:
    """Return the instrument to compute with, and a note where it is not what the file says.

    Parameters
    ----------
    text
        The geometry in the words of the file, such as ``"45/0"``, ``"0°:45°a"``, ``"D/8 SCI"``.
    specular
        ``"SCI"`` or ``"SCE"`` where the file says so elsewhere; see `specular_of`.

    Returns
    -------
    tuple
        A name of `core.instruments.REGISTRY`, and one sentence or an empty string.
    """
    stated = " ".join(text[:_LONGEST].split())
    if not stated:
        return ASSUMED, f"The file does not say the geometry; {_title(ASSUMED)} is assumed."
    if stated in REGISTRY:
        return stated, ""
    plain = _plain(stated)
    found = _multi_angle(plain) or _sphere(plain, specular) or _two_angles(plain)
    says = specular_of(plain)
    if not found and says:  # only a sphere can let specular light in, or leave it out
        found = _nearest_sphere(None, says == "SCE").name, NO_ANGLE
    if not found:
        return ASSUMED, f"The geometry {quote(stated)} is not known; {_title(ASSUMED)} is assumed."
    name, why = found
    note = f"The geometry {quote(stated)} {why}; it is computed as {_title(name)}." if why else ""
    return name, note


def is_geometry(text: str) -> bool:
    """Return whether a text says a geometry, one of the instruments' or another."""
    stated = " ".join(text[:_LONGEST].split())
    if stated in REGISTRY:
        return True
    plain = _plain(stated)
    return bool(_multi_angle(plain) or _sphere(plain, "") or _two_angles(plain))


def in_text(text: str) -> tuple[str, str]:
    """Return the geometry, and ``"SCI"`` or ``"SCE"``, that a sentence mentions; empty if none.

    Only what can be nothing else counts: free text has dates, times and ratios, too.
    """
    plain = _plain(text[:_LONGEST])
    found = [match[0] for match in _MENTIONED.finditer(plain)]
    says = bool(found) or bool(_SPECULAR_WORDS.search(text[:_LONGEST]))
    # "Integrating sphere, d/8": the angle says more.
    geometry = next((words for words in found if re.search(r"\d", words)), "".join(found[:1]))
    return geometry, (specular_of(text) if says else "")


def is_specular(text: str) -> bool:
    """Return whether a text is a maker's word for specular light in or out, and nothing else."""
    return bool(re.fullmatch(r"\W*R?(?:SCI|SCE|SPIN|SPEX|SIN(?<=RSIN)|SEX(?<=RSEX))\W*", text))


def specular_of(text: str) -> str:
    """Return ``"SCI"``, ``"SCE"``, or nothing where the words do not say which it is.

    Makers' words count: SPIN and SPEX, specular included and excluded, and CIE's di and de.
    """
    plain = _plain(text[:_LONGEST])
    included, excluded = bool(_INCLUDED.search(plain)), bool(_EXCLUDED.search(plain))
    if not included and not excluded:
        sphere = _SPHERE.search(plain)
        letters = sphere.groups() if sphere else ()
        included, excluded = "i" in letters, "e" in letters
    if included == excluded:
        return ""  # nothing said, or a list of both
    return "SCI" if included else "SCE"


def _plain(text: str) -> str:
    """Return lower-case text without degree signs."""
    # µ-style look-alikes of the degree sign are as common as the sign itself.
    lower = re.sub(r"[°º˚]|\bdeg(?:rees?)?\b\.?|(?<=\d)deg(?:rees?)?\b", "", text.lower())
    # "45\0" and "45-0": the hyphen only between two numbers, where it cannot be a sign.
    lower = re.sub(r"(?<=\d)\s*\\\s*(?=[\dd])|(?<=d)\s*\\\s*(?=\d)", ":", lower)
    return re.sub(r"(?<=\b45)\s*-\s*(?=0\b)|(?<=\b0)\s*-\s*(?=45\b)", ":", lower)


def _title(name: str) -> str:
    return REGISTRY[name].title.split(",")[0]


def _value(text: str) -> float:
    return float(text.replace(",", "."))


def _multi_angle(plain: str) -> tuple[str, str] | None:
    match = _ASPECULAR.search(plain)
    if not match:
        return None
    light = _value(match[2]) if match[2] else 45.0
    angle = _value(next(text for text in (match[1], match[3], match[4]) if text))
    known = {i.aspecular: i for i in REGISTRY.values() if i.aspecular is not None}
    nearest = min(known, key=lambda aspecular: abs(aspecular - angle))
    exact = nearest == angle and light == known[nearest].light.tilt
    return known[nearest].name, "" if exact else _OTHER


def _sphere(plain: str, specular: str) -> tuple[str, str] | None:
    match = _SPHERE.search(plain)
    both = _DIFFUSE_BOTH.search(plain)
    if not (match or both or (_HEMISPHERE.search(plain) and not _PAIR.search(plain))):
        return None
    says = specular or specular_of(plain)
    angle = _value(match[2] or match[4] or match[7]) if match else _angle_alone(plain)
    whole = bool(_ONE_DIRECTION.search(plain)) or (match is not None and "h" in match[0])
    # A detector at 0° looks at its own opening, which is a gloss trap (ISO 2469 has one too).
    trapped = says == "SCE" or (angle == 0.0 and says != "SCI")
    nearest = _nearest_sphere(angle, trapped and not both)
    if both or (angle is not None and angle != nearest.view.tilt):
        return nearest.name, _OTHER
    if angle is None:
        return nearest.name, NO_ANGLE
    if not says and not whole and angle != 0.0:
        return nearest.name, "does not say whether specular light is included"
    return nearest.name, ""


def _nearest_sphere(angle: float | None, trapped: bool) -> Instrument:
    """Return the sphere, with a gloss trap or without, whose detector looks from nearest by."""
    spheres = [
        instrument
        for instrument in REGISTRY.values()
        if instrument.light == HEMISPHERE and bool(instrument.trap) == trapped
    ]
    if angle is None:
        return spheres[0]
    return min(spheres, key=lambda instrument: abs(instrument.view.tilt - angle))


def _angle_alone(plain: str) -> float | None:
    """Return the angle of words such as "directional-hemispherical, 8°"; None unless it is one."""
    found = re.findall(rf"(?<![\w.]){_NUMBER}(?![\w.])", plain)
    return _value(found[0]) if len(found) == 1 else None


def _two_angles(plain: str) -> tuple[str, str] | None:
    match = _PAIR.search(plain)
    words = match or _INCIDENCE.search(plain)
    if not words:
        return None
    light, view = abs(_value(words[1])), abs(_value(words[3 if match else 2]))
    if max(light, view) >= 90.0:
        return None  # a ratio
    ring = (match[2] or match[4] or "")[:1] if match else "x"
    if not ring:
        ring = "x" if _SIDE_WORD.search(plain) and not _RING_WORD.search(plain) else "a"
    name = _of_angles(light, view, one_sided=ring in ("x", "d"))
    return (name, "") if name else (ASSUMED, _OTHER)


def _of_angles(light: float, view: float, one_sided: bool) -> str | None:
    """Return the ideal instrument of two angles, one of them the normal.

    Of the same sides if there is one, and in the same order: else what reads the same.
    """
    fits = [
        instrument
        for instrument in REGISTRY.values()
        if instrument.aspecular is None
        and instrument.light.half_angle == instrument.view.half_angle == 0.0
        and {instrument.light.tilt, instrument.view.tilt} == {light, view}
        and 0.0 in (light, view)
    ]

    def rank(instrument: Instrument) -> tuple[bool, bool]:
        ring = instrument.light.all_around or instrument.view.all_around
        return ring == one_sided, instrument.light.tilt != light

    return min(fits, key=rank).name if fits else None


def geometry_of_device(model: str) -> str:
    """Return the geometry that makers state for a device, or an empty string."""
    plain = model[:_LONGEST].lower()
    return next((geometry for pattern, geometry in _DEVICES if pattern.search(plain)), "")


def device_in_text(text: str) -> str:
    """Return the device of a known geometry, or of several, that free text names, or nothing."""
    for pattern in (*(pattern for pattern, _ in _DEVICES), _MULTI_ANGLE):
        for match in pattern.finditer(text[:_LONGEST].lower()):
            if match[0] not in _WORDS:
                # All of the model, as in "Ci7800".
                end = re.match(r"[\w-]*", text[match.end() :])
                return text[match.start() : match.end() + (end.end() if end else 0)]
    return ""


def is_multi_angle(text: str) -> bool:
    """Return whether a device reads at several angles, by its name or what is said of it."""
    plain = text[:_LONGEST].lower()
    return bool(_MULTI_ANGLE.search(plain) or re.search(r"multi[- ]?angle", plain))


_WORDS = {"exact", "isis", "isis "}
"""Names of devices that free text holds without meaning one."""
_MULTI_ANGLE = re.compile(r"byk[- ]?mac\b|\bma-?(?:t\d|5\b|6\b|68|9\d)|\bcm-?(?:512|m6\b)")
_DEVICES = (
    (re.compile(r"\bcm-?3630|\belrepho\b"), "d/0"),
    (
        # Not all of a maker's: Konica Minolta's CM-2500c is 45/0, its CM-512m3 has many angles.
        re.compile(
            r"\bsp-?6[0248]\b|\bci[67]\d{1,3}|\bcolor i[57]\b|\bcolor-?eye\b|\bce-?7000|"
            r"\bcm-?(?:5\b|17d|2[56]d|36d|508[di]|[67]00d|2[356]00d|3[25]\d0|3[67](?!30)\d0)|"
            r"\bdatacolor (?:spectro (?:7\d0|10\d0)|check\b|1[01]\d\d|[4-8][05]0)\b|"
            r"\b(?:spectraflash|spectroflash)\b|\bsf-?(?:[356]00|[456]50)\b|\bultrascan\b|"
            r"\bcolorquest\b|\bspectro-?2?-?guide (?:sphere|d/?8)|\bts-?7[67]00\b|\bys-?30[126]0\b"
        ),
        "d/8",
    ),
    (
        re.compile(
            r"spectrolino|spectroscan|\bi1 ?(?:pro|io|basic|photo|studio|isis)|eye-?one|isis\b|"
            r"color ?munki|\bdtp-?(?:20|22|41|70)\b|\bexact\b|\bfd-?[579]\b|myiro|"
            r"spectro ?(?:lfp|pad)|\bcolorflex\b|\bcm-?25(?:cg|00c)|\bdatacolor 45|"
            r"\bnix (?:pro|mini|spectro|qc)|\bspectroeye\b|\bspectro(?:dens|drive|jet)\b|"
            r"\bvariable spectro\b|\bspectro 1\b|\bspectro-?2?-?guide 45|\bys-?45[168]0\b"
        ),
        "45/0",
    ),
    (re.compile(r"\blabscan\b|\bagera\b|\bx-?rite (?:93[89]|96[24])\b"), "0/45"),
)
