"""How results are compared with those accepted, without running anything."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.support.fabricated import changed, entry, record, requantified
from vv.gate import acceptance, regression, speed
from vv.gate.bands import EXTERNAL, IN_HOUSE, Band
from vv.gate.regression import Strictness
from vv.records import codec
from vv.records.accepted import Acceptance, Baseline, Place
from vv.records.finding import Bit, Finding
from vv.records.job_record import Record
from vv.records.sorted_text import render

ACCEPTANCE = Acceptance("c", False, Place("P", "S"), "r", "u", {})
FIGURES = {"final": 3.0, "mean": 1.0}


def ran(error: float | None = 1e-4, final: float = 3.0, **changes: Any) -> Record:
    figures = {**FIGURES, "final": final}
    quantity = entry("pass", {"max": error}, scale=2.0, figures=figures)
    return changed(record("dem/default", "T1", 1e-3, quantities=[quantity]), **changes)


def accepted(*records: Record, old: Baseline | None = None) -> Baseline:
    return acceptance.accepted("bounce", old, records or (ran(),), ACCEPTANCE, ())


def compared(
    now: Record, external: tuple[str, ...] = (), then: Baseline | None = None
) -> list[Finding]:
    strictness = Strictness(external, enforced=True, demanded=False)
    return regression.compare("bounce", [now], then or accepted(), strictness)


def test_the_same_result_is_no_finding() -> None:
    assert compared(ran()) == []


@given(st.floats(1e-12, 1e-2), st.sampled_from([IN_HOUSE, EXTERNAL]))
def test_errors_are_compared_within_the_band_of_the_code(change: float, band: Band) -> None:
    external = ("dem",) if band is EXTERNAL else ()
    kinds = [finding.kind for finding in compared(ran(1e-4 + change), external)]
    if not 0.99 < change / band.width < 1.01:
        assert kinds == (["worse"] if change > band.width else [])


def test_the_band_applies_to_the_value_over_its_scale() -> None:
    assert compared(ran(final=3.0 + 1.9e-9)) == []
    (found,) = compared(ran(final=3.0 + 2.1e-9))
    assert (found.kind, found.red, found.quantity) == ("moved", True, "y")


def test_rounding_in_a_tiny_error_is_noise() -> None:
    assert compared(ran(5e-16), then=accepted(ran(1e-16))) == []


def test_the_last_bits_of_an_answer_that_has_blown_up_are_no_change() -> None:
    then = accepted(ran(8.2e34, final=8.2e34))
    assert compared(ran(8.2e34 * (1 + 1e-15), final=8.2e34 * (1 + 1e-15)), then=then) == []
    (found,) = compared(ran(8.1e34, final=8.1e34), then=then)
    assert found.kind == "better"


def test_a_better_error_is_no_failure_and_a_lost_one_is() -> None:
    (found,) = compared(ran(1e-5))
    assert (found.kind, found.red) == ("better", False)
    (found,) = compared(ran(None))
    assert (found.kind, found.red) == ("worse", True)


def test_a_quantity_no_longer_reported_is_red_and_a_new_one_is_noted() -> None:
    gone, new = compared(requantified(ran(), name="z"))
    assert (gone.kind, gone.red, new.kind, new.red) == ("gone", True, "new", False)


def test_a_modified_run_is_neither_compared_nor_accepted() -> None:
    assert compared(ran(1.0, modified=True)) == []
    assert not acceptance.acceptable(ran(modified=True))


def test_a_failure_is_not_acceptable() -> None:
    assert not acceptance.acceptable(requantified(ran(), verdict="fail"))
    assert not acceptance.acceptable(ran(status="error"))
    assert not acceptance.acceptable(ran(quantities=[]))


def test_small_changes_cannot_add_up_unseen() -> None:
    kept = accepted()
    for shift in (1e-9, 1.8e-9):
        kept = accepted(ran(final=3.0 + shift), old=kept)
    assert kept == accepted()
    assert [f.kind for f in compared(ran(final=3.0 + 2.7e-9), then=kept)] == ["moved"]


def test_what_is_not_installed_keeps_its_results_and_what_refuses_loses_them() -> None:
    kept = accepted()
    absent = accepted(ran(status="not-installed", quantities=[]), old=kept)
    assert absent.results == kept.results
    refused = accepted(ran(status="refused", quantities=[]), old=kept)
    assert refused.results == {}
    assert refused.acceptances == {}


def test_what_only_a_higher_level_runs_keeps_its_results() -> None:
    kept, name = accepted(ran(), ran(variant="T0")), "T0 dem/default dt=0.001"
    without = acceptance.accepted("bounce", kept, [ran()], ACCEPTANCE, (), {name})
    assert without.results == kept.results
    assert without.parameters.keys() == {"T0", "T1"}
    gone = acceptance.accepted("bounce", kept, [ran()], ACCEPTANCE, ())
    assert gone.parameters.keys() == {"T1"}


def test_rendered_text_reads_back_and_has_a_result_a_line() -> None:
    kept = accepted(ran(), ran(variant="T0"))
    text = render(kept)
    assert codec.read(Baseline, codec.parse(text), "baseline") == kept
    assert text.index('"T0 dem/default dt=0.001"') < text.index('"T1 dem/default dt=0.001"')
    assert max(map(len, text.splitlines())) < 200


def timed(low: float, high: float) -> Record:
    made = ran()
    return changed(made, cost=changed(made.cost, relative=[low, high]))


@pytest.mark.parametrize(
    ("now", "processor", "kind"),
    [
        ((1.4, 1.9), "P", ""),  # intervals within the factor of each other
        ((1.9, 2.5), "P", "slower"),
        ((1.9, 2.5), "Q", ""),  # another processor
        ((4.0, 4.5), "Q", "slower"),
        ((0.3, 0.5), "P", "faster"),
    ],
)
def test_speed_is_judged_by_intervals_apart(
    now: tuple[float, float], processor: str, kind: str
) -> None:
    then = accepted(timed(1.0, 1.2))
    found = speed.compare("bounce", [timed(*now)], then, processor, True)
    assert [f.kind for f in found] == ([kind] if kind else [])
    assert all(f.bit == (Bit.SPEED if kind == "slower" else 0) for f in found)


def test_costs_once_accepted_stay_when_results_are_accepted_without_timing() -> None:
    kept = accepted(timed(1.0, 1.2))
    again = accepted(ran(2e-4), old=kept)
    (result,) = again.results.values()
    assert result.cost == (1.0, 1.2)
    assert result.quantities["y"].error == 2e-4


def test_a_figure_is_accepted_with_twelve_digits() -> None:
    """Fewer would move results that did not, or hide those that did."""
    kept = codec.render(accepted(ran(1.23456789012345e-4, 3.14159265358979)))
    assert "3.14159265359," in kept
    assert "0.000123456789012" in kept
