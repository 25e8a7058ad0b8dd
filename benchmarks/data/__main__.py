"""Lists, downloads and rebuilds the labelled point clouds that tests and benchmarks use.

- ``python -m benchmarks.data list`` shows each with its licence, its size and what it is good for.
- ``python -m benchmarks.data fetch [NAME ...] [--to FOLDER]`` downloads the public sources of all,
  or of some, rebuilds them, and checks that they hold the points that were measured.
- ``python -m benchmarks.data digest FILE`` prints what the manifest states of a file. To add a
  cloud, copy an entry of ``benchmarks/data/manifest.json``, and put in its public address (with *
  for the names of the sources), size and SHA-256 of each source, its licences, the steps
  (``rebuilding.py`` lists them) and these digests; then try it by ``fetch``.

They go to $BARE_EARTH_DATA or, without it, to a cache folder, where tests and benchmarks look.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from bare_earth.algorithms.cli.terminal import Terminal

from . import FOLDER, find
from .fetching import Fetching
from .manifest import chosen, sha256
from .rebuilding import digests


def main() -> int:
    """Do what the command line says; return 1 if a cloud could not be fetched."""
    options = _options()
    if options.action == "list":
        print(_listing(options.names))
    elif options.action == "digest":
        known = {"bytes": options.file.stat().st_size, **digests(options.file)}
        known["source_sha256"] = sha256(options.file.read_bytes())
        print(json.dumps(known, indent=1))
    else:
        wanted = chosen(options.names)
        print(f"To {options.to}: {sum(one.download_size for one in wanted) / 1e6:,.0f} MB")
        with Terminal(verbose=True) as progress:
            failed = Fetching(options.to, progress).run(wanted)
        if failed:
            print("Not fetched:", *failed, sep="\n- ")
        return 1 if failed else 0
    return 0


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    actions = parser.add_subparsers(dest="action", required=True)
    listing = actions.add_parser("list", help="show what there is")
    fetching = actions.add_parser("fetch", help="download, rebuild and check")
    for action in (listing, fetching):
        action.add_argument(
            "names", nargs="*", metavar="NAME", help="such as megaplot; all if none"
        )
    fetching.add_argument("--to", type=Path, default=FOLDER, metavar="FOLDER")
    digest = actions.add_parser("digest", help="print what the manifest states of a file")
    digest.add_argument("file", type=Path, metavar="FILE")
    return parser.parse_args()


def _listing(names: list[str]) -> str:
    """Return the clouds, two lines each."""
    lines = []
    for entry in chosen(names):
        place = "here" if find(entry.file).exists() else "not here"
        lines += [
            f"{entry.name}: {entry.title} ({entry.land}); {entry.points:,} points,"
            f" {entry.download_size / 1e6:.1f} MB to download; {place}",
            f"    good for: {entry.good_for}. Licence: {entry.licence};"
            f" data: {entry.data_licence}.",
        ]
        if entry.note:
            lines.append(f"    {entry.note}")
    return "\n".join(lines)


if __name__ == "__main__":
    raise SystemExit(main())
