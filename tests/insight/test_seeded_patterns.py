"""Claims about patterns of bugs that are seeded into a code which runs: one of each sort."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from cases.contact.bounce import CASE as BOUNCE
from cases.contact.single_contact import CASE as CONTACTS
from tests.support.fabricated import record
from vv.ask import Ask, Knobs, Method, Run
from vv.case import Case, Ladder
from vv.engines import dem
from vv.insight.diagnosis import Diagnosis, Pattern, diagnose
from vv.records.job_record import Record
from vv.records.record import measured
from vv.scene import Scene, Spheres

STEPS = (4e-3, 2e-3, 1e-3, 5e-4)
Bug = Callable[[Scene], Scene]
Solve = Callable[[Ask], Run]


def spheres(scene: Scene, change: Callable[[Spheres], Spheres]) -> Scene:
    bodies = (change(body) if isinstance(body, Spheres) else body for body in scene.bodies)
    return dataclasses.replace(scene, bodies=tuple(bodies))


def right(scene: Scene) -> Scene:
    return scene


def drag_twice(scene: Scene) -> Scene:
    return dataclasses.replace(scene, eta=2.0 * scene.eta)


def thrown_back(scene: Scene) -> Scene:
    return spheres(scene, lambda body: dataclasses.replace(body, velocity=-body.velocity))


def without_rotation(scene: Scene) -> Scene:
    held = np.zeros(3, bool)
    return spheres(
        scene,
        lambda body: dataclasses.replace(
            body, spin=0.0 * body.spin, free_spin=np.tile(held, (len(body.mass), 1))
        ),
    )


Asked = Mapping[str, tuple[Case, Sequence[float]]]  # variant -> its case, and steps [s]


def patterns(asked: Asked, bug: Bug = right, solve: Solve = dem.solve_default) -> list[Diagnosis]:
    """What is said of a leapfrog of second order that has a bug."""
    records: list[Record] = []
    terms: dict[tuple[str, str], frozenset[str]] = {}
    for name, (case, steps) in asked.items():
        trial = case.declare(name, case.defaults(name))
        assert isinstance(trial.study, Ladder)
        study, method = trial.study, Method.LEAPFROG
        terms["bounce", name] = frozenset(term.value for term in study.scene.terms())
        for dt in steps:
            ask = Ask(bug(study.scene), study.goal, study.observables, Knobs(dt=dt))
            run = solve(ask)
            found = [measured(run, one, method, ask.knobs)[0] for one in trial.quantities]
            records.append(record("own/default", name, dt, quantities=found))
    return list(diagnose(records, terms))


SINGLE: Asked = dict.fromkeys(("T1", "T2", "T3", "T4"), (CONTACTS, STEPS))
ROLLING: Asked = {"floor": (BOUNCE, (5e-7, 2.5e-7)), "T3": (CONTACTS, STEPS)}


def test_a_code_without_a_bug_has_no_pattern() -> None:
    assert patterns(SINGLE) == []


def test_drag_that_counts_twice_does_not_converge_and_drag_is_blamed() -> None:
    (found,) = patterns(SINGLE, drag_twice)
    assert found.pattern is Pattern.STUCK
    assert found.text.startswith("it does not converge: error ")
    assert found.text.endswith("; only variants with drag fail")


def test_a_half_step_that_is_missing_in_the_drag_is_a_lower_order_than_claimed() -> None:
    (found,) = patterns(SINGLE, solve=dem.solve_published)
    assert found.pattern is Pattern.LOW_ORDER
    assert "where 2 is claimed: look for a term that is taken half a step late" in found.text
    assert found.text.endswith("; only variants with drag fail")


def test_a_sign_that_is_swapped_at_the_start_is_named() -> None:
    (found,) = patterns({"T3": SINGLE["T3"]}, thrown_back)
    assert found.pattern is Pattern.FACTOR
    assert found.text == "y is minus the exact answer: a sign is swapped"


def test_rotation_that_is_lost_is_an_effect_that_is_lost_and_rotation_is_blamed() -> None:
    (found,) = patterns(ROLLING, without_rotation)
    assert found.pattern is Pattern.FACTOR
    assert "an effect is lost; only variants with free rotation" in found.text
