"""Decides when packages are imported: early in a thread, at their first use, or not at all."""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import os
import sys
import threading
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any, Iterator

# Packages that other packages import, but that runs use late, seldom or never; with the optional
# packages that they would import, and that runs do not need.
_LATE: dict[str, tuple[str, ...]] = {
    "numpy.f2py": (), "numpy.testing": (), "scipy.special": (),
    "boto3": (), "pyproj": (),
    "laspy": ("laszip", "requests"),
    "pyogrio": ("geopandas", "pandas", "pyarrow", "shapely"),
}  # fmt: skip
_is_ours = threading.Event()
_lock = threading.Lock()


def import_early(*names: str) -> None:
    """Import modules that a later step needs in a thread, while the caller reads a file."""

    # If a module is missing or broken, the later step reports it.
    def load() -> None:
        with contextlib.suppress(ImportError):
            for name in names:
                importlib.import_module(name)

    threading.Thread(target=load, name="imports", daemon=True).start()


def own_this_process() -> None:
    """Note that this process belongs to Bare Earth, not to a program that uses the library."""
    # numpy starts threads of BLAS when it is imported, which takes time. All matrices here are
    # small, so one thread is enough.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    _is_ours.set()


def import_only_what_runs_need() -> None:
    """Import some packages only when they are used, if this process belongs to Bare Earth."""
    if not _is_ours.is_set():
        return
    importlib.import_module("numpy")  # asks itself for its inner modules
    for name, without in _LATE.items():
        if name in sys.modules:
            continue
        package, _, inner = name.rpartition(".")
        spec = None if package else importlib.util.find_spec(name)
        if package or spec:
            sys.modules[name] = late = _Late(name, spec, without)
            if package in sys.modules:
                setattr(sys.modules[package], inner, late)


class _Late(ModuleType):
    """A module that is imported when one of its attributes is first used."""

    def __init__(self, name: str, spec: ModuleSpec | None, without: tuple[str, ...]) -> None:
        super().__init__(name)
        self.__spec__ = spec  # used to find out whether a package is installed
        self._without = without

    def __getattr__(self, name: str) -> Any:
        # Python reads these attributes of all modules.
        if name in ("__file__", "__wrapped__", "__warningregistry__"):
            raise AttributeError(name)
        with _lock:
            is_first = sys.modules.get(self.__name__) is self
            if is_first:
                del sys.modules[self.__name__]
        with _as_if_missing(*(self._without if is_first else ())):
            module = importlib.import_module(self.__name__)
        return getattr(module, name)


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
