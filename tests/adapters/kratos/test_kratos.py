"""Claims about Kratos: what it is given and refuses, and what it answers where it is installed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from adapters.kratos import ADAPTER
from adapters.kratos.plan import plan
from reference_solutions.impact import hertz
from tests.support.adapters.live_asks import COARSE, TRIALS, error, ran
from tests.support.installed import only_with
from vv.ask import Ask, Displacement, History, Knobs
from vv.codes import unsupported
from vv.scene import Contact, Hertz, Scene, Spheres, Wall

X = np.eye(3)[:1]
UNDRAGGED = [name for name in TRIALS if name[:2] in ("T1", "T3")]


def struck(law: Hertz, pair: bool = False, dt: float = 1e-6) -> Ask:
    """A sphere of 0.1 m and 2 kg that strikes a wall, or one alike, at 1 m/s."""
    count = 1 + pair
    spheres = Spheres(
        position=np.array([[0.1, 0.0, 0.0], [-0.1, 0.0, 0.0]])[:count],
        velocity=np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])[:count],
        radius=np.full(count, 0.1),
        mass=np.full(count, 2.0),
        free=np.repeat(X == 1, count, axis=0),
    )
    wall = () if pair else (Wall(np.zeros(3), X[0]),)
    scene = Scene((spheres, *wall), Contact(0.0, mu=0.3, hertz=law))
    return Ask(scene, History(4e-3, 1e-3), tuple(map(Displacement, range(count))), Knobs(dt=dt))


def test_drag_is_a_term_that_it_lacks() -> None:
    (scheme,) = ADAPTER.schemes
    lacking = {name for name in TRIALS if unsupported(scheme, TRIALS[name].study.scene.terms())}
    assert lacking == set(TRIALS) - set(UNDRAGGED)


def test_a_load_stands_for_an_oblique_lock_and_cancels_the_contact_at_the_start() -> None:
    ask = TRIALS["T3-rotated"].study.ask(COARSE)
    assert ADAPTER.refuses(ask, "default") is None
    (sphere,) = plan(ask)["spheres"]
    assert sphere["free"] == [True, True, False]
    assert np.linalg.norm(sphere["start"]) < 1e-12 * np.linalg.norm(sphere["force"])


def test_the_face_of_a_wall_lies_in_it_and_looks_out_of_it() -> None:
    ask = TRIALS["T3-rotated"].study.ask(COARSE)
    (wall,), (corners,) = ask.scene.walls, plan(ask)["walls"]
    a, b, c, d = np.array(corners)
    half = np.linalg.norm(b - a) / 2
    assert np.cross(b - a, c - b) @ wall.normal == pytest.approx(4 * half**2)
    assert np.abs(([a, b, c, d] - wall.point) @ wall.normal).max() < 1e-12 * half
    assert half > 100 * ask.scene.spheres.radius.max()


def test_without_friction_shear_springs_carry_nothing() -> None:
    given = plan(TRIALS["T1"].study.ask(COARSE))
    assert given["mu"] == 0.0
    assert given["law"]["ks"] > 0


@pytest.mark.parametrize(
    ("shear", "fits"), [(0.0, True), (0.2e9, True), (0.1e9, False), (0.4e9, False)]
)
def test_moduli_of_contacts_are_refused_if_no_material_has_them(shear: float, fits: bool) -> None:
    reason = ADAPTER.refuses(struck(Hertz(1e9, shear)), "default")
    assert (reason is None) is fits
    assert fits or "none with a possible Poisson's ratio has these moduli" in str(reason)


@only_with(ADAPTER)
def test_elastic_spheres_strike_a_wall_or_each_other_to_second_order(tmp_path: Path) -> None:
    """A frictionless blow on a wall or on a sphere alike keeps all speed, by Hertz' duration."""
    asks = [struck(Hertz(1e9, 0.2e9), pair, dt) for pair in (False, True) for dt in (2e-6, 1e-6)]
    for number, run in enumerate(ran(ADAPTER, asks, "default", tmp_path)):
        ask = asks[number]
        mass = ask.scene.spheres.mass[0] / len(ask.scene.spheres)
        radius = 0.1 / len(ask.scene.spheres)
        lasting = hertz.contact_time(
            m=mass, K=hertz.normal_factor(modulus=1e9, radius=radius), v=1.0
        )
        moved = [run.values[seen][-1, 0] for seen in ask.observables]
        left = moved[0] - (moved[1] if len(moved) > 1 else 0.0)
        off = left - (run.times[-1] - lasting)
        assert abs(off) < 3e-4 * (2.0 if number % 2 == 0 else 1.0) ** 2 * lasting, number


@only_with(ADAPTER)
def test_single_contacts_are_of_second_order(tmp_path: Path) -> None:
    steps = (1e-3, 5e-4)
    asks = [TRIALS[name].study.ask(Knobs(dt=dt)) for name in UNDRAGGED for dt in steps]
    runs = iter(ran(ADAPTER, asks, "default", tmp_path))
    for name in UNDRAGGED:
        coarse, fine = (error(next(runs), name) for _ in steps)
        assert coarse < 1e-4, name
        assert fine < coarse / 2.5, name
