"""Cuts a survey into blocks, computes them and puts the results together."""
