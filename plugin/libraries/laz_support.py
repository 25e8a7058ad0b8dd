"""LAZ support: installs lazrs in the user's profile if the Python of QGIS does not have it."""

from __future__ import annotations

import importlib
import importlib.util
from pathlib import Path
from typing import Callable

from ...algorithms.core.errors import BareEarthError
from ...algorithms.core.files import temporary_folder
from ..i18n import tr
from . import folders, pip, wheels
from .build import Build

PACKAGE = "lazrs"
REQUIREMENTS = Path(__file__).parents[2] / "requirements.txt"


class LazSupport:
    """Installs and removes lazrs in the user's profile of QGIS, and tells whether it is there."""

    def __init__(self, profile: Path) -> None:
        self.folder = folders.profile_folder(profile)

    @property
    def is_there(self) -> bool:
        """Whether any lazrs is installed, so that .laz files can be read."""
        spec = importlib.util.find_spec(PACKAGE)
        # Without origin it is a folder without a package, as of one that is removed only in part.
        return spec is not None and spec.origin is not None

    @property
    def is_ours(self) -> bool:
        """Whether the installed lazrs is in the profile and can be removed."""
        spec = importlib.util.find_spec(PACKAGE)
        return bool(spec and spec.origin and self.folder in Path(spec.origin).parents)

    @property
    def state(self) -> str:
        """The present state as a sentence."""
        if not self.is_there:
            return tr("Not installed yet: .laz and .copc.laz files cannot be read or written.")
        if self.is_ours:
            return tr("Ready. The package lazrs is in {}").format(self.folder)
        return tr("Ready. This QGIS has the package lazrs.")

    def use(self) -> None:
        """Let Python find lazrs in the profile."""
        folders.add_to_path(self.folder)

    def get_by_pip(self, run: pip.Run, proxy: str = "") -> None:
        """Install lazrs from the package index, or raise the reason and leave nothing."""
        self._fill(
            lambda new, scratch: pip.get_by_pip(
                REQUIREMENTS, new, scratch, run, proxy, Build.here()
            )
        )

    def get_from_wheel(self, wheel: Path) -> None:
        """Install lazrs from a wheel file, or leave nothing behind and raise the reason."""
        self._fill(lambda new, _: wheels.unpack(wheel, new, PACKAGE, Build.here()))

    def remove(self) -> str:
        """Remove lazrs from the profile; return a message."""
        if folders.delete(self.folder):
            return tr("Removed.")
        return tr("Removed. Files that are in use are removed when QGIS starts next.")

    def _fill(self, put: Callable[[Path, Path], None]) -> None:
        """Let `put` fill a new folder, replace the present one by it, and import lazrs."""
        try:
            self.folder.parent.mkdir(parents=True, exist_ok=True)
            with temporary_folder(self.folder.parent) as folder:
                new, scratch = folder / "new", folder / "scratch"
                new.mkdir()
                put(new, scratch)
                if not folders.replace(self.folder, new):
                    raise BareEarthError(
                        tr("The removed lazrs is still in use: restart QGIS and try again.")
                    )
        except OSError as error:
            raise BareEarthError(tr("lazrs could not be stored: {}.").format(error)) from error
        self.use()
        try:
            importlib.import_module(PACKAGE)
        except Exception as error:
            folders.delete(self.folder)
            raise BareEarthError(
                tr("This QGIS cannot load the installed lazrs: {}.").format(error)
            ) from error
