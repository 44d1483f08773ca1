"""Claims about vv/engines/dem/."""
