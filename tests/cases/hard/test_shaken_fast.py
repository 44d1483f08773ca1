"""Claims about a base that shakes fast: both routes stay accurate, large steps lose the block."""

from decimal import Decimal, getcontext

import numpy as np
import pytest
from numpy.typing import NDArray

from reference_solutions.blocks import responding_block as closed
from reference_solutions.checks.blocks import responding_block as followed
from vv.ask import Displacement, Knobs, Method, Run, Status
from vv.case import Exact, Ladder, Scalar, Series
from vv.engines import dem, exact
from vv.plan.project import find

CASE = find().load_case("shaken-fast")
BLOCK, X = Displacement(1), np.array([1.0, 0.0, 0.0])
FAST = {"D": 0.2, "mu": 0.6, "g": 9.81}
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494")


def cosine(x: Decimal, s: int) -> Decimal:
    """cos x for s = 0, sin x for s = 1, by their series."""
    x %= 2 * PI
    total, term, n = Decimal(0), Decimal(1), 0
    while n < 4 or abs(term) > Decimal(10) ** -45:
        if n % 2 == s:
            total += term if n % 4 < 2 else -term
        n += 1
        term *= x / n
    return total


def in_40_digits(t: NDArray[np.float64], f: float) -> NDArray[np.float64]:
    """d2 of a block that always slips: linear velocities, reversals by Newton's method."""
    getcontext().prec = 40
    w, friction = 2 * PI * Decimal(f), Decimal(FAST["mu"]) * Decimal(FAST["g"])
    top = Decimal(FAST["D"]) * w
    then, x, v, a, i, d2 = Decimal(0), Decimal(0), Decimal(0), friction, 0, []
    due = [Decimal(float(one)) for one in t]
    half = 0
    while i < len(due):
        half += 1
        turn = half * PI / w
        for _ in range(8):
            behind = top * cosine(w * turn, 1) - v - a * (turn - then)
            turn -= behind / (top * w * cosine(w * turn, 0) - a)
        while i < len(due) and due[i] <= turn:
            s = due[i] - then
            d2.append(float(x + v * s + a * s * s / 2))
            i += 1
        s = turn - then
        x, v, a, then = x + v * s + a * s * s / 2, v + a * s, -a, turn
    return np.array(d2)


@pytest.mark.parametrize(("f", "end"), [(5.0, 4.0), (20.0, 2.0), (100.0, 0.5)])
def test_both_routes_agree_with_40_digits(f: float, end: float) -> None:
    t = np.linspace(0.0, end, 101)
    sharp = in_40_digits(t, f)
    for route in (closed, followed):
        off = np.abs(route.one_direction(t, f=f, **FAST) - sharp).max()
        assert off < 5e-14 * np.abs(sharp).max()


def test_at_100_hz_too_the_mean_of_a_period_tends_to_its_limit() -> None:
    t = 336.0 - np.arange(20.0) / 2000.0
    w = 200.0 * np.pi
    limit = 0.2 * np.pi**2 / 4.0 * (1.0 - 2.371 * (0.6 * 9.81 / (0.2 * w**2)) ** 2)
    mean = float(np.mean(closed.one_direction(t, f=100.0, **FAST)))
    assert mean == pytest.approx(limit, rel=1.5 * np.exp(-10.0))


def test_the_case_judges_path_and_mean_where_ten_time_constants_are_run() -> None:
    for variant, names in (("5hz", ["d2x", "mean"]), ("20hz", ["d2x", "mean"]), ("100hz", ["d2x"])):
        assert [q.name for q in CASE.declare(variant, CASE.defaults(variant)).quantities] == names


def test_the_exact_engine_ends_at_the_limit() -> None:
    trial = CASE.declare("5hz", CASE.defaults("5hz"))
    _, mean = trial.quantities
    assert isinstance(mean, Scalar)
    assert mean.observe(exact.solve(trial.study.ask(Knobs()))) == pytest.approx(
        mean.reference, rel=7e-5
    )


@pytest.mark.parametrize("step", [None, 5e-4, 2.5e-4, 1e-3])
@pytest.mark.parametrize(
    "given",
    [
        {},
        {"D": 0.196, "f": 6.55, "mu": 0.729, "g": 9.61, "duration": 22.7},
        {"f": 3.37, "duration": 11.4},
        {"D": 0.11, "f": 2.71, "mu": 0.5, "duration": 6.1},
    ],
)
def test_the_exact_path_has_the_mean_wherever_outputs_lie(
    given: dict[str, float], step: float | None
) -> None:
    trial = CASE.declare("5hz", {**CASE.defaults("5hz"), **given})
    path, mean = trial.quantities
    assert isinstance(path, Series)
    assert isinstance(mean, Scalar)
    assert isinstance(mean.judge, Exact)
    assert isinstance(mean.reference, float)
    assert path.reference is not None
    assert isinstance(trial.study, Ladder)
    times = trial.study.goal.times(step)
    run = Run(Status.RAN, times=times, values={BLOCK: np.outer(path.reference(times), X)})
    bound = mean.judge.tolerances[Method.EXACT].value
    assert bound < 2e-3
    assert abs(mean.observe(run) / mean.reference - 1) < bound


def test_no_mean_is_judged_where_friction_holds_the_block_for_a_while() -> None:
    given = {**CASE.defaults("5hz"), "f": 1.4, "duration": 30.0}
    assert [q.name for q in CASE.declare("5hz", given).quantities] == ["d2x"]


def test_steps_in_which_the_base_gains_more_than_friction_gives_lose_the_block() -> None:
    """Friction reverses at whole steps. The block drifts off at 20 Hz, but not at 5 Hz."""
    ways = []
    for variant, dt in (("20hz", 2.5e-4), ("5hz", 2.5e-4)):
        trial = CASE.declare(variant, CASE.defaults(variant))
        path = trial.quantities[0]
        assert isinstance(path, Series)
        assert path.reference is not None
        run = dem.solve_default(trial.study.ask(Knobs(dt, 1e8)))
        due = path.reference(run.times)
        moved = run.values[Displacement(1)][:, 0]
        ways.append(float(np.abs(moved - due).max() / np.abs(due).max()))
    assert ways[0] > 5.0
    assert ways[1] < 0.01
