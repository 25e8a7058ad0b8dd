"""Reports: pages of HTML that need no other file, and what they are made of."""
