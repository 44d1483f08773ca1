"""Claims about vv/insight/."""
