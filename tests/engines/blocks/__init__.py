"""Claims about vv/engines/blocks/."""
