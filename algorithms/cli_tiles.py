"""The command `bare-earth classify-tiles`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any, Sequence

from .errors import Cancelled

_DEFAULT_METHOD = "tin-densification"


def add_classify_tiles(
    commands: Any, common: argparse.ArgumentParser, arguments: Sequence[str]
) -> None:
    """Add the command to those of `bare-earth`."""
    from .cli import add_options
    from .filters import METHODS
    from .pointcloud.selection import Selection
    from .tiling.memory import Resources
    from .tiling.options import TileInput, TileOutput

    parser = commands.add_parser(
        "classify-tiles",
        parents=[common],
        help="classify the ground points of many files as one survey",
        description="Classifies the ground points of many LAS, LAZ or COPC files. Each point gets"
        " the class that it would get if all files were one: there is no seam. A file that cannot"
        " be classified is reported at the end. Give --method before --help to see its parameters.",
    )
    parser.add_argument(
        "input", metavar="INPUT", type=Path, nargs="+",
        help="files, folders, virtual point clouds (.vpc), or lists of files (.txt)",
    )  # fmt: skip
    parser.add_argument("output", metavar="FOLDER", type=Path, help="where the results go")
    parser.add_argument(
        "--vpc", metavar="FILE", type=Path,
        help="the virtual point cloud of the results (default: classified.vpc in FOLDER)",
    )  # fmt: skip
    parser.add_argument(
        "--scheduler", metavar="ADDRESS",
        help="let the workers of this Dask scheduler do it, such as tcp://host:8786; without it,"
        " processes of this computer do",
    )  # fmt: skip
    parser.add_argument(
        "--method", choices=list(METHODS), default=_DEFAULT_METHOD,
        help="the ground filter (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument("--json", action="store_true", help="print what was done as JSON")
    chosen = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    chosen.add_argument("--method", default=_DEFAULT_METHOD)
    method = METHODS.get(chosen.parse_known_args(arguments)[0].method, METHODS[_DEFAULT_METHOD])
    groups = {
        "parameters": (f"{method.label} parameters", method.parameters),
        "selection": ("Which points, which classes", Selection),
        "input": ("Files", TileInput),
        "output": ("Output", TileOutput),
        "resources": ("Threads and memory", Resources),
    }
    for title, declared in groups.values():
        add_options(parser.add_argument_group(title), declared)
    parser.set_defaults(
        run=_classify_tiles, groups={name: declared for name, (_, declared) in groups.items()}
    )


def _classify_tiles(options: argparse.Namespace) -> int:
    from .cli import _FAILED, _chosen, _tell, _Terminal
    from .tiles import classify_tiles
    from .tiling.cluster import Cluster
    from .tiling.workers import Processes

    *policy, resources = _chosen(options)
    workers = Processes(resources)
    if options.scheduler:
        workers = Cluster(options.scheduler, resources)
    try:
        with _Terminal(options.verbose) as progress:
            summary = classify_tiles(
                options.input, options.output, *policy, options.vpc, progress, workers
            )
    except (Cancelled, KeyboardInterrupt):
        text = "Cancelled; the tiles that are finished stay. Go on with --resume."
        print(f"bare-earth: {text}", file=sys.stderr)
        return _FAILED
    code = _tell(options, summary, f"{options.output}: {summary.text}")
    return _FAILED if summary.failures else code
