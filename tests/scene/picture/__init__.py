"""Claims about vv/scene/picture/."""
