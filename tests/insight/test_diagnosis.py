"""Claims about the patterns of failures: each is named from records alone."""

from __future__ import annotations

from typing import Any

import pytest

from tests.conftest import Tiny
from tests.support.fabricated import changed, entry, record
from vv.insight.diagnosis import Diagnosis, Pattern, diagnose
from vv.records.job_record import Record

STEPS = (4e-3, 2e-3, 1e-3, 5e-4)
TERMS = {
    ("bounce", "T1"): frozenset({"gravity", "spheres"}),
    ("bounce", "T2"): frozenset({"gravity", "spheres", "viscous drag -eta v"}),
    ("bounce", "T3"): frozenset({"gravity", "free rotation", "viscous drag -eta v"}),
}


def rung(dt: float, error: float, variant: str = "T2", verdict: str = "", **parts: Any) -> Record:
    """A record whose largest error is that, judged against 1e-5, in a code of second order."""
    came = verdict or ("pass" if error <= 1e-5 else "fail")
    errors = {"max": error, "l2": error, **parts.pop("errors", {})}
    quantity = entry(came, errors, tolerance=1e-5, **parts)
    return record("a/a", variant, dt, quantities=[quantity])


def only(records: list[Record]) -> Diagnosis:
    (found,) = diagnose(records, TERMS)
    return found


def test_an_error_that_stays_as_dt_shrinks_does_not_converge() -> None:
    found = only([rung(dt, 0.013) for dt in STEPS])
    assert found.pattern is Pattern.STUCK
    assert found.text == "it does not converge: error 0.013 to 0.013 as dt shrinks"
    assert (found.case, found.label) == ("bounce", "a/a")


def test_first_order_where_second_is_claimed_is_named_with_the_order_seen() -> None:
    found = only([rung(dt, dt) for dt in STEPS])
    assert found.pattern is Pattern.LOW_ORDER
    assert "order 1.00 where 2 is claimed" in found.text


def test_second_order_outside_the_tolerance_is_no_matter_of_order() -> None:
    assert list(diagnose([rung(dt, 20 * dt**2) for dt in STEPS], TERMS)) == []


def test_a_pattern_is_sought_at_the_stiffest_springs() -> None:
    def at(kn: float, errors: list[float]) -> list[Record]:
        rungs = [rung(dt, error) for dt, error in zip(STEPS, errors, strict=True)]
        return [changed(one, rung={"dt": one.rung.dt, "kn": kn}) for one in rungs]

    falls, stays = [20 * dt**2 for dt in STEPS], [0.1] * len(STEPS)
    assert list(diagnose([*at(1e7, falls), *at(1e6, stays)], TERMS)) == []
    assert only([*at(1e7, stays), *at(1e6, falls)]).pattern is Pattern.STUCK


def test_a_class_that_claims_no_order_is_not_held_to_one() -> None:
    slow = [record(r.label, r.variant, r.rung.dt, method="penalty", quantities=r.quantities)
            for r in (rung(dt, dt) for dt in STEPS)]  # fmt: skip
    assert list(diagnose(slow, TERMS)) == []


@pytest.mark.parametrize(
    ("factor", "said"),
    [(2.0, "a term counts twice"), (0.5, "counts half"), (-1.0, "a sign is swapped"),
     (0.0, "an effect is lost")],
)  # fmt: skip
def test_a_factor_in_the_answer_is_named(factor: float, said: str) -> None:
    error = abs(factor - 1)
    seen = [rung(dt, error, figures={"final": 3.001 * factor}, end=3.0) for dt in STEPS]
    found = only(seen)
    assert found.pattern is Pattern.FACTOR
    assert said in found.text
    scalar: dict[str, Any] = {"kind": "scalar", "value": 3.0 * factor, "reference": 3.0}
    assert said in only([rung(dt, error, **scalar) for dt in STEPS]).text


def test_an_error_that_is_largest_at_the_end_grows_in_time() -> None:
    grown: dict[str, Any] = {"figures": {"final": 1.01}, "end": 1.0, "errors": {"l2": 4e-3}}
    found = only([rung(1e-3, 1e-2, **grown)])
    assert found.pattern is Pattern.GROWTH
    steady = {**grown, "errors": {"l2": 1e-2}}
    assert list(diagnose([rung(1e-3, 1e-2, **steady)], TERMS)) == []


def test_the_effect_that_all_failing_variants_share_and_no_other_has_is_blamed() -> None:
    fine = [rung(dt, 1e-6, "T1") for dt in STEPS]
    late = [rung(dt, dt, variant) for variant in ("T2", "T3") for dt in STEPS]
    assert only([*fine, *late]).text.endswith("; only variants with drag fail")
    odd = [rung(1e-3, 20e-6, variant) for variant in ("T2", "T3")]
    assert only([*fine, *odd]) == Diagnosis(
        "bounce", "a/a", Pattern.TERM, "only variants with drag fail"
    )


def test_nothing_is_said_of_what_passes_or_did_not_run() -> None:
    stopped = record("a/a", "T1", 1e-3, status="error")
    assert list(diagnose([*(rung(dt, 1e-6) for dt in STEPS), stopped], TERMS)) == []


def test_known_disagreements_have_patterns_too() -> None:
    assert only([rung(dt, dt, verdict="xfail") for dt in STEPS]).pattern is Pattern.LOW_ORDER


