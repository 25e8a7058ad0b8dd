"""What Bare Earth does with points and rasters; `bare_earth` exports what users call."""
