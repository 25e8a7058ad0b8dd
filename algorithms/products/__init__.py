"""One file for each product that is made of classified points."""
