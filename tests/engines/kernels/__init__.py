"""Claims about vv/engines/kernels/."""
