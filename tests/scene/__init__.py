"""Claims about vv/scene/."""
