"""Claims about the contact solver of many blocks: when sweeps that are stuck restart from zero.

They do so once, and only far from the residual asked. The solver runs as plain Python, with sweeps
that are replaced by the given residuals.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from vv.engines.rigid.general import few, many
from vv.engines.rigid.general.few import Limits
from vv.engines.rigid.limits import CARRIED, FAR, LEAPT, SOFT, STALLED, STEADIED, STUCK, SWEPT
from vv.engines.rigid.solver.problem import Problem
from vv.scene import Vector

ASKED = 1e-6  # m/s
NEAR, AWAY = 0.5 * FAR * ASKED, 2.0 * FAR * ASKED
BLOCKS = 400  # in no chain
ROWS = {
    "it converges at once": ([0.0], []),
    "it is near and takes a Newton step": ([NEAR, 0.0], ["newton"]),
    "it is far and begins anew": ([AWAY, 0.0], ["anew"]),
    "it stays far and does not begin anew again": ([AWAY, AWAY, 0.0], ["anew", "newton"]),
    "it is near after it began anew": ([AWAY, NEAR, 0.0], ["anew", "newton"]),
}


@pytest.fixture
def done(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What happens between sweeps: impulses are set to zero, or a Newton step is taken."""
    said: list[str] = []

    def cleared(p: Vector) -> None:
        said.append("anew")
        p.fill(0.0)

    def polished(*given: object) -> float:
        said.append("newton" if given[-1] == SOFT else "stiff newton")
        return AWAY

    def rounds(*given: object) -> float:
        said.append("rounds")
        return AWAY

    monkeypatch.setattr(many, "clear", cleared)
    monkeypatch.setattr(many, "newton_rounds", rounds)
    for where in few, many:
        monkeypatch.setattr(where, "polish", polished)
        monkeypatch.setattr(where, "velocities_without", lambda given: (given.v, given.w))
    return said


def replace_sweeps(
    monkeypatch: pytest.MonkeyPatch, swept: Callable[..., Any], left: Callable[..., float]
) -> None:
    """Replace sweeps of all kinds, and the residual of velocities that are computed anew."""
    monkeypatch.setattr(many, "leap_sweeps", swept)
    monkeypatch.setattr(many, "momentum_sweeps", swept)
    for where in few, many:
        monkeypatch.setattr(where, "solve_contacts", swept)
        monkeypatch.setattr(where, "recomputed", left)
        monkeypatch.setattr(where, "smaller", min)


def solved(way: str, p: Vector, blocks: int = BLOCKS, most: int = 20_000) -> Any:
    """Sweeps and residual of one way of solving, from impulses p."""
    solve = getattr(few if way == "solve_chained" else many, way).py_func
    none: Any = None
    problem = Problem(none, none, none, p, p.copy(), p.copy())
    return solve(Limits(blocks, ASKED, most, 0.0), problem, 1, ASKED, none)


def sweeping(monkeypatch: pytest.MonkeyPatch, left: list[float], sweeps: int = STUCK) -> Vector:
    """Replace sweeps by ones that leave the given residuals; returns the impulses."""
    rows: Iterator[float] = iter(left)
    now = [np.inf]

    def swept(*_: object) -> tuple[int, float]:
        now[0] = next(rows)
        return sweeps, now[0]

    replace_sweeps(monkeypatch, swept, lambda *_: now[0])
    return np.ones((3, 3))


@pytest.mark.shows("`rigid` extrapolates along such a drift")
@pytest.mark.parametrize("way", ["solve_with_leaps", "solve_in_turns"])
@pytest.mark.parametrize("row", ROWS)
def test_sweeps_that_are_stuck_far_off_begin_anew_once(
    monkeypatch: pytest.MonkeyPatch, done: list[str], way: str, row: str
) -> None:
    left, wanted = ROWS[row]
    p = sweeping(monkeypatch, left)
    sweeps, residual = solved(way, p)
    assert (done, residual) == (wanted, 0.0)
    assert sweeps == STUCK * len(left)
    assert (p == 0.0).all() == ("anew" in wanted)


@pytest.mark.shows("`rigid` iterates from block to block in sweeps")
def test_a_chain_takes_stiff_newton_steps_and_never_begins_anew(
    monkeypatch: pytest.MonkeyPatch, done: list[str]
) -> None:
    p = sweeping(monkeypatch, [AWAY, AWAY, 0.0], sweeps=STALLED)
    found = solved("solve_chained", p)
    assert (done, found) == (["stiff newton", "stiff newton"], (3 * STALLED, 0.0))
    assert (p == 1.0).all()


@pytest.mark.shows("`rigid` iterates from block to block in sweeps")
@pytest.mark.parametrize(
    ("way", "blocks", "most", "parts"),
    [
        ("solve_chained", 2, 2 * STALLED + 7, [STALLED, STALLED, 7]),
        ("solve_in_turns", BLOCKS, CARRIED + STEADIED + 7, [CARRIED, STEADIED, 7]),
        ("solve_with_leaps", BLOCKS, LEAPT, LEAPT // STUCK * [STUCK]),
    ],
)
def test_sweeps_are_no_more_than_allowed_and_go_on_as_long_as_each_kind_may(
    monkeypatch: pytest.MonkeyPatch, done: list[str], way: str, blocks: int, most: int, parts: Any
) -> None:
    taken: list[int] = []

    def swept(*given: Any) -> tuple[int, float]:
        taken.append(given[-1])
        return given[-1], NEAR

    replace_sweeps(monkeypatch, swept, lambda *_: NEAR)
    sweeps, _ = solved(way, np.ones((3, 3)), blocks, most)
    assert taken == parts
    assert sweeps == most


def test_after_many_sweeps_with_leaps_rounds_take_the_place_of_newton_steps(
    monkeypatch: pytest.MonkeyPatch, done: list[str]
) -> None:
    few_times = SWEPT // STUCK
    p = sweeping(monkeypatch, [NEAR] * (few_times + 1) + [0.0])
    assert solved("solve_with_leaps", p)[1] == 0.0
    assert done == ["newton"] * (few_times - 1) + ["rounds"] * 2


@pytest.mark.parametrize("way", ["solve_with_leaps", "solve_in_turns"])
def test_after_sweeps_that_do_not_converge_velocities_are_computed_anew(
    monkeypatch: pytest.MonkeyPatch, done: list[str], way: str
) -> None:
    """The residual is then that of the impulses alone, without the rounding of all sweeps."""
    p = sweeping(monkeypatch, [AWAY, AWAY])
    monkeypatch.setattr(many, "recomputed", lambda *_: 0.5 * ASKED)
    found = solved(way, p)
    assert (done, found) == ([], (STUCK, 0.5 * ASKED))
