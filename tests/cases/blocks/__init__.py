"""Claims about the cases of blocks."""
