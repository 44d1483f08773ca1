"""Claims about searches: where they end, what they cost, and what becomes of failures in them."""

from __future__ import annotations

import dataclasses
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.scenes.small_scenes import ball
from vv.ask import (
    Ask,
    Bracket,
    Cost,
    Displacement,
    History,
    Knobs,
    Method,
    Model,
    Observable,
    Run,
    SearchVariable,
    Status,
)
from vv.case import Interval, Ladder, Level, Search, Trial, largest_step, last_stable_step
from vv.codes import Found, no_steps
from vv.records.checking import checked
from vv.records.outcomes import Verdict
from vv.records.record import measured, summarised
from vv.run import answering
from vv.run.search import _sum, answers
from vv.scene import Contact, Harmonic, Pulse, Scene, Vector
from vv.store.store import Store

BODY, STILL = Displacement(0), Displacement(1)
BOUND = 10.0
SCENE = Scene((ball(np.zeros(3), np.zeros(3)),), Contact(1.0))


class Limited:
    """A code in whose runs one body stays near up to a step and, beyond it, goes far or is lost."""

    name = "limited"
    schemes = ()

    def __init__(self, limit: float, beyond: Status = Status.RAN) -> None:
        self.limit, self.beyond, self.calls = limit, beyond, 0

    def found(self) -> Found:
        return Found(True)

    def refuses(self, ask: Ask, scheme: str) -> str | None:
        return None

    def describe(self, ask: Ask, scheme: str) -> Model:
        return Model(1, ask.scene.terms())

    def native(self, ask: Ask, scheme: str) -> str:
        return ""

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        self.calls += 1
        assert not list(scratch.iterdir())
        (scratch / "ask-0.done").touch()
        for ask in asks:
            assert ask.search is None
            dt = ask.knobs.dt or 0.0
            times = ask.goal.times(dt)
            fine = dt <= self.limit
            if not fine and self.beyond is not Status.RAN:
                yield Run(self.beyond, f"lost at {dt:g} s")
            else:
                values: dict[Observable, Vector] = {
                    STILL: np.zeros((len(times), 3)),
                    BODY: np.full((len(times), 3), 1.0 if fine else -20.0),
                }
                model = self.describe(ask, scheme)
                yield Run(Status.RAN, times=times, values=values, steps=40, model=model)


def study(bracket: Bracket) -> Search:
    return Search(SCENE, (BODY,), 1.0, 40, bracket)


def found(code: Limited, *brackets: Bracket) -> list[Run]:
    asks = [study(bracket).ask(Knobs(1.0)) for bracket in brackets]
    with tempfile.TemporaryDirectory() as folder:
        return list(answers(code, asks, "default", Path(folder), 0.0))


@given(st.floats(1.0, 16.0), st.integers(2, 9), st.integers(1, 4), st.sampled_from(Status))
def test_it_ends_at_the_limit_as_sharply_as_it_says(
    limit: float, tries: int, rounds: int, beyond: Status
) -> None:
    bracket = Bracket(16.0, BOUND, tries, rounds)
    (run,) = found(Limited(limit, beyond), bracket)
    gaps = (tries - 1) * (tries + 1) ** (rounds - 1)  # between the steps of a single long round
    least = limit / bracket.span ** (1.0 / gaps) * (1 - 1e-12)
    assert least <= last_stable_step(run, bracket) <= limit


def test_several_searches_take_their_rounds_together() -> None:
    code = Limited(3.0)
    both = found(code, Bracket(8.0, BOUND, 5, 3), Bracket(4.0, BOUND, 5, 2))
    assert code.calls == 3
    assert [len(run.tried) for run in both] == [15, 10]
    assert all((np.diff(run.tried[:, 0]) > 0).all() for run in both)


def test_its_cost_is_that_of_all_steps_that_were_tried_and_of_whole_processes_if_any_is() -> None:
    one, other = (Cost(1.0, 2.0, cpu, 4.0, 5.0, repeats=3) for cpu in (0.5, 0.25))
    assert _sum([one, other]) == Cost(2.0, 4.0, 0.75, 8.0, 10.0)
    assert _sum([one, dataclasses.replace(other, whole=True)]).whole


