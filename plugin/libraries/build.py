"""Which compiled packages this Python can load."""

from __future__ import annotations

import platform
import re
import sys
import sysconfig
from dataclasses import dataclass

from ..i18n import tr

# Versions of glibc, by the older names of wheels without version numbers.
_LEGACY_GLIBC = {"1": (2, 5), "2010": (2, 12), "2014": (2, 17)}


@dataclass(frozen=True)
class Build:
    """A build of Python, as far as compiled packages depend on it."""

    python: tuple[int, int]  # such as (3, 11)
    system: str  # as wheels call it: "linux", "macosx", "win" or another
    machine: str  # processor as wheels call it: "x86_64", "arm64", "amd64"
    version: tuple[int, int] = (0, 0)  # of glibc in Linux, or of macOS; otherwise (0, 0)

    @classmethod
    def here(cls) -> Build:
        """Return the build of the running Python."""
        system, _, machine = sysconfig.get_platform().partition("-")
        version = "0.0"
        if system == "macosx":
            # The platform is "universal2" in builds for both processors.
            machine, version = platform.machine(), platform.mac_ver()[0]
        elif system == "linux":
            version = platform.libc_ver()[1]
        numbers = [int(number) for number in re.findall(r"\d+", version)[:2]]
        major, minor = (*numbers, 0, 0)[:2]
        return cls(sys.version_info[:2], system, machine, (major, minor))

    @property
    def name(self) -> str:
        """Return a short name of what compiled packages depend on, as cp311-linux_x86_64."""
        # The platform of 32-bit Windows is "win32", without a processor.
        return "-".join([self._python, "_".join(filter(None, [self.system, self.machine]))])

    @property
    def wheels(self) -> str:
        """The tags that wheels must have, in words: "cp311 and linux_x86_64"."""
        return tr("{} and {}").format(*self.name.split("-", 1))

    @property
    def _python(self) -> str:
        return "cp{}{}".format(*self.python)

    def takes(self, tag: str) -> bool:
        """Return whether a wheel with a tag, as in the file WHEEL (PEP 425, PEP 600), such as
        cp311-cp311-manylinux_2_17_x86_64, can be loaded.
        """
        python, abi, system = (*tag.split("-", 2), "", "", "")[:3]
        return self._takes_python(python, abi) and (system == "any" or self._takes_system(system))

    def _takes_python(self, python: str, abi: str) -> bool:
        if abi == "none":
            return python in ("py3", self._python)
        if abi == "abi3":
            # The stable ABI of a version also works in all later versions.
            found = re.fullmatch(r"cp3(\d+)", python)
            return found is not None and self.python >= (3, int(found[1]))
        return python == abi == self._python

    def _takes_system(self, system: str) -> bool:
        if self.system == "linux":
            return self._takes_linux(system)
        if self.system == "macosx":
            found = re.fullmatch(r"macosx_(\d+)_(\d+)_(\w+)", system)
            if not found or found.group(3) not in (self.machine, "universal2"):
                return False
            # To older Pythons, every macOS since 11 reports the version 10.16.
            version = (99, 0) if self.version == (10, 16) else self.version
            return (int(found.group(1)), int(found.group(2))) <= version
        return system == self.name.partition("-")[2]

    def _takes_linux(self, system: str) -> bool:
        found = re.fullmatch(
            rf"(linux|musllinux|manylinux)(1|2010|2014|_(\d+)_(\d+))?_{self.machine}", system
        )
        if not found:
            return False
        kind, legacy = found.group(1), _LEGACY_GLIBC.get(found.group(2) or "")
        if kind == "linux":
            return True
        if kind == "musllinux":  # systems with musl have no glibc
            return self.version == (0, 0)
        needed = legacy or (int(found.group(3) or 0), int(found.group(4) or 0))
        return needed <= self.version
