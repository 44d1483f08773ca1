"""Claims about single kernels of vv/engines/blocks/, against numbers found by hand."""
