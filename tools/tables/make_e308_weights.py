# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write addon/colorimetry/e308_weights.npy: ASTM E308's usual grids, by colour-science.

    .venv/bpy-5.2/bin/python -m tools.tables.make_e308_weights

The same library gives the same bytes but for the last digit; the tests compare with it.
"""

import warnings

import numpy as np

from tools.run.run_command_line import load_extension


def main() -> None:
    """Compute and write the weights."""
    load_extension()
    from rough_spectra.addon.colorimetry import astm_e308 as e308

    # colour-science tells on the console of every table that it aligns.
    warnings.simplefilter("ignore")
    rows = [
        [
            np.concatenate(
                [e308.by_science(e308.whole(step), light, observer) for step in e308.TABLED_STEPS]
            )
            for light in e308.ILLUMINANTS
        ]
        for observer in e308.OBSERVERS
    ]
    np.save(e308.FILE, np.array(rows), allow_pickle=False)
    print(f"{e308.FILE}: {e308.FILE.stat().st_size} bytes")


if __name__ == "__main__":
    main()
