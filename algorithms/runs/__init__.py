"""Runs on one file and on many, and what they are asked for."""
