"""Claims about vv/output/."""
