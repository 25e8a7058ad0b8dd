"""Lets NumPy and OpenBLAS compute as on processors with fewer instructions."""

from __future__ import annotations

from typing import Sequence

# What NumPy may not use on each level, by the beginnings of the names, which differ between its
# versions, and the processor for which OpenBLAS computes.
LEVELS = {
    "without AVX-512": (("AVX512", "X86_V4"), "Haswell"),
    "without AVX": (("AVX", "F16C", "FMA", "X86_V"), "Nehalem"),
}


def environment(level: str) -> dict[str, str]:
    """Return the variables of a level, or none if it is that of this processor. NumPy takes
    names that it or the processor lacks for errors.
    """
    beginnings, kernel = LEVELS[level]
    off = " ".join(name for name in _features() if name.startswith(beginnings))
    return {"NPY_DISABLE_CPU_FEATURES": off, "OPENBLAS_CORETYPE": kernel} if off else {}


def _features() -> Sequence[str]:
    """Return what NumPy would use here beyond what it was built for."""
    try:
        from numpy._core import _multiarray_umath as built
    except ImportError:  # before NumPy 2
        from numpy.core import _multiarray_umath as built
    return [name for name in built.__cpu_dispatch__ if built.__cpu_features__.get(name)]
