"""Claims about vv/engines/dda/."""
