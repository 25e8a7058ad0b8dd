"""What pyproject.toml cannot say: packages, stubs of a wheel, addresses, links of README."""

import configparser
import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import find_packages, setup
from setuptools.command.build_py import build_py

ROOT = Path(__file__).parent


class WithStubs(build_py):
    """Copies the package, and makes the stubs from which editors and mypy know the library."""

    def find_package_modules(self, package, package_dir):
        """Leave out this file, which lies in the folder of the package."""
        modules = super().find_package_modules(package, package_dir)
        return [module for module in modules if module[:2] != ("bare_earth", "setup")]

    def run(self):
        """Make them by the copy, since this folder may have another name than the package."""
        super().run()
        if not self.editable_mode:
            folder = Path(self.build_lib).resolve()
            paths = [str(folder), *filter(None, [os.environ.get("PYTHONPATH")])]
            subprocess.run(
                [sys.executable, ROOT / "tools" / "stub.py", folder / "bare_earth"],
                env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)}, check=True,
            )  # fmt: skip


def addresses():
    """Return the addresses that metadata.txt states, where QGIS reads them, too."""
    metadata = configparser.ConfigParser()
    metadata.read(ROOT / "metadata.txt", encoding="utf-8")
    return {name: metadata["general"][name] for name in ("homepage", "repository", "tracker")}


def readme(repository):
    """Return README.md with links and pictures in the repository: PyPI has no other file."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    text = re.sub(r"(!\[[^]]*\]\()(?!https?:)", rf"\g<1>{repository}/raw/main/", text)
    return re.sub(r"(\]\()(?!https?:)", rf"\g<1>{repository}/blob/main/", text)


if __name__ == "__main__":  # this file lies in the package, too
    found = find_packages(str(ROOT), include=["algorithms*"])
    urls = addresses()
    setup(
        long_description=readme(urls["repository"]),
        long_description_content_type="text/markdown",
        project_urls={name.capitalize(): address for name, address in urls.items()},
        packages=["bare_earth", *(f"bare_earth.{name}" for name in found)],
        cmdclass={"build_py": WithStubs},
    )
