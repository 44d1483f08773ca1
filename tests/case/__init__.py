"""Claims about vv/case/."""
