# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write addon/colorimetry/e308_weights.npy: ASTM E308's usual grids, by colour-science.

    .venv/bpy-5.2/bin/python -m tools.tables.make_e308_weights

The same library gives the same bytes but for the last digit; the tests compare with it.
"""

import warnings

import numpy as np
import numpy.typing as npt

from tools.run.run_command_line import load_extension
from tools.tables.make_cie_tables import LIGHTS, OBSERVERS


def main() -> None:
    """Compute and write the weights."""
    load_extension()
    from rough_spectra.addon.colorimetry import astm_e308 as e308
    from rough_spectra.addon.colorimetry import cie_tables
    from rough_spectra.addon.support.colour_science import colour

    science = colour()

    def weights(bands: npt.NDArray[np.float64], light: str, observer: int) -> npt.ArrayLike:
        """Compute ASTM E308 of every unit spectrum."""
        xyz = science.msds_to_XYZ(
            science.MultiSpectralDistributions(np.eye(bands.size), bands),
            cmfs=science.MSDS_CMFS[OBSERVERS[observer]],
            illuminant=science.SDS_ILLUMINANTS[LIGHTS.get(light, light)],
            method="ASTM E308",
        )
        return np.asarray(xyz) / 100

    # colour-science tells on the console of every table that it aligns.
    warnings.simplefilter("ignore")
    rows = [
        [
            np.concatenate(
                [weights(e308.whole(step), light, observer) for step in e308.TABLED_STEPS]
            )
            for light in cie_tables.ILLUMINANTS
        ]
        for observer in cie_tables.OBSERVERS
    ]
    np.save(e308.FILE, np.array(rows), allow_pickle=False)
    print(f"{e308.FILE}: {e308.FILE.stat().st_size} bytes")


if __name__ == "__main__":
    main()
