"""Claims about vv/growth/."""
