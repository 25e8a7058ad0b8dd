"""Installs packages with pip, run by the Python of QGIS (`sys.executable` may be QGIS itself)."""

from __future__ import annotations

import platform
import sys
import sysconfig
from pathlib import Path
from typing import Callable, Iterator, Mapping, NamedTuple, Sequence

from ...algorithms.core.errors import BareEarthError
from ..i18n import mark, tr
from .build import Build


class Finished(NamedTuple):
    """Exit code and output of a command."""

    code: int
    output: str


# A function that runs a command with additional environment variables, and waits for its end.
Run = Callable[[Sequence[str], Mapping[str, str]], Finished]

_PROBE = (
    "import platform, sys, sysconfig;"
    "print(*sys.version_info[:2], sysconfig.get_platform(), platform.machine())"
)
# These override settings of the user for pip.
_SETTINGS = {
    "PIP_USER": "0",
    "PIP_REQUIRE_VIRTUALENV": "0",
    "PIP_NO_INPUT": "1",
    "PIP_DISABLE_PIP_VERSION_CHECK": "1",
}
_UNREACHED = mark(
    "the package index was not reached: check the connection, and the proxy in Settings > Options"
    " > Network, or choose a wheel file."
)
# Meanings of texts in the output of pip; the first text that is found counts.
_REASONS = {
    "SOCKS": mark(
        "pip cannot work through the SOCKS proxy of QGIS's settings: choose a wheel file."
    ),
    "407 Proxy": mark(
        "the proxy wants a name and password: give them in Settings > Options > Network."
    ),
    "CERTIFICATE_VERIFY_FAILED": mark("the certificate of the package index was not accepted."),
    "ProxyError": _UNREACHED,
    "Retrying (": _UNREACHED,
    "timed out": _UNREACHED,
    "No space left": mark("the disk is full."),
    "Permission denied": mark("you have no permission to write into the folder of the profile."),
}


def get_by_pip(
    requirements: Path, folder: Path, scratch: Path, run: Run, proxy: str, build: Build
) -> None:
    """Install packages that fit a build with pip, which goes into `scratch` if this Python has
    none, into a folder, without their dependencies.
    """
    # The proxy may be empty. An error says if no Python interpreter or no pip is found, or why pip
    # fails.
    python = find_python(run)
    settings = dict(_SETTINGS)
    if proxy:
        # Not as an argument, where every user of the machine could read the password.
        settings.update(http_proxy=proxy, https_proxy=proxy)
    done = run(
        [
            *_pip_of(python, scratch, run), "install", "--no-deps", "--only-binary", ":all:",
            "--no-compile", "--retries", "1", "--timeout", "20", "--target", str(folder),
            "--requirement", str(requirements),
        ],
        settings,
    )  # fmt: skip
    if done.code:
        reason = _reason(done.output, build)
        raise BareEarthError(tr("lazrs could not be installed: {}").format(reason))


def find_python(run: Run) -> str:
    """Return the path of the interpreter of this Python, or raise an error if QGIS has none."""
    here = [*sys.version_info[:2], sysconfig.get_platform(), platform.machine()]
    for path in candidates():
        done = run([str(path), "-c", _PROBE], {})
        if done.code == 0 and done.output.split() == [str(path) for path in here]:
            return str(path)
    raise BareEarthError(
        tr(
            "No Python interpreter was found beside this QGIS, so pip cannot be run: choose a wheel"
            " file instead."
        )
    )


def candidates() -> Iterator[Path]:
    """Yield files that may be the interpreter of this Python, the most likely first."""
    program, version = Path(sys.executable or "."), "{}.{}".format(*sys.version_info[:2])
    prefixes = [Path(path) for path in dict.fromkeys([sys.exec_prefix, sys.base_prefix])]
    if sys.platform == "win32":
        folders, names = [*prefixes, program.parent], ["python.exe", "python3.exe"]
    else:
        folders, names = [prefix / "bin" for prefix in prefixes], [f"python{version}", "python3"]
    if sys.platform == "darwin":
        # The bundles of QGIS 3.44 and later, and older bundles.
        folders = [program.parent, program.parent / "bin", *folders]
        names.append("python")
    files = [folder / name for folder in folders for name in names]
    if program.name.lower().startswith("python"):
        files.insert(0, program)
    yield from (path for path in dict.fromkeys(files) if path.is_file())


def _pip_of(python: str, scratch: Path, run: Run) -> list[str]:
    """Return the command that starts pip; if there is no pip, install it with ensurepip."""
    if run([python, "-m", "pip", "--version"], _SETTINGS).code == 0:
        return [python, "-m", "pip"]
    # With another root, so that it is not installed among the packages of QGIS.
    done = run([python, "-m", "ensurepip", "--root", str(scratch)], _SETTINGS)
    found = sorted(scratch.rglob("pip/__main__.py"))
    if done.code or not found:
        raise BareEarthError(
            tr(
                "The Python of this QGIS has no pip. In Debian and Ubuntu run sudo apt-get install"
                " python3-pip, elsewhere install pip for it, and try again; or choose a wheel file."
            )
        )
    return [python, str(found[0].parent)]


def _reason(output: str, build: Build) -> str:
    for words, meaning in _REASONS.items():
        if words in output:
            return tr(meaning)
    if "No matching distribution" in output:
        return tr("the package index has none for {}.").format(build.wheels)
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    errors = [line for line in lines if line.startswith("ERROR")]
    return (errors or lines or [tr("pip gave no reason")])[-1].rstrip(".") + "."
