"""Reads and writes LAS, LAZ and COPC files, and keeps what it does not change."""

import os

# Stack size of the threads of lazrs; see `gps_times` for the reason. It is read when the threads
# start. Unused parts of a stack take no memory.
os.environ.setdefault("RUST_MIN_STACK", str(64 << 20))
