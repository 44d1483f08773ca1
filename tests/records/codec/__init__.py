"""Claims about vv/records/codec/."""
