"""Finds missing packages for reading and writing, and tells how to install them.

The packages are not imported here, so that the plugin can check them in every QGIS.
"""

from __future__ import annotations

import importlib.util
import shutil
import sys
from pathlib import Path
from typing import Iterable

from ..core.errors import BareEarthError

READING = ("laspy", "lazrs")
WRITING_COPC = ("lazrs",)

# This file exists in every Flatpak.
_FLATPAK = Path("/.flatpak-info")
_PURPOSES = {
    "laspy": "reading point clouds",
    "lazrs": "reading and writing .laz and .copc.laz files",
    "distributed": "working on a Dask cluster",
}


def missing_packages(packages: Iterable[str] = READING) -> list[str]:
    """Return the `packages` that this Python does not have."""
    return [name for name in packages if importlib.util.find_spec(name) is None]


def require(*packages: str) -> None:
    """Raise an error that says how to install `packages` if one of them is missing."""
    missing = missing_packages(packages)
    if missing:
        purpose = _PURPOSES.get(missing[0], "this")
        lacking = "QGIS does not have yet" if _inside_qgis() else "Python does not have"
        raise BareEarthError(
            f"{purpose[0].upper()}{purpose[1:]} needs {' and '.join(missing)}, which this"
            f" {lacking}. {install_hint(missing)}"
        )


def install_hint(packages: Iterable[str]) -> str:
    """Return a sentence that tells how to install `packages` for this Python."""
    # Inside QGIS, the plugin installs lazrs and contains laspy. numpy and scipy are part of QGIS,
    # and are installed as QGIS was.
    missing = list(packages)
    if not _inside_qgis():
        command = f"{_quoted(sys.executable)} -m pip install {' '.join(missing)}"
        return f"Install with: {command}"
    if missing == ["lazrs"]:
        return "Choose Plugins > Bare Earth > LAZ support in the QGIS window to get it."
    if "laspy" in missing:
        return "Install the plugin from its zip, which holds laspy; a clone does not."
    return _command_of_the_build(missing)


def _command_of_the_build(packages: list[str]) -> str:
    """Return the command that adds packages to this build of QGIS."""
    names, debs = " ".join(packages), " ".join(f"python3-{name}" for name in packages)
    if sys.platform == "win32":
        command = f"osgeo4w-setup -q -k -P {debs.replace(' ', ',')}"
        return (
            f"Open the OSGeo4W Shell from the Windows start menu, type '{command}' and restart"
            " QGIS."
        )
    if sys.platform == "darwin":
        program = Path(sys.executable).parent
        # The bundles of QGIS 3.44 and later, and those before.
        pythons = [program / "python", program / "bin" / "python3"]
        python = next((path for path in pythons if path.is_file()), pythons[0])
        command = f"{_quoted(str(python))} -m pip install --user --no-deps {names}"
    elif _FLATPAK.exists():
        command = f"flatpak run --devel --command=pip3 org.qgis.qgis install {names} --user"
    else:
        managers = ("apt-get", "dnf", "zypper")
        manager = next((name for name in managers if shutil.which(name)), "apt-get")
        command = f"sudo {manager} install {debs}"
    return f"In a terminal, type '{command}' and restart QGIS."


def _inside_qgis() -> bool:
    return "qgis.core" in sys.modules


def _quoted(path: str) -> str:
    return f'"{path}"' if " " in path else path or "python"
