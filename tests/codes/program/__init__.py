"""Claims about vv/codes/program/."""
