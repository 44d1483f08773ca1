"""Claims about the loop over the bonds of a block: it is vectorised."""

import re
from typing import Any

import numba
import numpy as np

from vv.engines.dem.bonds.block_forces import SCRATCH, compute_block
from vv.engines.dem.bonds.blocks import ALL, WIDE
from vv.engines.dem.bonds.law import Frail
from vv.engines.dem.space.neighbours import State
from vv.engines.kernels.compiled import ENTRY, ROUNDING
from vv.engines.kernels.compiler.parts import WholeCompiler
from vv.scene import Vector


def bent(
    scratch: Vector, table: Vector, many: int, ks: Vector, frail: Frail | None, state: State
) -> int:
    """How many bonds of all blocks break; many: of all."""
    breaking = 0
    for k in range(len(table)):
        here = min(WIDE, many - k * WIDE)
        breaking += compute_block(scratch, 0, table, k, here, 1e-6, None, ks, None, frail, state)
    return breaking


def test_a_block_of_bonds_is_computed_several_at_once() -> None:
    compute_block.dispatcher  # type: ignore[attr-defined]  # noqa: B018 - sets numba up
    kernel: Any = numba.njit(pipeline_class=WholeCompiler, **ENTRY, **ROUNDING)(bent)  # not kept
    table, none = np.ones((2, ALL * WIDE)), np.zeros((0, WIDE), np.uint8)
    assert kernel(np.ones((1, SCRATCH * WIDE)), table, 2 * WIDE, np.ones(1), None, none) == 0
    (code,) = kernel.inspect_llvm().values()
    assert re.search(r"call contract <\d+ x double> @llvm.sqrt", code)
