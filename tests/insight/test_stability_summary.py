"""Claims about what an invocation says of stability: each kind in a sentence, and in the report."""

from __future__ import annotations

from tests.support import fabricated
from tests.support.fabricated import case, changed, entry, record
from vv.insight.stability_summary import StabilityStatement, stability
from vv.records import codec
from vv.records.job_record import Record
from vv.records.manifest import Manifest


def manifest(*records: Record, critical: dict[float, float] | None = None) -> Manifest:
    """Records of the fabricated case, whose steps are multiples of these."""
    steps = tuple((critical or {}).items())
    variants = {
        name: changed(
            facts,
            critical=steps,
            quantities=[changed(one, meaning="what is seen") for one in facts.quantities],
        )
        for name, facts in case().variants.items()
    }
    return fabricated.manifest(*records, cases={"bounce": changed(case(), variants=variants)})


def only(*records: Record, critical: dict[float, float] | None = None) -> StabilityStatement:
    (told,) = stability(manifest(*records, critical=critical))
    return told


def sought(verdict: str, value: float | None, note: str = "") -> Record:
    number = {"kind": "scalar", "value": value, "reference": 1.0, "note": note}
    return record(
        "dem/default", "T1", 1e-3, study="search", reason="at dt = 0.2 s: it blew up",
        quantities=[entry(verdict, {}, **number)],
    )  # fmt: skip


def test_a_search_says_its_limit_and_what_comes_beyond() -> None:
    told = only(sought("pass", 0.9996))
    assert (told.kind, told.value, told.due) == ("step", 0.9996, 1.0)
    assert told.text == "what is seen: 0.9996, as due; at dt = 0.2 s: it blew up"


def test_a_limit_that_is_not_due_is_said_to_be_so_or_known() -> None:
    assert "0.5, not as due;" in only(sought("fail", 0.5)).text
    assert "0.5, known; drag is late;" in only(sought("xfail", 0.5, "drag is late")).text
    assert only(sought("fail", None)).text == "no step was stable"


def test_a_limit_that_is_only_shown_is_told_by_the_quantity_that_is_judged() -> None:
    assert stability(manifest(sought("no-reference", 0.5))) == []


def point(dt: float, kn: float, error: float | None, status: str = "ran") -> Record:
    entries = [entry("no-reference", {"max": error}, judge="shown")] if error is not None else []
    rung = {"dt": dt, "kn": kn}
    return record("dem/default", "T1", dt, study="grid", status=status, rung=rung,
                  quantities=entries)  # fmt: skip


def test_a_map_says_how_much_is_lost_from_which_step_on_and_how_good_it_gets() -> None:
    told = only(
        point(2.0, 1e4, None, "diverged"),
        point(0.3, 1e6, 30.0),
        point(0.1, 1e4, 0.2),
        point(0.01, 1e6, 0.003),
        point(5.0, 1e4, None, "refused"),
        critical={1e4: 1.0, 1e6: 0.1},
    )
    assert told.kind == "map"
    assert told.value == 0.5
    assert told.text == (
        "of 5 points 1 refused, 2 lost, 1 of them diverged, from 2 critical steps on, "
        "least error 0.003 at kn 1e+06 N/m, dt 0.01 s"
    )


def test_points_left_out_for_their_steps_are_told_from_those_refused() -> None:
    told = only(point(0.1, 1e4, 0.2), point(1.0, 1e4, None, "too-long"))
    assert told.text.startswith("of 2 points 1 too long to run, none lost, least error 0.2 at")
    more = only(
        point(0.1, 1e4, 0.2), point(1.0, 1e4, None, "too-long"), point(2.0, 1e4, None, "refused")
    )
    assert more.text.startswith("of 3 points 1 refused and 1 too long to run, none lost")


def test_a_code_that_refuses_a_whole_map_says_nothing_of_it() -> None:
    assert stability(manifest(point(0.1, 1e4, None, "refused"))) == []


