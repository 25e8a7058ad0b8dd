"""What every room may use: errors, progress, parameters, points, threads and files."""
