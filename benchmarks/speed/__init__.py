"""Measures what the filters cost beside reading and writing, and beside peers."""
