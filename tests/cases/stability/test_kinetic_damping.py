"""Claims about kinetic damping: dd is a knob, and schemes without it refuse."""

from pathlib import Path

import pytest

from vv.ask import Knobs, Method, Status
from vv.case import Exact, Level
from vv.codes import Scheme
from vv.codes.adapter import known_beforehand
from vv.plan.planning import project_knobs
from vv.plan.project import find
from vv.records.reading import in_words

PROJECT = find()
CASE = PROJECT.load_case("kinetic-damping")
TRIAL = CASE.declare("3-per-cent", CASE.defaults("3-per-cent"))


def answer(name: str, scheme: Scheme, knobs: Knobs) -> str:
    """The reason why a scheme does not run the case at these knobs; empty if it runs."""
    adapter = PROJECT.load_adapter(name)
    ask = TRIAL.study.ask(project_knobs(knobs, scheme))
    run = known_beforehand(adapter, scheme, ask, adapter.found())
    return run.reason if run and run.status is Status.REFUSED else ""


@pytest.mark.parametrize("name", PROJECT.adapter_names())
def test_a_scheme_without_the_knob_refuses_and_never_runs_undamped(name: str) -> None:
    knobs = TRIAL.study.rungs[Level.QUICK][0]
    for scheme in PROJECT.load_adapter(name).schemes:
        assert bool(answer(name, scheme, knobs)) == ("dd" not in scheme.knobs)


def test_rigid_says_that_it_is_the_damping_that_it_lacks() -> None:
    (scheme,) = PROJECT.load_adapter("rigid").schemes
    assert answer("rigid", scheme, Knobs(1e-2, None, 0.97)) == (
        "its steps keep all velocity, not dd = 0.97"
    )


def test_a_rung_says_its_damping_and_other_rungs_are_written_as_before() -> None:
    assert in_words(Knobs(1e-3, 1e9, 0.97)) == "dt=0.001,kn=1000000000,dd=0.97"
    assert in_words(Knobs(1e-3, 1e9)) == "dt=0.001,kn=1000000000"
    assert in_words(Knobs(dd=0.0)) == "dd=0"


@pytest.mark.parametrize("scheme", ["default", "generalised-alpha"])  # each has its own model
def test_a_hundred_thousand_steps_are_summed_to_rounding(scheme: str, tmp_path: Path) -> None:
    """Plain summation had errors of 1e-12 in positions at dd = 0.913."""
    trial = CASE.declare("3-per-cent", {**CASE.defaults("3-per-cent"), "dd": 0.913})
    ask = trial.study.ask(trial.study.rungs[Level.DEFAULT][-1])
    (run,) = PROJECT.load_adapter("dda").run([ask], scheme, tmp_path, 0.0)
    assert trial.quantities[0].observe(run) == pytest.approx(1.0, abs=1e-13)


@pytest.mark.shows("each step of `dda` takes a fixed part of all velocity")
@pytest.mark.parametrize("dd", [-0.1, 1.1, float("nan")])
def test_a_step_hands_on_a_part_of_its_velocity(dd: float) -> None:
    with pytest.raises(ValueError, match=r"dd = .*; a step keeps a fraction between 0 and 1"):
        Knobs(dd=dd)


def test_the_tolerance_grows_with_the_velocities_that_are_handed_on() -> None:
    def allowed(dd: float) -> float:
        judge = CASE.declare("3-per-cent", {**CASE.defaults("3-per-cent"), "dd": dd}).quantities[0]
        assert isinstance(judge.judge, Exact)
        return judge.judge.tolerance(Method.PENALTY).value

    assert allowed(0.97) == pytest.approx(1e-12, rel=0.01)
    assert allowed(0.99999) == pytest.approx(allowed(1.0), rel=1e-6)
    assert allowed(1.0) < 3e-11
