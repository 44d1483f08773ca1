"""Claims about prefetching: kernels generate it, and it changes no number."""

import re
from typing import Any

import numba
import numpy as np

from vv.engines.kernels.compiled import ENTRY, ROUNDING
from vv.engines.kernels.prefetch import begin_to_read
from vv.scene import Vector


def summed(rows: Vector, ahead: int, column: int) -> float:
    """The sum of the first column; a row some rows ahead is prefetched."""
    total = 0.0
    for i in range(len(rows)):
        begin_to_read(rows, i + ahead, column)
        total += rows[i, 0]
    return total


def test_a_kernel_asks_for_a_row_beforehand_to_read_it_and_to_keep_it() -> None:
    kernel: Any = numba.njit(**ENTRY, **ROUNDING)(summed)
    rows = np.arange(24.0).reshape(6, 4)
    far_beyond = 10**6  # a prefetch is no access: the row need not exist
    assert kernel(rows, 1, 3) == kernel(rows, far_beyond, 0) == 60.0
    (code,) = kernel.inspect_llvm().values()
    assert re.search(r"call void @llvm\.prefetch\.p0\(.*, i32 0, i32 3, i32 1\)", code)
