"""Nothing is left out: every case, quantity, tolerance, scheme and answer is there."""

import functools
from pathlib import Path

import numpy as np
import pytest

from vv.ask import Method
from vv.case import Case, Exact, Level, Parameters, Series, Trial, knobs_in_scene
from vv.codes import Adapter
from vv.gate import answers
from vv.gate.all_checks import baseline_of
from vv.plan.project import find
from vv.scene import Term, Vector

PROJECT = find(Path(__file__))
CASES = [PROJECT.load_case(name) for name in PROJECT.case_names()]
ADAPTERS = [PROJECT.load_adapter(name) for name in PROJECT.adapter_names()]
SCHEMES = {f"{a.name}/{s.name}": s for a in ADAPTERS for s in a.schemes}
HERE = {adapter.name for adapter in ADAPTERS if adapter.found().installed}
ON_RECORD = {case.name: answers.accepted(PROJECT, case.name) for case in CASES}


@functools.cache
def declared(case: str, variant: str) -> Trial:
    """A variant with its defaults; kept, since to declare some takes seconds."""
    asked = next(one for one in CASES if one.name == case)
    return asked.declare(variant, asked.defaults(variant))


def test_every_file_in_cases_but_helpers_is_a_case() -> None:
    files = [p for p in (PROJECT.root / "cases").rglob("*.py") if not p.name.startswith("_")]
    assert len(files) == len(CASES) > 0


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_what_runs_and_what_is_refused_is_as_it_was_accepted(case: Case) -> None:
    """After a change that is meant: vv accept CASE; of many cases, python -m tests.answer_table.

    A new case, code or variant is not on record yet, and nothing is asked of it here.
    """
    known = ON_RECORD[case.name] or {}
    then = {name: row for name, row in known.items() if name.partition("/")[0] in HERE}
    given = answers.given(PROJECT, case.name) if then else {}
    now = {name: {v: given.get(name, {}).get(v) for v in row} for name, row in then.items()}
    assert now == then


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_what_has_a_baseline_has_its_answers_on_record_and_refusals_have_reasons(
    case: Case,
) -> None:
    known = ON_RECORD[case.name]
    assert (known is None) == (baseline_of(PROJECT, case.name) is None)
    for row in (known or {}).values():
        assert all(isinstance(answer, int) or len(answer) > 20 for answer in row.values())


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_every_quantity_has_a_tolerance_with_its_reason(case: Case) -> None:
    for variant in case.variants:
        trial = declared(case.name, variant.name)
        assert trial.quantities
        for quantity in trial.quantities:
            judge = quantity.judge
            if isinstance(judge, Exact):
                terms = trial.study.scene.terms()
                running = [SCHEMES[name] for name in runs(case.name, variant.name)]
                needed = {scheme.method_for(terms) for scheme in running}
                told = set(judge.tolerances) | set(judge.not_judged)
                assert all({method, method.general} & told for method in needed)
                reasons = [t.reason for t in judge.tolerances.values()]
                assert all(len(reason) > 20 for reason in [*reasons, *judge.not_judged.values()])
            else:
                assert len(judge.reason) > 20


def runs(case: str, variant: str) -> list[str]:
    """The schemes that are on record as running a variant: CODE/SCHEME."""
    known = ON_RECORD[case] or {}
    return [name for name, row in known.items() if isinstance(row.get(variant), int)]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_every_case_tells_its_source_its_parameters_and_its_formulas(case: Case) -> None:
    assert case.source.citation
    assert not case.source.doi or case.source.doi.startswith("10.")
    assert all(p.meaning for p in case.parameters)
    assert all(v.summary and v.formula for v in case.variants)
    names = {p.name for p in case.parameters}
    assert all(v.inert | set(v.defaults) <= names for v in case.variants)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_level_adds_rungs_and_never_changes_the_scene(case: Case) -> None:
    for variant in case.variants:
        study = declared(case.name, variant.name).study
        quick, default, paper = (set(study.rungs[level]) for level in Level)
        assert quick <= default <= paper
        own = {tuple(getattr(knobs, name) for name in knobs_in_scene(study)) for knobs in paper}
        assert len({study.ask(knobs).scene.digest() for knobs in paper}) == len(own)
        assert set(study.timed) <= default


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_each_parameter_enters_the_answer_or_is_declared_inert(case: Case) -> None:
    for variant in case.variants:
        defaults = case.defaults(variant.name)
        now = answer(case, variant.name, defaults)
        if not len(now):  # a map shows a number of each run, whose reference is no error at all
            continue
        inert = {
            name
            for name in set(defaults) - {"duration"}
            if np.allclose(answer(case, variant.name, moved(defaults, name)), now, 1e-11, 0)
        }
        declared = variant.inert | {n for n, value in defaults.items() if value == 0}
        assert declared <= inert <= declared | set(variant.unseen), variant


def moved(parameters: Parameters, name: str) -> Parameters:
    """With one parameter a millionth off: enough to see, too little to lift a block off."""
    return {**parameters, name: parameters[name] * (1 + 1e-6)}


def answer(case: Case, variant: str, parameters: Parameters) -> Vector:
    """All that the references of a variant say at ten times."""
    trial = case.declare(variant, parameters)
    t = trial.study.goal.duration * np.arange(1, 11) / 10
    series = [q for q in trial.quantities if isinstance(q, Series)]
    told = [q.reference(t) for q in series if q.reference is not None]
    return np.concatenate([np.zeros(0), *told])


@pytest.mark.parametrize("adapter", ADAPTERS, ids=lambda adapter: adapter.name)
def test_every_scheme_says_what_it_is(adapter: Adapter) -> None:
    assert len({scheme.name for scheme in adapter.schemes}) == len(adapter.schemes) > 0
    for scheme in adapter.schemes:
        assert scheme.summary
        assert scheme.terms <= set(Term)
        assert isinstance(scheme.method, Method)