def test_drift_is_the_largest_breach_at_any_rung() -> None:
    def kept(dt: float, error: float) -> Record:
        conserved = {"kind": "scalar", "judge": "invariant", "tolerance": 1e-11, "value": 0.0}
        made = entry("pass", {"max": error}, **conserved)
        return record("dem/default", "T1", dt, quantities=[made])

    told = only(kept(1e-3, 1e-13), kept(1e-4, 4e-12))
    assert (told.kind, told.value, told.due) == ("drift", 4e-12, 1e-11)
    assert "kept to 4e-12" in told.text
    assert "drifts by 2e-06" in only(kept(1e-3, 2e-6)).text


def counted(dt: float | None, value: int) -> Record:
    whole = {"kind": "count", "value": float(value), "reference": 1}
    return record("dem/default", "T1", dt, quantities=[entry("pass", {}, **whole)])


def test_counts_are_told_from_the_longest_step_to_the_shortest() -> None:
    told = only(counted(1e-4, 3), counted(1e-3, 6))
    assert (told.kind, told.value, told.due) == ("count", 3, 1)
    assert "6, 3 from the longest step to the shortest; 1 in the exact motion" in told.text
    assert "1 at every step" in only(counted(1e-4, 1), counted(1e-3, 1)).text
    assert "what is seen: 1; 1 in" in only(counted(None, 1)).text


def test_kinds_come_in_one_order_and_as_plain_data() -> None:
    found = stability(manifest(counted(1e-4, 1), point(0.1, 1e4, 0.1), sought("pass", 1.0)))
    told = codec.to_data(found)
    assert [one["kind"] for one in told] == ["step", "map", "count"]
    assert told[0]["label"] == "dem/default"


def kept(value: float | None, **more: object) -> Record:
    bound = {"judge": "invariant", "kind": "scalar", "tolerance": 1e-6, "value": value, **more}
    return record("dem/default", "T1", 1e-3, quantities=[entry("pass", {"max": 1e-9}, **bound)])


def test_what_is_to_be_conserved_and_has_no_value_is_not_finite() -> None:
    assert only(kept(None)).text == "what is seen: not finite"
    assert "kept to 1e-09 of its scale" in only(kept(None, figures={"end": 1.0})).text
    assert "kept to 1e-09 of its scale" in only(kept(1.0)).text


def test_one_value_that_is_not_finite_among_several_is_told() -> None:
    good, bad = kept(1.0), kept(None)
    assert "not finite" in only(changed(good, rung={"dt": 2e-3, "kn": None}), bad).text


def test_counts_at_every_step_are_of_several_with_a_step() -> None:
    assert "1 at every step" in only(counted(1e-4, 1), counted(None, 1)).text
    assert "at every step" not in only(counted(1e-4, 1)).text
    assert "at every step" not in only(counted(None, 1), counted(None, 1)).text


def test_a_point_of_a_map_is_as_bad_as_its_worst_quantity() -> None:
    two = [entry("no-reference", {"max": error}, name=name, judge="shown")
           for name, error in (("a", 0.1), ("b", 30.0))]  # fmt: skip
    told = only(changed(point(0.1, 1e4, 0.1), quantities=two), point(0.01, 1e4, 0.1))
    assert told.value == 0.5


def test_limits_bounds_and_what_is_due_are_those_of_the_finest_setting() -> None:
    def at(kn: float, one: Record, **parts: object) -> Record:
        quantities = [changed(quantity, **parts) for quantity in one.quantities]
        return changed(one, rung={"dt": 1e-3, "kn": kn}, quantities=quantities)

    limits = [at(kn, sought("pass", value), reference=due)
              for kn, value, due in ((1e8, 0.75, 1.5), (1e7, 0.5, 1.25))]  # fmt: skip
    told = only(*limits)
    assert (told.value, told.due) == (0.75, 1.5)
    assert told.text.startswith("what is seen: 0.75, as due")
    drifts = [at(kn, kept(1.0), errors={"max": error}, tolerance=bound)
              for kn, error, bound in ((1e8, 2e-9, 5e-8), (1e7, 3e-9, 4e-6))]  # fmt: skip
    told = only(*drifts)
    assert (told.value, told.due) == (3e-9, 5e-8)
    assert told.text == "what is seen: kept to 3e-09 of its scale, 5e-08 allowed"
