"""Getting a package for QGIS's Python by pip or from a wheel; the package here is a made one."""

import functools
import importlib
import importlib.util
import os
import shutil
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest
from wheels import PACKAGE, make_wheel, tag_here

from bare_earth import BareEarthError
from bare_earth.plugin.libraries import folders, laz_support, pip, wheels
from bare_earth.plugin.libraries.build import Build
from bare_earth.plugin.libraries.laz_support import LazSupport

LINUX = Build((3, 11), "linux", "x86_64", (2, 36))
MUSL = Build((3, 11), "linux", "x86_64")
WINDOWS = Build((3, 12), "win", "amd64")
MAC = Build((3, 12), "macosx", "arm64", (14, 5))
OLD_MAC = Build((3, 9), "macosx", "x86_64", (10, 16))


@pytest.mark.parametrize(
    ("build", "tag", "taken"),
    [
        (LINUX, "cp311-cp311-manylinux_2_17_x86_64", True),
        (LINUX, "cp311-cp311-manylinux2014_x86_64", True),
        (LINUX, "cp311-cp311-linux_x86_64", True),
        (LINUX, "cp38-abi3-manylinux_2_17_x86_64", True),
        (LINUX, "py3-none-any", True),
        (LINUX, "cp312-cp312-manylinux_2_17_x86_64", False),
        (LINUX, "cp312-abi3-manylinux_2_17_x86_64", False),
        (LINUX, "cp311-cp311-manylinux_2_38_x86_64", False),
        (LINUX, "cp311-cp311-manylinux_2_17_aarch64", False),
        (LINUX, "cp311-cp311-musllinux_1_2_x86_64", False),
        (LINUX, "cp311-cp311-win_amd64", False),
        (LINUX, "cp311-cp311t-manylinux_2_17_x86_64", False),
        (LINUX, "", False),
        (MUSL, "cp311-cp311-musllinux_1_2_x86_64", True),
        (MUSL, "cp311-cp311-manylinux_2_17_x86_64", False),
        (WINDOWS, "cp312-cp312-win_amd64", True),
        (WINDOWS, "cp312-cp312-win32", False),
        (WINDOWS, "cp312-cp312-win_arm64", False),
        (Build((3, 9), "win32", ""), "cp39-cp39-win32", True),
        (MAC, "cp312-cp312-macosx_11_0_arm64", True),
        (MAC, "cp312-cp312-macosx_10_12_universal2", True),
        (MAC, "cp312-cp312-macosx_15_0_arm64", False),
        (MAC, "cp312-cp312-macosx_10_12_x86_64", False),
        (OLD_MAC, "cp39-cp39-macosx_11_0_x86_64", True),
    ],
)
def test_what_a_python_can_load(build, tag, taken):
    assert build.takes(tag) == taken


def test_pip_agrees_on_what_this_python_can_load():
    tags = pytest.importorskip("pip._vendor.packaging.tags")
    here = Build.here()
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    supported = {str(tag) for tag in tags.sys_tags()}
    # Old interfaces and generic platforms that no wheel of lazrs has are not asked about.
    of_wheels = {value for value in supported if f"-{python}-" in value or "-abi3-" in value}
    assert of_wheels and all(here.takes(wheel) for wheel in of_wheels)
    system = next(iter(of_wheels)).split("-", 2)[2]
    for other in (f"cp27-cp27m-{system}", f"{python}-{python}-win_mips", f"cp399-cp399-{system}"):
        assert other not in supported and not here.takes(other)


@pytest.fixture
def support(monkeypatch, tmp_path):
    monkeypatch.setattr(laz_support, "PACKAGE", PACKAGE)
    (tmp_path / "requirements.txt").write_text(f"{PACKAGE}>=0.5\n", encoding="utf-8")
    monkeypatch.setattr(laz_support, "REQUIREMENTS", tmp_path / "requirements.txt")
    support = LazSupport(tmp_path / "profile")
    yield support
    folders.take_from_path(support.folder)


def left(support):
    """Return what lies where packages are kept."""
    return list(support.folder.parent.iterdir()) if support.folder.parent.exists() else []


def test_a_wheel_is_there_at_once_and_gone_when_removed(support, tmp_path):
    assert not support.is_there and not support.is_ours and "cannot be read" in support.state
    wheel = make_wheel(tmp_path / "renamed by a browser (1).whl")
    support.get_from_wheel(wheel)
    assert importlib.import_module(PACKAGE).made
    assert support.is_ours and str(support.folder) in support.state
    assert left(support) == [support.folder]
    assert support.folder == tmp_path / "profile" / "bare_earth" / "packages" / Build.here().name
    assert support.remove() == "Removed."
    assert not support.is_there and not left(support)
    support.get_from_wheel(wheel)
    assert importlib.import_module(PACKAGE).made


