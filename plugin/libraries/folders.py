"""The folders of packages: one that travels in the zip, and one in the user's profile."""

from __future__ import annotations

import importlib
import shutil
import sys
from pathlib import Path

from .build import Build

# The zip holds it, see tools/package.py; a clone of the repository does not.
BUNDLED = Path(__file__).parents[2] / "packages"
# Windows cannot delete what is loaded, so a folder can only be marked until the next start.
_REMOVED = "removed.txt"


def profile_folder(profile: Path) -> Path:
    """Return the folder of this Python's packages in a profile of QGIS; it need not exist."""
    return profile / "bare_earth" / "packages" / Build.here().name


def add_to_path(folder: Path) -> None:
    """Let Python find the packages of a folder, after all others: QGIS's own come first."""
    if (folder / _REMOVED).exists():
        shutil.rmtree(folder, ignore_errors=True)
    elif folder.is_dir() and str(folder) not in sys.path:
        sys.path.append(str(folder))
    importlib.invalidate_caches()


def take_from_path(folder: Path) -> None:
    """Let Python forget the packages of a folder, also those that are imported."""
    sys.path[:] = [each for each in sys.path if each != str(folder)]
    inside = f"{folder}/".replace("\\", "/")
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None) or ""
        if file.replace("\\", "/").startswith(inside):
            del sys.modules[name]
    importlib.invalidate_caches()


def replace(folder: Path, new: Path) -> bool:
    """Put the folder `new` in the place of another.

    Returns
    -------
    bool
        Whether that could be done; if not, Windows holds a package that was loaded before.
    """
    if not delete(folder):
        return False
    folder.parent.mkdir(parents=True, exist_ok=True)
    new.replace(folder)
    return True


def delete(folder: Path) -> bool:
    """Delete a folder, or mark it so that it is not used again and deleted at the next start.

    Returns
    -------
    bool
        Whether the folder is gone.
    """
    take_from_path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    if folder.exists():
        (folder / _REMOVED).touch()
    return not folder.exists()
