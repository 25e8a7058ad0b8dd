"""Writes `__init__.pyi`, from which editors and mypy know the functions of the library.

python tools/stub.py   writes it anew; `tests/core/test_library.py` tells when that is to be done
"""

from __future__ import annotations

import inspect
import textwrap
from pathlib import Path

from bare_earth.algorithms.library import names
from bare_earth.algorithms.library.tools import declared

STUB = Path(__file__).parents[1] / "__init__.pyi"
_PATH = "str | PathLike[str]"
_HEAD = """\
# Made by tools/stub.py from what tools declare. Do not edit.
# ruff: noqa
# fmt: off
from os import PathLike
from typing import Any, Callable, Iterable, Literal, Sequence

from .algorithms.core.errors import BareEarthError as BareEarthError
from .algorithms.core.errors import Cancelled as Cancelled
from .algorithms.core.progress import Progress as Progress
from .algorithms.core.version import __version__ as __version__
"""


def stub() -> str:
    """Return the text of the stub."""
    results = {declared(name).result for name in names()} - {None}
    lines = sorted(f"from {kind.__module__[10:]} import {kind.__name__}\n" for kind in results)
    head = [f"{_HEAD}{''.join(lines)}", f"_Path = {_PATH}\n"]
    return "\n".join([*head, "def classFactory(iface: Any) -> Any: ...\n", *map(_of, names())])


def _of(name: str) -> str:
    function = declared(name)
    lines, is_keyword = [], False
    for argument in (described.parameter for described in function.parameters):
        if argument.kind is inspect.Parameter.KEYWORD_ONLY and not is_keyword:
            lines, is_keyword = [*lines, "*,"], True
        default = "" if argument.default is inspect.Parameter.empty else f" = {argument.default!r}"
        lines.append(f"{argument.name}: {argument.annotation.replace(_PATH, '_Path')}{default},")
    text = textwrap.indent(f'"""{function.documentation}"""', "    ").replace("\\", "\\\\")
    head, result = textwrap.indent("\n".join(lines), "    "), function.returns
    return f"def {name}(\n{head}\n) -> {result}:\n{text}\n"


if __name__ == "__main__":
    STUB.write_text(stub(), encoding="utf-8")
