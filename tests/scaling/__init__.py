"""Claims about vv/scaling/."""
