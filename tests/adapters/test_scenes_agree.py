"""Claims that every code solves small scenes of unlike spheres as scipy does from the law."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping

import numpy as np
import pytest

import adapters.dem
import adapters.liggghts
import adapters.yade
from tests.scenes.law_by_scipy import reference
from tests.scenes.spheres.unlike_spheres import SCENES, facing, rolled, spheres
from tests.support.installed import require
from vv.ask import Ask, Run, Status
from vv.codes import Adapter
from vv.scene import Scene, Vector

REFUSED = {("liggghts", "rolling as given"), ("liggghts", "rolling one way")}
CODES: dict[str, Adapter] = {
    "dem": adapters.dem.ADAPTER,
    "dem, general": adapters.dem.ADAPTER,
    "yade": adapters.yade.ADAPTER,
    "liggghts": adapters.liggghts.ADAPTER,
}
FAR = 1e3  # m


def crowded(scene: Scene) -> Scene:
    """The scene with a sphere, a wall and forces that do not matter: all need the same kernel."""
    walls = scene.walls or (facing(0, 0, 1, at=(0, 0, -10 * FAR)),)
    place = FAR * np.sum([wall.normal for wall in walls], axis=0)
    still, turning = np.zeros((1, 3), bool), np.array([[True, False, False]])
    bystander = spheres([place], free=still, free_spin=turning, load=[[1e-100, 0, 0]])
    bodies = (*scene.bodies, bystander, *(() if scene.walls else walls))
    gravity = np.where(scene.gravity.any(), scene.gravity, 1e-100)
    return dataclasses.replace(scene, bodies=bodies, eta=scene.eta or 1e-100, gravity=gravity)


def asked(code: str) -> dict[str, Ask]:
    """What a code is asked, by the scenes' names; dem plainly only where it has a small model."""
    if code == "dem, general":
        return {name: known.ask(crowded(known.scene)) for name, known in SCENES.items()}
    asks = {name: known.ask(known.scene) for name, known in SCENES.items()}
    if code == "dem":
        return {name: ask for name, ask in asks.items() if unknowns(ask) <= 2}
    return {name: ask for name, ask in asks.items() if (code, name) not in REFUSED}


def unknowns(ask: Ask) -> int:
    return adapters.dem.ADAPTER.describe(ask, "default").unknowns


def expected(code: str, name: str, times: Vector) -> Vector:
    """What the law says, as far as the code holds to it.

    YADE sees slip on an aligned wall in the wall's plane, not half an overlap above it.
    """
    scene = SCENES[name].scene
    if name.startswith("rolling"):
        return rolled(scene, times, 1.0 if code == "yade" else 0.5)
    return solved(name, tuple(times))


@functools.cache
def solved(name: str, times: tuple[float, ...]) -> Vector:
    return reference(SCENES[name].scene, np.array(times))


Runs = Mapping[str, Run]
Answers = Callable[[str], Runs]


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> Answers:
    """The runs of a code by the scenes' names, all from one call of its adapter."""

    @functools.cache
    def run(code: str) -> Runs:
        require(CODES[code])
        asks, folder = asked(code), tmp_path_factory.mktemp("scenes")
        runs = CODES[code].run(list(asks.values()), "default", folder, 0.0)
        return dict(zip(asks, runs, strict=True))

    return run


CHOICES = [(code, name) for code in CODES for name in asked(code)]


@pytest.mark.parametrize(("code", "name"), CHOICES)
def test_a_code_does_what_the_law_says(code: str, name: str, answers: Answers) -> None:
    run = answers(code)[name]
    assert run.status is Status.RAN, run.reason
    exact = expected(code, name, run.times)
    error = np.abs(moved(run) - exact).max() / np.abs(exact).max()
    assert error < SCENES[name].within[not code.startswith("dem")]


@pytest.mark.parametrize(("code", "name"), [pair for pair in CHOICES if pair[0].startswith("dem")])
def test_the_ledger_holds_m_g_h_and_f_x(code: str, name: str, answers: Answers) -> None:
    ledger, s = answers(code)[name].ledger, SCENES[name].scene.spheres
    assert ledger is not None
    fallen = s.mass[:, None] * SCENES[name].scene.gravity * moved(answers(code)[name])[-1]
    loaded = s.load * moved(answers(code)[name])[-1]
    for term, work in (("gravity potential", fallen), ("load potential", loaded)):
        assert ledger.terms[term] == pytest.approx(-work.sum(), abs=1e-12 * np.abs(work).sum())


@pytest.mark.parametrize("name", [name for name in SCENES if name.startswith("rolling")])
def test_the_reference_rolls_as_the_closed_form_says(name: str) -> None:
    times = np.linspace(0.0, 0.05, 6)
    scene = SCENES[name].scene
    assert np.abs(reference(scene, times) - rolled(scene, times, 0.5)).max() < 1e-12


@pytest.mark.parametrize(("code", "name"), sorted(REFUSED))
def test_what_a_code_cannot_hold_it_refuses(code: str, name: str) -> None:
    known = SCENES[name]
    assert CODES[code].refuses(known.ask(known.scene), "default") is not None


def moved(run: Run) -> Vector:
    """Displacements (times, spheres, 3) [m]."""
    return np.stack(list(run.values.values()), axis=1)
