"""How numba compiles kernels here: its passes, its code and its calls, less what is not needed."""
