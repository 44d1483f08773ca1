"""References of blocks."""
