"""What is compared with what was accepted, one row a decision, by hand."""

import pytest

from tests.support.acceptances import accepted, ran
from tests.support.fabricated import changed, requantified
from vv.gate import regression
from vv.gate.bands import EXTERNAL, IN_HOUSE, LARGE
from vv.gate.regression import Strictness
from vv.records.accepted import Baseline
from vv.records.finding import Bit, Finding
from vv.records.job_record import Record


def compared(now: list[Record], then: Baseline | None, demanded: bool = False) -> list[Finding]:
    return regression.compare("bounce", now, then, Strictness((), True, demanded))


@pytest.mark.parametrize(
    ("then", "now", "told"),
    [
        (1e-4, 1e-4 + 3e-9, "error 0.0001, now 0.000100003"),
        (8.2e34, 8.2e34 * (1 + 1e-6), "error 8.2e+34, now 8.20001e+34"),
        (8.2e34, 8.2e34 * (1 - 1e-6), None),  # as wrong as before
        (8.2e34, 4.1e34, "error 8.2e+34, now 4.1e+34"),
        (1.2, 1.2 * (1 - 3e-9), None),
        (1.0, 1.0 - 3e-9, "error 1, now 0.999999997"),  # not above its scale
    ],
)
def test_a_change_of_an_error_is_told_in_digits_that_show_it(
    then: float, now: float, told: str | None
) -> None:
    found = compared([requantified(ran(), errors={"max": now})], accepted(ran(then)))
    assert [one.text.partition(";")[0] for one in found] == ([told] if told else [])


@pytest.mark.parametrize(
    ("error", "value", "kind", "size"),
    [
        (1e-4 + 3e-9, 3.0, "worse", 3.0),
        (1e-4 - 3e-9, 3.0, "better", 3.0),
        (1e-4, 3.0 + 8e-9, "moved", 4.0),  # over the scale, 2
        (1e-4, 3.0 - 8e-9, "moved", 4.0),
        (1e-4, -3.0, "moved", 3e9),  # as large, but the other way
        (1e-4 + 3e-9, 3.0 + 8e-9, "worse", 4.0),  # the larger of both
        (1e-4, 3.0 + 1.9e-9, None, 0.0),
    ],
)
def test_the_size_of_a_change_is_in_bands(
    error: float, value: float, kind: str | None, size: float
) -> None:
    figures = {"final": value, "mean": 1.0}
    found = compared([requantified(ran(), errors={"max": error}, figures=figures)], accepted(ran()))
    assert [one.kind for one in found] == ([kind] if kind else [])
    assert all(one.size == pytest.approx(size, rel=1e-3) for one in found)


def test_a_value_that_was_not_finite_and_is_or_the_reverse_has_moved_without_end() -> None:
    then = accepted(requantified(ran(), figures={"final": None, "mean": 1.0}))
    (found,) = compared([ran()], then)
    assert (found.kind, found.size) == ("moved", LARGE)
    same = requantified(ran(), figures={"final": None, "mean": 1.0})
    assert compared([same], then) == []


def test_the_scale_is_that_which_was_accepted_and_one_where_there_was_none() -> None:
    moved = {"final": 3.0 + 3e-9, "mean": 1.0}
    wide, none = (
        accepted(requantified(ran(), scale=10.0)),
        accepted(requantified(ran(), scale=None)),
    )
    assert compared([requantified(ran(), figures=moved, scale=1.0)], wide) == []
    (found,) = compared([requantified(ran(), figures=moved, scale=10.0)], none)
    assert found.kind == "moved"
    assert found.size == pytest.approx(3.0, rel=1e-3)


def test_an_error_above_one_may_move_by_the_larger_of_before_and_now() -> None:
    for then, now in ((1000.0, 0.5), (0.5, 1000.0)):
        (found,) = compared([requantified(ran(), errors={"max": now})], accepted(ran(then)))
        assert "it may move by 1e-06:" in found.text
        assert found.size == pytest.approx(999.5 / 1e-6)