def test_bugs_seeded_into_a_code_that_runs_are_named_on_the_page_of_the_case(tiny: Tiny) -> None:
    page = tiny.root / ".vv" / "report" / "case-fall.html"
    tiny.vv("run", "fall:up", "--codes", "fake/coarse,fake/first-order")
    assert "it does not converge: error 0.01 to 0.01 as dt shrinks" in page.read_text()
    assert "it converges with order 1.00 where 2 is claimed" in page.read_text()
    for factor, said in (("-1.0", "a sign is swapped"), ("2.0", "a term counts twice")):
        before = "1.0" if factor == "-1.0" else "-1.0"
        tiny.edit("adapters/fake.py", f"FACTOR = {before}", f"FACTOR = {factor}")
        told = tiny.vv("run", "fall:up", "--codes", "fake/good")
        assert said in page.read_text()
        (line,) = (one for one in told.stdout.splitlines() if one.startswith("  pattern: "))
        assert said in line


@pytest.mark.parametrize(
    ("slope", "pattern"),
    [
        (0.25, Pattern.STUCK),
        (0.4, None),  # as at a floor
        (0.8, Pattern.LOW_ORDER),
        (1.35, Pattern.LOW_ORDER),
        (1.45, None),
    ],
)
def test_an_order_is_flat_below_a_third_and_late_by_more_than_six_tenths(
    slope: float, pattern: Pattern | None
) -> None:
    found = [*diagnose([rung(dt, 10 * dt**slope) for dt in STEPS], TERMS)]
    assert [one.pattern for one in found] == ([pattern] if pattern else [])


def test_an_error_that_falls_once_does_converge() -> None:
    errors = (1e-2, 1e-2, 2.5e-3, 2.5e-3)
    found = [*diagnose([rung(dt, e) for dt, e in zip(STEPS, errors, strict=True)], TERMS)]
    assert Pattern.STUCK not in [one.pattern for one in found]


@pytest.mark.parametrize(
    ("value", "named"), [(4.0, True), (4.05, True), (3.95, True), (4.08, False), (3.92, False)]
)
def test_a_factor_is_one_within_three_hundredths(value: float, named: bool) -> None:
    """Of 2: no slip leaves behind 2.04; errors over the exact one are then those of a slip."""
    rows = [rung(dt, 9e-3 * dt / 1e-3, value=value, reference=2.0) for dt in STEPS[:1]]
    assert (Pattern.FACTOR in [one.pattern for one in diagnose(rows, TERMS)]) is named


def test_the_quantity_farthest_outside_its_tolerance_is_looked_at() -> None:
    def two(dt: float, far: float) -> Record:
        quantities = [
            entry("fail", {"max": 5e-2 * dt}, name="near", tolerance=1e-4),
            entry("fail", {"max": far}, name="far", tolerance=1e-6),
            entry("pass", {"max": None}, name="lost", tolerance=1e-9),
            entry("pass", {"max": 9.0}, name="shown", tolerance=None),
        ]
        return record("a/a", "T2", dt, quantities=quantities)

    found = only([two(dt, 1e-3) for dt in STEPS])
    assert found.text == "it does not converge: error 0.001 to 0.001 as dt shrinks"


def test_a_variant_is_wrong_if_one_of_its_quantities_is() -> None:
    rows = [
        record("a/a", "T2", dt, quantities=[
            entry("pass", {"max": 1e-6}, name="good", tolerance=1e-5),
            entry("fail", {"max": 1e-2}, name="bad", tolerance=1e-5),
        ])
        for dt in STEPS
    ]  # fmt: skip
    assert only(rows).pattern is Pattern.STUCK


@pytest.mark.parametrize(
    ("mean", "scale", "final", "grows"),
    [
        (0.8, 1.0, 1.0, True),
        (0.9, 1.0, 1.0, False),  # not above its mean square by far
        (0.8, 4.0, 4.0, True),  # over its scale
        (0.8, 4.0, 1.0, False),
        (0.7, 1.0, 0.85, False),  # it was worse before
    ],
)
def test_an_error_grows_if_it_is_largest_at_the_end_and_above_its_mean_square(
    mean: float, scale: float, final: float, grows: bool
) -> None:
    parts: dict[str, Any] = {"scale": scale, "figures": {"final": final}, "end": 1e-30}
    rows = [rung(dt, 1.0 * dt**2 * 1e6, errors={"l2": mean}, **parts) for dt in (2e-3, 1e-3)]
    found = [*diagnose(rows, TERMS)]
    assert [one.pattern for one in found] == ([Pattern.GROWTH] if grows else [])


def test_errors_that_stay_are_told_from_the_longest_step_to_the_shortest() -> None:
    falls = [rung(dt, error) for dt, error in zip(STEPS, (0.14, 0.13, 0.12, 0.11), strict=True)]
    assert only(falls[::-1]).text == "it does not converge: error 0.14 to 0.11 as dt shrinks"


def test_the_finest_step_says_which_factor_and_which_quantity_is_worst() -> None:
    seen = [rung(dt, 1.0, kind="scalar", value=value, reference=2.0)
            for dt, value in ((4e-3, 4.0), (1e-3, 1.0))]  # fmt: skip
    assert only(seen).text == "y is half the exact answer: a term counts half"

    def two(dt: float, p: float, q: float) -> Record:
        errors = {"p": p, "q": q}
        return record("a/a", "T2", dt, quantities=[
            entry("fail", {"max": e}, name=name, tolerance=1e-5) for name, e in errors.items()
        ])  # fmt: skip

    # at the coarsest step p is worst, which falls; at the finest q, which does not
    errors = zip(STEPS, (16.0, 4.0, 1.0, 0.25), (0.51, 0.52, 0.53, 0.54), strict=True)
    told = only([two(dt, p, q) for dt, p, q in errors]).text
    assert told == "it does not converge: error 0.51 to 0.54 as dt shrinks"
