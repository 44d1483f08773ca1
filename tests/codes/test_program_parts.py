"""Parts of how a program is asked and answers, by hand: costs, numbers, lines of its ask."""

from __future__ import annotations

import ast
import dataclasses
import json
import resource
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from vv.ask import Ask, Cost, Displacement, History, Knobs, Model, Run, Status
from vv.base.errors import UsageError
from vv.codes import own_python, script
from vv.codes.program import adapter, declared, process, question, result
from vv.codes.program.bad_answer import BadAnswerError


def ran(*seconds: float) -> list[Run]:
    return [Run(Status.RAN, f"{cpu}", cost=Cost(solve_cpu=cpu)) for cpu in seconds]


@pytest.mark.parametrize(
    ("seconds", "least", "spread"),
    [((4.0, 2.0, 3.0), 2.0, 1.0), ((4.0,), 4.0, 0.0), ((0.0, 1.0), 0.0, 0.0)],
)
def test_the_cheapest_run_counts_with_the_number_and_spread_of_all(
    seconds: tuple[float, ...], least: float, spread: float
) -> None:
    best = adapter._cheapest(ran(*seconds))
    assert best.reason == f"{least}"
    assert (best.cost.solve_cpu, best.cost.repeats, best.cost.spread) == (
        least, len(seconds), spread,
    )  # fmt: skip


def test_all_ran_only_if_each_did() -> None:
    assert adapter._all_ran(ran(1.0, 2.0))
    assert not adapter._all_ran([*ran(1.0), Run(Status.ERROR, "no")])


@pytest.mark.parametrize(
    ("words", "version"),
    [
        ("print('\\n  code 1.2  \\nmore')", "code 1.2"),
        ("pass", adapter.UNSTATED),
        ("print('code 1.2'); raise SystemExit(3)", adapter.UNSTATED),
        ("print('x' * 200)", "x" * 80),
    ],
)
def test_a_version_is_the_first_line_of_a_command_that_ends_well(words: str, version: str) -> None:
    assert adapter._version((sys.executable, "-c", words)) == version


SPENT = Cost(solve_wall=9.0, solve_cpu=5.0)


@pytest.mark.parametrize(
    ("stepping", "startup", "wall"),
    [(3.0, 2.0, 7.0), (5.0, 0.0, 9.0), (5.0 + 0.9 * process.JITTER, 0.0, 9.0)],
)
def test_what_a_program_takes_beside_its_steps_is_its_start(
    stepping: float, startup: float, wall: float
) -> None:
    cost = process._costed(Run(Status.RAN), stepping, SPENT).cost
    assert (cost.startup, cost.solve_cpu) == (startup, stepping)
    assert cost.solve_wall == pytest.approx(wall, abs=process.JITTER)
    assert not cost.whole


def test_steps_that_took_more_than_the_process_are_an_error_and_unstated_ones_are_the_whole() -> (
    None
):
    wrong = process._costed(Run(Status.RAN), 5.0 + 1.1 * process.JITTER, SPENT)
    assert wrong.status is Status.ERROR
    idle = process._costed(Run(Status.RAN), 0.0, dataclasses.replace(SPENT, solve_wall=1.0))
    assert idle.cost.solve_wall == 0.0
    model = Model(1, frozenset(), "a point")
    whole = process._costed(Run(Status.RAN, model=model), None, SPENT)
    assert (whole.cost.whole, whole.cost.solve_cpu) == (True, 5.0)
    assert whole.model is not None
    assert whole.model.note.startswith("a point; ")


@pytest.mark.parametrize(
    ("value", "size"),
    [(0, True), (2.5, True), (-1, False), (True, False), ("1", False), (float("inf"), False),
     (float("nan"), False), (None, False)],
)  # fmt: skip
def test_a_size_is_a_finite_number_zero_or_more(value: object, size: bool) -> None:
    given = result.Value("solve_cpu", value)
    if size:
        assert given.size() == value
    else:
        with pytest.raises(BadAnswerError, match="zero or more"):
            given.size()


@pytest.mark.parametrize(
    ("value", "good"),
    [(0, True), (2.5, True), (9e8, True), (1.1e9, False), (-1, False), (True, False), ("1", False)],
)
def test_a_time_is_a_number_of_seconds_less_than_thirty_years(value: object, good: bool) -> None:
    assert declared._is_time(value) is good


def test_a_pace_is_a_pair_of_times() -> None:
    def read(pair: object) -> tuple[float, float]:
        return declared._pace(declared.Entry(Path("code.toml"), "scheme.a.pace", pair))

    assert read([1e-6, 0]) == (1e-6, 0.0)
    for pair in ([1e-6, "x"], ["x", 1e-6], [1e-6], 1e-6):
        with pytest.raises(UsageError, match="CPU seconds of a step"):
            read(pair)


