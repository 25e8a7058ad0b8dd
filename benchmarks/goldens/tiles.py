"""The larger form: what is run on tiles of real land, in two processes."""

from __future__ import annotations

import shutil
from functools import partial
from pathlib import Path

from benchmarks import data
from benchmarks.work import side_by_side

from .commands import TILE_COMMANDS
from .digests import Digests
from .running import of_commands, working_in


def of_tiles(folder: Path, keeps: bool) -> Digests:
    """Return the digests of all tiles that are here; `keeps`: their outputs stay in the folder."""
    paths = [*data.isprs(), *sorted((data.FOLDER / "real").glob("*.la[sz]"))]
    if not paths:
        raise SystemExit(f"There are no tiles in {data.FOLDER}. Set BARE_EARTH_DATA.")
    found: Digests = {}
    work = partial(_of_tile, folder=folder, keeps=keeps)
    for path, some in zip(paths, side_by_side(work, [path.resolve() for path in paths])):
        print(path.name, flush=True)
        found.update(some)
    return found


def _of_tile(path: Path, folder: Path, keeps: bool) -> Digests:
    """Return the digests of what is run on one tile; its name begins those of the outputs."""
    name = path.name.split(".")[0]
    commands = {
        f"{name}/{key}": words.replace("TILE", str(path)) for key, words in TILE_COMMANDS.items()
    }
    with working_in(folder):
        found = of_commands(commands, folder)
    if not keeps:
        shutil.rmtree(folder / name)
    return found