def test_each_step_that_is_tried_is_asked_with_the_other_knobs_as_they_are() -> None:
    """Once, kinetic damping was left out and the result told as one with it."""
    first = study(Bracket(8.0, BOUND, 5)).ask(Knobs(1.0, 1e6, 0.5))
    tried = first.at(4.0)
    assert (tried.knobs, tried.search) == (Knobs(4.0, 1e6, 0.5), None)
    assert tried.goal == History(4 * first.goal.duration, 4 * first.goal.interval)


def test_its_record_has_the_step_that_it_found_and_one_that_failed_has_none() -> None:
    bracket = Bracket(8.0, BOUND, 5)
    trial = Trial(study(bracket), ())
    (run,) = found(Limited(3.0), bracket)
    step = answering._largest_step(trial, run)
    assert step == pytest.approx(3.0, rel=0.2)
    assert summarised(run, (), step).largest_step == step
    assert answering._largest_step(trial, Run(Status.ERROR, "crashed")) is None
    ladder = Ladder(SCENE, History(1.0, 0.1), (BODY,), dict.fromkeys(Level, (Knobs(1e-3),)))
    assert answering._largest_step(Trial(ladder, ()), run) is None


def test_where_nothing_is_unstable_the_longest_step_is_the_answer() -> None:
    code, bracket = Limited(1e9), Bracket(8.0, BOUND, 5)
    (run,) = found(code, bracket)
    assert last_stable_step(run, bracket) == pytest.approx(8.0)
    assert run.reason == "all values that were tried are stable"


def test_what_is_lost_beyond_the_limit_is_data_and_its_reason_is_told() -> None:
    bracket = Bracket(8.0, BOUND, 5)
    (run,) = found(Limited(3.0, Status.DIVERGED), bracket)
    assert run.status is Status.RAN
    assert run.reason.startswith("at dt = 3.0")
    assert "lost at 3.0" in run.reason
    assert np.isinf(run.tried[-1, 1])


def test_what_grows_beyond_the_bound_is_told_by_how_much() -> None:
    (run,) = found(Limited(3.0), Bracket(8.0, BOUND, 5))
    assert run.reason.endswith("reaches 20 of at most 10")


def test_a_code_that_cannot_take_the_first_step_has_failed() -> None:
    (run,) = found(Limited(0.5, Status.ERROR), Bracket(8.0, BOUND, 5))
    assert run.status is Status.ERROR
    assert run.reason == "lost at 1 s"


def test_a_first_step_that_is_unstable_leaves_no_stable_one() -> None:
    bracket = Bracket(8.0, BOUND, 5)
    (run,) = found(Limited(0.5), bracket)
    assert last_stable_step(run, bracket) == 0.0


def test_the_store_gives_back_what_was_tried(tmp_path: Path) -> None:
    store, bracket = Store(tmp_path), Bracket(8.0, BOUND, 5)
    (run,) = found(Limited(3.0, Status.DIVERGED), bracket)
    store.keep_run("ab12", run)
    again = store.run("ab12")
    assert again is not None
    assert np.array_equal(again.tried, run.tried)
    assert again.reason == run.reason


def test_the_largest_step_is_judged_over_theory() -> None:
    bracket = Bracket(8.0, BOUND)
    judge = Interval(0.99, 1.01, "as sharp as the search")
    (run,) = found(Limited(3.0), bracket)
    ask = study(bracket).ask(Knobs(1.0))
    assert checked(run, ask) is run
    for theory, verdict in ((3.0, Verdict.PASS), (3.1, Verdict.FAIL)):
        quantity = largest_step("limit", theory, "2/w", bracket, judge)
        entry, _ = measured(run, quantity, Method.SECOND_ORDER, ask.knobs)
        assert entry.verdict is verdict


