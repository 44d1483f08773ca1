"""Claims about the tiny scenes of `vv check`: codes get them right, and any wrong term is seen."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import adapters.dem
from tests.support.installed import require
from vv.codes import Adapter
from vv.codes.greetings import Greeting, greetings
from vv.codes.handshake import Grip, Handshake, judged
from vv.plan.project import find
from vv.scene import Bonds, Contact, Hertz, Scene, Spheres, Term, Wall

FIRST_ORDER = "it claims order 2 in dt, and 1.0 was seen"  # of drag, which is on record
DEM = adapters.dem.ADAPTER
Wrong = Callable[[Scene], Scene]


def asked(adapter: Adapter, folder: Path) -> Iterator[tuple[str, Handshake]]:
    """What is said of every tiny scene that an adapter's default scheme takes."""
    scheme = adapter.schemes[0]
    taken = [
        one
        for one in greetings(scheme)
        if adapter.refuses(one.asks(scheme)[0], scheme.name) is None
    ]
    asks = [one.asks(scheme) for one in taken]
    runs = iter(adapter.run([ask for each in asks for ask in each], scheme.name, folder, 0.0))
    for one, each in zip(taken, asks, strict=True):
        yield one.name, judged(scheme, one, [next(runs) for _ in each])


@pytest.mark.parametrize("code", ["dem", "dda", "rigid", "yade", "liggghts"])
def test_codes_get_every_tiny_scene_right(code: str, tmp_path: Path) -> None:
    adapter = find().load_adapter(code)
    require(adapter)
    found = dict(asked(adapter, tmp_path))
    wrong = {name: one.words for name, one in found.items() if one.grip is not Grip.FIRM}
    assert FIRST_ORDER in wrong.pop("drag", FIRST_ORDER)
    assert wrong == {}
    assert len(found) >= {"dda": 3, "rigid": 1}.get(code, 15)


def _law(**changed: Any) -> Wrong:
    return lambda scene: dataclasses.replace(
        scene, contact=dataclasses.replace(scene.contact, **changed)
    )


def _times(name: str, by: float) -> Wrong:
    return lambda scene: _law(**{name: by * getattr(scene.contact, name)})(scene)


def _hertz(**changed: Any) -> Wrong:
    def wrong(scene: Scene) -> Scene:
        law = dataclasses.replace(scene.contact.hertz or Hertz(1.0), **changed)
        return dataclasses.replace(scene, contact=Contact(0.0, hertz=law))

    return wrong


def _bonds(**times: float) -> Wrong:
    def wrong(scene: Scene) -> Scene:
        assert isinstance(scene.bonds, Bonds)
        changed = {name: by * getattr(scene.bonds, name) for name, by in times.items()}
        return dataclasses.replace(scene, bonds=dataclasses.replace(scene.bonds, **changed))

    return wrong


def _spheres(change: Callable[[Spheres], Spheres]) -> Wrong:
    return lambda scene: dataclasses.replace(
        scene, bodies=tuple(change(b) if isinstance(b, Spheres) else b for b in scene.bodies)
    )


def _far_walls(scene: Scene) -> Scene:
    bodies = tuple(
        dataclasses.replace(b, point=b.point - 9.0 * b.normal) if isinstance(b, Wall) else b
        for b in scene.bodies
    )
    return dataclasses.replace(scene, bodies=bodies)


def _still(scene: Scene) -> Scene:
    bodies = tuple(
        dataclasses.replace(b, motion=None) if isinstance(b, Wall) else b for b in scene.bodies
    )
    return dataclasses.replace(scene, bodies=bodies)


def _aside(scene: Scene) -> Scene:
    held, flying = scene.bodies
    assert isinstance(held, Spheres)
    away = dataclasses.replace(held, position=held.position + np.array([1.0, 0.0, 0.0]))
    return dataclasses.replace(scene, bodies=(away, flying))


