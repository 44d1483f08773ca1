"""Claims about `vv speed`: what an error costs, scaling, and what was not timed."""

import json
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tests.conftest import Tiny
from vv.ask import Knobs
from vv.case import Level
from vv.cli import speed_command


def test_speed_prints_what_an_error_costs_and_writes_it(tiny: Tiny, tmp_path: Path) -> None:
    target = tmp_path / "speed.json"
    done = tiny.vv("speed", "--codes", "fake/good", "--json", str(target))
    assert done.returncode == 0, done.stderr
    assert "CPU time of the stepping loop to reach an error of" in done.stdout
    whole = json.loads(target.read_text())
    assert {"fronts", "cheapest", "duels", "profiles"} <= whole.keys()
    assert whole["cheapest"]["0.01"]["fall:up"][0]["scheme"] == "fake/good"
    found = whole["efforts"]
    assert {one["label"] for one in found} == {"fake/good"}
    rows = [row for one in found for row in one["rows"]]
    timed = {p["dt"] for row in rows for p in row["points"] if p["cpu"]}
    assert timed == {0.1, 0.05}


def test_scaling_has_a_scene_of_its_own_and_says_who_cannot_step_it(
    tiny: Tiny, tmp_path: Path
) -> None:
    assert tiny.vv("speed", "fall", "--scaling", "100").returncode == 64
    assert tiny.vv("speed", "--scaling", "99").returncode == 64
    assert tiny.vv("speed", "--scaling", "0").returncode == 64
    target = tmp_path / "scaling.json"
    done = tiny.vv("speed", "--scaling", "100", "--codes", "fake/good", "--json", str(target))
    assert done.returncode == 0, done.stderr
    assert "fake/good with 100 spheres: fake/good does not support:" in done.stdout
    assert done.stdout.splitlines()[1].split() == ["spheres", "memory"]
    (size,) = json.loads(target.read_text())["sizes"]
    assert size["seconds"] == {}
    assert size["bandwidth"] > 1e8


def test_speed_says_so_where_nothing_is_timed(tiny: Tiny) -> None:
    tiny.edit("cases/fall.py", "timed=RUNGS[:2]", "timed=()")
    done = tiny.vv("speed")
    assert (done.returncode, done.stderr.count("\n")) == (64, 1)


def test_speed_shows_what_is_not_timed_against_indicative_costs_and_times_it_when_asked(
    tiny: Tiny,
) -> None:
    tiny.edit("cases/fall.py", "timed=RUNGS[:2]", "timed=RUNGS[:2] if variant == 'up' else ()")
    words = ("speed", "fall", "--codes", "fake/good")
    out = tiny.vv(*words).stdout
    assert "fall:up: CPU time" in out
    assert "fall:slow: not timed; errors, and indicative costs" in out
    out = tiny.vv(*words, "--level", "paper").stdout
    assert "fall:slow: CPU time" in out
    assert "not timed" not in out


def test_speed_names_the_cases_that_it_left_out(tiny: Tiny) -> None:
    text = (tiny.root / "cases" / "fall.py").read_text().replace("timed=RUNGS[:2]", "timed=()")
    (tiny.root / "cases" / "drop.py").write_text(text.replace('name="fall"', 'name="drop"'))
    assert "not timed: drop, and" in tiny.vv("speed", "--codes", "fake/good").stdout


@dataclass(frozen=True)
class Job:
    """What is read of a job."""

    variant: str
    ask: Any
    timed: bool
    case: str = "fall"


def timed_at_level_paper(knobs: Knobs, other_is_timed: bool) -> bool:
    """Whether an untimed job is timed, by its setting and another job of its variant."""
    default = (Knobs(0.1, 1e6), Knobs(0.05, 1e6))
    levels = {Level.DEFAULT: default, Level.PAPER: (*default, Knobs(0.025, 1e6))}
    trial = SimpleNamespace(study=SimpleNamespace(rungs=levels))
    jobs = [
        Job("up", SimpleNamespace(knobs=knobs), False),
        Job("up", SimpleNamespace(knobs=Knobs(0.2, 1e6)), other_is_timed),
        Job("slow", SimpleNamespace(knobs=knobs), True),
    ]
    plan: Any = SimpleNamespace(jobs=jobs, trials=dict.fromkeys([("fall", "up")], trial))
    first, other, elsewhere = speed_command._all_timed(plan)
    assert (other.timed, elsewhere.timed) == (other_is_timed, True)
    return first.timed


@pytest.mark.parametrize(
    ("knobs", "timed"),
    [
        (Knobs(0.1, 1e6), True),
        (Knobs(0.05, 1e6), True),
        (Knobs(0.025, 1e6), False),
        (Knobs(0.1, 1e7), False),
        (Knobs(None, 1e6), True),  # a code that has no step
        (Knobs(None, 1e7), False),
        (Knobs(0.1, None), True),  # a code that has no stiffness
        (Knobs(0.025, None), False),
        (Knobs(None, None), True),
    ],
)
def test_a_variant_that_times_nothing_is_timed_at_the_settings_of_level_default(
    knobs: Knobs, timed: bool
) -> None:
    assert timed_at_level_paper(knobs, other_is_timed=False) is timed
    assert not timed_at_level_paper(knobs, other_is_timed=True)
