"""Claims about vv/engines/rigid/."""
