"""Claims about vv/engines/dem/bulk/."""
