"""The benchmarks: one file each, ending in CASE."""
