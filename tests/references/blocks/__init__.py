"""Claims about the references of blocks."""
