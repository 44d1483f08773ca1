"""Claims about steps of one block in `dda` that are divided, where iterations end by script."""

from __future__ import annotations

from typing import Any

import pytest

from vv.engines.dda.law import OPEN
from vv.engines.dda.limits import CUTS
from vv.engines.dda.point import kernel
from vv.engines.dda.point.block import Block, Contact, Motion, Rule
from vv.engines.dda.point.energies import CUT, ENERGIES, FAILED, PEAK
from vv.engines.dda.point.iteration import iterate
from vv.engines.kernels.arrays import zero_numbers
from vv.engines.kernels.triples import NOWHERE

pytestmark = pytest.mark.usefixtures("in_python")
STEP, MASS = 0.25, 2.0  # s, kg
FALL, UP = (0.0, 0.0, -8.0), (0.0, 0.0, 1.0)  # m/s2, the normal of the wall


def fallen(monkeypatch: pytest.MonkeyPatch, ends_at: float) -> tuple[list[float], Any, Any]:
    """A step of free fall whose iterations end in parts of at most `ends_at` [s].

    The parts that were tried [s], the motion after the step, and what the step counted.
    """
    tried: list[float] = []
    solve: Any = iterate

    def iterated(given: Any, *others: Any) -> Any:
        tried.append((2.0 * MASS / given.inertia) ** 0.5)
        assert len(tried) <= 2 * CUTS
        return solve(given, *others)._replace(ended=tried[-1] <= ends_at)

    monkeypatch.setattr(kernel, "iterate", iterated)
    weight: Any = (0.0, 0.0, MASS * FALL[2])
    block = Block(MASS, 1, 1e6, FALL, NOWHERE, weight, UP, 1e3, None)
    motion = Motion(NOWHERE, NOWHERE, (1.0, 0.0, 0.0), NOWHERE)
    apart, rule = Contact(OPEN, 0.0, NOWHERE, NOWHERE), Rule(0.0, 6, 1.0, 1.0, 0.5)
    spent, worst = zero_numbers(ENERGIES), zero_numbers(PEAK + 1)
    step: Any = kernel.step_block
    after, _ = step(motion, apart, 0, STEP, rule, block, None, spent, worst)
    return tried, after, worst


@pytest.mark.parametrize("halvings", [0, 1, 3])
def test_a_step_is_halved_until_iterations_end_and_its_parts_fill_it(
    monkeypatch: pytest.MonkeyPatch, halvings: int
) -> None:
    part = STEP / 2**halvings
    tried, after, worst = fallen(monkeypatch, part)
    larger = [STEP / 2**k for k in range(halvings)]
    assert tried == pytest.approx([*larger, *[part] * 2**halvings])
    assert after.x == pytest.approx((STEP, 0.0, 0.5 * FALL[2] * STEP**2))
    assert after.v == pytest.approx((1.0, 0.0, FALL[2] * STEP))
    assert (worst[CUT], worst[FAILED]) == (halvings, 0)


def test_a_step_is_halved_no_further_than_its_limit_and_then_counts_as_failed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tried, after, worst = fallen(monkeypatch, 0.0)
    assert min(tried) == pytest.approx(STEP / CUTS)
    assert worst[FAILED] == CUTS
    assert after.x == pytest.approx((STEP, 0.0, 0.5 * FALL[2] * STEP**2))
