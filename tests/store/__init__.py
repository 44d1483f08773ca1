"""Claims about vv/store/."""
