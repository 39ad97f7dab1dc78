# SPDX-FileCopyrightText: 2026 Rough Spectra authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Somebody else's extension, with a wheel of its own that has to be left alone."""

import base64
import hashlib
import zipfile
from pathlib import Path

MODULE = "tiny_wheel"
"""What its wheel brings."""

_MANIFEST = """
schema_version = "1.0.0"
id = "tiny"
version = "1.0.0"
name = "Tiny"
tagline = "Brings a wheel"
maintainer = "Nobody"
type = "add-on"
blender_version_min = "4.5.0"
license = ["SPDX:GPL-3.0-or-later"]
wheels = ["./wheels/{wheel}"]
"""


def build(folder: Path) -> Path:
    """Write the zip that Blender installs into a folder, and give its path."""
    wheel = _wheel(folder)
    path = folder / "tiny.zip"
    with zipfile.ZipFile(path, "w") as package:
        package.writestr("blender_manifest.toml", _MANIFEST.format(wheel=wheel.name))
        package.writestr("__init__.py", "def register(): pass\ndef unregister(): pass\n")
        package.write(wheel, f"wheels/{wheel.name}")
    return path


def _wheel(folder: Path) -> Path:
    info = f"{MODULE}-1.0.dist-info"
    files = {
        f"{MODULE}.py": "ANSWER = 42\n",
        f"{info}/METADATA": f"Metadata-Version: 2.1\nName: {MODULE}\nVersion: 1.0\n",
        f"{info}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n",
    }
    lines = [f"{name},sha256={_digest(text)},{len(text)}" for name, text in files.items()]
    record = f"{info}/RECORD"
    path = folder / f"{MODULE}-1.0-py3-none-any.whl"
    with zipfile.ZipFile(path, "w") as wheel:
        for name, text in files.items():
            wheel.writestr(name, text)
        wheel.writestr(record, "\n".join([*lines, f"{record},,", ""]))
    return path


def _digest(text: str) -> str:
    digest = hashlib.sha256(text.encode()).digest()
    return base64.urlsafe_b64encode(digest).rstrip(b"=").decode()
