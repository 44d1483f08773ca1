"""Claims about `vv explain`: which results it shows, and which of them agree."""

from __future__ import annotations

from tests.insight.test_agreement import AGREEING, records_of, written_down
from tests.support.fabricated import NOWHERE, changed
from vv.output import explain
from vv.records.manifest import Manifest


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


def test_results_of_modified_parameters_are_not_shown_beside_tolerances_of_others() -> None:
    own = records_of({"a/x": (1.03, 1.01)})
    changed_ones = [changed(one, modified=True) for one in records_of({"a/x": (5.0, 5.0)})]
    manifests = [
        Manifest(NOWHERE, {}, {}, (), tuple(records), (), {}, ()) for records in (changed_ones, own)
    ]
    before = explain._last_results(manifests[1:])
    assert explain._last_results(manifests) == before
    assert before
