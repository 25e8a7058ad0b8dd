"""When packages are imported: early in a thread, when they are first used, or not at all."""

from __future__ import annotations

import contextlib
import importlib
import os
import sys
import threading
from types import ModuleType
from typing import Any, Iterator

# What numpy and scipy import, and runs seldom or never use. Each takes longer than numpy itself.
_SELDOM_USED = ("numpy.f2py", "numpy.testing", "scipy.special")
# What laspy imports if it is installed, for what this package does without laspy.
_BESIDE_LASPY = ("laszip", "pyproj", "requests")
_lock = threading.Lock()


def import_early(*names: str) -> None:
    """Import modules that a later step needs in a thread, while the caller reads a file."""

    # Modules that are missing or broken are left to that step, which says so.
    def load() -> None:
        with contextlib.suppress(ImportError):
            for name in names:
                importlib.import_module(name)

    threading.Thread(target=load, name="imports", daemon=True).start()


def import_only_what_runs_need() -> None:
    """Prepare a process that is ours, and has no other thread yet, for fast imports."""
    # Threads of BLAS take time to start, and all its matrices here are small.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    import numpy as numpy

    for name in _SELDOM_USED:
        if name not in sys.modules:
            package, _, inner = name.rpartition(".")
            sys.modules[name] = late = _WhenUsed(name)
            if package in sys.modules:
                setattr(sys.modules[package], inner, late)
    with _as_if_missing(*_BESIDE_LASPY), contextlib.suppress(ImportError):
        importlib.import_module("laspy")


class _WhenUsed(ModuleType):
    """A module that is imported when one of its attributes is first asked for."""

    def __getattr__(self, name: str) -> Any:
        # What Python itself asks modules for, such as __file__; but packages for their __path__.
        if name.startswith("__") and name != "__path__":
            raise AttributeError(name)
        with _lock:
            if sys.modules.get(self.__name__) is self:
                del sys.modules[self.__name__]
        return getattr(importlib.import_module(self.__name__), name)


@contextlib.contextmanager
def _as_if_missing(*packages: str) -> Iterator[None]:
    """Let imports of packages fail, unless they are imported already."""
    hidden = [package for package in packages if package not in sys.modules]
    sys.modules.update(dict.fromkeys(hidden))  # type: ignore[arg-type]
    try:
        yield
    finally:
        for package in hidden:
            del sys.modules[package]
