"""Fetches parts of point clouds from servers, and checks every byte count before they are used."""
