"""Claims about vv/engines/exact/."""
