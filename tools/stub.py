"""Writes `__init__.pyi` and `arrays.pyi`, from which editors and mypy know the library.

python tools/stub.py FOLDER   writes them into the folder of the package, as setup.py does
"""

from __future__ import annotations

import inspect
import sys
import textwrap
from pathlib import Path

from bare_earth.algorithms.library import array_names, arrays, names
from bare_earth.algorithms.library.functions import Function
from bare_earth.algorithms.library.tools import declared

_PATH = "str | PathLike[str]"
_HEAD = """\
# Made by tools/stub.py from what tools declare. Do not edit.
# ruff: noqa
# fmt: off
from os import PathLike
from typing import Any, Callable, Iterable, Literal, Sequence

"""
_PACKAGE = """\
from .algorithms.core.errors import BareEarthError as BareEarthError
from .algorithms.core.errors import Cancelled as Cancelled
from .algorithms.core.progress import Progress as Progress
from .algorithms.core.version import __version__ as __version__
from .algorithms.library.given import Bar
"""
_ARRAYS = """\
from numpy import bool_, float64, uint8
from numpy.typing import ArrayLike, NDArray

from .algorithms.core.progress import Progress
from .algorithms.library.blocks import Block as Block
from .algorithms.library.features import Features as Features
from .algorithms.library.given import Bar
from .algorithms.library.rasters import Raster as Raster
"""


def stubs() -> dict[str, str]:
    """Return the texts of the stubs, by their names."""
    functions, on_arrays = map(declared, names()), map(arrays.declared, array_names())
    plugin = "def classFactory(iface: Any) -> Any: ...\n"
    return {
        "__init__.pyi": _text(_PACKAGE, plugin, [*functions]),
        "arrays.pyi": _text(_ARRAYS, "", [*on_arrays]),
    }


def _text(imports: str, more: str, functions: list[Function]) -> str:
    """Return the text of a stub."""
    results = {function.result for function in functions} - {None}
    lines = sorted(f"from {kind.__module__[10:]} import {kind.__name__}\n" for kind in results)
    head = [f"{_HEAD}{imports}{''.join(lines)}", f"_Path = {_PATH}\n", *[more] * bool(more)]
    return "\n".join([*head, *map(_of, functions)])


def _of(function: Function) -> str:
    lines, is_keyword = [], False
    for argument in (described.parameter for described in function.parameters):
        if argument.kind is inspect.Parameter.KEYWORD_ONLY and not is_keyword:
            lines, is_keyword = [*lines, "*,"], True
        default = "" if argument.default is inspect.Parameter.empty else f" = {argument.default!r}"
        lines.append(f"{argument.name}: {argument.annotation.replace(_PATH, '_Path')}{default},")
    head = textwrap.indent("\n".join(lines), "    ")
    return f"def {function.name}(\n{head}\n) -> {function.returns}: ...\n"


def write(package: Path) -> None:
    """Write the stubs into the folder of the package."""
    for name, text in stubs().items():
        (package / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write(Path(sys.argv[1]))
