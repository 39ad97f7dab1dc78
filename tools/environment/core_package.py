# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The core as a Python package of its own, `rough-spectra-core`: a wheel without Blender.

`core/` imports itself by relative names only, so it works under any name. The wheel is written
here, since there is nothing to compile; equal sources give equal bytes.
"""

from __future__ import annotations

import base64
import hashlib
from pathlib import Path

from . import archives, package

NAME = "rough-spectra-core"
MODULE = "rough_spectra_core"
NUMPY = "1.26"
"""The oldest numpy that it is tested with: that of Blender 4.5 LTS."""

_METADATA = """Metadata-Version: 2.4
Name: {name}
Version: {version}
Summary: Physics of rough reflectance on numpy arrays: readings, albedos and Cycles' shaders
License-Expression: GPL-3.0-or-later
License-File: LICENSE
Requires-Python: >=3.11
Requires-Dist: numpy>={numpy}
Classifier: Typing :: Typed
Description-Content-Type: text/markdown

# {name}

What the Blender extension Rough Spectra computes with, on numpy arrays and without Blender: how a
rough surface of a given albedo reads at an instrument, the albedo behind a reading, the models of
interreflection, emissivity, and the color and roughness with which Cycles reads the same.

```python
from math import radians

from {module} import reading

reading.from_albedo([0.2, 0.5, 0.8], radians(30), model="surface", instrument="45a:0")
```

Angles are radians, reflectance is a fraction, wavelengths run along the last axis. Every public
function has an example in its docstring.
"""

_WHEEL = "Wheel-Version: 1.0\nGenerator: dev.py\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


def build(root: Path, folder: Path) -> Path:
    """Write the wheel into a folder and return its path.

    Parameters
    ----------
    root
        Root of the repository.
    folder
        Where to put it.
    """
    version = package.version(root)
    about = f"{MODULE}-{version}.dist-info"
    staged = folder / "stage-core"
    package.stage(root, staged, ["LICENSE"], ["core"])
    code = sorted(path for path in (staged / "core").rglob("*") if path.is_file())
    files = {
        f"{MODULE}/{path.relative_to(staged / 'core').as_posix()}": path.read_bytes()
        for path in code
    }
    told = _METADATA.format(name=NAME, module=MODULE, version=version, numpy=NUMPY)
    files[f"{about}/METADATA"] = told.encode()
    files[f"{about}/WHEEL"] = _WHEEL.encode()
    files[f"{about}/licenses/LICENSE"] = (staged / "LICENSE").read_bytes()
    lines = [f"{name},{_digest(content)},{len(content)}" for name, content in files.items()]
    files[f"{about}/RECORD"] = "\n".join([*lines, f"{about}/RECORD,,", ""]).encode()
    wheel = folder / f"{MODULE}-{version}-py3-none-any.whl"
    archives.write(wheel, files)
    return wheel


def _digest(content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"sha256={digest}"
