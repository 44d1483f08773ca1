"""Claims about vv/engines/exact/slide/."""
