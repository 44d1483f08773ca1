"""Claims about vv/cli/."""
