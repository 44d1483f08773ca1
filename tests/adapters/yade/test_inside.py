"""Claims about the program inside YADE, with one that touches nothing in its place, by hand.

Masses, radii, loads and directions are unlike, so that none can stand for another.
"""

from __future__ import annotations

import io
import json
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.support.adapters.inside_yade import OMEGA, asked, part, sphere, wall


def test_displacements_and_velocities_are_exact_in_free_flight(driver: Any) -> None:
    values, facts = driver.solve(asked())
    for row, t in enumerate((0.0, 0.2, 0.4)):
        assert values[0, row] == pytest.approx([1.5 * t + 1.5 * t**2, 0.0, -2.0 * t - t**2])
        assert values[1, row] == pytest.approx([1.5 + 3 * t, 0.0, -2.0 - 2 * t])
    assert (facts["status"], facts["unknowns"], facts["steps"]) == ("ran", 2, 5)
    _, facts = driver.solve(asked(observe=[["displacement", 0]]))
    assert facts["steps"] == 4  # none beyond the end, which displacements do not need


def test_a_reaction_is_against_all_forces_along_blocked_axes(driver: Any) -> None:
    held = sphere(
        blocked="xzXYZ", velocity=[0.0] * 3, push=[0.25, 0.5, -0.75], force=[4.0, 7.0, 6.0]
    )
    values, _ = driver.solve(asked(held, observe=[["reaction", 0]]))
    # -(4 + 2 1) and -(6 - 2 5); what pushes in the first step alone does not stay
    assert values[0] == pytest.approx(np.array([[-6.0, 0.0, 4.0]] * 3))
    going = sphere(
        blocked="xzXYZ", velocity=[0.25, 0.0, 0.0], carried=[1.0, 0.0, 2.0], held=[0.25, 0.0, 0.5],
        force=[0.0] * 3,
    )  # fmt: skip
    values, _ = driver.solve(asked(going, observe=[["reaction", 0]], drag=8.0))
    # at t = 0 the drag on what it does not yet carry is added: 8 (1 - 0.25), 8 (2 - 0.5)
    assert values[0, 0] == pytest.approx([-2.0 + 6.0, 0.0, 10.0 + 12.0])
    assert values[0, 1] == pytest.approx([-2.0, 0.0, 10.0])


def test_what_is_carried_starts_after_the_first_step_and_catches_up(driver: Any) -> None:
    body = sphere(blocked="xyzXYZ", velocity=[0.25, 0.0, 0.0], carried=[1.0, 0.0, 0.0],
                  held=[0.25, 0.0, 0.0])  # fmt: skip
    values, _ = driver.solve(asked(body, observe=[["displacement", 0]]))
    assert values[0, :, 0] == pytest.approx([0.0, 0.2, 0.4])


def test_pushes_and_twists_end_with_the_first_step(driver: Any) -> None:
    for push, twist, force in (
        ([0.0, 9.0, 0.0], [0.0] * 3, [4.0, 0.0, 6.0]), ([0.0] * 3, [0.0, 0.0, 3.0], [0.0] * 3)
    ):  # fmt: skip
        ask = asked(sphere(push=push, twist=twist, force=force))
        driver.build(ask)
        assert OMEGA.forces.force[0] == pytest.approx(np.add(force, push))
        assert OMEGA.forces.torque[0] == twist
        part(driver, "stepping").first_step(ask)
        assert OMEGA.forces.force[0].tolist() == force
        assert OMEGA.forces.torque[0] == [0, 0, 0]
    driver.build(asked(sphere(force=[0.0] * 3)))
    assert OMEGA.forces.force == {}


def test_bare_steps_are_as_many_as_asked(driver: Any) -> None:
    ask = asked()
    driver.build(ask)
    cpu, whole = part(driver, "stepping").bare(ask)
    assert OMEGA.iter == 4
    assert 0.0 <= cpu < 1.0
    assert 0.0 <= whole < 60.0


