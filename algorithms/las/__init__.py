"""Reads and writes LAS, LAZ and COPC files, and keeps what it does not change."""

import os

# The bytes that the stack of each thread of lazrs may take: `gps_times` says why. It is asked for
# once, when they begin; what is not needed takes no memory.
os.environ.setdefault("RUST_MIN_STACK", str(64 << 20))
