"""Every status and verdict, seen through the command line on a tiny project."""

import dataclasses
import json
from typing import Any

import numpy as np
import pytest

from tests.conftest import Tiny
from vv.ask import Knobs, Ledger, Method, Run, Status
from vv.case import Exact, Scalar, Tolerance
from vv.records.finding import Bit
from vv.records.record import measured


def records(tiny: Tiny, *words: str) -> tuple[int, list[dict[str, Any]]]:
    """The exit status of a gate run and its records."""
    done = tiny.vv("gate", *words, "--json", "out.json")
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, json.loads((tiny.root / "out.json").read_text())["records"]


def test_a_right_answer_passes(tiny: Tiny) -> None:
    code, found = records(tiny, "fall:up", "--codes", "fake/good", "--level", "default")
    assert code == 0
    assert [r["status"] for r in found] == ["ran"] * 3
    verdicts = [{q["name"]: q["verdict"] for q in r["quantities"]} for r in found]
    assert verdicts == [{"y": "pass", "y_end": "no-reference", "turns": "pass"}] * 3


OUTCOMES = {
    "coarse": ("ran", Bit.ACCURACY, ""),
    "zeros": ("ran", Bit.ACCURACY, ""),
    "raises": ("error", Bit.CRASH | Bit.INCOMPLETE, "RuntimeError: a bug in the code"),
    "dies": ("error", Bit.CRASH | Bit.INCOMPLETE, "exit code 3"),
    "killed": ("error", Bit.CRASH | Bit.INCOMPLETE, "SIGKILL"),
    "diverges": ("diverged", Bit.CRASH | Bit.INCOMPLETE, "blew up"),
    "nan": ("diverged", Bit.CRASH | Bit.INCOMPLETE, "not finite from t = 0.6 s"),
    "silent": ("error", Bit.CRASH | Bit.INCOMPLETE, "and not reported"),
    "truncated": ("error", Bit.CRASH | Bit.INCOMPLETE, "reported 9 of 11 output times"),
    "ignores": ("error", Bit.CRASH | Bit.INCOMPLETE, "does not say that it modelled: gravity"),
    "refuses": ("refused", Bit.INCOMPLETE, "does not feel like it"),
    "weightless": ("refused", Bit.INCOMPLETE, "does not support: gravity"),
}


@pytest.mark.parametrize("scheme", OUTCOMES)
def test_each_misbehaviour_has_its_status_and_exit_bit(tiny: Tiny, scheme: str) -> None:
    status, bits, reason = OUTCOMES[scheme]
    code, (record,) = records(tiny, "fall:up", "--codes", f"fake/{scheme}", "--level", "quick")
    assert (record["status"], code) == (status, int(bits))
    assert reason in record["reason"]


