"""Claims about the case of a loaded block: its bounds follow the drives."""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

import numpy as np
import pytest

from cases.blocks.laden_block import CASE
from vv.ask import Ask, Knobs, Method, Run
from vv.case import Exact, Ladder, Series
from vv.engines import dem
from vv.records.outcomes import Verdict
from vv.records.record import measured
from vv.scene import Vector


def bounds(given: dict[str, float], variant: str = "level") -> tuple[Vector, float]:
    """The bounds of slip and rise for springs, and the largest displacement [m]."""
    p = {**CASE.defaults(variant), **given}
    quantities = {q.name: q for q in CASE.declare(variant, p).quantities}
    slip, rise = quantities["slip"], quantities["rise"]
    assert isinstance(slip, Series)
    assert isinstance(slip.judge, Exact)
    assert isinstance(rise.judge, Exact)
    assert slip.reference is not None
    way = np.asarray(slip.reference(np.linspace(0.0, p["duration"], 1000)))
    one, other = (judge.tolerance(Method.PENALTY) for judge in (slip.judge, rise.judge))
    return np.array([one.value, other.value]), float(np.abs(way).max())


@pytest.mark.parametrize(
    ("given", "times"),
    [
        ({"a": 3.0, "D": 0.04}, (2.0, 2.0)),
        ({"a": 4.5, "D": 0.06, "mu": 0.15}, (1.5, 3.0)),
        ({"mu": 0.6}, (2.0, 1.0)),
        ({"press": 1.0}, (1.0, 1.0)),
    ],
    ids=str,
)
def test_bounds_grow_with_the_drives_and_those_of_the_slip_with_friction(
    given: dict[str, float], times: tuple[float, float]
) -> None:
    """By hand: springs sink in proportion to the pressure's change, and mu of that is friction."""
    own, way = bounds({"v": 6.0})
    other, moved = bounds({"v": 6.0, **given})
    assert other * moved == pytest.approx(np.array(times) * own * way, rel=0.05)


def test_a_block_of_a_fifth_of_the_mass_sinks_a_fifth_and_swings_less() -> None:
    """The plate that can rotate is as much thinner, and stands on the same springs.

    Its swing is m^(3/2) p'(0)/kn^(3/2), and that of a start half a step late is the cube's alone.
    """
    (_, cube), _ = bounds({})
    (_, plate), _ = bounds({}, "turning")
    assert 0.92 * cube / 5 < plate < cube / 5


LATE = {"alpha": 38.7, "mu": 0.414, "v": 4.02, "push": 0.693, "press": 2.49, "a": 0.911}
LATE |= {"D": 0.0279, "g": 6.6, "duration": 0.32}


@pytest.mark.parametrize("solve", [dem.solve_default, dem.solve_published])
def test_a_start_half_a_step_late_swings_within_the_bounds_of_springs(
    solve: Callable[[Ask], Run],
) -> None:
    trial = CASE.declare("level", {**CASE.defaults("level"), **LATE})
    study, knobs = cast(Ladder, trial.study), Knobs(1e-3, 1e8)
    run = solve(study.ask(knobs))
    for one in trial.quantities:
        if one.name in ("rise", "rising"):
            found = measured(run, one, Method.PENALTY, knobs, True)[0]
            assert found.verdict is Verdict.PASS, one.name


def test_a_pressure_that_springs_could_end_is_refused() -> None:
    near = {"press": 2.49, "D": 0.0394, "g": 6.27, "alpha": 53.7, "a": 2.14, "duration": 0.763}
    with pytest.raises(ValueError, match="by which the softest springs oscillate"):
        CASE.declare("level", {**CASE.defaults("level"), **near, "mu": 0.206, "v": 3.29})
