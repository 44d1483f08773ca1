"""Claims about the machine code of series: products that are alike are formed several at once."""

import re
from typing import Any

import numba
import numpy as np

from vv.engines.exact.turn.slipping import _products
from vv.engines.kernels.compiled import ENTRY, ROUNDING
from vv.engines.kernels.compiler.parts import JoiningCompiler
from vv.scene import Vector


def multiplied(q: Vector, n: int, sums: Vector) -> None:
    """Coefficients n of the products of a slip."""
    _products(q, n, sums)


def test_products_of_a_slip_are_formed_several_at_once() -> None:
    _products.dispatcher  # type: ignore[attr-defined]  # noqa: B018 - numba is told of what it is
    kernel: Any = numba.njit(pipeline_class=JoiningCompiler, **ENTRY, **ROUNDING)(multiplied)
    q, sums = np.random.default_rng(4).normal(size=(9, 17)), np.zeros(17)
    kernel(q, 8, sums)
    by_speed, by_way = q[::-1, 16] @ q[:, :8], (q[::-1, 12:16] * q[:, 8:12]).sum(axis=0)
    assert np.abs(sums[:12] - np.append(by_speed, by_way)).max() < 1e-13
    (code,) = kernel.inspect_llvm().values()
    assert re.search(r"fmul contract <\d+ x double>", code)
