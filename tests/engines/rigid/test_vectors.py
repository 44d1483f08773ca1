"""Claims about loops of the contact solver, over contacts and equations: they are vectorised."""

import re
from typing import Any

import numba
import numpy as np

from vv.engines.kernels.compiled import ENTRY, ROUNDING
from vv.engines.kernels.compiler.parts import BranchingCompiler
from vv.engines.rigid.solver.banded import eliminate
from vv.engines.rigid.solver.batches import BATCH, LAYER, PAIRS, Record
from vv.engines.rigid.solver.lanes import update_layer
from vv.engines.rigid.solver.seats import LANES
from vv.scene import Vector


def pressed(pairs: Record, batches: Record, layers: Record) -> None:
    """Update each contact of each batch once."""
    for k in range(len(batches)):
        update_layer(pairs[0], batches[k], layers[k])


def eliminated(matrix: Vector, right: Vector, half: int) -> None:
    """Solve a banded system of equations."""
    eliminate(matrix, right, half)


def test_equations_in_a_band_are_solved_several_numbers_at_once() -> None:
    eliminate.dispatcher  # type: ignore[attr-defined]  # noqa: B018 - as below
    kernel: Any = numba.njit(pipeline_class=BranchingCompiler, **ENTRY, **ROUNDING)(eliminated)
    rng, m, half = np.random.default_rng(7), 60, 9
    far = np.abs(np.subtract.outer(np.arange(m), np.arange(m))) > half
    full = np.where(far, 0.0, rng.normal(size=(m, m)))
    band, solution = np.zeros((m, 3 * half + 1)), rng.normal(size=m)
    for i in range(m):
        for j in range(max(0, i - half), min(m, i + half + 1)):
            band[i, j - i + half] = full[i, j]
    right = full @ solution
    kernel(band, right, half)
    assert np.abs(right - solution).max() <= 1e-13 * np.linalg.cond(full)
    (code,) = kernel.inspect_llvm().values()
    assert re.search(r"fmul contract <\d+ x double>", code)


def test_contacts_of_a_batch_are_pressed_several_at_once() -> None:
    update_layer.dispatcher  # type: ignore[attr-defined]  # noqa: B018 - numba is told what kernels need
    kernel: Any = numba.njit(pipeline_class=BranchingCompiler, **ENTRY, **ROUNDING)(pressed)
    batches, layers = np.zeros(2, BATCH), np.zeros(2, LAYER)
    batches["lanes"] = LANES
    kernel(np.zeros(1, PAIRS), batches, layers)
    assert (layers["p"] == 0).all()
    (code,) = kernel.inspect_llvm().values()
    assert re.search(r"call contract <\d+ x double> @llvm.sqrt", code)
