# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write addon/colorimetry/cie_tables.npy: observers, illuminants, daylight, by colour-science.

    .venv/bpy-5.2/bin/python -m tools.tables.make_cie_tables

The same library gives the same bytes; the tests compare with it.
"""

import warnings

import numpy as np

from tools.run.run_command_line import load_extension

OBSERVERS = {
    2: "CIE 1931 2 Degree Standard Observer",
    10: "CIE 1964 10 Degree Standard Observer",
}
LIGHTS = {"F2": "FL2", "F7": "FL7", "F11": "FL11"}
"""What colour-science calls illuminants that it has other names for."""


def main() -> None:
    """Take the tables from colour-science and write them."""
    load_extension()
    from rough_spectra.addon.colorimetry import cie_tables
    from rough_spectra.addon.support.colour_science import colour

    # colour-science tells on the console of every table that it aligns.
    warnings.simplefilter("ignore")
    science = colour()
    grid = cie_tables.GRID
    shape = science.SpectralShape(grid[0], grid[-1], 1)
    rows = []
    for degrees in cie_tables.OBSERVERS:
        rows += list(science.MSDS_CMFS[OBSERVERS[degrees]].copy().align(shape).values.T)
    for name in (*cie_tables.ILLUMINANTS, *cie_tables.LAMPS):
        table = science.SDS_ILLUMINANTS[LIGHTS.get(name, name)]
        rows.append(table.copy().align(shape).values)
    parts = science.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES
    rows += [np.interp(grid, parts[s].wavelengths, parts[s].values) for s in ("S0", "S1", "S2")]
    np.save(cie_tables.FILE, np.array(rows), allow_pickle=False)
    print(f"{cie_tables.FILE}: {cie_tables.FILE.stat().st_size} bytes")


if __name__ == "__main__":
    main()
