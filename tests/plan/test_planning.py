"""Claims about what stands in a plan: the jobs of each variant and setting."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from tests.support.fabricated import some
from vv.ask import Knobs, Method
from vv.base.errors import UsageError
from vv.case import Level, Variant
from vv.plan import planning
from vv.plan.plan import EmptyPlanError, Options, Plan, merge_plans
from vv.scene import Term

LEVELS = {"T1": Level.QUICK, "T2": Level.DEFAULT, "T3": Level.PAPER}
USUAL = {"m": 1.0, "g": 2.0, "c": 3.0}
RUNGS = (Knobs(4e-3, 1e8), Knobs(4e-3, 1e9), Knobs(2e-3, 1e9, 0.5))


def study(rigid: bool = True) -> Any:
    scene = some(terms=lambda: frozenset({Term.DRAG}), contact=some(rigid=rigid))
    rungs = dict.fromkeys(Level, RUNGS)
    return some(
        scene=scene, rungs=rungs, timed=(Knobs(4e-3, 1e9),), ask=lambda knobs: some(knobs=knobs)
    )


def a_case() -> Any:
    variants = {name: Variant(name, "what", "y = 0", level=level, inert=frozenset({"g", "c"}))
                for name, level in LEVELS.items()}  # fmt: skip
    return some(name="fall", variant=variants.__getitem__, defaults=lambda name: dict(USUAL))


def posed(**parameters: float) -> Any:
    values = {**USUAL, **parameters}
    return planning._Declared(a_case(), "T1", values, some(study=study(), quantities=()), RUNGS,
                              study().ask)  # fmt: skip


def scheme(name: str, *knobs: str, **lowered: Method) -> Any:
    return some(name=name, knobs=knobs, method_for=lambda terms: Method.FIRST_ORDER
                if Term.DRAG in terms else Method.EXACT)  # fmt: skip


@pytest.mark.parametrize(
    ("knobs", "settings", "timed"),
    [
        (("dt", "kn"), [RUNGS[0], RUNGS[1], RUNGS[2]], [False, True, False]),
        (("dt",), [Knobs(4e-3), Knobs(2e-3, None, 0.5)], [True, False]),
        (
            ("kn",),
            [Knobs(None, 1e8), Knobs(None, 1e9), Knobs(None, 1e9, 0.5)],
            [False, True, False],
        ),
        ((), [Knobs(), Knobs(None, None, 0.5)], [True, False]),
    ],
)
def test_a_scheme_has_a_job_for_each_setting_that_differs_in_its_own_knobs(
    knobs: tuple[str, ...], settings: list[Knobs], timed: list[bool]
) -> None:
    code, nothing = some(name="a"), some()
    jobs = planning._jobs(posed(), code, scheme("x", *knobs), nothing)
    assert [job.ask.knobs for job in jobs] == settings
    assert [job.timed for job in jobs] == timed
    for job in jobs:
        assert (job.case, job.variant, job.code, job.scheme) == ("fall", "T1", "a", "x")
        assert (job.method, job.modified, job.inert) == (Method.FIRST_ORDER, False, "")


@pytest.mark.parametrize(
    ("changes", "inert"),
    [({"m": 9.0}, ""), ({"g": 9.0}, "g = 9: "), ({"m": 9.0, "c": 8.0, "g": 7.0}, "g = 7, c = 8: ")],
)
def test_changed_parameters_without_effect_are_named_with_their_values(
    changes: dict[str, float], inert: str
) -> None:
    code, nothing = some(name="a"), some()
    first, *_ = planning._jobs(posed(**changes), code, scheme("x", "dt"), nothing)
    assert first.modified
    assert first.inert.partition("inert")[0] == inert


@pytest.mark.parametrize(
    ("names", "level", "planned", "first"),
    [
        (["T1", "T2", "T3"], Level.QUICK, ["T1"], ""),
        (["T1", "T2", "T3"], Level.DEFAULT, ["T1", "T2"], ""),
        (["T1", "T2", "T3"], Level.PAPER, ["T1", "T2", "T3"], ""),
        (["T2", "T3"], Level.QUICK, [], "--level default has variants of it"),
        (["T3"], Level.DEFAULT, [], "--level paper has variants of it"),
        ([], Level.PAPER, [], "the selection is empty"),
    ],
)
def test_a_plan_holds_the_variants_of_its_level_and_names_the_first_that_has_any(
    names: list[str], level: Level, planned: list[str], first: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    case, code = a_case(), some(name="a", found=lambda: "here")
    for name, what in (
        ("select", lambda *_: [(case, one) for one in names]),
        ("named_adapters", lambda *_: {"a": code}),
        ("choose_schemes", lambda *_: [(code, scheme("x", "dt"))]),
        ("declare_trial", lambda *_: some(study=study(), quantities=())),
        ("parameters_with_settings", lambda *_: USUAL),
    ):
        monkeypatch.setattr(planning, name, what)
    project: Any = some()
    if first:
        with pytest.raises(EmptyPlanError, match=first):
            planning.make_plan(project, ["fall"], Options(level))
        return
    plan = planning.make_plan(project, ["fall"], Options(level))
    assert [*dict.fromkeys(job.variant for job in plan.jobs)] == planned
    assert [*plan.trials] == [("fall", name) for name in planned]
    found: Any = plan.found
    assert (found, [*plan.cases]) == ({"a": "here"}, ["fall"])


@pytest.mark.parametrize(
    ("rigid", "rungs", "refused"),
    [
        (True, (Knobs(1e-3, 1e9),), False),
        (False, (Knobs(1e-3),), False),
        (False, (), False),
        (False, (Knobs(1e-3), Knobs(1e-3, 1e9)), True),
    ],
)
def test_a_stiffness_is_no_setting_of_what_has_one_of_its_own(
    rigid: bool, rungs: tuple[Knobs, ...], refused: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    trial = some(study=study(rigid), quantities=())
    monkeypatch.setattr(planning, "declare_trial", lambda *_: trial)
    monkeypatch.setattr(planning, "parameters_with_settings", lambda *_: USUAL)
    options = Options(rungs=rungs)
    if refused:
        with pytest.raises(UsageError, match="fall:T1 has a contact stiffness of its own"):
            planning._declared(a_case(), "T1", options)
        return
    assert planning._declared(a_case(), "T1", options).rungs == (rungs or RUNGS)
    last: Any = planning.finest_ask(a_case(), "T1", options)
    assert last.knobs == (rungs or RUNGS)[-1]


def test_of_two_plans_the_first_wins_where_both_have_a_job() -> None:
    def job(mark: str, dt: float, kn: float, variant: str = "T1") -> Any:
        return SimpleNamespace(case="fall", variant=variant, code="a", scheme="x", mark=mark,
                               ask=some(knobs=Knobs(dt, kn)))  # fmt: skip

    def plan(*jobs: Any) -> Any:
        trials = {("fall", one.variant): one.mark for one in jobs}
        return Plan(jobs, {"fall": jobs[0].mark}, trials, {}, {})

    one = plan(job("one", 1e-3, 1e8), job("one", 1e-3, 1e9))
    other = plan(job("other", 1e-3, 1e8), job("other", 2e-3, 1e8), job("other", 1e-3, 1e8, "T2"))
    both = merge_plans(one, other)
    jobs: Any = both.jobs
    found = sorted((job.variant, job.ask.knobs.dt, job.ask.knobs.kn, job.mark) for job in jobs)
    assert found == [
        ("T1", 1e-3, 1e8, "one"), ("T1", 1e-3, 1e9, "one"),
        ("T1", 2e-3, 1e8, "other"), ("T2", 1e-3, 1e8, "other"),
    ]  # fmt: skip
    trials: Any = both.trials
    assert trials == {("fall", "T1"): "one", ("fall", "T2"): "other"}
