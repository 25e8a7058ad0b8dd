"""The `bare-earth` command."""

from __future__ import annotations

import argparse
import signal
import sys
import traceback
from typing import Sequence

from ..core.errors import BareEarthError, Cancelled, FinishedFilesStay, UsageError
from ..core.imports import own_this_process
from ..core.memory import share_one_heap
from ..core.words import Flags, use_names
from ..tools.listing import COMPOSITIONS, FILE_TOOLS, MAP_TOOLS, POINT_TOOLS
from .commands import tool_command
from .options import DONE, FAILED, USAGE, Command, keep_what_was_given


def _add_cache(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    parser.add_argument(
        "--cache", metavar="FOLDER",
        help="The folder of the cache. Without it: that of BARE_EARTH_CACHE, or one of the user.",
    )  # fmt: skip


def _clear_cache(options: argparse.Namespace) -> int:
    from ..remote.cache import cache_of, clear
    from ..remote.fetching import in_words

    folder = cache_of(options.cache)
    print(f"{folder}: {in_words(clear(folder))} were removed.")
    return DONE


_EMPTY = "Where the help says what an empty value means, give the word none for it."
_CLEAR_CACHE = Command(
    "clear-cache",
    "Removes the parts of remote point clouds that runs have fetched and kept.",
    "It tells how many bytes that were.",
    _add_cache,
    _clear_cache,
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return 0 if it is done, 1 if it failed, 2 after wrong usage."""
    if arguments is None:
        own_this_process()
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    _set_output_encoding()
    share_one_heap()
    signal.signal(signal.SIGTERM, _stop)
    names = use_names(Flags())
    try:
        options = _parser(arguments).parse_args(arguments)
        keep_what_was_given(options)
        return options.run(options)
    except SystemExit as error:  # argparse has printed the error
        return error.code if isinstance(error.code, int) else USAGE
    except UsageError as error:
        return _say(error, USAGE, arguments)
    except BareEarthError as error:
        return _say(error, FAILED, arguments)
    except FinishedFilesStay as error:
        text = "Cancelled. The finished files stay. Continue with --resume."
        return _say(text, FAILED, arguments, error)
    except (Cancelled, KeyboardInterrupt):
        return _say("Cancelled; nothing was written.", FAILED, [])
    except MemoryError as error:
        return _say("There is not enough memory for this file.", FAILED, arguments, error)
    except BrokenPipeError:
        return FAILED
    except Exception as error:
        text = f"Unexpected {type(error).__name__}: {error}. Run with --verbose and report it."
        return _say(text, FAILED, arguments, error)
    finally:
        use_names(names)


def _stop(number: int, frame: object) -> None:
    """Stop like Ctrl-C, so that temporary files are removed."""
    raise KeyboardInterrupt


def _set_output_encoding() -> None:
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def _say(
    problem: object, code: int, arguments: Sequence[str], error: BaseException | None = None
) -> int:
    """Print an error in one line; with --verbose, also the traceback."""
    if "--verbose" in arguments and (error is not None or isinstance(problem, BaseException)):
        traceback.print_exc()
    print(f"bare-earth: {problem}", file=sys.stderr)
    return code


def _parser(arguments: Sequence[str]) -> argparse.ArgumentParser:
    from ..core.version import __version__

    parser = argparse.ArgumentParser(
        prog="bare-earth",
        description="Classifies lidar points into ground and non-ground, and makes terrain models.",
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument(
        "--verbose", action="store_true", help="print what is done, and where an error arose"
    )
    tools = {**MAP_TOOLS, **COMPOSITIONS, **POINT_TOOLS, **FILE_TOOLS}
    # Those without a line are dialogs alone.
    of_tools = (tool_command(name) for name, tool in tools.items() if tool.line)
    for command in (*of_tools, _CLEAR_CACHE):
        options = commands.add_parser(
            command.name, parents=[common], help=command.line, epilog=_EMPTY,
            description=f"{command.line} {command.more}",
        )  # fmt: skip
        options.set_defaults(run=command.run)
        # Declarations of parameters import numpy, so other commands are left out.
        if command.name in arguments:
            command.add(options, arguments)
    return parser
