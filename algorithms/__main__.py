"""Runs the command `bare-earth` as `python -m bare_earth.algorithms`."""

import sys

from .cli import main

sys.exit(main())
