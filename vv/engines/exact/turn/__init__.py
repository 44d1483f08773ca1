"""Exact motion of one body whose slip on rigid contact turns, by Taylor series in numba."""
