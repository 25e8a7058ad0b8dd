"""What differs on Windows and macOS, as far as it can be seen on any system."""

import ast
import ctypes
import os
import re
from types import SimpleNamespace

import pytest
from shipped import nodes

from bare_earth.algorithms.core import commands, memory
from bare_earth.algorithms.core.commands import shell_line
from bare_earth.algorithms.core.memory import free_memory
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.engine.workers import Processes

pytestmark = pytest.mark.processes

# Before numpy 2, integers have 32 bits on Windows where nothing else is said.
_NARROW = re.compile(r"np\.arange\([^=]*\) \* len\(.*\)|np\.cumsum\(\[[^=]*\]\)")
# What these are about, so that not each part of each expression is written out.
_LOOKED_AT = (ast.Attribute, ast.BinOp, ast.Call, ast.Name)
_NEW = re.compile(
    r".*\.write_text\(.*newline=.*|zip\(.*strict=.*|.*pairwise\(.*|.*\.bit_count\(.*|.*hardlink_to.*"
    r"|dataclass\(.*(slots|kw_only)=.*|.*\.is_junction\(.*|datetime\.UTC|.*\bStrEnum\b.*"
)


def test_a_mac_counts_free_pages_and_those_that_were_not_used_lately(monkeypatch):
    class System:
        class mach_host_self:
            def __new__(cls):
                return 7

        @staticmethod
        def host_statistics64(host, flavour, pages, count):
            assert (host, flavour, len(pages)) == (7, 4, 38)
            pages[0], pages[1], pages[2] = 1 << 20, 1 << 21, 1 << 19
            return 0

    monkeypatch.setattr(memory.sys, "platform", "darwin")
    monkeypatch.setattr(ctypes, "CDLL", lambda name: System)
    monkeypatch.setattr(memory, "_CGROUP", memory._CGROUP / "none")
    assert free_memory() == (3 << 19) * os.sysconf("SC_PAGE_SIZE")
    monkeypatch.setattr(System, "host_statistics64", lambda *_: 5)
    assert free_memory() == 4 << 30


def test_windows_gets_no_more_processes_than_it_can_wait_for(monkeypatch, tmp_path):
    monkeypatch.setattr(Processes, "most", 61)
    workers = Processes(Resources(threads=200, memory=100.0))
    workers.start(tmp_path, 1, 500, 500)
    workers.stop()
    assert workers.at_once == 61 and workers.share.thread_count == 3


@pytest.mark.parametrize(
    ("word", "shown"),
    [
        (r"C:\data\dtm-1_0.tif", r"C:\data\dtm-1_0.tif"),
        ("--crs=25832", "--crs=25832"),
        (r"C:\my data\a.laz", r'"C:\my data\a.laz"'),
        (r"C:\my data\\", r'"C:\my data\\\\"'),
        ("R&D(1)^2;a,b.laz", '"R&D(1)^2;a,b.laz"'),
        ("", '""'),
    ],
)
def test_words_of_commands_are_quoted_for_windows(monkeypatch, word, shown):
    monkeypatch.setattr(commands, "os", SimpleNamespace(name="nt"))
    assert shell_line(["bare-earth", word]) == f"bare-earth {shown}"


def test_shipped_code_does_nothing_that_windows_or_python_3_9_lack():
    # `make test-rest` runs all in Python 3.9 where there is one.
    wrong = [
        f"{place}: {text}"
        for place, node in nodes()
        if isinstance(node, _LOOKED_AT)
        and (_NARROW.fullmatch(text := ast.unparse(node)) or _NEW.fullmatch(text))
    ]
    assert wrong == []