def test_what_was_got_is_used_at_the_next_start(support, tmp_path):
    support.get_from_wheel(make_wheel(tmp_path / "a.whl"))
    folders.take_from_path(support.folder)
    assert not support.is_there
    LazSupport(tmp_path / "profile").use()
    assert support.is_ours


def test_the_packages_of_qgis_come_first(tmp_path, monkeypatch):
    for name in ("own", "bundled"):
        (tmp_path / name / PACKAGE).mkdir(parents=True)
        (tmp_path / name / PACKAGE / "__init__.py").write_text(f"of = {name!r}", encoding="utf-8")
    monkeypatch.setattr(sys, "path", [*sys.path, str(tmp_path / "own")])
    folders.add_to_path(tmp_path / "bundled")
    folders.add_to_path(tmp_path / "bundled")
    folders.add_to_path(tmp_path / "missing")
    assert sys.path[-2:] == [str(tmp_path / "own"), str(tmp_path / "bundled")]
    assert importlib.import_module(PACKAGE).of == "own"
    folders.take_from_path(tmp_path / "own")
    assert importlib.import_module(PACKAGE).of == "bundled"
    folders.take_from_path(tmp_path / "bundled")


def test_what_windows_still_holds_goes_at_the_next_start(support, tmp_path, monkeypatch):
    support.get_from_wheel(make_wheel(tmp_path / "a.whl"))
    with monkeypatch.context() as held:
        held.setattr(shutil, "rmtree", lambda *_, **__: None)
        assert "when QGIS starts next" in support.remove()
        assert not support.is_there
    with monkeypatch.context() as held:
        # Only the folder in use; the temporary one can go.
        delete = shutil.rmtree
        held.setattr(
            folders.shutil,
            "rmtree",
            lambda path, *rest, **words: path == support.folder or delete(path, *rest, **words),
        )
        with pytest.raises(BareEarthError, match="restart QGIS"):
            support.get_from_wheel(tmp_path / "a.whl")
    LazSupport(tmp_path / "profile").use()
    assert not support.is_there and not left(support)


def test_a_plugin_that_is_installed_again_uses_nothing_that_windows_still_holds(
    support, tmp_path, monkeypatch
):
    wheel = make_wheel(tmp_path / "a.whl", {f"{PACKAGE}/__init__.py": "", f"{PACKAGE}/a.pyd": ""})
    support.get_from_wheel(wheel)
    importlib.import_module(PACKAGE)
    delete = shutil.rmtree

    def all_but_what_is_loaded(path, *rest, **words):
        if Path(path) != support.folder and Path(path) not in support.folder.parents:
            delete(path, *rest, **words)
        for file in Path(path).rglob("*"):
            if file.is_file() and file.suffix != ".pyd":
                file.unlink()

    with monkeypatch.context() as held:
        held.setattr(shutil, "rmtree", all_but_what_is_loaded)
        folders.remove_if_uninstalled(tmp_path / "plugin", tmp_path / "profile")
        again = LazSupport(tmp_path / "profile")
        again.use()
        assert not again.is_there and "Not installed" in again.state
        # What is left of a package is none.
        with monkeypatch.context() as added:
            added.syspath_prepend(support.folder)
            assert importlib.util.find_spec(PACKAGE) and not again.is_there
        with pytest.raises(BareEarthError, match="restart QGIS"):
            again.get_from_wheel(wheel)
    LazSupport(tmp_path / "profile").use()
    again.get_from_wheel(wheel)
    assert again.is_ours


@pytest.mark.parametrize(
    ("words", "changed"),
    [
        ("other; .* tinylaz", {"name": "other"}),
        ("another Python", {"tag": "cp27-cp27m-win_amd64"}),
        ("differs from its list", {"record": False}),
        ("does not belong", {"files": {"../evil.py": ""}}),
        ("does not belong", {"files": {"tinylaz/../../evil.py": ""}}),
        ("does not belong", {"files": {"/evil.py": ""}}),
        ("does not belong", {"files": {"evil.pth": "import os"}}),
        ("does not belong", {"files": {"tinylaz/C:evil.py": ""}}),
        ("does not belong", {"files": {"tinylaz/..\\evil.py": ""}}),
        ("does not belong", {"files": {"tinylaz/a": "/etc"}, "links": ("tinylaz/a",)}),
    ],
)
def test_a_wheel_that_does_not_fit_is_refused_and_leaves_nothing(support, tmp_path, words, changed):
    wheel = make_wheel(tmp_path / "a.whl", **changed)
    with pytest.raises(BareEarthError, match=words) as caught:
        support.get_from_wheel(wheel)
    assert "a.whl" in str(caught.value)
    assert not support.is_there and not left(support)
    assert not [path for path in tmp_path.rglob("evil*")]


