"""Claims about statements of papers beside results: at which setting, and those that agree."""

from collections.abc import Mapping

from vv.ask import Knobs
from vv.case.published import Assessment, Computed, Figure, Paper, Statement
from vv.insight.papers import Answer, Row, counted, rows
from vv.records.accepted import AcceptedQuantity, AcceptedResult


def result(value: float, error: float | None = None) -> AcceptedResult:
    return AcceptedResult("1", None, {"x": AcceptedQuantity(error, 1.0, {"value": value})})


RESULTS = {
    "one a/default dt=0.001,kn=100000000": result(1.0, 0.5),
    "one a/default dt=0.0001,kn=1000000000": result(2.0, 0.25),
    "one b/other dt=0.0001": result(2.0000001, 1e-15),
    "one c/default": result(3.0),
    "two a/default dt=0.001": result(9.0),
}


def row(computed: Computed, printed: str = "2.0") -> Row:
    one = Statement(
        "Eq. 1", "what", printed, Assessment.REPRODUCED, "", "m", lambda: 2.0, (computed,)
    )
    return rows(Paper("A", "B", "", (one,)), lambda case: RESULTS if case == "case" else {})[0]


def test_codes_that_give_the_same_stand_together_each_at_its_finest() -> None:
    assert row(Computed("case", "one", "x")).answers == (
        Answer("case:one", "2", ("a/default", "b/other")),
        Answer("case:one", "3", ("c/default",)),
    )


def test_a_setting_that_is_asked_for_is_the_one_shown_where_a_code_has_its_knobs() -> None:
    found = row(Computed("case", "one", "x", rung=Knobs(1e-3, 1e8)))
    assert [(a.text, a.codes) for a in found.answers] == [
        ("1", ("a/default",)),
        ("3", ("c/default",)),
    ]


def test_errors_are_shown_in_per_cent_and_rounding_as_none() -> None:
    found = row(Computed("case", "one", "x", Figure.ERROR, 100.0))
    assert [a.text for a in found.answers] == ["25", "0"]


def test_what_no_record_has_is_left_out() -> None:
    assert row(Computed("case", "one", "y")).answers == ()
    assert row(Computed("other", "one", "x")).answers == ()


def test_standings_are_counted_in_their_order() -> None:
    assert counted([row(Computed("case", "one", "x"))]) == {Assessment.REPRODUCED: 1}


def test_numbers_have_the_power_of_ten_that_the_paper_prints_or_one_that_people_write() -> None:
    masses = {"one a/default": result(2.165064e7)}

    def shown(printed: str) -> str:
        computed = (Computed("case", "one", "x"),)
        one = Statement(
            "Eq. 1", "mass", printed, Assessment.REPRODUCED, "", "kg", lambda: 1.0, computed
        )
        return rows(Paper("A", "B", "", (one,)), lambda _: masses)[0].answers[0].text

    assert [shown(printed) for printed in ("21.651e6", "2.1651e7", "")] == [
        "21.651e6",
        "2.1651e7",
        "2.1651e7",
    ]
    assert shown("1e-13") == "2.1651e7"


def test_the_finest_setting_has_the_stiffest_springs_and_at_these_the_shortest_step() -> None:
    found = {
        "one a/x dt=0.00001,kn=100000000": result(4.0),
        "one a/x dt=0.01,kn=1000000000": result(5.0),
        "one a/x dt=0.001,kn=1000000000": result(6.0),
        "one a/x dt=0.002,kn=1000000000": result(7.0),
        "other a/x dt=0.0001,kn=10000000000": result(8.0),
    }
    assert answered(found, Computed("case", "one", "x")) == [("6", ("a/x",))]
    assert answered(found, Computed("case", "one", "x", rung=Knobs(1e-5))) == [("4", ("a/x",))]
    assert answered(found, Computed("case", "one", "x", times=1e3)) == [("6000", ("a/x",))]


def answered(found: Mapping[str, AcceptedResult], seen: Computed) -> list[tuple[str, object]]:
    one = Statement("Eq. 1", "what", "2", Assessment.REPRODUCED, "", "m", lambda: 2.0, (seen,))
    (row,) = rows(Paper("A", "B", "", (one,)), lambda _: found)
    return [(answer.text, answer.codes) for answer in row.answers]
