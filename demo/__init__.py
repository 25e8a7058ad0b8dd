"""A scene whose truth is known, and a picture of what the classifier makes of it: `make demo`."""
