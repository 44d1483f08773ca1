"""Adapts numba's compiler to kernels: its passes, code and calls, without needless work."""
