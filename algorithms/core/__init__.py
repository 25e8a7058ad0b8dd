"""Used by all other packages: errors, progress, parameters, points, threads and files."""
