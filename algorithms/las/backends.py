"""Which packages reading and writing need, and how to get those that are missing.

Nothing is imported here, so that the plugin can ask in every QGIS.
"""

from __future__ import annotations

import importlib.util
import sys
import sysconfig
from pathlib import Path
from typing import Iterable

from ..core.errors import BareEarthError

READING = ("laspy", "lazrs")
WRITING_COPC = ("lazrs",)

_PURPOSES = {
    "laspy": "reading point clouds",
    "lazrs": "reading and writing .laz and .copc.laz files",
    "distributed": "working on a Dask cluster",
}


def missing_packages(packages: Iterable[str] = READING) -> list[str]:
    """Return those of `packages` that this Python does not have.

    Examples
    --------
    >>> missing_packages(["sys", "no_such_package"])
    ['no_such_package']
    """
    return [name for name in packages if importlib.util.find_spec(name) is None]


def require(*packages: str) -> None:
    """Refuse to go on without `packages`.

    Raises
    ------
    BareEarthError
        If one is missing; the text says how to install it here.
    """
    missing = missing_packages(packages)
    if missing:
        purpose = _PURPOSES.get(missing[0], "this")
        raise BareEarthError(
            f"{purpose[0].upper()}{purpose[1:]} needs {' and '.join(missing)}, which this Python"
            f" does not have. {install_hint(missing)}"
        )


def install_hint(packages: Iterable[str]) -> str:
    """Return a sentence with the command that installs `packages` for the Python at hand.

    Inside QGIS the command keeps pip away from numpy, of which QGIS has its own.
    """
    names = " ".join(packages)
    if not _inside_qgis():
        return f"Install with: {_quoted(sys.executable)} -m pip install {names}"
    if sys.platform == "win32":
        return (
            f"Open the OSGeo4W Shell from the Windows start menu, type"
            f" 'python -m pip install --no-deps {names}' and start QGIS anew."
        )
    if sys.platform == "darwin":
        return (
            f"In the Terminal, type '/Applications/QGIS.app/Contents/MacOS/bin/python3 -m pip"
            f" install --no-deps {names}' and start QGIS anew."
        )
    flags = "--user --no-deps"
    if (Path(sysconfig.get_path("stdlib")) / "EXTERNALLY-MANAGED").exists():
        flags += " --break-system-packages"
    return f"In a terminal, type 'python3 -m pip install {flags} {names}' and start QGIS anew."


def _inside_qgis() -> bool:
    return "qgis.core" in sys.modules


def _quoted(path: str) -> str:
    return f'"{path}"' if " " in path else path or "python"
