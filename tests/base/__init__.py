"""Claims about vv/base/."""