def test_a_run_that_tried_nothing_is_no_answer_to_a_search() -> None:
    asked = study(Bracket(8.0, BOUND)).ask(Knobs(1.0))
    (run,) = Limited(3.0).run([asked.at(1.0)], "", Path(tempfile.mkdtemp()), 0.0)
    assert checked(run, asked).status is Status.ERROR


def test_a_scheme_without_a_step_has_none_to_search() -> None:
    asked = study(Bracket(8.0, BOUND)).ask(Knobs())
    assert "no time step" in (no_steps(asked) or "")


def test_all_steps_of_a_search_are_as_many() -> None:
    one = study(Bracket(8.0, BOUND))
    for dt in (1.0, 1.7, 8.0):
        assert one.ask(Knobs(1.0)).at(dt).goal.steps(dt) == 40
        assert one.ask(Knobs(dt)).goal.steps(dt) == 40
    assert {rung for level in Level for rung in one.rungs[level]} == {Knobs(1.0)}


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"span": 1.0}, "Bracket.span = 1.0"),
        ({"bound": 0.0}, "Bracket.bound = 0.0"),
        ({"tries": 1}, "Bracket.tries = 1"),
        ({"rounds": 0}, "rounds = 0"),
    ],
)
def test_a_bracket_that_makes_no_sense_is_refused(changed: dict[str, float], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        Bracket(**{"span": 8.0, "bound": BOUND, **changed})  # type: ignore[arg-type]


def test_asks_before_and_after_a_search_do_not_find_each_other_s_files(tmp_path: Path) -> None:
    sought = study(Bracket(8.0, BOUND, 5)).ask(Knobs(1.0))
    plain = dataclasses.replace(sought, search=None)
    runs = answers(Limited(1.5), [plain, sought, plain, plain], "default", tmp_path, 0.0)
    assert [run.status for run in runs] == [Status.RAN] * 4


class Overturned(Limited):
    """A code in which a body is thrown far by more than so much shaking."""

    def run(self, asks: Sequence[Ask], scheme: str, scratch: Path, repeat: float) -> Iterator[Run]:
        for ask in asks:
            assert ask.search is None
            assert ask.scene.wave is not None
            far = 1.0 if ask.scene.wave.amplitude[0] <= self.limit else 20.0
            times = ask.goal.times(ask.dt)
            values: dict[Observable, Vector] = {BODY: np.full((len(times), 3), far)}
            yield Run(Status.RAN, times=times, values=values, steps=40)


@pytest.mark.parametrize("ends", [False, True])
def test_a_search_for_the_largest_shaking_multiplies_it_and_keeps_all_else(ends: bool) -> None:
    wave = Harmonic(np.array([2.0, 0.0, 0.0]), np.ones(3))
    scene = dataclasses.replace(SCENE, shaking=Pulse(wave, 0.5) if ends else wave)
    bracket = Bracket(4.0, BOUND, 4, 6, SearchVariable.SHAKING)
    rungs = dict.fromkeys(Level, (Knobs(0.1),))
    ask = Ladder(scene, History(1.0, 0.1), (BODY,), rungs, search=bracket).ask(Knobs(0.1))
    with tempfile.TemporaryDirectory() as folder:
        (run,) = answers(Overturned(5.0), [ask], "default", Path(folder), 0.0)
    assert last_stable_step(run, bracket) == pytest.approx(2.5, rel=3e-4)
    assert (ask.shaken(2.0).scene.terms(), ask.shaken(2.0).goal) == (scene.terms(), ask.goal)


def test_a_search_for_the_largest_shaking_needs_some() -> None:
    with pytest.raises(ValueError, match="there is none to be multiplied"):
        study(Bracket(2.0, 1.0)).ask(Knobs(1.0)).shaken(2.0)


def test_a_ladder_does_not_search_for_steps() -> None:
    with pytest.raises(ValueError, match="has steps of its own"):
        Ladder(SCENE, History(1.0, 0.1), (BODY,), {}, search=Bracket(2.0, 1.0))
