"""Claims about vv/gate/."""