WRONG: dict[Term, tuple[Wrong, ...]] = {
    Term.SPHERE: (_spheres(lambda s: dataclasses.replace(s, velocity=0.9 * s.velocity)),),
    Term.SPHERE_CONTACT: (_aside, _times("kn", 1.5)),
    Term.WALL_CONTACT: (_far_walls, _times("kn", 1.5)),
    Term.FRICTION: (_times("mu", 2.0), _times("mu", 0.5), _times("ks", 2.0), _law(mu=0.0)),
    Term.DRAG: tuple(
        lambda s, by=by: dataclasses.replace(s, eta=by * s.eta)  # type: ignore[misc]
        for by in (0.0, 0.8, 1.2)
    ),
    Term.FLUID: (
        lambda s: dataclasses.replace(s, fluid=None),
        lambda s: dataclasses.replace(
            s, fluid=s.fluid and dataclasses.replace(s.fluid, viscosity=1.2 * s.fluid.viscosity)
        ),
        lambda s: dataclasses.replace(
            s, fluid=s.fluid and dataclasses.replace(s.fluid, density=1.2 * s.fluid.density)
        ),
    ),
    Term.GRAVITY: (lambda s: dataclasses.replace(s, gravity=1.1 * s.gravity),),
    Term.LOAD: (_spheres(lambda s: dataclasses.replace(s, load=1.1 * s.load)),),
    Term.ROTATION: (_spheres(lambda s: dataclasses.replace(s, free_spin=s.free_spin & False)),),
    Term.OBLIQUE_LOCK: (_spheres(lambda s: dataclasses.replace(s, free=s.free | True)),),
    Term.SHAKING: (lambda s: dataclasses.replace(s, shaking=None),),
    Term.BASE_MOTION: (_still,),
    Term.BOND: (_bonds(kn=1.5), lambda s: dataclasses.replace(s, bonds=None)),
    Term.BOND_SHEAR: (_bonds(ks=1.5), _bonds(ks=0.0)),
    Term.BREAKAGE: (_bonds(tension=1.2), _bonds(tension=0.8)),
    Term.CARRIED: (_spheres(lambda s: dataclasses.replace(s, velocity=s.velocity * s.free)),),
    Term.CONTACT_VISCOSITY: (_times("eta_n", 1.2), _law(eta_n=0.0)),
    Term.HERTZ: (_hertz(modulus=1.3e7), _hertz(modulus=0.7e7)),
    Term.HERTZ_VISCOSITY: (_hertz(damping=0.0), _hertz(damping=0.25)),
    Term.VISCOUS_FRICTION: (_law(mu=0.0), _times("mu", 1.2)),
}  # fmt: skip


def told(greeting: Greeting, wrong: Wrong) -> Handshake:
    """What is said of a code that has something wrong, as another scene is right."""
    (*_, ask) = greeting.asks(DEM.schemes[0])
    mistaken = dataclasses.replace(ask, scene=wrong(ask.scene))
    (run,) = DEM.run([mistaken], "default", Path(), 0.0)
    return judged(DEM.schemes[0], greeting, [run])


def seen(greeting: Greeting, wrong: Wrong) -> bool:
    """Whether a tiny scene tells a code that has something wrong."""
    if greeting.scene.digest() == wrong(greeting.scene).digest():
        return False
    return told(greeting, wrong).grip is Grip.WRONG


@pytest.mark.parametrize("term", WRONG, ids=lambda term: term.name)
def test_a_code_with_any_one_declared_term_wrong_is_told(term: Term) -> None:
    known = [one for one in greetings(DEM.schemes[0]) if term in one.scene.terms()]
    assert known
    for wrong in WRONG[term]:
        assert any(seen(one, wrong) for one in known), term


def test_a_wrong_answer_is_tried_for_every_term_that_spheres_show() -> None:
    shown = frozenset().union(*(one.scene.terms() for one in greetings(DEM.schemes[0])))
    assert shown - {Term.BLOCK, Term.RIGID_CONTACT} == set(WRONG)


@pytest.mark.parametrize(
    ("name", "wrong", "words"),
    [
        ("roll", WRONG[Term.ROTATION][0], "rotation is left out"),
        ("roll", _times("mu", 0.5), "friction is half as strong"),
        ("roll", _times("mu", 1e3), "friction has no limit"),
        ("skid", _times("mu", 1e3), "friction has no limit"),
        ("skid", _times("mu", 2.0), "friction has no limit, or twice"),
    ],
)
def test_friction_and_rotation_that_are_wrong_are_named(
    name: str, wrong: Wrong, words: str
) -> None:
    known = {one.name: one for one in greetings(DEM.schemes[0])}
    assert f"it looks as if {words}" in told(known[name], wrong).words


def test_an_answer_a_little_off_is_not_taken_for_axes_in_their_own_order() -> None:
    known = {one.name: one for one in greetings(DEM.schemes[0])}
    assert told(known["roll"], _times("ks", 1.12)).words.startswith("wrong by")
    assert "x, y, z" not in told(known["roll"], _times("ks", 1.12)).words
