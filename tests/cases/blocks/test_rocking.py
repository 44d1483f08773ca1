"""Claims about the case of a rocking block: its references at the output times of a run."""

import numpy as np
import pytest

from cases.blocks.parts._leaning import CENTRE, MOVING, Leaning
from cases.blocks.parts._rocking_friction import _needed
from cases.blocks.parts._rocking_quantities import ExactMotion
from cases.blocks.rocking import CASE
from reference_solutions.blocks import rocking
from vv.ask import Knobs, Method, Observable, Run, Status
from vv.case import Exact, Parameters, Scalar, Series
from vv.engines import rigid
from vv.scene import Pulse, Vector


@pytest.mark.parametrize("dt", [1e-3, 5e-4, 1.25e-4])
def test_the_way_is_that_at_the_outputs_of_a_step(dt: float) -> None:
    """Outputs fall on whole steps, which for most durations are not the times without a step."""
    p = {**CASE.defaults("released"), "b": 0.3221, "h": 0.7388, "part": 0.2098, "duration": 1.469}
    trial = CASE.declare("released", p)
    times = trial.study.goal.times(dt)
    assert not np.array_equal(times, trial.study.goal.times(None))
    law = {name: p[name] for name in ("b", "h", "g")}
    alpha, _ = rocking.slenderness(**law)
    rest = alpha - np.abs(rocking.leans(times, **law, A=0.0, w=1.0, T=0.0, theta=0.2098 * alpha))
    height = np.hypot(p["b"], p["h"]) * np.cos(rest)
    (z,) = (q for q in trial.quantities if isinstance(q, Series) and q.name == "z")
    assert z.reference is not None
    assert np.asarray(z.reference(times)) == pytest.approx(height - height[0], abs=1e-12)


@pytest.mark.parametrize(
    "given",
    [{"b": 0.0634, "h": 0.132, "g": 13.0, "f": 0.429}, {"b": 0.08, "h": 0.15, "f": 0.6}],
    ids=str,
)
def test_a_foot_that_slips_under_a_block_thrown_over_is_solved(given: dict[str, float]) -> None:
    trial = CASE.declare(
        "overturns-1e-1", {**CASE.defaults("overturns-1e-1"), "mu": 5.0, **given}
    )  # fmt: skip
    run = rigid.solve(trial.study.ask(Knobs(1e-3)))
    assert run.ledger is not None
    left, allowed = run.ledger.audits["residual of contact [m/s]"]
    assert left <= 1e-6 * allowed


@pytest.mark.parametrize(("part", "floor"), [(0.2, 5e-4), (0.9, 2e-3), (0.9999, 2.5e-2)])
def test_a_shifted_top_is_felt_over_what_is_left_to_it_between_once_and_fifty_times(
    part: float, floor: float
) -> None:
    """The corners are a thousandth of the size wide; 0.4/(1 - part) is 0.5, 4 and 4000."""
    p = {**CASE.defaults("released"), "part": part, "duration": 1.0}
    (swing,) = (q for q in CASE.declare("released", p).quantities if q.name == "first swing")
    assert isinstance(swing.judge, Exact)
    bound = swing.judge.tolerance(Method.PENALTY)
    assert bound.floor == pytest.approx(floor)
    _, rate = rocking.slenderness(b=p["b"], h=p["h"], g=p["g"])
    assert bound.value == pytest.approx(0.5 * rate * 1e-3 + floor)


def exact_run(p: Parameters, part: float, times: Vector) -> Run:
    """The run of an exact code under a pulse of this fraction of the threshold."""
    law, w = {name: p[name] for name in ("b", "h", "g")}, 2 * np.pi * p["f"]
    pulse = {"A": part * rocking.threshold(**law, w=w), "w": w, "T": np.pi / w}
    lean, rate = rocking.phases(times, **law, **pulse, theta=0.0).T
    block = Leaning(p["b"], p["h"])
    sideways, up = (block.place(lean) - block.initial_centre()).T
    rest = block.alpha - np.abs(lean)
    speed = block.arm * rate[:, None] * np.column_stack([np.cos(rest), 0 * rest, np.sin(rest)])
    values: dict[Observable, Vector] = {
        CENTRE: np.column_stack([sideways, 0 * up, up]),
        MOVING: speed,
    }
    return Run(Status.RAN, times=times, values=values)


@pytest.mark.parametrize(("variant", "part"), [("threshold", 1.01), ("overturns-1e-1", 1.1)])
def test_what_is_seen_of_an_exact_run_is_what_is_due(variant: str, part: float) -> None:
    p = {**CASE.defaults(variant), "f": 0.43, "part": part}
    trial = CASE.declare(variant, p)
    (seen,) = trial.quantities
    assert isinstance(seen, Scalar)
    assert seen.reference is not None
    run = exact_run(p, part, trial.study.goal.times(None))
    assert seen.observe(run) == pytest.approx(seen.reference, rel=1e-5)


@pytest.mark.parametrize("f", [0.43, 1.7])
def test_a_pulse_is_half_a_sine(f: float) -> None:
    shaking = CASE.declare("topples", {**CASE.defaults("topples"), "f": f}).study.scene.shaking
    assert isinstance(shaking, Pulse)
    assert shaking.until == pytest.approx(1 / (2 * f))
    assert float(shaking.wave.frequency[0]) == f


@pytest.mark.parametrize(
    ("given", "held"),
    [
        ({"part": 0.45}, 3.27),  # the pulse does not lift the block
        (  # it lands in the pulse
            {"b": 0.268, "h": 0.791, "part": 0.642, "f": 0.738, "g": 9.49},
            3.215,
        ),
    ],
)
def test_a_pulse_after_which_the_block_does_not_lean_shows_no_threshold(
    given: dict[str, float], held: float
) -> None:
    said = rf"g b/h = {held} m/s2 by so much that the block still leans when it ends"
    with pytest.raises(ValueError, match=said):
        CASE.declare("threshold", {**CASE.defaults("threshold"), **given})


@pytest.mark.parametrize("variant", ["released", "stands", "threshold", "overturns-1e-1"])
def test_friction_must_hold_the_corner_while_the_block_rocks(variant: str) -> None:
    given = CASE.defaults(variant)
    CASE.declare(variant, given)
    with pytest.raises(ValueError, match="slips"):
        CASE.declare(variant, {**given, "mu": 0.335 if variant != "released" else 0.333})


def test_the_friction_that_a_rocking_block_needs_is_that_of_its_path() -> None:
    given = CASE.defaults("threshold")
    w, law = 2 * np.pi * given["f"], {name: given[name] for name in ("b", "h", "g")}
    most = rocking.threshold(**law, w=w)
    exact = ExactMotion(tuple(law.items()), (("A", most), ("w", w), ("T", np.pi / w)), 0.0)
    t = np.linspace(0.05, np.pi / w, 4001)
    block = Leaning(given["b"], given["h"])
    x, z = np.gradient(np.gradient(block.place(exact.leans(t)), t, axis=0), t, axis=0)[10:-10].T
    along = np.abs(x - most * np.sin(w * t[10:-10])) / (z + given["g"])
    lifted = exact.leans(t)[10:-10] > 1e-4
    assert _needed(block, exact, given["g"], np.pi / w) == pytest.approx(
        along[lifted].max(), rel=2e-3
    )
