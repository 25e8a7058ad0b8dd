"""The walls of the house: who may import whom, and what shipped code must not hold."""

import ast
import functools
import re
import subprocess
import sys

import pytest
from shipped import ROOT, SHIPPED, name_of, nodes, tree_of

# Qt's own names may come from here only, so that one code runs with Qt 5 and Qt 6.
QT = {"PyQt5", "PyQt6", "PySide2", "PySide6", "sip"}
# Arrays, and files; what tools are made of.
ARRAYS = "core grids tin relief"
FILES = "core crs las rasters survey classes"
# Which rooms of `algorithms` a room may import, besides itself: the floors below it.
FLOORS = {
    "core": "",
    "crs": "core",
    "grids": "core",
    "tin": "core grids",
    "relief": "core grids",
    "filters": "core grids tin",
    "las": "core crs",
    "rasters": "core crs grids",
    "survey": "core crs las rasters",
    "classes": "core crs las rasters survey",
    "remote": "core crs las rasters survey",
    "report": "core grids relief",
    "engine": "core crs las survey classes",
    "tools": f"{ARRAYS} {FILES} report engine remote",
    "tools/ground": f"core grids {FILES} filters engine",
    "tools/compare_settings": f"{ARRAYS} {FILES} filters report engine tools",
    "delivery": f"{ARRAYS} {FILES} filters report engine tools",
    "library": f"core grids {FILES} filters engine tools delivery remote",
    "cli": f"core grids {FILES} filters engine tools delivery library remote",
    "__main__": "cli",
    "__init__": f"core grids {FILES} filters engine tools delivery",
}