def test_files_that_are_no_wheels_are_refused(support, tmp_path):
    whole = make_wheel(tmp_path / "whole.whl").read_bytes()
    with zipfile.ZipFile(tmp_path / "plain.zip", "w") as archive:
        archive.writestr("readme.txt", "hello")
    (tmp_path / "cut.whl").write_bytes(whole[: len(whole) // 2])
    (tmp_path / "text.whl").write_text("<html>", encoding="utf-8")
    for name in ("plain.zip", "cut.whl", "text.whl", "missing.whl"):
        with pytest.raises(BareEarthError, match=f"^{name} "):
            support.get_from_wheel(tmp_path / name)
    assert not left(support)


@pytest.mark.rest(but="0")
@pytest.mark.parametrize("compression", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_bytes_that_are_changed_anywhere_are_told(tmp_path, compression):
    whole = make_wheel(tmp_path / "a.whl", compression=compression).read_bytes()
    for place in range(0, 2 * len(whole), 5):
        changed = bytearray(whole)
        changed[place // 2] ^= 0x01 if place % 2 else 0xFF
        (tmp_path / "b.whl").write_bytes(changed)
        # Some bytes say nothing (dates, modes); a sentence or the package, nothing else.
        try:
            wheels.unpack(tmp_path / "b.whl", tmp_path / "new", PACKAGE, Build.here())
        except BareEarthError as error:
            assert "b.whl" in str(error)
        else:
            file = tmp_path / "new" / PACKAGE / "__init__.py"
            assert file.read_text(encoding="utf-8") == "made = True\n"
        shutil.rmtree(tmp_path / "new", ignore_errors=True)


def test_a_package_that_cannot_be_loaded_is_taken_away_again(support, tmp_path):
    wheel = make_wheel(tmp_path / "a.whl", {f"{PACKAGE}/__init__.py": "raise ImportError('DLL')"})
    with pytest.raises(BareEarthError, match="lazrs: DLL"):
        support.get_from_wheel(wheel)
    assert not support.is_there and not left(support)


def run(command, settings):
    """Run a command as the plugin does, but for QGIS's own classes."""
    done = subprocess.run(
        command,
        env={**os.environ, **settings},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    return pip.Finished(done.returncode, done.stdout)


@functools.cache
def answer_of(command):
    """Return what a command says that changes nothing: one time is enough to ask it."""
    return run(command, {})


@pytest.fixture
def index(tmp_path, monkeypatch):
    """A folder that pip takes for the package index."""
    (tmp_path / "index").mkdir()
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(tmp_path / "index"))
    monkeypatch.setenv("PIP_CONFIG_FILE", os.devnull)
    return tmp_path / "index"


@pytest.mark.rest
def test_pip_gets_a_package_into_the_profile(support, index):
    make_wheel(index / f"{PACKAGE}-1.0-{tag_here()}.whl")
    support.get_by_pip(run)
    assert importlib.import_module(PACKAGE).made and support.is_ours
    assert left(support) == [support.folder]


@pytest.mark.long
def test_pip_is_brought_along_where_there_is_none(support, index, tmp_path, monkeypatch):
    venv.create(tmp_path / "bare", with_pip=False, symlinks=os.name != "nt")
    python = (
        tmp_path / "bare" / ("Scripts" if os.name == "nt" else "bin") / Path(sys.executable).name
    )
    assert run([str(python), "-m", "pip"], {}).code != 0
    monkeypatch.setattr(pip, "candidates", lambda: iter([python]))
    make_wheel(index / f"{PACKAGE}-1.0-{tag_here()}.whl")
    support.get_by_pip(run)
    assert support.is_ours and left(support) == [support.folder]
    # The Python itself got nothing.
    assert run([str(python), "-m", "pip"], {}).code != 0


@pytest.mark.long
def test_no_wheel_for_this_python_is_told(support, index):
    make_wheel(index / f"{PACKAGE}-1.0-cp27-cp27m-win_amd64.whl", tag="cp27-cp27m-win_amd64")
    with pytest.raises(BareEarthError, match=r"index .* none .* cp3\d+ and \w+"):
        support.get_by_pip(run)
    assert not support.is_there and not left(support)


@pytest.mark.rest(but="-pip gave no reason.")
@pytest.mark.parametrize(
    ("said", "told"),
    [
        (
            "WARNING: Retrying (Retry(total=0)) after connection broken by 'NewConnectionError'\n"
            "ERROR: No matching distribution found for lazrs",
            "not reached",
        ),
        ("ProxyError('Cannot connect to proxy.', OSError('Tunnel connection failed: 407 Proxy"
         " Authentication Required'))", "password"),
        ("SSLError(CERTIFICATE_VERIFY_FAILED)\nRetrying (", "certificate"),
        ("ERROR: Missing dependencies for SOCKS support.", "SOCKS proxy"),
        ("OSError: [Errno 28] No space left on device", "disk is full"),
        ("one\nERROR: Something else.\n", "ERROR: Something else."),
        ("", "pip gave no reason."),
    ],
)  # fmt: skip
def test_why_pip_failed_is_told_in_a_sentence(support, said, told):
    def failing(command, settings):
        return pip.Finished(1, said) if "install" in command else answer_of(tuple(command))

    with pytest.raises(BareEarthError, match="lazrs could not be installed") as caught:
        support.get_by_pip(failing)
    assert told in str(caught.value) and "\n" not in str(caught.value)
    assert not left(support)


def test_the_proxy_is_given_where_other_users_do_not_see_it(support):
    seen = []

    def looking(command, settings):
        seen.append((" ".join(command), settings.get("https_proxy")))
        return pip.Finished(1, "") if "install" in command else answer_of(tuple(command))

    with pytest.raises(BareEarthError):
        support.get_by_pip(looking, "http://me:word@proxy.invalid:3128")
    command, proxy = seen[-1]
    assert proxy == "http://me:word@proxy.invalid:3128" and "me:word" not in command
    # Never what they depend on, and never into QGIS.
    assert "--no-deps" in command and f"--target {support.folder.parent}" in command


def test_the_python_of_qgis_is_found(monkeypatch, tmp_path):
    # As on Windows and macOS: the program is QGIS itself.
    program = tmp_path / "QGIS"
    program.write_text("", encoding="utf-8")
    monkeypatch.setattr(sys, "executable", str(program))
    found = list(pip.candidates())
    assert found and program not in found
    assert pip.find_python(run) in map(str, found)


@pytest.mark.parametrize(
    ("platform", "program", "prefix", "expected"),
    [
        ("win32", "bin/qgis-bin.exe", "apps/Python312", "apps/Python312/python.exe"),
        ("win32", "bin/qgis-ltr-bin.exe", "apps/Python39", "bin/python3.exe"),
        ("darwin", "MacOS/QGIS", "Frameworks", "MacOS/python"),
        ("darwin", "MacOS/QGIS", "MacOS", "MacOS/bin/python3"),
        ("linux", "bin/qgis", "usr", "usr/bin/python3"),
    ],
)
def test_where_each_system_keeps_its_python(
    monkeypatch, tmp_path, platform, program, prefix, expected
):
    for name in (program, expected):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("", encoding="utf-8")
    monkeypatch.setattr(sys, "platform", platform)
    monkeypatch.setattr(sys, "executable", str(tmp_path / program))
    for name in ("exec_prefix", "base_prefix"):
        monkeypatch.setattr(sys, name, str(tmp_path / prefix))
    assert list(pip.candidates()) == [tmp_path / expected]


def test_a_python_of_another_kind_is_not_taken(monkeypatch):
    asked = []

    def other(command, settings):
        asked.append(command)
        return pip.Finished(0, "2 7 linux-x86_64 x86_64")

    with pytest.raises(BareEarthError, match="Python interpreter"):
        pip.find_python(other)
    assert asked


def test_requirements_that_ship_are_those_of_pip():
    lines = laz_support.REQUIREMENTS.read_text(encoding="utf-8").splitlines()
    asked = [line for line in lines if line and line[0] != "#"]
    assert len(asked) == 1 and asked[0].startswith(f"{laz_support.PACKAGE}>=")


@pytest.mark.parametrize("is_there", [True, False])
def test_uninstalling_leaves_nothing_in_the_profile(is_there, tmp_path):
    plugin, profile = tmp_path / "plugins" / "bare_earth", tmp_path / "profile"
    packages = folders.profile_folder(profile)
    packages.mkdir(parents=True)
    (packages / "lazrs.py").touch()
    (profile / "QGIS3.ini").touch()
    if is_there:  # as after an update
        plugin.mkdir(parents=True)
    folders.remove_if_uninstalled(plugin, profile)
    assert packages.exists() == is_there
    assert (profile / "bare_earth").exists() == is_there and (profile / "QGIS3.ini").exists()
