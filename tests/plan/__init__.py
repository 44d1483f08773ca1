"""Claims about vv/plan/."""
