"""Claims about vv/codes/."""
