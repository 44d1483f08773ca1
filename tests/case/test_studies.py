"""Claims about studies through the command line: what diverges in a map, what a search runs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import Tiny
from vv.base import closure
from vv.plan import keys
from vv.plan.plan import Options
from vv.plan.planning import make_plan
from vv.plan.project import find

LADDER = "Ladder(scene, History(1.0, 0.1), (BALL,), levels, timed=RUNGS[:2])"
GRID = "Grid(scene, History(1.0, 0.1), (BALL,), dict.fromkeys(Level, (1.0, 0.5)), lambda kn: 0.1)"
SEARCH = "Search(scene, (BALL,), 0.02, 40, Bracket(8.0, 1.3, 4, 2))"
IMPORTS = "from vv.case import Ladder, Level"


def posed(tiny: Tiny, study: str) -> None:
    """The tiny project's case with another study."""
    tiny.edit("cases/fall.py", LADDER, study)
    tiny.edit("cases/fall.py", IMPORTS, f"{IMPORTS}, Grid, Search\nfrom vv.ask import Bracket")


def ran(tiny: Tiny, codes: str, *words: str) -> tuple[int, dict[str, Any], int]:
    """Exit status of a gate, what it wrote, and how many asks the code has seen so far."""
    log = tiny.root / "log"
    done = tiny.vv(
        "gate", "fall:up", "--codes", codes, "--json", "out.json", *words, FAKE_LOG=str(log)
    )
    assert "Traceback" not in done.stderr, done.stderr
    asked = len(log.read_text().splitlines()) if log.exists() else 0
    return done.returncode, json.loads((tiny.root / "out.json").read_text()), asked


def test_what_diverges_in_a_map_is_no_fault_and_is_kept(tiny: Tiny) -> None:
    posed(tiny, GRID)
    code, told, asked = ran(tiny, "fake/good,fake/diverges")
    assert code == 0
    assert {(r["study"], r["scheme"], r["status"]) for r in told["records"]} == {
        ("grid", "good", "ran"),
        ("grid", "diverges", "diverged"),
    }
    assert {(t["kind"], t["label"], t["value"]) for t in told["stability"]} >= {
        ("map", "fake/good", 0.0),
        ("map", "fake/diverges", 1.0),
    }
    assert asked == 4
    assert ran(tiny, "fake/diverges,fake/good")[::2] == (0, 4)


def test_a_point_of_a_map_that_takes_too_long_is_left_out_and_says_so(tiny: Tiny) -> None:
    posed(tiny, GRID.replace("lambda kn: 0.1", "lambda kn: 0.1, cpu_limit=0.15"))
    tiny.edit("adapters/fake.py", "ORDER, GRAVITY)", "ORDER, GRAVITY, pace=(0.0, 0.01))")
    code, told, asked = ran(tiny, "fake/good")
    assert (code, asked) == (0, 1)
    short, long = sorted(told["records"], key=lambda r: -r["rung"]["dt"])
    assert (short["status"], long["status"]) == ("ran", "too-long")
    assert long["reason"] == (
        "not run: 20 steps of about 0.01 s each; the limit is 0.15 s, 15 steps"
    )


def test_a_rung_that_takes_too_long_is_left_out_and_the_others_are_judged(tiny: Tiny) -> None:
    posed(tiny, f"{LADDER[:-1]}, cpu_limit=0.25)")
    tiny.edit("adapters/fake.py", "ORDER, GRAVITY)", "ORDER, GRAVITY, pace=(0.0, 0.01))")
    code, told, _ = ran(tiny, "fake/good", "--level", "default")
    steps = {round(1.0 / r["rung"]["dt"]): r["status"] for r in told["records"]}
    assert code == 0
    assert {n: status == "too-long" for n, status in steps.items()} == {n: n > 25 for n in steps}
    assert set(steps.values()) == {"ran", "too-long"}


@pytest.mark.parametrize(("refused", "asked"), [("> 0.06", 2), ("> 0.01", 0), ("< 0.06", 1)])
def test_a_step_refused_for_its_length_alone_is_run_in_a_map(
    tiny: Tiny, refused: str, asked: int
) -> None:
    """What is refused at the shortest step too is refused for something else."""
    posed(tiny, GRID)
    tiny.edit("adapters/fake.py", 'if scheme == "refuses"', f"if ask.knobs.dt {refused}")
    _, told, seen = ran(tiny, "fake/good")
    assert seen == asked
    assert [r["status"] for r in told["records"]].count("refused") == 2 - asked


def test_an_error_in_a_map_is_an_error(tiny: Tiny) -> None:
    posed(tiny, GRID)
    assert ran(tiny, "fake/good,fake/raises")[0] != 0


def test_a_search_runs_in_rounds_and_is_stored_as_one_result(tiny: Tiny) -> None:
    posed(tiny, SEARCH)
    code, told, asked = ran(tiny, "fake/good")
    (record,) = told["records"]
    assert (code, record["study"], record["status"]) == (0, "search", "ran")
    assert asked == 8
    assert "reaches" in record["reason"]
    tiny.edit("cases/fall.py", "the tiny project says so", "it says so still")
    _, told, asked = ran(tiny, "fake/good")
    assert asked == 8
    assert told["records"][0]["reason"] == record["reason"]


def test_how_a_search_is_done_is_in_the_key_of_its_run_and_of_no_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    project = find(Path(__file__))
    options = Options(codes=("dem/default",))
    plan = make_plan(project, ["stable-step:undamped", "single-contact:T1"], options)
    before = keys.run_keys(project, plan)
    digest = closure.source_digest
    monkeypatch.setattr(
        keys, "source_digest", lambda files: digest(files) + str([p.name for p in files])[:14]
        if [p.name for p in files] == ["search.py"] else digest(files)
    )  # fmt: skip
    after = keys.run_keys(project, plan)
    searched = {n for n, job in enumerate(plan.jobs) if job.ask.search is not None}
    assert searched
    assert {n for n in before if before[n] != after[n]} == searched