def test_time_spent_reading_is_taken_off_the_steps(
    driver: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    stepping, now = part(driver, "stepping"), [100.0]

    def tick(seconds: float) -> None:
        now[0] += seconds

    clock = SimpleNamespace(process_time=lambda: now[0], perf_counter=lambda: 2 * now[0])
    monkeypatch.setattr(stepping, "time", clock)
    step = OMEGA.step

    def slow_step() -> None:
        tick(1.0)
        step()

    monkeypatch.setattr(OMEGA, "step", slow_step)
    for name in ("check_contacts", "read_first", "read", "read_later"):
        monkeypatch.setattr(stepping, name, lambda *given: tick(0.125))
    ask = asked()
    driver.build(ask)
    _, cpu, whole, reading = stepping.watched(ask)
    # five steps; contacts and start, then two rows of two readings
    assert (cpu, whole, reading) == (5.0, 10.75, 0.75)
    driver.build(ask)
    assert stepping.bare(ask) == (4.0, 8.0)


def test_timed_is_what_a_clock_gained(driver: Any) -> None:
    now = iter((5.0, 7.5))
    assert part(driver, "session").timed(lambda: next(now), lambda one: one, 0) == 2.5


@pytest.mark.parametrize(
    ("repeat", "costs", "repeats", "least", "spread"),
    [
        (10.0, (21.0,), 1, 21.0, 0.0),  # long enough as it was watched
        (10.0, (20.0, 6.0, 5.0, 8.0), 3, 5.0, 0.6),
        (10.0, (20.0, 3.0, 2.0, 3.0, 4.0), 4, 2.0, 1.0),
        (0.0, (0.0, 0.0, 0.0, 0.0), 3, 0.0, 0.0),  # each within a tick of the clock
    ],
)
def test_solves_are_repeated_until_they_took_so_long(
    driver: Any, monkeypatch: pytest.MonkeyPatch, repeat: float, costs: tuple[float, ...],
    repeats: int, least: float, spread: float,
) -> None:  # fmt: skip
    first, *more = costs
    left = iter(more)
    monkeypatch.setattr(driver, "watched", lambda ask: (np.zeros(1), first, 2 * first, 0.5))
    monkeypatch.setattr(driver, "bare", lambda ask: ((cpu := next(left)), 3 * cpu))
    monkeypatch.setattr(driver, "check_end", lambda ask: None)
    setups = iter((0.5, 0.25, 0.75, 1.0, 2.0))
    monkeypatch.setattr(driver, "timed", lambda *given: next(setups))
    _, facts = driver.solve(asked(), repeat)
    assert facts["setup"] == (0.5 if repeats == 1 else 0.25)
    wall_of = 2 if repeats == 1 else 3
    assert (facts["repeats"], facts["solve_cpu"]) == (repeats, least)
    assert (facts["solve_wall"], facts["output"]) == (wall_of * least, 0.5)
    assert facts["spread"] == pytest.approx(spread)
    assert not [*left]


def test_a_run_that_must_not_count_is_refused(driver: Any) -> None:
    stepping = part(driver, "stepping")
    with pytest.raises(stepping.RunError, match="found 0 of 2 contacts"):
        driver.solve(asked(contacts=2))
    OMEGA.contacts = 2
    stepping.check_contacts(asked(contacts=2))
    still = sphere(velocity=[0.0] * 3, force=[-2.0, 0.0, 10.0])
    with pytest.raises(stepping.RunError, match="nothing moved in 5 steps"):
        driver.solve(asked(still))
    driver.solve(asked(still, moves=False))
    floor = wall(point=[0.0, 0.0, 2.5])
    with pytest.raises(stepping.RunError, match="centre of body 1 went through a wall"):
        driver.solve(asked(floor, sphere(velocity=[0.0, 0.0, -2.0]), observe=[]))
    driver.solve(asked(wall(), sphere(), observe=[]))
    with pytest.raises(stepping.RunError, match=r"velocity not finite at t = 0\.2 s"):
        driver.solve(asked(sphere(velocity=[math.inf, 0.0, 0.0]), observe=[["velocity", 0]]))
    with pytest.raises(stepping.RunError, match="a position is not finite after 4 steps"):
        driver.solve(asked(sphere(velocity=[math.nan, 0.0, 0.0]), observe=[]))


def test_an_answer_is_whole_or_says_what_was_wrong(
    driver: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def answered(ask: dict[str, Any], ready: float) -> dict[str, Any]:
        path = tmp_path / "ask.json"
        path.write_text(json.dumps(ask | {"repeat": 0.0}))
        driver.answer(str(path), ready)
        found: dict[str, Any] = json.loads((tmp_path / "ask.json.answer").read_text())
        return found

    monkeypatch.setattr(driver, "timed", lambda clock, work, *given: work(*given) or 2.0)
    fine = answered(asked(), 3.5)
    assert (fine["status"], fine["ready"], fine["version"]) == ("ran", 3.5, "still")
    assert 2.0 <= fine["output"] < 3.0  # beside what the readings took
    assert np.load(tmp_path / "ask.json.npy").shape == (2, 3, 3)
    lost = answered(asked(contacts=1), 0.0)
    assert lost["status"] == "error"
    assert lost["reason"].startswith("YADE found 0 of 1")
    broken = answered({"dt": 1.0}, 0.0)
    assert (broken["status"], broken["reason"]) == ("error", "KeyError: 'hertz'")


def test_the_program_answers_what_is_listed_or_prints_what_is_written_in(
    driver: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    told: list[tuple[str, float]] = []
    monkeypatch.setattr(
        OMEGA, "tmpFilename", lambda: str(tmp_path / "none" / "file"), raising=False
    )
    monkeypatch.setattr(driver, "answer", lambda path, ready: told.append((path, ready)))
    for name, asks in (("one", "a\nb b\n"), ("two", "c\n")):
        (tmp_path / name).write_text(asks)
    monkeypatch.setattr("sys.stdin", io.StringIO(f"{tmp_path}/one\n{tmp_path}/two\n"))
    driver.main()
    assert [path for path, _ in told] == ["a", "b b", "c"]
    assert told[0][1] > 0.0  # start-up is that of the first
    assert [ready for _, ready in told[1:]] == [0.0, 0.0]
    monkeypatch.setattr(driver, "ASK", asked(observe=[["displacement", 0]]))
    driver.main()
    _, heading, *rows = capsys.readouterr().out.splitlines()
    assert heading == "# t [s], displacement of body 0: x, y, z [SI]"
    assert [float(row.split()[0]) for row in rows] == pytest.approx([0.0, 0.2, 0.4])
    assert float(rows[2].split()[1]) == pytest.approx(1.5 * 0.4 + 1.5 * 0.16)
