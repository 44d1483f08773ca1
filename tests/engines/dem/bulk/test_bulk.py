"""Claims about the model of many free spheres: it moves them as the general model does."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import dem
from vv.engines.dem.bulk.model import Bulk, bulk
from vv.engines.dem.space.model import Space, space
from vv.scene import Contact, Hertz, Scene, Spheres, Vector, Wall

RADIUS, COUNT, DT = 0.01, (5, 5, 4), 2e-5
ASKEW = np.array([[1.0, 0.5, 0.2], [-0.6, 1.0, 0.4], [0.1, -0.7, 1.0]])
LAWS = {
    "springs, friction, dashpots, drag": (Contact(1e5, 2e4, 0.5, 0.3), 2e-3),
    "elastic spheres that rub": (Contact(0.0, mu=0.4, hertz=Hertz(1e8, 8e7)), 0.0),
}


def crowd(
    contact: Contact,
    eta: float = 0.0,
    walls: bool = True,
    across: tuple[int, int, int] = COUNT,
) -> Scene:
    """Unequal spheres in no regular order, in a box that is oblique to all cells."""
    random, count = np.random.default_rng(3), int(np.prod(across))
    grid = np.stack(np.meshgrid(*map(np.arange, across), indexing="ij"), 3).reshape(-1, 3)
    position = RADIUS * (2.2 * random.permutation(grid) + 0.04 * random.normal(size=(count, 3)))
    radius, turned = RADIUS * random.uniform(0.9, 1.0, count), np.linalg.qr(ASKEW)[0]
    spheres = Spheres(
        position @ turned, 0.5 * random.normal(size=(count, 3)), radius, 1e4 * radius**3,
        free=np.ones((count, 3), bool), free_spin=np.ones((count, 3), bool),
        spin=10 * random.normal(size=(count, 3)),
    )  # fmt: skip
    planes = [Wall(-1.05 * RADIUS * np.ones(3) @ turned, n) for n in turned]
    planes += [Wall(2.2 * RADIUS * (np.array(across) - 0.5) @ turned, -n) for n in turned]
    down = np.array([0.0, 0.0, -9.81]) if walls else np.zeros(3)
    return Scene((spheres, *(planes if walls else ())), contact, eta=eta, gravity=down)


def moved(
    model: Bulk | Space, steps: int, leapfrog: dem.Leapfrog, count: int = int(np.prod(COUNT))
) -> tuple[Vector, Vector]:
    """Path (2, n, 6 or 9) and energies (2, 7) at the start and after a number of steps."""
    outputs: Any = model.outputs(2, tuple(range(count)))
    path, energy, watched = outputs
    run = model.kernel()
    assert run(path, energy, watched, steps, DT, *model.state, leapfrog.lag, leapfrog.back) == 2
    return path, energy


@pytest.mark.parametrize("law", LAWS)
def test_spheres_move_as_in_the_general_model(law: str) -> None:
    """Differences are rounding, grown in 600 steps in which contacts change several times."""
    scene = crowd(*LAWS[law])
    fast = bulk(scene)
    assert fast is not None
    assert fast.terms == scene.terms()
    for leapfrog in (dem.CENTRED, dem.LAGGED):
        (path, energy), (other, others) = (
            moved(model, 600, leapfrog) for model in (fast, space(scene))
        )
        assert energy[1, 3] > 0.01 * energy[0, 0], "friction takes a share"
        went = np.linalg.norm(path[1, :, :3], axis=1)
        assert np.median(went) > 0.2 * RADIUS, "many go from cell to cell"
        for columns in (slice(0, 3), slice(3, 6), slice(6, 9)):
            one, two = path[1, :, columns], other[1, :, columns]
            assert np.abs(one - two).max() <= 1e-7 * np.abs(two).max()
        assert energy[1] == pytest.approx(others[1], rel=1e-8, abs=1e-12 * energy[0, 0])


@pytest.mark.parametrize("mu", [0.0, 0.5])
def test_spheres_of_several_chunks_move_as_in_the_general_model(mu: float) -> None:
    """Two thousand are divided into chunks with contacts across borders; some have no friction."""
    scene = crowd(Contact(1e5, 2e4 if mu > 0 else 0.0, mu), 2e-3, across=(10, 10, 21))
    fast, count = bulk(scene), len(scene.spheres)
    assert fast is not None
    (path, energy), (other, others) = (
        moved(model, 150, dem.CENTRED, count) for model in (fast, space(scene))
    )
    for k in range(0, path.shape[2], 3):
        one, two = path[1, :, k : k + 3], other[1, :, k : k + 3]
        assert np.abs(one - two).max() <= 1e-10 * np.abs(two).max()
    assert energy[1] == pytest.approx(others[1], rel=1e-11, abs=1e-12 * energy[0, 0])


def test_momentum_is_kept_and_energy_explained() -> None:
    scene = crowd(*LAWS["springs, friction, dashpots, drag"], walls=False)
    law = Contact(scene.contact.kn, scene.contact.ks, scene.contact.mu)
    scene = Scene((scene.spheres,), law)
    fast, s = bulk(scene), scene.spheres
    assert fast is not None
    path, energy = moved(fast, 400, dem.CENTRED)
    x = s.position + path[:, :, :3]
    momentum = s.mass[:, None] * path[:, :, 3:6]
    moment = np.cross(x, momentum) + s.inertia[:, None] * path[:, :, 6:]
    size = np.abs(momentum[0]).sum(), np.abs(moment[0]).sum()
    for told, most in zip((momentum, moment), size, strict=True):
        total = told.sum(axis=1)
        assert np.abs(total[1] - total[0]).max() <= 1e-13 * most
    held = energy[:, :5].sum(axis=1)
    assert energy[1, 3] > 0.01 * held[0]
    assert held[1] == pytest.approx(held[0], rel=2e-3), "(w dt)^2/4 of contacts that close"


def partly_held(scene: Scene) -> Scene:
    """The same with every seventh sphere fixed; some of these overlap."""
    s = scene.spheres
    moving = (np.arange(len(s)) % 7 > 0)[:, None] * np.ones(3, bool)
    x = s.position.copy()
    x[7] = x[0] + np.array([1.7 * RADIUS, 0.0, 0.0])
    held = Spheres(
        x, s.velocity * moving, s.radius, s.mass, moving, free_spin=moving, spin=s.spin * moving
    )
    return replace(scene, bodies=(held, *scene.walls))


@pytest.mark.parametrize("law", LAWS)
def test_spheres_move_among_those_held_as_in_the_general_model(law: str) -> None:
    scene = partly_held(crowd(*LAWS[law]))
    fast = bulk(scene)
    assert fast is not None
    assert sum(array.size for array in fast.unknowns) == 6 * 85
    (path, energy), (other, others) = (
        moved(model, 300, dem.CENTRED) for model in (fast, space(scene))
    )
    assert not path[1, ::7].any()
    for k in (0, 3, 6):
        one, two = path[1, :, k : k + 3], other[1, :, k : k + 3]
        assert np.abs(one - two).max() <= 1e-9 * np.abs(two).max()
    assert energy[1] == pytest.approx(others[1], rel=1e-9, abs=1e-12 * energy[0, 0])


def test_few_spheres_and_those_that_are_held_in_part_are_left_to_the_general_model() -> None:
    scene = crowd(LAWS["elastic spheres that rub"][0])
    s = scene.spheres
    locked = np.ones_like(s.free)
    locked[0, 0] = False
    for changed in (
        s.part(slice(0, 60)),
        Spheres(s.position, s.velocity, s.radius, s.mass, locked, free_spin=s.free_spin),
        Spheres(s.position, s.velocity, s.radius, s.mass, s.free),
    ):
        assert bulk(Scene((changed,), scene.contact)) is None


def test_an_ask_of_many_free_spheres_is_given_the_bulk_model() -> None:
    scene = crowd(LAWS["elastic spheres that rub"][0])
    ask = Ask(scene, History(2 * DT, DT), (Displacement(0),), Knobs(DT))
    assert isinstance(dem.prepare(ask, dem.CENTRED).system, Bulk)


@pytest.mark.parametrize("sunk", [0.15, 0.05])
def test_of_many_spheres_the_deepest_contact_is_told_itself(sunk: float) -> None:
    """All are slightly compressed, so that one contact with all their energy would be deep."""
    grid = np.stack(np.meshgrid(*map(np.arange, (6, 6, 6)), indexing="ij"), 3).reshape(-1, 3)
    x = RADIUS * 1.97 * np.asarray(grid, float)
    x[0] -= (sunk - 0.03) * np.array([-RADIUS, 0.0, 0.0])
    free = np.ones((len(x), 3), bool)
    s = Spheres(x, np.zeros_like(x), np.full(len(x), RADIUS), np.full(len(x), 0.01), free)
    seen = tuple(Displacement(i) for i in range(len(x)))
    run = dem.solve_default(Ask(Scene((s,), Contact(1e5)), History(1e-9, 1e-9), seen, Knobs(1e-9)))
    assert run.ledger is not None
    told, allowed = run.ledger.audits["penetration [m]"]
    assert told == pytest.approx(sunk * RADIUS, rel=1e-4)
    assert (told > allowed) == (sunk > 0.1)


def test_crowds_share_a_kernel_whether_drag_slows_them_or_not() -> None:
    kinds = set()
    for eta in (0.0, 2e-3):
        model = bulk(crowd(Contact(1e5), eta))
        assert model is not None
        kernel: Any = model.kernel()
        kinds.add(tuple(map(kernel.typeof_pyval, model.state)))
    assert len(kinds) == 1
