"""Runs the command `bare-earth` as `python -m bare_earth.algorithms`."""

import sys

from .cli import main

if __name__ == "__main__":
    sys.exit(main())
