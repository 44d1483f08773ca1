"""Tests: claims about all of the project, on one thread per library as `vv` itself runs."""

import os
from pathlib import Path

ROOT = Path(__file__).parents[1]

for _library in ("OMP", "OPENBLAS", "MKL", "NUMBA"):  # before numpy: workers are forked
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")
