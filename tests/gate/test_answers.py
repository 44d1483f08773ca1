"""Claims about what schemes answer to a case: it is accepted with the results, and guarded."""

import json
from pathlib import Path

import pytest

from tests.conftest import Tiny
from vv.records.finding import Bit

CODES = ("--codes", "fake/good,fake/refuses,fake/weightless,missing")
UNWILLING = 'return "it does not feel like it" if scheme == "refuses" else None'


@pytest.fixture
def accepted(tiny: Tiny) -> Tiny:
    """The tiny project without the schemes that misbehave, and what it answers on record."""
    names = (tiny.root / "adapters/fake.py").read_text().partition("NAMES = (")[2].partition(")")
    tiny.edit("adapters/fake.py", names[0], '"good", "refuses"')
    done = tiny.vv("accept", "fall", "--reason", "it is right")
    assert done.returncode == 0, done.stderr
    return tiny


def on_record(project: Tiny) -> Path:
    return project.root / "cases" / "answers" / "fall.json"


def test_accepting_puts_on_record_the_unknowns_of_what_runs_and_why_others_refuse(
    accepted: Tiny,
) -> None:
    """A code that is not here has no answer yet."""
    weightless = "fake/weightless does not support: gravity, spheres"
    assert json.loads(on_record(accepted).read_text()) == {
        "fake/good": {"up": 1, "slow": 1},
        "fake/refuses": dict.fromkeys(("up", "slow"), "it does not feel like it"),
        "fake/weightless": dict.fromkeys(("up", "slow"), weightless),
    }
    assert accepted.vv("gate", "fall", *CODES).returncode == 0


def test_what_was_refused_and_runs_is_red_until_it_is_accepted(accepted: Tiny) -> None:
    accepted.edit("adapters/fake.py", UNWILLING, "return None")
    done = accepted.vv("gate", "fall", *CODES)
    assert done.returncode == 1
    assert "was refused: it does not feel like it; to accept that it runs" in done.stdout
    accepted.vv("accept", "fall", "--reason", "it changed its mind")
    assert accepted.vv("gate", "fall", *CODES).returncode == 0


def test_what_ran_and_is_refused_is_red(accepted: Tiny) -> None:
    accepted.edit("adapters/fake.py", 'if scheme == "refuses"', "if scheme")
    done = accepted.vv("gate", "fall", *CODES)
    assert done.returncode & Bit.ACCURACY
    assert "has a baseline, but now: refused" in done.stdout


def test_another_reason_to_refuse_is_noted(accepted: Tiny) -> None:
    accepted.edit("adapters/fake.py", "it does not feel like it", "it is tired")
    done = accepted.vv("gate", "fall", *CODES)
    assert done.returncode == 0
    assert "was refused: it does not feel like it; now: it is tired" in done.stdout


def test_a_scheme_that_is_not_on_record_is_not_compared(accepted: Tiny) -> None:
    table = json.loads(on_record(accepted).read_text())
    del table["fake/refuses"]
    on_record(accepted).write_text(json.dumps(table))
    accepted.edit("adapters/fake.py", UNWILLING, "return None")
    assert accepted.vv("gate", "fall", *CODES).returncode == 0


def test_answers_of_a_code_that_is_not_here_stay(accepted: Tiny) -> None:
    table = {**json.loads(on_record(accepted).read_text()), "missing/default": {"up": 7}}
    on_record(accepted).write_text(json.dumps(table))
    accepted.vv("accept", "fall", "--reason", "again")
    assert json.loads(on_record(accepted).read_text()) == table


def test_a_broken_file_is_a_usage_error_that_names_it(accepted: Tiny) -> None:
    on_record(accepted).write_text("{")
    done = accepted.vv("gate", "fall", *CODES)
    assert done.returncode == 64
    assert "answers/fall.json" in done.stderr
