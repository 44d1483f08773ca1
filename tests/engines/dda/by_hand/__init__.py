"""Claims about single kernels of `dda`, which have truths by hand and need no compiler."""
