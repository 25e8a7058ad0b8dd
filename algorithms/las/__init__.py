"""Reads and writes LAS, LAZ and COPC files, and keeps what it does not change."""
