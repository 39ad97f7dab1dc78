# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write presets/index.json: what lists show of the presets.

    .venv/bpy-5.2/bin/python -m tools.tables.make_preset_index

To be run whenever a preset is added or changed; a test says so.
"""

from tools.run.run_command_line import load_extension


def main() -> None:
    """Read all presets and write the index."""
    load_extension()
    from rough_spectra.addon.matching import own_gloss
    from rough_spectra.addon.samples import library, preset_index

    found: list[library.Entry] = []
    glosses: dict[str, tuple[str, list[float]]] = {}
    for file in library.read_presets():
        found += file.entries
        for entry, sample in zip(file.entries, file.samples, strict=True):
            readings = None if sample is None else own_gloss.readings(sample)
            gloss = None if readings is None else own_gloss.estimated(*readings)
            if readings is not None and gloss is not None:
                numbers = [round(number, 6) for number in gloss.numbers()]
                glosses[entry.id] = (own_gloss.key_of(*readings), numbers)
    text = preset_index.text(tuple(found), glosses)
    preset_index.FILE.write_text(text, encoding="utf-8", newline="\n")
    print(f"{preset_index.FILE}: {len(found)} presets")


if __name__ == "__main__":
    main()
