"""The folders of packages: one in the zip of the plugin, and one in the user's profile."""

from __future__ import annotations

import importlib
import shutil
import sys
from pathlib import Path

from ...algorithms.core.temporary import patiently, remove
from .build import Build

# Only in the zip (see tools/package.py), not in a clone of the repository.
BUNDLED = Path(__file__).parents[2] / "packages"
# Windows cannot delete loaded libraries, so the folder is marked until the next start.
_REMOVED = "removed.txt"
# In the profile.
_HOME = "bare_earth"


def profile_folder(profile: Path) -> Path:
    """Return the folder of packages in a profile of QGIS for this Python; it need not exist."""
    return profile / _HOME / "packages" / Build.here().name


def add_to_path(folder: Path) -> None:
    """Let Python find the packages of a folder, after the packages of QGIS."""
    if (folder / _REMOVED).exists():
        remove(folder)
    elif folder.is_dir() and str(folder) not in sys.path:
        sys.path.append(str(folder))
    importlib.invalidate_caches()


def take_from_path(folder: Path) -> bool:
    """Let Python forget the packages of a folder; return whether any was imported."""
    count = len(sys.modules)
    sys.path[:] = [path for path in sys.path if path != str(folder)]
    inside = f"{folder}/".replace("\\", "/")
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None) or ""
        if file.replace("\\", "/").startswith(inside):
            del sys.modules[name]
    importlib.invalidate_caches()
    return len(sys.modules) < count


def replace(folder: Path, new: Path) -> bool:
    """Replace a folder by the folder `new`, and return whether it was; if not, Windows still uses a
    package in the old folder.
    """
    if not delete(folder):
        return False
    folder.parent.mkdir(parents=True, exist_ok=True)
    patiently(new.replace, folder)
    return True


def delete(folder: Path) -> bool:
    """Delete a folder and return True, or mark it as unused, to be deleted at the next start."""
    if take_from_path(folder):  # Windows keeps what is loaded, there is nothing to wait for
        shutil.rmtree(folder, ignore_errors=True)
    else:
        remove(folder)
    if folder.exists():
        (folder / _REMOVED).touch()
    return not folder.exists()


def remove_if_uninstalled(plugin: Path, profile: Path) -> None:
    """Remove everything that the plugin put into a profile, if the folder of the plugin is gone."""
    # QGIS does not say whether it unloads a plugin to update or to uninstall it.
    if plugin.exists():
        return
    # Marked one by one, since a plugin that is installed again must not use what is left of them.
    if all([delete(path) for path in (profile / _HOME / "packages").glob("*")]):
        remove(profile / _HOME)
