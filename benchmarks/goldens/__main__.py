"""Tells which outputs of any tool differ from those that were agreed.

- ``python -m benchmarks.goldens`` compares the small survey, also in QGIS if there is one.
- ``--write`` agrees to what comes out now; ``--folder outputs`` keeps it for a look.
- ``--tiles --keep before`` and ``--tiles --against before`` compare real land. Its digests are
  remembered outside of the repository.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from pathlib import Path

from benchmarks.cache import FOLDER

from .agreed import AGREED, AGREED_IN_QGIS, ROOT, differences, read, write
from .digests import Digests
from .running import of_everything
from .tiles import of_tiles

_QGIS = (str(ROOT / "tools" / "environment"), "qgis", "/usr/bin/python3")
_MOST_LINES = 200


def main() -> int:
    """Compare or write the digests, as the command line says; return 1 if any differs."""
    chosen = _options()
    with tempfile.TemporaryDirectory(prefix="goldens-") as temporary:
        folder = Path(chosen.folder or temporary).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()):
            raise SystemExit(f"{folder} is not empty. Name another folder.")
        if chosen.tiles:
            target = FOLDER / "goldens" / f"{chosen.keep or chosen.against}.json"
            if chosen.against and not target.exists():
                raise SystemExit(f"Nothing is remembered as {chosen.against}: use --keep first.")
            runs = {target: of_tiles(folder, bool(chosen.folder))}
        else:
            runs = {AGREED: of_everything(_made(folder / "core")), **_of_qgis(folder)}
    if chosen.write or chosen.keep:
        for path, found in runs.items():
            write(path, found)
            print(f"{len(found)} outputs are in {path}")
        return 0
    return max(_compared(path, found) for path, found in runs.items())


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="agree to what comes out now")
    parser.add_argument("--folder", metavar="FOLDER", help="keep all outputs in this new folder")
    parser.add_argument("--tiles", action="store_true", help="run on the tiles of real land")
    named = parser.add_mutually_exclusive_group()
    named.add_argument("--keep", metavar="NAME", help="remember what comes out, with --tiles")
    named.add_argument("--against", metavar="NAME", help="compare with what was remembered")
    chosen = parser.parse_args()
    if chosen.tiles != bool(chosen.keep or chosen.against):
        parser.error("--tiles needs --keep NAME or --against NAME, and these need --tiles.")
    return chosen


def _made(folder: Path) -> Path:
    folder.mkdir()
    return folder


def _of_qgis(folder: Path) -> dict[Path, Digests]:
    """Return the digests of the dialogs, by the file of those that were agreed."""
    if subprocess.run([_QGIS[-1], "-c", "import qgis.core"], capture_output=True).returncode:
        print("There is no QGIS: the dialogs are left out.")
        return {}
    target = _made(folder / "qgis") / "found.json"
    module = "benchmarks.goldens.dialogs"
    subprocess.run([*_QGIS, "-m", module, target.parent, target], cwd=ROOT, check=True)
    return {AGREED_IN_QGIS: read(target)}


def _compared(path: Path, found: Digests) -> int:
    """Print what differs from the digests in a file; return 1 if anything does."""
    lines = [*differences(read(path), found)]
    print("\n".join(lines[:_MOST_LINES]) or f"All {len(found)} outputs are as in {path}")
    if len(lines) > _MOST_LINES:
        print(f"and {len(lines) - _MOST_LINES} more")
    return 1 if lines else 0


if __name__ == "__main__":
    raise SystemExit(main())
