"""Claims about vv/records/."""
