"""Claims about single kernels of `rigid`, which have truths by hand."""
