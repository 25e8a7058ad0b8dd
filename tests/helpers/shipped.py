"""The code that is shipped, read once for all tests that look at it."""

import ast
import functools
from pathlib import Path

ROOT = Path(__file__).parents[2]
SHIPPED = sorted(
    [ROOT / "__init__.py", *(ROOT / "algorithms").rglob("*.py"), *(ROOT / "plugin").rglob("*.py")]
)


@functools.cache
def name_of(path):
    """Return the name of a file from the root of the repository."""
    return path.relative_to(ROOT).as_posix()


@functools.cache
def tree_of(path):
    """Return the code of a file."""
    return ast.parse(path.read_text(encoding="utf-8"))


@functools.cache
def nodes():
    """Return each piece of shipped code, with its file."""
    return [(path, node) for path in SHIPPED for node in ast.walk(tree_of(path))]
