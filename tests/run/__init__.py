"""Claims about vv/run/."""
