"""All of result.json, by hand: no two numbers are alike, so that none can stand for another."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.codes.program.test_series import ASK, GOOD, NAMES
from vv.ask import Ledger, Model, Status
from vv.codes.program import answer
from vv.codes.program.bad_answer import BadAnswerError
from vv.codes.program.result import Result, read_result
from vv.scene import Term


def read(folder: Path, **entries: object) -> Result:
    file = folder / "result.json"
    file.write_text(json.dumps(entries))
    return read_result(file)


def test_each_entry_of_a_result_stands_for_itself(tmp_path: Path) -> None:
    energies = {"forms": {"kinetic": 1.0, "drag": 2.0, "numerical": 3.0, "heat of mine": 4.0},
                "unaccounted": 5.0, "peak": 6.0, "bound": 7.0}  # fmt: skip
    found = read(
        tmp_path, status="diverged", reason="it grew", solve_cpu=8.5, steps=9, unknowns=10,
        terms=["gravity", "drag"], note="explicit", energies=energies,
    )  # fmt: skip
    forms = {"kinetic": 1.0, "drag dissipation": 2.0, "numerical dissipation": 3.0,
             "heat of mine": 4.0}  # fmt: skip
    assert found == Result(
        status=Status.DIVERGED,
        reason="it grew",
        solve_cpu=8.5,
        steps=9,
        unknowns=10,
        terms=frozenset({Term.GRAVITY, Term.DRAG}),
        note="explicit",
        energies=Ledger(forms, unaccounted=5.0, peak=6.0, bound=7.0),
    )


def test_what_a_result_leaves_out_is_unknown_and_it_ran(tmp_path: Path) -> None:
    assert read(tmp_path) == read_result(tmp_path / "none") == Result(Status.RAN)
    unbound = read(tmp_path, energies={"forms": {}, "unaccounted": 5.0, "peak": 6.0})
    assert unbound.energies == Ledger({}, unaccounted=5.0, peak=6.0, bound=None)


HUGE = 10**400  # a number in JSON that no float holds
WHOLE = {"forms": {}, "unaccounted": 0.0, "peak": 1.0}


@pytest.mark.parametrize(
    ("entry", "value", "rule"),
    [
        ("solve_cpu", True, "finite number, zero or more"),
        ("solve_cpu", float("inf"), "finite number, zero or more"),
        ("solve_cpu", HUGE, "finite number, zero or more"),
        ("solve_cpu", -1e-9, "finite number, zero or more"),
        ("steps", 1.0, "whole number, zero or more"),
        ("steps", True, "whole number, zero or more"),
        ("unknowns", -1, "whole number, zero or more"),
        ("status", "not installed", "it must be one of ran, refused, diverged, error"),
        ("status", ["ran"], "it must be one of ran, refused, diverged, error"),
        ("reason", 1, "it must be a text"),
        ("terms", "drag", "it must be a list of texts"),
        ("energies", {"forms": {}, "peak": 1.0}, "only bound may be left out"),
        ("energies", {**WHOLE, "more": 1.0}, "only bound may be left out"),
        ("energies", {**WHOLE, "peak": -1.0}, "finite number, zero or more"),
        ("energies", {**WHOLE, "forms": {"kinetic": float("nan")}}, "it must be a finite number"),
    ],
)
def test_a_value_of_another_kind_is_refused_with_its_rule(
    tmp_path: Path, entry: str, value: object, rule: str
) -> None:
    with pytest.raises(BadAnswerError, match=rule):
        read(tmp_path, **{entry: value})


MODEL = Model(3, frozenset({Term.GRAVITY}), "as declared")


@pytest.mark.parametrize(
    ("entries", "steps", "model"),
    [
        ({}, 4, MODEL),
        ({"steps": 0, "unknowns": 0, "terms": []}, 0, Model(0, frozenset(), "as declared")),
        (
            {"terms": ["drag"], "note": "with care"},
            4,
            Model(3, frozenset({Term.DRAG}), "as declared; with care"),
        ),
    ],
)
def test_what_a_result_says_replaces_what_was_declared_and_a_note_is_added(
    tmp_path: Path, entries: dict[str, Any], steps: int, model: Model
) -> None:
    (tmp_path / "series.csv").write_text("\n".join([",".join(NAMES), *GOOD]))
    read(tmp_path, **entries)
    run, cost = answer.read(tmp_path, ASK, MODEL)
    assert (run.status, run.steps, run.model, cost) == (Status.RAN, steps, model, None)


def test_a_program_that_gives_up_without_a_reason_is_told_so(tmp_path: Path) -> None:
    read(tmp_path, status="refused")
    run, _ = answer.read(tmp_path, ASK, MODEL)
    assert (run.status, run.reason) == (Status.REFUSED, "result.json gives no reason")
