"""Bridge decks, told from the ground by their cross-sections."""
