"""Clouds of any size: blocks with buffers, threads, and a bound on the memory."""
