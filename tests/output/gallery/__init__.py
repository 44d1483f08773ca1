"""Claims about vv/output/gallery/."""
