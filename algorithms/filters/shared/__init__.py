"""What the ground filters share."""
