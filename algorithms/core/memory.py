"""The memory of this computer and of this process."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from typing import Callable

from .progress import PassingOn, Progress

GIGABYTE = 1 << 30
_UNKNOWN = 4 * GIGABYTE
# Seconds of processor time after which freed memory is given back if memory is short. Memory must
# be cleared before it is used again, so this is not done more often on a busy machine.
_SECONDS = 0.4
_MEMINFO = Path("/proc/meminfo")
_STATUS = Path("/proc/self/status")
_CLEAR = Path("/proc/self/clear_refs")
_CGROUP = Path("/sys/fs/cgroup")
# Options of `mallopt` in malloc.h: one heap, arrays of up to 128 MB in the heap, and up to 128 MB
# of free memory at its end.
_HEAP = (-8, 1), (-3, 1 << 27), (-1, 1 << 27)


def _of_c(name: str) -> Callable[..., int] | None:
    """Return a function of the C library of Linux; None on other systems."""
    if sys.platform != "linux":
        return None
    import ctypes

    return getattr(ctypes.CDLL(None), name, None)


def share_one_heap() -> None:
    """Let all threads of this process, which runs only our jobs, use one heap of glibc."""
    # Otherwise each thread has a heap of its own, which keeps the memory that was freed in it.
    mallopt = _of_c("mallopt")
    if mallopt is not None:
        for option in _HEAP:
            mallopt(*option)


def give_back() -> None:
    """Return the freed memory that glibc keeps to the system."""
    trim = _of_c("malloc_trim")
    if trim is not None:
        trim(0)


class GivingBack(PassingOn):
    """Passes on progress, and at intervals gives freed memory back to the system and calls `also`,
    which frees other memory.
    """

    def __init__(self, whole: Progress, also: Callable[[], None] | None = None) -> None:
        super().__init__(whole)
        self._also, self._given = also, time.process_time()

    def report(self, fraction: float) -> None:
        super().report(fraction)
        if time.process_time() - self._given > _SECONDS:
            give_back()
            if self._also is not None:
                self._also()
            self._given = time.process_time()


class PeakMemory:
    """Measures how much memory this process takes from now on, in Linux."""

    def __init__(self) -> None:
        self._begun = _own("VmRSS")
        try:
            # The peak counts from now on.
            _CLEAR.write_text("5", encoding="ascii")
        except OSError:
            self._begun = None

    def end(self) -> int | None:
        """Return the largest number of bytes that were taken in addition to those at the start."""
        peak = _own("VmHWM")
        if self._begun is None or peak is None:
            return None
        return max(peak - self._begun, 0)


def _own(name: str) -> int | None:
    for line in _lines(_STATUS):
        if line.startswith(f"{name}:"):
            return int(line.split()[1]) * 1024
    return None


def free_memory() -> int:
    """Return the bytes of free memory; 4 GB if this is not known."""
    free = _FREE.get(sys.platform, _linux_free)()
    limits = [_cgroup_free(), _UNKNOWN if free is None else free]
    return min(limit for limit in limits if limit is not None)


def _linux_free() -> int | None:
    for line in _lines(_MEMINFO):
        if line.startswith("MemAvailable:"):
            return int(line.split()[1]) * 1024
    try:
        return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError, OSError):
        return None


def _mac_free() -> int | None:
    """Return the bytes of pages that are free or were not used recently."""
    import ctypes

    system = ctypes.CDLL(None)
    # The first four counts: free, active, inactive and wired pages. Flavour 4 is HOST_VM_INFO64,
    # which has 38 words.
    pages, count = (ctypes.c_uint32 * 38)(), ctypes.c_uint32(38)
    system.mach_host_self.restype = ctypes.c_uint32
    if system.host_statistics64(system.mach_host_self(), 4, pages, ctypes.byref(count)):
        return None
    return (pages[0] + pages[2]) * os.sysconf("SC_PAGE_SIZE")


def _cgroup_free() -> int | None:
    """Return the bytes left within the limit of a container, if there is one."""
    limit, used = _lines(_CGROUP / "memory.max"), _lines(_CGROUP / "memory.current")
    if not limit or not used or not limit[0].isdigit():
        return None
    # The system can free used memory that caches files which were not read recently.
    lines = _lines(_CGROUP / "memory.stat")
    cached = [int(line.split()[1]) for line in lines if line.startswith("inactive_file ")]
    return max(int(limit[0]) - int(used[0]) + sum(cached), 0)


def _lines(path: Path) -> list[str]:
    """Return the lines of a system file; none if the file does not exist."""
    try:
        return path.read_text(encoding="ascii").splitlines()
    except (OSError, ValueError):
        return []


def _windows_free() -> int | None:
    import ctypes

    class Status(ctypes.Structure):
        _fields_ = (
            ("length", ctypes.c_ulong),
            ("load", ctypes.c_ulong),
            *((name, ctypes.c_ulonglong) for name in ("total", "free")),
            *((f"other_{number}", ctypes.c_ulonglong) for number in range(5)),
        )

    status = Status(length=ctypes.sizeof(Status))
    windows = ctypes.windll  # type: ignore[attr-defined]
    if not windows.kernel32.GlobalMemoryStatusEx(ctypes.byref(status)):
        return None
    return int(status.free)


_FREE = {"win32": _windows_free, "darwin": _mac_free}