@pytest.mark.parametrize("scale", [1.0, None])
@pytest.mark.parametrize(("off", "kinds"), [(2.5e-6, []), (4e-6, ["moved"])])
def test_a_figure_far_above_its_scale_moves_by_its_own_last_bits(
    off: float, kinds: list[str], scale: float | None
) -> None:
    """3000 is kept to twelve digits, 5e-9, and may move by 3e-6; without a scale that is 1."""
    figures = {"final": 3000.0, "mean": 1.0}
    far = requantified(ran(None), figures=figures, scale=scale)
    moved = requantified(far, figures={**figures, "final": 3000.0 + off})
    assert [found.kind for found in compared([moved], accepted(far))] == kinds


def test_the_bands_are_these() -> None:
    assert (IN_HOUSE.width, EXTERNAL.width) == (1e-9, 1e-6)


@pytest.mark.parametrize("status", ["refused", "not-run", "too-long"])
def test_a_result_that_no_longer_comes_is_red(status: str) -> None:
    gone = changed(ran(), status=status, quantities=[])
    (found,) = compared([gone], accepted(ran()))
    assert (found.kind, found.red) == ("gone", True)


@pytest.mark.parametrize("status", ["not-installed", "error", "timeout", "diverged"])
def test_what_another_check_tells_is_not_told_twice(status: str) -> None:
    assert compared([changed(ran(), status=status, quantities=[])], accepted(ran())) == []


@pytest.mark.parametrize(("code", "width"), [("dem", 1e-9), ("yade", 1e-6)])
def test_a_code_of_others_has_the_wider_band(code: str, width: float) -> None:
    for part, moved in ((0.9, False), (1.2, True)):
        now = requantified(ran(code=code), errors={"max": 1e-4 + part * width})
        strict = Strictness(("yade",), True, False)
        found = regression.compare("bounce", [now], accepted(ran(code=code)), strict)
        assert bool(found) is moved


def test_a_result_or_a_case_without_a_baseline_is_red_only_where_one_is_demanded() -> None:
    fresh, refused = ran(variant="T2"), changed(ran(), status="refused", quantities=[])
    for then, kind in ((None, "no baseline"), (accepted(ran()), "new")):
        for demanded in (False, True):
            (found,) = compared([fresh, refused] if then is None else [fresh], then, demanded)
            assert (found.kind, found.red) == (kind, demanded)
    assert compared([refused], None, demanded=True) == []  # nothing ran
    assert compared([changed(ran(variant="T2"), status="refused")], accepted(ran()), True) == []


def test_a_result_at_another_setting_than_those_of_the_baseline_says_so() -> None:
    def said(record: Record) -> str:
        (found,) = compared([record], accepted(ran()), demanded=False)
        return found.text

    assert said(ran(rung={"dt": 3e-3})) == "has no baseline at this setting"
    assert said(ran(rung={"dt": 3e-3}, variant="T2")) == "has no baseline yet"


def test_other_parameters_name_only_those_that_differ() -> None:
    then = accepted(ran(parameters={"m": 1.0, "g": 9.81}), ran(variant="T2"))
    now = [ran(parameters={"m": 2.0, "g": 9.81}), ran(variant="T2")]
    (found,) = compared(now, then)
    assert found.text == "the baseline was taken with m = 1.0, now 2.0"
    assert (found.variant, found.bit) == ("T1", Bit.INCOMPLETE)


@pytest.mark.parametrize(
    ("variants", "labels", "codes", "count"),
    [
        (["T1"], ["dem/default"], ["dem"], 0),
        ([], ["dem/default"], ["dem"], 1),
        (["T1"], [], ["dem"], 1),
        ([], [], ["dem"], 1),
        ([], [], ["yade"], 0),  # not looked at
        ([], ["dem/default"], [], 0),
    ],
)
def test_a_result_whose_variant_or_scheme_is_no_more_is_gone(
    variants: list[str], labels: list[str], codes: list[str], count: int
) -> None:
    then = accepted(ran(), changed(ran(), rung={"dt": 5e-4}))  # told once
    found = regression.removed_results("bounce", then, variants, labels, codes)
    assert [one.kind for one in found] == ["gone"] * count
    assert regression.removed_results("bounce", None, variants, labels, codes) == []
