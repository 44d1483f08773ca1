"""Claims about `vv explain`: which results it shows, which agree, and how judges are told."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace
from typing import Any

import pytest

from tests.insight.test_agreement import AGREEING, records_of, written_down
from tests.support.fabricated import NOWHERE, changed, entry, manifest, record
from vv.ask import Method, Run, Status
from vv.case import (
    CodeToCode,
    Exact,
    Interval,
    Measured,
    Measurement,
    Norm,
    Printed,
    Tolerance,
)
from vv.output import explain
from vv.records.job_record import Record
from vv.records.manifest import Manifest
from vv.scene import Term


def test_the_newest_results_of_each_scheme_are_compared() -> None:
    newest, before = (
        Manifest(NOWHERE, {}, {}, (), tuple(records_of(answers)), (), {}, ())
        for answers in ({"a/x": (1.03, 1.01)}, {**AGREEING, "a/x": (5.0, 5.0)})
    )
    records, _ = explain._last_records([newest, before])
    values = {r.label: r.quantities[0].figures["final"] for r in records}
    assert values == {"a/x": 1.01, "b/x": 0.99, "c/x": 1.005}


def test_what_is_recorded_is_compared_while_the_newest_invocation_lacks_the_code() -> None:
    absent, kept = written_down("a/x", 1.03, 1.01)
    lacking = Manifest(NOWHERE, {}, {}, (), tuple(absent), (), {}, tuple(kept))
    having = Manifest(NOWHERE, {}, {}, (), tuple(records_of(AGREEING)), (), {}, ())
    assert explain._last_records([lacking, having])[1] == kept
    assert explain._last_records([having, lacking])[1] == []


def test_results_are_shown_at_the_parameters_that_are_explained_and_at_no_others() -> None:
    def at(m: float | None) -> list[Record]:
        own = records_of({"a/x": (1.03, 1.01)})
        if m is None:
            return own
        more: dict[str, Any] = {"modified": True, "changed": ["m"], "parameters": {"m": m, "g": 9}}
        return [changed(one, **more) for one in own]

    def left(names: tuple[str, ...], m: float) -> list[Record]:
        job = SimpleNamespace(
            case="bounce", variant="floor", changed=names, parameters={"m": m, "g": 9}
        )
        plan: Any = SimpleNamespace(jobs=[job])
        return [*explain._at_parameters(plan, manifest(*at(2.0), *at(3.0), *at(None))).records]

    assert left((), 1.0) == at(None)
    assert left(("m",), 3.0) == at(3.0)
    assert left(("m",), 4.0) == []


def test_of_each_scheme_the_newest_results_are_shown_with_their_day() -> None:
    def run(day: str, errors: dict[str, float]) -> Manifest:
        judged = {label: entry("pass", {"max": error}) for label, error in errors.items()}
        records = [record(label, "T1", 1e-3, quantities=[one]) for label, one in judged.items()]
        return manifest(*records, provenance=dataclasses.replace(NOWHERE, utc=day))

    refused = record("b/x", "T1", 1e-3, status="refused", reason="it has no drag")
    found = explain._last_results(
        [
            manifest(refused, provenance=dataclasses.replace(NOWHERE, utc="day 3")),
            run("day 2", {"a/x": 2e-4}),
            run("day 1", {"a/x": 1e-4, "b/x": 3e-4}),
        ]
    )
    assert found == {
        ("bounce", "T1", "a", "x"): ["day 2", "dt 0.001: pass: y: error 0.0002, allowed 0.001"],
        ("bounce", "T1", "b", "x"): ["day 1", "dt 0.001: pass: y: error 0.0003, allowed 0.001"],
    }


def test_a_variant_is_told_with_its_own_values_terms_freedoms_and_last_results(
    capsys: pytest.CaptureFixture[str],
) -> None:
    meanings = (("m", "kg", "mass"), ("g", "m/s^2", "pull"), ("mu", "", "rub"))
    parameters = [SimpleNamespace(name=n, unit=u, meaning=m) for n, u, m in meanings]
    shown = SimpleNamespace(
        summary="it falls", formula="y = t", inert=("g",), unseen={"mu": "smooth"}
    )
    case: Any = SimpleNamespace(
        name="bounce",
        parameters=parameters,
        variant={"T2": shown}.__getitem__,
    )
    scene = SimpleNamespace(terms=lambda: {Term.GRAVITY, Term.DRAG}, unknowns=lambda: 7)
    job = SimpleNamespace(
        case="bounce", variant="T2", code="a", scheme="x", settled=None, ask=None,
        parameters={"m": 4.0, "g": 5.0, "mu": 6.0}, changed=("mu",),
    )  # fmt: skip
    lacks = changed_job(job, scheme="y", settled=Run(Status.REFUSED, "a/y has no drag"))
    was = changed_job(job, scheme="z", settled=Run(Status.REFUSED, "a/z has no drag"))
    plan: Any = SimpleNamespace(
        trials={
            ("bounce", "T2"): SimpleNamespace(study=SimpleNamespace(scene=scene), quantities=())
        },
        jobs=[
            job,
            lacks,
            was,
            changed_job(job, variant="T1", scheme="only there"),
            changed_job(job, code="p"),
        ],
        adapters={
            "a": SimpleNamespace(describe=lambda ask, _: SimpleNamespace(note="one freedom")),
            "p": SimpleNamespace(
                describe=lambda ask, _: SimpleNamespace(note=""),
                schemes=(SimpleNamespace(name="x", summary="velocities first"),),
            ),
        },
    )
    explain._explain_variant(plan, case, "T2", {("bounce", "T2", "a", "z"): ["day 1", "it ran"]})
    assert capsys.readouterr().out.splitlines() == [
        "",
        "bounce:T2: it falls",
        "  formula: y = t",
        "  m = 4 kg  mass",
        "  g = 5 m/s^2  pull  (inert: not in the exact answer)",
        "  mu = 6   rub  (changed)  (not seen: smooth)",
        f"  terms: {Term.GRAVITY.value}, {Term.DRAG.value}",
        "  unknowns: 7",
        "  a/x: one freedom",
        "    last result: none yet",
        "  a/y: has no drag",
        "  a/z: has no drag",
        "    last result: day 1",
        "      it ran",
        "  p/x: velocities first",
        "    last result: none yet",
    ]


def changed_job(job: SimpleNamespace, **changes: object) -> SimpleNamespace:
    return SimpleNamespace(**{**vars(job), **changes})


SEEN = {"value": 2.0, "digitisation": 0.3, "experiment": 0.4, "conditions": "", "source": "",
        "band": 0.75}  # fmt: skip
OTHER = {"value": 2.0, "rounding": 0.1, "code": "a code", "source": "", "band": None}


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({}, "y: error 0.002, allowed 0.001"),
        ({"errors": {"max": None}}, "y: error nan, allowed 0.001"),
        ({"note": "late"}, "y: error 0.002, allowed 0.001, late"),
        (
            {"tolerance": None, "value": 2.5, "errors": {}, "why": "nothing is known"},
            "y: 2.5, nothing is known",
        ),
        (
            {"tolerance": None, "figures": {"final": 2.5}, "why": "no tolerance"},
            "y: 2.5, error 0.002, no tolerance",
        ),
        ({"tolerance": None, "errors": {}, "why": "unknown"}, "y: no value, unknown"),
        ({"value": 2.5, "measurement": SEEN}, "y: computed 2.5, measured 2 +- 0.5, band 0.75"),
        ({"value": 2.5, "printed": OTHER}, "y: computed 2.5, a code has 2, shown"),
    ],
)
def test_a_result_is_told_with_its_error_and_bound_or_with_why_it_has_none(
    changes: dict[str, Any], said: str
) -> None:
    errors = changes.pop("errors", {"max": 2e-3})
    assert explain._quantity_in_words(entry("fail", errors, **changes)) == said
    if "value" in changes:  # numbers beside those of others have no errors
        assert explain._quantity_in_words(entry("fail", {}, **changes)) == said


def test_a_result_is_told_at_its_step_and_stiffness_and_one_without_numbers_with_its_reason() -> (
    None
):
    run = record("a/x", "T1", 1e-3, rung={"dt": 1e-3, "kn": 1e9},
                 quantities=[entry("fail", {"max": 2e-3})])  # fmt: skip
    assert explain._in_words(run) == "dt 0.001 kn 1e+09: fail: y: error 0.002, allowed 0.001"
    damped = changed(run, rung={"dt": 1e-3, "kn": None, "dd": 0.0})
    assert explain._in_words(damped).startswith("dt 0.001 dd 0: ")
    none = record("a/x", "T1", None, status="refused", reason="it has no walls")
    assert explain._in_words(none) == "not supported: it has no walls"


def told(capsys: pytest.CaptureFixture[str], judge: Any) -> list[str]:
    """What is said below a quantity with this judge."""
    quantity: Any = SimpleNamespace(name="y", unit="m", meaning="height")
    explain._explain_quantity(quantity, judge)
    head, *lines = capsys.readouterr().out.splitlines()
    assert head == "  quantity y [m]: height"
    return [line.strip() for line in lines]


@pytest.mark.parametrize(
    ("band", "said"), [(None, "shown beside it: as it is"), (0.5, "within 0.5 of it: as it is")]
)
def test_a_judge_beside_a_number_of_others_says_whether_and_how_far_it_may_be_off(
    band: float | None, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    seen = Measurement(2.5, 0.25, 0.125, "in air", "a paper")
    first, second = told(capsys, Measured(seen, band, "as it is"))
    assert first == "measured: 2.5, digitised to 0.25, experiment to 0.125; in air; a paper"
    assert second == said
    other = Printed(2.5, 0.05, "a code", "a report")
    first, second = told(capsys, CodeToCode(other, band, "as it is"))
    assert first.endswith("a code has 2.5, rounded to 0.05; a report")
    assert second == said


def test_a_tolerance_is_told_with_all_that_it_scales_by(
    capsys: pytest.CaptureFixture[str],
) -> None:
    whole = Tolerance(2e-3, "of the step", dt=1e-3, order=2, floor=4e-5, kn=1e9, softness=0.5,
                      late=3.0)  # fmt: skip
    judge = Exact(
        {Method.SECOND_ORDER: whole, Method.FIRST_ORDER: Tolerance(1e-2, "of all")},
        Norm.FINAL,
        {Method.PENALTY: "too soft"},
    )
    assert told(capsys, judge) == [
        f"norm: {Norm.FINAL.value}",
        f"{Method.SECOND_ORDER.value}: 0.002 at dt = 0.001 s, as dt^2, at kn = 1e+09 N/m, as "
        "kn^-0.5, plus 3 1/s times dt, at least 4e-05: of the step",
        f"{Method.FIRST_ORDER.value}: 0.01: of all",
        f"{Method.PENALTY.value}: shown: too soft",
    ]
    assert told(capsys, Interval(1.0, 2.0, "between")) == ["interval: between"]


@pytest.mark.parametrize(("doi", "said"), [("", ""), ("10.1/2", ", doi:10.1/2")])
def test_an_agreement_is_told_below_its_own_variant_alone(
    doi: str, said: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(explain, "_explain_variant", lambda plan, case, name, _: print(name))
    variants = [SimpleNamespace(name=one) for one in ("other", "floor", "skipped")]
    source = SimpleNamespace(citation="Someone", doi=doi, note="none")
    bounce = SimpleNamespace(title="Bounces", source=source, published={}, variants=variants)
    job = SimpleNamespace(case="bounce", variant="floor", changed=())
    plan: Any = SimpleNamespace(
        cases={"bounce": bounce},
        trials={("bounce", "other"): 0, ("bounce", "floor"): 0},
        jobs=[job],
    )
    whole = Manifest(NOWHERE, {}, {}, (), tuple(records_of(AGREEING)), (), {}, ())
    explain.print_explanation(plan, [whole])
    lines = capsys.readouterr().out.splitlines()
    assert lines[:3] == ["Bounces", f"  source: Someone{said}", "  note: none"]
    assert lines[3:-1] == ["other", "floor"]
    assert lines[-1].startswith("  agreement: y of bounce:floor ")


@pytest.mark.parametrize(
    ("reason", "said"),
    [
        (None, "two freedoms"),
        ("a/x has no drag", "has no drag"),
        ("a/y has no drag", "not supported: a/y has no drag"),
    ],
)
def test_a_scheme_is_told_with_its_model_or_with_what_it_lacks(
    reason: str | None, said: str
) -> None:
    settled = Run(Status.REFUSED, reason) if reason else None
    job: Any = SimpleNamespace(settled=settled, code="a", scheme="x", ask=None)
    model = SimpleNamespace(describe=lambda ask, scheme: SimpleNamespace(note="two freedoms"))
    plan: Any = SimpleNamespace(adapters={"a": model})
    assert explain._model_or_refusal(plan, job) == said
