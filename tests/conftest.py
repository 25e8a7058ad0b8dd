"""What all tests share: the order in which they run, and fixtures."""

import errno
import gc
import os
import sys
from pathlib import Path

import pytest
from las_files import LasKit
from left_out import (  # noqa: F401
    pytest_deselected,
    pytest_itemcollected,
    pytest_runtest_setup,
    pytest_testnodedown,
)
from remote_server import serving

from bare_earth.algorithms.core import temporary as temporary_module
from bare_earth.algorithms.engine import workers
from bare_earth.algorithms.remote import transfers

# The command line speaks English here, and need not look for another language each time.
os.environ["LANGUAGE"] = "C"
# Where Python is told to keep no bytecode, each process that a test starts compiles scipy anew:
# that takes longer than what it is to show. Here it is kept, and not among the sources, as
# tools/environment does it.
if sys.dont_write_bytecode:
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ["PYTHONPYCACHEPREFIX"] = str(Path(__file__).parents[1] / "build" / "bytecode")
    sys.pycache_prefix, sys.dont_write_bytecode = os.environ["PYTHONPYCACHEPREFIX"], False

# Requests that failed are made again at once.
transfers._FIRST_PAUSE = 0.001

# These begin first; and these share the code that they parse.
SLOWEST = (
    "project/test_goldens.py", "delivery/test_deliveries.py", "engine/test_tiles.py",
    "project/test_tutorials.py",
)  # fmt: skip
READ_THE_CODE = (
    "project/test_docstrings.py", "cli/test_security.py", "project/test_walls.py",
    "engine/test_windows.py", "project/test_quotes.py", "project/test_pages.py",
    "project/test_daily.py",
)  # fmt: skip


def pytest_collection_modifyitems(items):
    """Begin with the files that take longest, so that no process waits for another one at last."""
    items.sort(key=lambda item: not item.path.as_posix().endswith(SLOWEST))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Give each process whole files, so that what the tests of a file share is made once."""
    if config.getvalue("dist") != "load":  # that is, unless another way is asked for
        return None
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):
        def _split_scope(self, nodeid):
            file = nodeid.partition("::")[0]
            return "code" if file.endswith(READ_THE_CODE) else file

    config.option.loadscopereorder = False
    return Scheduling(config, log)


def pytest_collection_finish():
    """Keep what all tests share from being looked through for garbage, and look less often."""
    gc.freeze()
    gc.set_threshold(20_000)


def pytest_sessionfinish():
    """Let a process end at once: what is left is not looked through for garbage six times."""
    gc.freeze()


@pytest.fixture(autouse=True, scope="module")
def threads_unless_processes_are_tested(request):
    """Let runs work in threads: a process takes a second of two processors to begin."""
    with pytest.MonkeyPatch.context() as patch:
        if request.node.get_closest_marker("processes") is None:
            patch.setattr(workers, "Processes", workers.Threads)
        yield


@pytest.fixture
def threads_for_processes(monkeypatch):
    """Let one test of a module that tests processes work in threads."""
    monkeypatch.setattr(workers, "Processes", workers.Threads)


@pytest.fixture
def las(tmp_path):
    folder = tmp_path / "clouds"
    folder.mkdir()
    return LasKit(folder)


@pytest.fixture
def server():
    with serving() as running:
        yield running


class Windows:
    """Lets files be in use as on Windows, for some tries or for good."""

    def __init__(self, monkeypatch):
        self.in_use, self.patch, self.tries = {}, monkeypatch, 0
        for name in ("replace", "rename", "unlink"):
            monkeypatch.setattr(os, name, self.refusing(getattr(os, name)))
        monkeypatch.setattr(temporary_module, "_PAUSE", 0.0)

    def hold(self, path, number=32, tries=10**9):
        self.in_use[str(path)] = number, tries
        if tries == 10**9:
            self.patch.setattr(temporary_module, "_PATIENCE", 0.0)

    def refusing(self, action):
        def act(*paths, **named):
            for path in map(str, paths):
                number, tries = self.in_use.get(path, (0, 0))
                if tries > 0:
                    self.tries += 1
                    self.in_use[path] = number, tries - 1
                    error = PermissionError(errno.EACCES, "Access is denied", path)
                    error.winerror = number
                    raise error
            return action(*paths, **named)

        return act


@pytest.fixture
def windows(monkeypatch):
    return Windows(monkeypatch)
