"""Claims about the exact engine as a code: refusals, limits, native input, cost."""

from __future__ import annotations

import dataclasses
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from adapters.exact import ADAPTER
from cases.contact.single_contact import CASE
from tests import ROOT
from tests.scenes.small_scenes import DOWN, FLOOR, ball, crowded
from vv.ask import Ask, Displacement, History, Knobs, Status
from vv.codes import unsupported
from vv.engines.exact import solve
from vv.scene import Contact, Harmonic, Scene, Term

PLAIN = ["T1", "T2", "T3", "T4"]


def asked(variant: str, duration: float = 0.4) -> Ask:
    study = CASE.declare(variant, CASE.defaults(variant)).study
    return Ask(study.scene, History(duration, 1e-3), study.observables)


def test_accumulating_events_are_an_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vv.engines.exact.flow.MOST_EVENTS", 100)
    run = solve(Ask(crowded(1e4), History(3.0, 0.1), (Displacement(1),)))
    assert run.status is Status.DIVERGED
    assert "events accumulate: more than 100 by t = 0.496" in run.reason


def test_too_many_steps_are_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for most, value in (("STEPS", 100), ("NUMBERS", 0)):
        monkeypatch.setattr(f"vv.engines.exact.flow.MOST_{most}", value)
    (run,) = ADAPTER.run([asked("T3", 20.0)], "default", tmp_path, 0.0)
    assert run.status is Status.REFUSED
    assert "more than 100 steps" in run.reason


def test_a_run_may_take_more_steps_where_they_store_fewer_numbers(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("vv.engines.exact.flow.MOST_STEPS", 100)
    assert solve(asked("T3", 20.0)).status is Status.RAN
    monkeypatch.setattr("vv.engines.exact.flow.MOST_NUMBERS", 100 * 34)
    assert "more than 100 steps" in solve(asked("T3", 20.0)).reason


def test_numbers_out_of_range_are_an_answer() -> None:
    scene = dataclasses.replace(crowded(1.0), gravity=np.array([1e308, 0.0, 0.0]))
    with np.errstate(all="ignore"):
        run = solve(Ask(scene, History(100.0, 1.0), ()))
    assert run.status is Status.DIVERGED
    assert "range of floating-point numbers" in run.reason


def test_spheres_that_pass_through_each_other_are_an_answer() -> None:
    scene = dataclasses.replace(crowded(1.0), contact=Contact(0.1))
    run = solve(Ask(scene, History(10.0, 0.1), (Displacement(1),)))
    assert run.status is Status.DIVERGED
    assert "centres of bodies 1 and 2 meet" in run.reason


RESTING = ball(np.array([0.0, 0.0, 0.9]), np.zeros(3))
REFUSED = {
    "nothing in the scene moves": Scene((ball(np.zeros(3), np.zeros(3)),), Contact(1e3)),
    "the contact normal between bodies 0 and 1 turns": Scene(
        (
            ball(np.zeros(3), np.array([1.0, 0.0, 0.0])),
            ball(np.array([3.0, 0.1, 0.0]), np.zeros(3)),
        ),
        Contact(1e3),
    ),
    "the slip between bodies 0 and 1 can turn": Scene(
        (FLOOR, ball(np.array([0.0, 0.0, 0.9]), np.array([1.0, 0.0, 0.0]), load=[[0, 1, 0]])),
        Contact(1e3, 1e3, 0.5),
        gravity=DOWN,
    ),
    "locked bodies that move steadily is not modelled": Scene(
        (FLOOR, ball(np.zeros(3), np.ones(3), free=[[True, True, False]])), Contact(1e3)
    ),
    "free rotation is not modelled": Scene(
        (FLOOR, ball(np.zeros(3), np.ones(3), free_spin=np.ones((1, 3)))), Contact(1e3)
    ),
    "sphere 0 spins; rotation is not modelled": Scene(
        (FLOOR, ball(np.zeros(3), np.ones(3), spin=np.ones((1, 3)))), Contact(1e3)
    ),
    "bodies 0 and 1 overlap by 0.1 m at t = 0; rigid bodies cannot": Scene(
        (FLOOR, RESTING), Contact(np.inf)
    ),
    "contact between spheres is not modelled on rigid contact": Scene(
        (FLOOR, RESTING, RESTING), Contact(np.inf)
    ),
    "a body acceleration that varies in time is not modelled on springs": Scene(
        (FLOOR, RESTING),
        Contact(1e3),
        shaking=Harmonic(np.ones(3), np.ones(3)),
    ),
    "the centres of bodies 0 and 1 coincide": Scene((RESTING, RESTING), Contact(1e3)),
    "the scene has 33 spheres; at most 32 are solved": Scene((RESTING,) * 33, Contact(1e3)),
    "body 0 is not a sphere of this scene, which has 2 bodies": Scene(
        (FLOOR, RESTING), Contact(1e3), gravity=DOWN
    ),
}


@pytest.mark.parametrize("reason", REFUSED)
def test_scenes_outside_the_class_are_refused_with_the_reason(reason: str, tmp_path: Path) -> None:
    ask = Ask(REFUSED[reason], History(1.0, 0.1), (Displacement(0),))
    assert ADAPTER.refuses(ask, "default") == reason
    (run,) = ADAPTER.run([ask], "default", tmp_path, 0.0)
    assert (run.status, run.reason) == (Status.REFUSED, reason)
    assert (solve(ask).status, solve(ask).reason) == (Status.REFUSED, reason)


def test_only_steps_have_a_knob_and_rotation_is_lacking() -> None:
    assert [scheme.knobs for scheme in ADAPTER.schemes] == [(), (), ("dt",)]
    assert all(Term.ROTATION in unsupported(s, frozenset(Term)) for s in ADAPTER.schemes)
    scheme = ADAPTER.schemes[0]
    assert not unsupported(scheme, asked("T4-rotated").scene.terms())


@pytest.mark.parametrize("test", PLAIN)
def test_a_solve_takes_a_few_milliseconds_and_its_cost_has_parts(test: str, tmp_path: Path) -> None:
    (run,) = ADAPTER.run([asked(test)], "default", tmp_path, 0.03)
    assert 0 < run.cost.solve_cpu < 5e-3
    assert run.cost.repeats > 1
    assert run.cost.setup > 0
    assert run.cost.output > 0


def test_the_native_input_gives_the_same_numbers_to_the_last_bit(tmp_path: Path) -> None:
    assert ADAPTER.found().installed
    ask = asked("T4-rotated", 0.4)
    script = tmp_path / "native.py"
    script.write_text(ADAPTER.native(ask, "default"))
    root = str(ROOT)
    done = subprocess.run(
        [sys.executable, str(script)], cwd=root, env={"PYTHONPATH": root},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    printed = np.loadtxt(done.stdout.splitlines())
    run = solve(ask)
    assert (printed[:, 0] == run.times).all()
    assert (printed[:, 1:] == run.values[Displacement(1)]).all()


def test_importing_the_engine_loads_nothing_heavy() -> None:
    code = "import sys, adapters.exact; print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT,
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert not {"scipy", "numba", "pandas", "matplotlib"} & set(done.stdout.split())


def test_a_step_asked_for_only_sets_the_output_times() -> None:
    ask = dataclasses.replace(asked("T1"), knobs=Knobs(dt=3e-4))
    run = solve(ask)
    assert (run.times == ask.goal.times(3e-4)).all()
    assert run.steps == solve(asked("T1")).steps