def test_objects_that_are_long_have_their_entries_on_lines_of_their_own() -> None:
    short = {"a": 1, "b": [1, 2]}
    assert question._lines(short) == '{"a": 1, "b": [1, 2]}'
    long: dict[str, Any] = {"first": "x" * question.WIDTH, "second": short}
    assert question._lines(long).splitlines() == [
        "{", f'  "first": "{"x" * question.WIDTH}",', '  "second": {"a": 1, "b": [1, 2]}', "}",
    ]  # fmt: skip
    just = {"a": "x" * (question.WIDTH - 9)}
    assert len(question._lines(just)) == question.WIDTH
    assert "\n" in question._lines(just, " ")
    assert question._lines(["x" * 200]) == json.dumps(["x" * 200])


def test_a_script_writes_what_is_long_one_to_a_line_indented() -> None:
    array = np.arange(40.0)
    text = script.source((array, 1.5), 0)
    assert np.array_equal(eval(text, {"np": np})[0], array)
    assert len(text.splitlines()) > 40
    assert all(line.startswith("    ") for line in text.splitlines()[1:-1])
    fits = ["1"] * ((script.WIDTH - 2 + 2) // 3)
    line = script._bracketed("(", fits, ")", 0)
    assert len(line) <= script.WIDTH
    assert "\n" not in line
    assert "\n" in script._bracketed("(", fits, ")", 10)
    assert script._bracketed("(", ["a\nb"], ")", 0).count("\n") == 3
    inner = script._bracketed("(", ["a" * script.WIDTH], ")", 4).splitlines()
    assert inner == ["(", " " * 8 + "a" * script.WIDTH + ",", "    )"]


def answered(folder: Path, values: np.ndarray, **facts: Any) -> Run | None:
    """What is read of an answer to an ask for one displacement at 0, 0.5 and 1 s."""
    from tests.scene.test_scene import scene

    ask = Ask(scene(), History(1.0, 0.5), (Displacement(0),), Knobs(0.5))
    path = folder / "ask.json"
    np.save(folder / "ask.json.npy", values)
    whole = {"status": "ran", "reason": "", "steps": 2, "ready": 12.0, "solve_cpu": 3.0, **facts}
    (folder / "ask.json.answer").write_text(json.dumps(whole))
    return own_python.parse(path, ask, Model(3, frozenset()), 2.0 * np.eye(3), 10.0)


def test_an_answer_is_read_in_the_frame_with_its_costs(tmp_path: Path) -> None:
    run = answered(tmp_path, np.ones((1, 3, 3)))
    assert run is not None
    assert (run.status, run.cost.startup, run.cost.solve_cpu, run.steps) == (
        Status.RAN,
        2.0,
        3.0,
        2,
    )
    assert (run.values[Displacement(0)] == 2.0).all()
    late, early = (answered(tmp_path, np.ones((1, 3, 3)), ready=ready) for ready in (0.0, 9.0))
    assert late is not None
    assert early is not None
    assert late.cost.startup == early.cost.startup == 0.0


def test_an_answer_of_another_shape_or_status_is_told(tmp_path: Path) -> None:
    run = answered(tmp_path, np.ones((1, 4, 3)))
    assert run is not None
    assert run.reason == "the answer has shape (1, 4, 3); (1, 3, 3) was asked for"
    lost = answered(tmp_path, np.zeros(0), status="diverged", reason="it blew up")
    assert lost is not None
    assert (lost.status, lost.reason) == (Status.DIVERGED, "it blew up")


def test_a_driver_alone_keeps_its_lines_where_they_were() -> None:
    ours = "from vv.codes.driver_protocol import (\n    solve,\n)\n"
    text = f"import os\n{ours}from math import pi\nx = 1\n"
    lines = own_python._alone(text).splitlines()
    assert "from math import pi" in lines
    assert not any("served" in line for line in lines)
    assert (
        ast.unparse(ast.parse(own_python._alone(text))) == "import os\nfrom math import pi\nx = 1"
    )


@pytest.mark.parametrize("narrow", [False, True])
def test_files_of_a_program_are_bounded_by_the_lower_of_its_limit_and_ours(
    narrow: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    unbound, most = resource.RLIM_INFINITY, process._most()
    soft = most // 2 if narrow else unbound
    limits = [(soft, unbound)]
    monkeypatch.setattr(resource, "getrlimit", lambda _: limits[-1])
    monkeypatch.setattr(resource, "setrlimit", lambda _, pair: limits.append(pair))
    with process._bounded():
        assert limits[-1] == (min(most, soft) if narrow else most, unbound)
    assert limits[-1] == (soft, unbound)
