"""Contacts are pressed several at once: the loop over a batch is one of vectors of numbers."""

import re
from typing import Any

import numba
import numpy as np

from vv.engines.kernels.compiled import ENTRY, ROUNDING
from vv.engines.kernels.compiler.parts import BranchingCompiler
from vv.engines.rigid.solver.batches import BATCH, LAYER, PAIRS, Record
from vv.engines.rigid.solver.lanes import press
from vv.engines.rigid.solver.seats import LANES


def pressed(pairs: Record, batches: Record, layers: Record) -> None:
    """Press each contact of each batch once."""
    for k in range(len(batches)):
        press(pairs[0], batches[k], layers[k])


def test_contacts_of_a_batch_are_pressed_several_at_once() -> None:
    press.dispatcher  # type: ignore[attr-defined]  # noqa: B018 - numba is told what kernels need
    kernel: Any = numba.njit(pipeline_class=BranchingCompiler, **ENTRY, **ROUNDING)(pressed)
    batches, layers = np.zeros(2, BATCH), np.zeros(2, LAYER)
    batches["lanes"] = LANES
    kernel(np.zeros(1, PAIRS), batches, layers)
    assert (layers["p"] == 0).all()
    (code,) = kernel.inspect_llvm().values()
    assert re.search(r"call contract <\d+ x double> @llvm.sqrt", code)
