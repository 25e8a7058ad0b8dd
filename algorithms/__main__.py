"""Lets `python -m bare_earth.algorithms` run the command."""

import sys

from .cli import main

sys.exit(main())
