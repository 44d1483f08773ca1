"""Claims about T3 beyond its end: the exact oscillation does not slip; other slips are counted."""

from math import pi

import numpy as np
import pytest

from reference_solutions.checks.contact import single_contact as integrated
from reference_solutions.contact import single_contact as closed
from vv.ask import Displacement, Knobs, Method, Run, Status
from vv.case import Level
from vv.engines import dem, exact
from vv.engines.exact.modes import State
from vv.plan.project import find
from vv.records.record import measured
from vv.scene import Vector

CASE = find().load_case("grazing")
P = CASE.defaults("T3")
TRIAL = CASE.declare("T3", P)
SLIPS, CREPT = TRIAL.quantities
OVERLAP = {name: P[name] for name in ("rho", "r", "kn", "ks", "mu", "eta", "v_b")}
T = TRIAL.study.goal.times(None)
LIMIT = P["mu"] * P["kn"] * closed.overlap(**OVERLAP) / P["ks"]


def run_of(y: Vector) -> Run:
    """A run with the displacements y along y."""
    path = y[:, None] * np.array([0.0, 1.0, 0.0])
    return Run(Status.RAN, times=T[: len(y)], values={Displacement(1): path})


def test_the_closed_form_slips_once_in_20_seconds() -> None:
    assert SLIPS.observe(run_of(closed.t3(T, **OVERLAP))) == 1 == SLIPS.reference


def test_the_second_route_swings_to_the_limit_and_no_farther() -> None:
    """It integrates the spring itself, whose stretch after the slip just reaches mu kn dx/ks."""
    moved = integrated.t3(T[T <= 2.0], **OVERLAP)
    assert moved == pytest.approx(closed.t3(T[T <= 2.0], **OVERLAP), abs=1e-11)
    late = moved[T[: len(moved)] > 0.6]
    assert np.ptp(late) == pytest.approx(2.0 * LIMIT, rel=2e-4)


def test_the_exact_engine_finds_one_slip_by_its_events_too() -> None:
    ask = TRIAL.study.ask(Knobs())
    path = exact.move(exact.prepare(ask), 20.0)
    assert isinstance(path, exact.Path)
    slips = [e for e in path.events if e.before is State.STUCK]
    assert len(slips) == SLIPS.observe(exact.solve(ask)) == 1


@pytest.mark.parametrize(("part", "seen"), [(1e-3, True), (1e-7, True), (1e-10, False)])
def test_a_slip_at_a_turn_is_seen_unless_it_is_rounding(part: float, seen: bool) -> None:
    y = closed.t3(T, **OVERLAP)
    turns = np.flatnonzero(np.diff(y[:-1]) * np.diff(y[1:]) < 0) + 1
    slipped = np.where(np.arange(len(y)) > turns[40], part * LIMIT, 0.0)
    assert SLIPS.observe(run_of(y + slipped)) == 1 + seen
    assert CREPT.observe(run_of(y + slipped)) == pytest.approx(part, abs=3e-8)


def test_the_middle_is_found_whatever_frequency_a_code_swings_at() -> None:
    k = closed.mass(P["rho"], P["r"]) ** -0.5 * P["ks"] ** 0.5
    for wrong in (0.9, 1.0, 1.1):
        y = 0.3 * LIMIT * (1.0 - np.cos(wrong * k * T))
        assert SLIPS.observe(run_of(y)) == 1  # from the first centre, 0, to the final one
        assert SLIPS.observe(run_of(LIMIT * np.sin(wrong * k * T))) == 0


def test_a_leapfrog_slips_again_and_the_count_has_no_order() -> None:
    counts = []
    for knobs in TRIAL.study.rungs[Level.PAPER]:
        counts.append(SLIPS.observe(dem.solve_default(TRIAL.study.ask(knobs))))
    assert counts == [6, 5, 6, 5, 3]


def test_methods_of_second_order_are_shown_and_only_exact_ones_judged() -> None:
    run = exact.solve(TRIAL.study.ask(Knobs()))
    wrong = run_of(closed.t3(T, **OVERLAP) + 1e-3 * LIMIT * (10.0 * pi / 3.0 < T))
    for method, verdict in ((Method.EXACT, "fail"), (Method.SECOND_ORDER, "shown only")):
        entry, _ = measured(wrong, SLIPS, method, Knobs())
        assert entry.verdict.value == verdict
        assert entry.judge.value == ("exact" if verdict == "fail" else "shown")
        assert bool(entry.errors) == (verdict == "fail")  # and so no order in the step
    assert measured(run, SLIPS, Method.EXACT, Knobs())[0].verdict.value == "pass"