def test_a_run_of_which_nothing_can_be_measured_has_failed(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", "run.values[BALL][-1, 1]", "run.values[BALL][-1, 7]")
    code, (record,) = records(tiny, "fall:up", "--codes", "fake/good", "--level", "quick")
    assert (record["status"], code) == ("error", int(Bit.CRASH | Bit.INCOMPLETE))
    assert "out of bounds" in record["reason"]
    assert record["quantities"] == []


def test_zeros_are_called_unmoving(tiny: Tiny) -> None:
    _, (record,) = records(tiny, "fall:up", "--codes", "fake/zeros", "--level", "quick")
    assert record["quantities"][0]["note"] == "nothing moves, though the reference does"


def test_a_hanging_code_times_out(tiny: Tiny) -> None:
    done = tiny.vv(
        "gate", "fall:up", "--codes", "fake/hangs", "--level", "quick", "--timeout", "0.1"
    )
    assert done.returncode == int(Bit.TIMEOUT | Bit.INCOMPLETE)
    assert "no answer in time" in done.stderr


def test_steps_too_many_for_the_time_are_not_begun(tiny: Tiny) -> None:
    words = ("fall:up", "--codes", "fake/hangs", "--rung", "dt=1e-14", "--timeout", "3")
    done = tiny.vv("run", *words)
    assert done.returncode == int(Bit.TIMEOUT | Bit.INCOMPLETE)
    assert "for 1e+14 steps of 1e-14 s; not begun" in done.stdout


def test_an_absent_code_is_an_error_only_if_required(tiny: Tiny) -> None:
    words = ("fall:up", "--codes", "fake/good,missing")
    assert records(tiny, *words)[0] == 0
    assert records(tiny, *words, "--require", "missing")[0] == Bit.INCOMPLETE


def test_a_required_code_that_never_ran_is_an_error(tiny: Tiny) -> None:
    words = ("fall:up", "--codes", "fake/good", "--require", "fake/refuses")
    assert records(tiny, *words)[0] == Bit.INCOMPLETE


def test_the_rest_of_a_batch_stands_when_one_ask_kills_its_process(tiny: Tiny) -> None:
    code, found = records(tiny, "fall:up", "--codes", "fake/stumbles", "--level", "default")
    assert [r["status"] for r in found] == ["ran", "error", "ran"]
    assert code == Bit.CRASH


def test_the_scratch_folder_of_a_failure_is_kept_and_named(tiny: Tiny) -> None:
    _, (record,) = records(tiny, "fall:up", "--codes", "fake/dies", "--level", "quick")
    assert str(tiny.root / ".vv" / "scratch") in record["reason"]
    kept = list((tiny.root / ".vv" / "scratch").iterdir())
    assert len(kept) == 1
    records(tiny, "fall:up", "--codes", "fake/good", "--level", "quick")
    assert list((tiny.root / ".vv" / "scratch").iterdir()) == kept


DISAGREEMENT = """
[[disagreement]]
code = "fake"
schemes = "first-order"
versions = "1.*"
case = "fall"
variants = ["up"]
quantity = "y"
dt = 0.1
error = [{low}, {high}]
order = [{slowest}, {fastest}]
reason = "it was made so"
expires = {expires}
"""


def known(tiny: Tiny, **changes: Any) -> tuple[int, set[str]]:
    """Exit status and verdicts of the first-order scheme under a ledger entry."""
    entry = {"low": 5e-3, "high": 2e-2, "slowest": 0.9, "fastest": 1.1, "expires": "2999-01-01"}
    text = DISAGREEMENT.format(**{**entry, **changes})
    (tiny.root / "cases" / "disagreements.toml").write_text(text)
    words = ("fall:up", "--codes", "fake/first-order", "--level", "default")
    code, found = records(tiny, *words)
    return code, {r["quantities"][0]["verdict"] for r in found}


def test_a_known_disagreement_inside_its_bands_is_no_failure(tiny: Tiny) -> None:
    assert known(tiny) == (0, {"xfail"})


@pytest.mark.parametrize(
    "change",
    [
        {"low": 1.5e-2},  # the code became better than known
        {"high": 8e-3},  # or worse
        {"slowest": 1.05},  # or of another order
        {"expires": "2000-01-01"},
    ],
)
def test_a_known_disagreement_outside_its_bands_is_red(tiny: Tiny, change: dict[str, Any]) -> None:
    assert known(tiny, **change) == (Bit.ACCURACY, {"fail"})


def test_an_unexpected_pass_is_red(tiny: Tiny) -> None:
    tiny.edit("adapters/fake.py", "(1 + 0.1 * ask.knobs.dt)", "(1 + 1e-4 * ask.knobs.dt)")
    assert known(tiny) == (Bit.ACCURACY, {"xpass"})


def test_two_variants_of_one_scene_are_judged_each_by_its_own_reference(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", "variants=(", 'variants=(Variant("wrong", "it falls up", "y"),')
    tiny.edit(
        "cases/fall.py", "fall.height(t,", "(2 if variant == 'wrong' else 1) * fall.height(t,"
    )
    words = ("--codes", "fake/good", "--level", "quick")
    assert records(tiny, "fall:up", *words)[0] == 0
    assert records(tiny, "fall:wrong", *words)[0] == Bit.ACCURACY
    assert records(tiny, "fall:up", *words)[0] == 0


def test_a_reference_of_zeros_fails_unless_the_case_states_a_scale(tiny: Tiny) -> None:
    words = ("fall:up", "--codes", "fake/good", "--level", "quick")
    tiny.edit("cases/fall.py", "fall.height(t, p", "0 * fall.height(t, p")
    code, (record,) = records(tiny, *words)
    assert (code, record["quantities"][0]["verdict"]) == (Bit.ACCURACY, "fail")
    assert "states no scale" in record["quantities"][0]["note"]
    tiny.edit("cases/fall.py", "judge=Exact({method: TOL", "scale=1e4, judge=Exact({method: TOL")
    assert records(tiny, *words)[0] == 0


def test_a_step_longer_than_the_run_is_refused_for_every_code(tiny: Tiny) -> None:
    done = tiny.vv("run", "fall:up", "--codes", "fake/good", "--rung", "dt=2")
    assert done.returncode == Bit.INCOMPLETE
    assert "dt = 2 s is longer than the 1 s to be run" in done.stderr


def test_what_a_code_does_not_tell_is_not_judged_in_it_and_in_others_is() -> None:
    def left_over(run: Run) -> float:
        assert run.ledger
        return run.ledger.unaccounted

    bound = Exact({Method.SECOND_ORDER: Tolerance(1e-9, "rounding")})
    kept = Scalar("balance", "E", "J", "left over", left_over, 0.0, 1.0, bound,
                  is_reported=lambda run: run.ledger is not None)  # fmt: skip
    silent = Run(Status.RAN, times=np.array([0.0, 1.0]))
    booked = dataclasses.replace(silent, ledger=Ledger({}, 1.0, 1.0, 0.0))
    for run, verdict in ((silent, "shown only"), (booked, "fail")):
        entry, _ = measured(run, kept, Method.SECOND_ORDER, Knobs(1e-3))
        assert entry.verdict.value == verdict