@functools.cache
def _imports(path):
    """Return the modules that a file imports anywhere; those of the package as ".algorithms..."."""
    package = path.relative_to(ROOT).parts[:-1]
    found = set()
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.Import):
            found |= {name.name for name in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else ()
            base = ".".join([*above, *([node.module] if node.module else [])])
            base = f".{base}" if node.level else base
            found |= {base, *(f"{base.rstrip('.')}.{name.name}" for name in node.names)}
    return frozenset(found)


def _within(modules, *packages):
    return {
        module
        for module in modules
        if any(f"{module}.".startswith(f"{name}.") for name in packages)
    }


def test_the_imports_are_read_rightly(tmp_path):
    here = ROOT / "algorithms" / "filters" / "__init__.py"
    assert ".algorithms.core.parameters.ParameterSet" in _imports(here)
    assert ".algorithms.filters.tin" in _imports(here)
    assert ".algorithms.las.reading" in _imports(
        ROOT / "algorithms" / "tools" / "info" / "__init__.py"
    )
    assert "numpy" in _imports(here.with_name("method.py"))
    assert "typing.Callable" in _imports(here.with_name("method.py"))
    assert len(SHIPPED) > 20


def test_the_classifier_imports_neither_qgis_nor_the_plugin():
    for path in (ROOT / "algorithms").rglob("*.py"):
        assert not _within(_imports(path), "qgis", "osgeo.gdal.qgis", ".plugin", *QT), path


def test_grids_and_filters_know_no_files():
    for room in ("grids", "tin", "relief", "filters"):
        for path in (ROOT / "algorithms" / room).rglob("*.py"):
            assert not _within(
                _imports(path),
                ".algorithms.core.files",
                ".algorithms.core.temporary",
                "laspy",
                "lazrs",
            ), path


def _room(path):
    """Return the room of a file; a tool that has floors of its own is one."""
    parts = path.relative_to(ROOT / "algorithms").with_suffix("").parts
    return "/".join(parts[:2]) if "/".join(parts[:2]) in FLOORS else parts[0]


def test_each_room_imports_only_the_floors_below_it():
    assert set(FLOORS) == {_room(path) for path in (ROOT / "algorithms").rglob("*.py")}
    for path in (ROOT / "algorithms").rglob("*.py"):
        room = _room(path)
        relative = {module for module in _imports(path) if module.startswith(".")}
        below = [f".algorithms.{name}" for name in (room.split("/")[0], *FLOORS[room].split())]
        # A room and the rooms below it; `from .. import core` names the house as well.
        assert relative - {".algorithms"} <= _within(relative, *below), path


def _algorithms_of(path):
    """Return the files of the classifier that a file of it imports, wherever in the file."""
    found = set()
    for module in _within(_imports(path), ".algorithms"):
        place = ROOT.joinpath(*module.split(".")[1:])
        found |= {place.with_suffix(".py"), place / "__init__.py"}
    return {value for value in found if value.is_file()} - {path}


def test_no_file_imports_itself_by_way_of_others():
    left = {path: _algorithms_of(path) for path in (ROOT / "algorithms").rglob("*.py")}
    assert sum(map(len, left.values())) > 200
    # What imports nothing that is left can be loaded; circles are what remains in the end.
    while free := {path for path, others in left.items() if not others & left.keys()}:
        left = {path: others for path, others in left.items() if path not in free}
    assert not left, sorted(map(name_of, left))


@pytest.mark.parametrize("step", ["tools/heights", "tools/key_points", "tools/rasters/step"])
def test_steps_for_classified_points_need_no_filter(step):
    reached, left = set(), [ROOT / "algorithms" / f"{step}.py"]
    while left:
        path = left.pop()
        if path not in reached:
            reached.add(path)
            # The package itself only says what it holds.
            left += [
                algorithm
                for algorithm in _algorithms_of(path)
                if algorithm.parent != ROOT / "algorithms"
            ]
    assert len(reached) > 10
    assert not {file for file in reached if _room(file) == "filters"}


def test_only_the_point_cloud_package_knows_the_file_format():
    for path in SHIPPED:
        if not {"las", "survey"} & set(path.parts):
            assert not _within(_imports(path), "laspy", "lazrs", "copclib"), path


def test_only_the_command_names_flags():
    # Messages name options by `option` of core/words.py, since QGIS and the library show them, too.
    # These hold command lines, of other programs or of ours.
    lines = {"core/words.py", "las/backends.py", "tools/compare_settings/settings.py"}
    told, found = set(), {}
    for path, node in nodes():
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            told.add(id(node.value))  # documentation
        text = node.value if isinstance(node, ast.Constant) else None
        if not isinstance(text, str) or id(node) in told:
            continue
        room, _, name = name_of(path).partition("/")
        if room != "algorithms" or name.startswith("cli/") or name in lines:
            continue
        if re.search(r"(?<![\w-])--[a-z]|'bare-earth ", text):
            found.setdefault(name, []).append(text)
    assert found == {}


def test_imports_inside_the_package_are_relative():
    # The plugin folder may have any name.
    for path in SHIPPED:
        assert not _within(_imports(path), "bare_earth", "algorithms", "plugin"), path


def test_qt_comes_from_qgis_only():
    for path in SHIPPED:
        assert not _within(_imports(path), *QT), path


def test_results_are_deterministic():
    for path in SHIPPED:
        assert not _within(_imports(path), "random"), path


def test_shipped_code_holds_none_of_what_hides_or_varies():
    for path, node in nodes():
        where = f"{name_of(path)}:{getattr(node, 'lineno', 0)}"
        assert not isinstance(node, ast.Assert), f"{where}: python -O removes assert"
        if isinstance(node, ast.ExceptHandler):
            assert node.type is not None, f"{where}: a bare except hides everything"
            hides = all(isinstance(inner, (ast.Pass, ast.Continue)) for inner in node.body)
            assert not hides, f"{where}: an error is swallowed"
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            assert "/tmp" not in node.value, f"{where}: not every system has it"


@pytest.mark.parametrize("module", ["bare_earth", "bare_earth.algorithms", "bare_earth.plugin"])
def test_the_package_itself_loads_nothing_heavy(module):
    # QGIS imports every plugin when it starts, and laspy may be missing.
    code = (
        f"import sys, {module}; print(*sorted({{'laspy', 'lazrs', 'numpy', 'scipy', 'qgis'}}"
        " & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


def test_every_module_of_the_classifier_imports_without_laspy():
    modules = [
        ".".join(["bare_earth", *path.relative_to(ROOT).with_suffix("").parts])
        for path in (ROOT / "algorithms").rglob("*.py")
        if path.stem not in ("__init__", "__main__")
    ]
    # None in sys.modules makes an import fail, as if the package were not installed.
    code = (
        "import importlib, sys\n"
        "for name in ('laspy', 'lazrs', 'copclib', 'rasterio', 'osgeo', 'tqdm', 'distributed'):\n"
        "    sys.modules[name] = None\n"
        f"for name in {modules!r}:\n"
        "    importlib.import_module(name)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
