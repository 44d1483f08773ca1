"""What is compared with answers and results on record, one row a decision, by hand."""

import datetime
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.acceptances import ran
from tests.support.fabricated import changed, entry, record
from vv.gate import answers, recorded
from vv.records.accepted import Place
from vv.records.job_record import Record
from vv.records.recorded import RecordedFile, RecordedQuantity

TODAY = datetime.date(2027, 1, 1)


@pytest.mark.parametrize(
    ("changes", "kind", "red"),
    [
        ({}, "no longer refused", True),
        ({"status": "refused", "reason": "no springs"}, None, False),
        ({"status": "refused", "reason": "too hot"}, "refused otherwise", False),
        ({"status": "error", "reason": "too hot"}, None, False),
        (
            {"variant": "T4", "status": "refused", "reason": "dt = 2.5e-4 s is too long"},
            None,
            False,
        ),
        (
            {"variant": "T4", "status": "refused", "reason": "dt = 1e-3 s is too short"},
            "refused otherwise",
            False,
        ),
        ({"case": "fall"}, None, False),
        ({"modified": True}, None, False),
        ({"variant": "T2"}, None, False),  # on record with its unknowns
        ({"variant": "T3"}, None, False),  # not on record
        ({"scheme": "other"}, None, False),
    ],
)
def test_an_answer_is_compared_with_that_on_record(
    changes: dict[str, Any], kind: str | None, red: bool
) -> None:
    known: answers.Answers = {
        "dem/default": {"T1": "no springs", "T2": 7, "T4": "dt = 0.001 s is too long"}
    }
    found = list(answers.compare("bounce", [ran(**changes)], known, True))
    assert [(one.kind, one.red) for one in found] == ([(kind, red)] if kind else [])


def recorded_file() -> RecordedFile:
    utc = "2026-12-22T10:00:00+00:00"
    return RecordedFile("yade", "", "2.0", utc, "c", False, Place("P", "S"))


def series(_: str) -> dict[str, np.ndarray]:
    t = np.linspace(0.0, 1.0, 101)
    return {"t": t, "y.value": t * t}


def theirs(dt: float, **changes: Any) -> Record:
    quantity = entry("pass", {"max": 1e-4}, figures={"final": 1.0 / 3.0})
    made = record("yade/default", "T1", dt, quantities=[quantity])
    return changed(made, **changes)


def test_recorded_are_runs_at_the_case_s_own_parameters_and_the_finest_with_its_series(
    tmp_path: Path,
) -> None:
    runs = [theirs(2e-3), theirs(1e-3), theirs(5e-4, modified=True), theirs(4e-3, status="error")]
    (path,) = recorded.write_recorded(tmp_path, runs, series, {"yade": recorded_file()})
    assert path == tmp_path / "yade" / "bounce.json"
    results = json.loads(path.read_text())["results"]
    assert sorted(results) == ["T1 yade/default dt=0.001", "T1 yade/default dt=0.002"]
    fine, coarse = (results[name]["y"] for name in sorted(results))
    assert fine["final"] == coarse["final"] == 0.333333
    assert "t" not in coarse
    assert (len(fine["t"]), fine["t"][0], fine["t"][-1], fine["y"][-1]) == (41, 0.0, 1.0, 1.0)


@pytest.mark.parametrize(
    ("changes", "count"),
    [
        ({}, 1),
        ({"status": "ran"}, 0),
        ({"status": "refused"}, 0),
        ({"parameters": {"m": 2.0}}, 0),
        ({"case": "other"}, 0),
        ({"variant": "T9"}, 0),
    ],
)
def test_recorded_results_stand_where_the_code_is_absent(
    tmp_path: Path, changes: dict[str, Any], count: int
) -> None:
    recorded.write_recorded(tmp_path, [theirs(1e-3)], series, {"yade": recorded_file()})
    asked = theirs(1e-3, **{"status": "not-installed", **changes})
    found = recorded.shown(tmp_path, [asked], TODAY)
    assert [one.days for one in found] == [10] * count


def test_seconds_on_record_are_by_case_variant_scheme_and_rung(tmp_path: Path) -> None:
    unset = record("yade/default", "T2", None, quantities=[])
    runs = [theirs(1e-3), unset, theirs(2e-3)]
    runs[2] = changed(runs[2], cost=changed(runs[2].cost, solve_cpu=0.0))
    recorded.write_recorded(tmp_path, runs, series, {"yade": recorded_file()})
    assert recorded.seconds_recorded(tmp_path, "yade", "bounce") == {
        ("bounce", "T1", "yade/default", "dt=0.001"): 1e-4,
        ("bounce", "T2", "yade/default", ""): 1e-4,
    }
    assert recorded.seconds_recorded(tmp_path, "yade", "fall") == {}


def test_a_recorded_result_has_the_numbers_on_record_and_none_of_the_one_that_is_asked(
    tmp_path: Path,
) -> None:
    """The finest step stands first, and no two numbers are alike."""

    def made(dt: float, cpu: float, final: float, **changes: Any) -> Record:
        errors = {"max": 7 * dt, "l2": 5 * dt}
        quantity = entry("pass", errors, figures={"final": final})
        own = record("yade/default", "T1", dt, quantities=[quantity], code_version="9.9")
        return changed(own, cost=changed(own.cost, solve_cpu=cpu, solve_wall=9 * cpu), **changes)

    def line(_: str) -> dict[str, np.ndarray]:
        t = np.linspace(0.0, 1.0, 5)
        return {"t": t, "y.value": 3.0 + t, "y.reference": 8.0 + t}

    runs = [made(1e-3, 0.25, 4.0), made(2e-3, 0.125, 5.0)]
    recorded.write_recorded(tmp_path, runs, line, {"yade": recorded_file()})
    asked = [made(dt, 99.0, 98.0, status="not-installed") for dt in (2e-3, 1e-3)]
    coarse, fine = recorded.shown(tmp_path, asked, TODAY)
    assert [(one.knobs, one.rung.dt, one.cpu, one.version, one.utc) for one in (coarse, fine)] == [
        ("dt=0.002", 2e-3, 0.125, "2.0", recorded_file().utc),
        ("dt=0.001", 1e-3, 0.25, "2.0", recorded_file().utc),
    ]
    assert coarse.quantities == {
        "y": RecordedQuantity({"final": 5.0, "max error": 0.014, "l2 error": 0.01})
    }
    assert fine.quantities == {
        "y": RecordedQuantity(
            {"final": 4.0, "max error": 0.007, "l2 error": 0.005},
            (0.0, 0.25, 0.5, 0.75, 1.0),
            (3.0, 3.25, 3.5, 3.75, 4.0),
        )
    }
