"""Claims about vv/standins/."""
