"""Claims about units of four pulled or pressed to failure: what their rates leave is bounded."""

from __future__ import annotations

from pathlib import Path

import pytest

from adapters.dem import ADAPTER
from cases.bonds.parts import _detour, _open_base, _rate_errors, _unit_strengths
from cases.bonds.parts._loading import RATES, lost
from cases.bonds.tetrahedral_strength import CASE
from tests.cases.bonds.driven_unit import Unit
from vv.case import Exact, Ladder, Level, Parameters, Scalar

USUAL = {way: CASE.defaults(way) for way in ("pulled", "pressed")}
INTEGRATED = 2e-11  # relative error of an integrated stress: processors differ by as much


def times(way: str, given: dict[str, float]) -> Parameters:
    """The parameters of the case, some of them multiplied."""
    return {name: value * given.get(name, 1.0) for name, value in USUAL[way].items()}


def at_zero_rate(fast: float, slow: float) -> float:
    return 2.0 * slow - fast


@pytest.mark.parametrize(
    "given",
    [
        {"kn": 0.01}, {"kn": 0.02, "m": 0.1}, {"eta": 30.0}, {"eta": 100.0, "rate": 0.1},
        {"ks": 3.0, "eta": 8.0}, {"xb": 0.01}, {"eta": 0.01, "d": 3.0}, {"m": 30.0, "d": 3.0},
    ],
    ids=str,
)  # fmt: skip
def test_what_rates_leave_in_tension_is_that_of_an_integrated_base(given: dict[str, float]) -> None:
    p = times("pulled", given)
    found = at_zero_rate(*(Unit(p, rate * p["rate"]).tension() for rate in RATES))
    due = _unit_strengths.tension(p).state
    within = _rate_errors.bonded(p, due, _detour.ALONG, p["xb"])
    assert 0.05 < abs(found / due.stress - 1.0) / within < 1.0


@pytest.mark.parametrize(
    "given",
    [
        {}, {"rate": 0.1}, {"rate": 8.0}, {"m": 8.0}, {"m": 0.1}, {"eta": 8.0}, {"eta": 0.3},
        {"kn": 0.3}, {"kn": 3.0}, {"ks": 0.1}, {"xb": 0.2}, {"d": 0.3}, {"d": 8.0}, {"fs0": 3.0},
        {"m": 60.0}, {"mu_p": 0.1},
    ],
    ids=str,
)  # fmt: skip
def test_what_rates_leave_under_pressure_is_that_of_an_integrated_base(
    given: dict[str, float],
) -> None:
    p = times("pressed", given)
    both = (Unit(p, rate * p["rate"]).pressures() for rate in RATES)
    opens, slides = (at_zero_rate(*one) for one in zip(*both, strict=True))
    opening, sliding = _unit_strengths.opening(p), _unit_strengths.sliding(p)
    within = _rate_errors.bonded(p, opening.state, _detour.RIM, p["xb"])
    assert_close(abs(opens / opening.state.stress + 1.0), within)
    assert_close(abs(slides / sliding.state.stress + 1.0), sliding.bound)


def assert_close(error: float, bound: float) -> None:
    """An error is below its bound, and above a hundredth of it but for what integration adds."""
    assert error < bound
    assert error + INTEGRATED > 0.01 * bound


@pytest.mark.parametrize(
    ("way", "given"),
    [
        ("pulled", {"rate": 8.0}), ("pulled", {"eta": 100.0}), ("pulled", {"xb": 0.01}),
        ("pulled", {"kn": 0.01}), ("pressed", {"ks": 0.1}), ("pressed", {"m": 0.01}),
        ("pressed", {"kn": 0.3}), ("pressed", {"xb": 0.1}), ("pressed", {"eta": 0.01}),
    ],
    ids=str,
)  # fmt: skip
@pytest.mark.parametrize("scheme", ["default", "published"])
def test_strengths_and_balance_are_within_their_bounds_far_from_the_usual_parameters(
    way: str, given: dict[str, float], scheme: str, tmp_path: Path
) -> None:
    trial = CASE.declare(way, times(way, given))
    assert isinstance(trial.study, Ladder)
    (made,) = (one for one in ADAPTER.schemes if one.name == scheme)
    method = made.method_for(frozenset(trial.study.scene.terms()))
    for knobs in trial.study.rungs[Level.QUICK]:
        (run,) = ADAPTER.run([trial.study.ask(knobs)], scheme, tmp_path, 0.0)
        judged = [q for q in trial.quantities if isinstance(q.judge, Exact)]
        assert len(judged) == {"pulled": 2, "pressed": 3}[way]
        for one in judged:
            assert isinstance(one, Scalar)
            assert isinstance(one.judge, Exact)
            assert isinstance(one.reference, float)
            assert isinstance(one.scale, float)
            error = abs(one.observe(run) - one.reference) / one.scale
            assert error < one.judge.tolerance(method).at(knobs), one.name


@pytest.mark.parametrize(
    ("way", "given", "why"),
    [
        ("pulled", {"rate": -1.0}, r"rate = -1.6 1/s; it must be positive where units are pulled"),
        ("pressed", {"rate": -1.0}, r"rate = 7.5 1/s; it must be negative where they are pressed"),
        ("pulled", {"rate": 200.0}, r"rate = 320.0 1/s; its size must be below 216.996"),
        ("pressed", {"xb": 0.01}, r"rate = -7.5 1/s: as the base opens, the pressure grows"),
        ("pressed", {"ks": 0.2, "fs0": 0.4, "mu_p": 0.1}, r"bonds slide below the pressure that"),
        ("pressed", {"eta": 100.0}, r"in half a swing, and hides its fall; that must be below"),
        ("pulled", {"eta": -1.0}, r"eta = -6.0 N s/m; drag must be zero or more"),
        ("pulled", {"m": 0.0}, r"Spheres.mass\[0\] = 0.0 kg; masses must be positive"),
    ],
)  # fmt: skip
def test_what_shows_no_failure_is_refused(way: str, given: dict[str, float], why: str) -> None:
    with pytest.raises(ValueError, match=why):
        CASE.declare(way, times(way, given))


def test_the_fall_of_the_pressure_is_that_of_springs_at_small_strains() -> None:
    """Beside the equilibria before and after the opening, at a finite strain."""
    p = USUAL["pressed"]
    failed = _open_base.under(p, 0.0)
    assert lost(p) == pytest.approx(1.0 - failed.settled / failed.held, rel=1e-2)
