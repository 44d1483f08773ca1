"""Kernels of plain algebra: matrices of three rows, and systems of equations in a profile."""
