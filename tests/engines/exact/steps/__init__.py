"""Claims about vv/engines/exact/steps/."""
