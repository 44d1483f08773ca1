"""Claims about the loop over the bonds of a block: it is vectorised."""

import re
from typing import Any

import numba
import numpy as np

from vv.engines.dem.bonds.arrays import BondArrays, shares
from vv.engines.dem.bonds.block_forces import compute_block
from vv.engines.dem.bonds.blocks import ALL, WIDE, Blocks
from vv.engines.kernels.compiled import ENTRY, ROUNDING
from vv.engines.kernels.compiler.parts import WholeCompiler


def bent(bonds: BondArrays) -> int:
    """How many bonds of all blocks break."""
    breaking = 0
    for k in range(len(bonds.table)):
        breaking += compute_block(bonds, 0, k, 1e-6, None, bonds.ks, None, bonds.frail)
    return breaking


def test_a_block_of_bonds_is_computed_several_at_once() -> None:
    compute_block.dispatcher  # type: ignore[attr-defined]  # noqa: B018 - sets numba up
    kernel: Any = numba.njit(pipeline_class=WholeCompiler, **ENTRY, **ROUNDING)(bent)  # not kept
    table, row = np.ones((2, ALL * WIDE)), np.zeros((2 * WIDE, 2), np.intp)
    blocks = Blocks(np.zeros((2, 2 * WIDE), np.uint32), table, None, row[0], row)
    one, three = np.ones(1), np.ones((1, 3))
    springs = row, three, one, one, one, np.ones((1, 2))
    state, torn = np.zeros((0, WIDE), np.uint8), np.zeros(2)
    bonds = BondArrays(springs, one, blocks, None, table, *shares(1, 1), state, torn)
    assert kernel(bonds) == 0
    (code,) = kernel.inspect_llvm().values()
    assert re.search(r"call contract <\d+ x double> @llvm.sqrt", code)
