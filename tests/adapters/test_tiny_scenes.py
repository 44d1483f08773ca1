"""Claims about the tiny scenes of `vv check`: codes get them right, and any wrong term is seen."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import adapters.dda
import adapters.dem
from tests.support.installed import require
from vv.codes import Adapter
from vv.codes.tiny_scene_check import Answered, CheckResult, judged
from vv.codes.tiny_scenes import TinyScene, tiny_scenes
from vv.plan.project import find
from vv.scene import Block, Bonds, Contact, Hertz, Scene, Spheres, Term, Wall

FIRST_ORDER = "it claims order 2 in dt, and 1.0 was seen"  # of drag, which is on record
DEM = adapters.dem.ADAPTER
Wrong = Callable[[Scene], Scene]


def asked(adapter: Adapter, folder: Path) -> Iterator[tuple[str, CheckResult]]:
    """What is said of every tiny scene that an adapter's default scheme takes."""
    scheme = adapter.schemes[0]
    taken = [
        one
        for one in tiny_scenes(scheme)
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
    wrong = {name: one.words for name, one in found.items() if one.answered is not Answered.RIGHT}
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


def told(tiny: TinyScene, wrong: Wrong, code: Adapter = DEM) -> CheckResult:
    """What is said of a code that has something wrong, as another scene is right."""
    scheme = code.schemes[0]
    (*_, ask) = tiny.asks(scheme)
    mistaken = dataclasses.replace(ask, scene=wrong(ask.scene))
    (run,) = code.run([mistaken], scheme.name, Path(), 0.0)
    return judged(scheme, tiny, [run])


def seen(tiny: TinyScene, wrong: Wrong) -> bool:
    """Whether a tiny scene tells a code that has something wrong."""
    if tiny.scene.digest() == wrong(tiny.scene).digest():
        return False
    return told(tiny, wrong).answered is Answered.WRONG


@pytest.mark.parametrize("term", WRONG, ids=lambda term: term.name)
def test_a_code_with_any_one_declared_term_wrong_is_told(term: Term) -> None:
    known = [one for one in tiny_scenes(DEM.schemes[0]) if term in one.scene.terms()]
    assert known
    for wrong in WRONG[term]:
        assert any(seen(one, wrong) for one in known), term


def test_a_wrong_answer_is_tried_for_every_term_that_spheres_show() -> None:
    shown = frozenset().union(*(one.scene.terms() for one in tiny_scenes(DEM.schemes[0])))
    assert shown - {Term.BLOCK, Term.RIGID_CONTACT} == set(WRONG)


def _scene(**of: Callable[[Any], Any]) -> Wrong:
    """A scene with fields made from what they were."""
    return lambda scene: dataclasses.replace(
        scene, **{name: change(getattr(scene, name)) for name, change in of.items()}
    )


def _sphere(**of: Callable[[Any], Any]) -> Wrong:
    return _spheres(
        lambda s: dataclasses.replace(s, **{n: change(getattr(s, n)) for n, change in of.items()})
    )


def _wave(amplitude: float = 1.0, phase: float = 1.0) -> Wrong:
    return _scene(
        shaking=lambda one: dataclasses.replace(
            one, amplitude=amplitude * one.amplitude, phase=phase * one.phase
        )
    )


def _fluid(by: float, share: float) -> Wrong:
    """A drag so many times as strong, of which the second term has so large a share."""
    return _scene(
        fluid=lambda one: dataclasses.replace(
            one, viscosity=by * one.viscosity, density=max(by * share, 1e-9) * one.density
        )
    )


def _block(**of: Callable[[Any], Any]) -> Wrong:
    return lambda scene: dataclasses.replace(
        scene, bodies=tuple(
            dataclasses.replace(b, **{n: change(getattr(b, n)) for n, change in of.items()})
            if isinstance(b, Block) else b
            for b in scene.bodies
        )
    )  # fmt: skip


def _by(factor: float) -> Callable[[Any], Any]:
    return lambda value: factor * value


def _nothing(_: Any) -> None:
    return None


MASS = 3.0  # kg, of every sphere and block
UNIT_DENSITY = 4 / 3 * np.pi * 0.1**3  # kg
MET: dict[str, Wrong] = {
    "contact is twice as stiff": _times("kn", 2.0),
    "contact is half as stiff": _times("kn", 0.5),
    "contact has another mass": _sphere(mass=_by(UNIT_DENSITY / MASS)),
}
LIKE: dict[str, dict[str, Wrong]] = {
    "free flight": {
        "gravity is left out": _scene(gravity=_by(0.0)),
        "gravity is reversed": _scene(gravity=_by(-1.0)),
        "gravity is taken twice": _scene(gravity=_by(2.0)),
        "gravity is a force": _scene(gravity=_by(1 / MASS)),
    },
    "dead load": {
        "the load is left out": _sphere(load=_by(0.0)),
        "the load is reversed": _sphere(load=_by(-1.0)),
        "the load is taken twice": _sphere(load=_by(2.0)),
        "the load is an acceleration": _sphere(load=_by(MASS)),
    },
    "bounce": {"contact is left out": _far_walls, **MET},
    "collision": {"contact is left out": _aside, **MET},
    "lock": {"the lock is not kept": _sphere(free=lambda free: free | True)},
    "oblique lock": {"the lock is not kept": _sphere(free=lambda free: free | True)},
    "carried": {"locked directions stand still": WRONG[Term.CARRIED][0]},
    "drag": {
        "drag is left out": _scene(eta=_by(0.0)),
        "drag is twice as strong": _scene(eta=_by(2.0)),
        "drag is half as strong": _scene(eta=_by(0.5)),
        "drag is a rate": _scene(eta=_by(MASS)),
    },
    "fluid": {
        "the fluid is left out": _scene(fluid=_nothing),
        "drag grows as the speed alone": _fluid(1.0, 0.0),
        "drag of the fluid is twice as strong": _fluid(2.0, 1.0),
        "drag of the fluid is half as strong": _fluid(0.5, 1.0),
    },
    "shaking": {
        "shaking is left out": _scene(shaking=_nothing),
        "shaking is reversed": _wave(amplitude=-1.0),
        "the phase of shaking is left out": _wave(phase=0.0),
    },
    "moving wall": {"the wall stands still": _still},
    "dashpot": {
        "the dashpot is left out": _times("eta_n", 0.0),
        "the dashpot is twice as strong": _times("eta_n", 2.0),
        "the dashpot is half as strong": _times("eta_n", 0.5),
    },
    "Hertz's contact": {
        "contact is left out": _far_walls,
        "contact is twice as stiff": _hertz(modulus=2e7),
        "contact is half as stiff": _hertz(modulus=0.5e7),
    },
    "viscous Hertz": {"viscosity is left out": _hertz(damping=0.0)},
    "skid": {
        "friction is left out": _law(mu=0.0),
        "friction is half as strong": _times("mu", 0.5),
        "the shear spring is twice as stiff": _times("ks", 2.0),
        "the shear spring is half as stiff": _times("ks", 0.5),
        "friction has no limit": _times("mu", 1e3),
        "friction has no limit, or twice": _times("mu", 2.0),
    },
    "roll": {
        "rotation is left out": WRONG[Term.ROTATION][0],
        "friction is left out": _law(mu=0.0),
        "friction is half as strong": _times("mu", 0.5),
        "friction has no limit": _times("mu", 1e3),
    },
    "viscous skid": {
        "friction is left out": _law(mu=0.0),
        "friction is twice as strong": _times("mu", 2.0),
    },
    "bond": {
        "the bond is left out": _scene(bonds=_nothing),
        "the bond is twice as stiff": _bonds(kn=2.0),
        "the bond is half as stiff": _bonds(kn=0.5),
    },
    "shear of a bond": {
        "a bond resists no shear": _bonds(ks=0.0),
        "a bond is as stiff across as along": _bonds(ks=2.5),
        "a bond is twice as stiff across": _bonds(ks=2.0),
        "a bond is half as stiff across": _bonds(ks=0.5),
    },
    "breakage": {
        "the bond does not break": _bonds(tension=1e3),
        "the bond is left out": _scene(bonds=_nothing),
    },
    "flight of a block": {
        "gravity is left out": _scene(gravity=_by(0.0)),
        "gravity is reversed": _scene(gravity=_by(-1.0)),
        "gravity is taken twice": _scene(gravity=_by(2.0)),
    },
    "dead load on a block": {
        "the load is left out": _block(load=_by(0.0)),
        "the load is reversed": _block(load=_by(-1.0)),
    },
    "slide of a block": {
        "contact is left out": _far_walls,
        "friction is left out": _law(mu=0.0),
        "friction is twice as strong": _times("mu", 2.0),
        "friction is half as strong": _times("mu", 0.5),
    },
}
BY_HAND = {"the shear force is reversed", "friction turns it the other way", "friction pulls along"}


def _checked() -> dict[str, tuple[Adapter, TinyScene]]:
    """Every tiny scene, with an in-house code that takes it."""
    offered = [
        (code, one, one.asks(code.schemes[0])[0], code.schemes[0].name)
        for code in (adapters.dda.ADAPTER, DEM)
        for one in tiny_scenes(code.schemes[0])
    ]
    return {
        one.name: (code, one)
        for code, one, ask, scheme in offered
        if code.refuses(ask, scheme) is None
    }


@pytest.mark.parametrize("name", LIKE)
def test_a_mistake_is_named_as_what_it_is_by_how_such_a_scene_moves(name: str) -> None:
    code, tiny = _checked()[name]
    for words, wrong in LIKE[name].items():
        assert f"it looks as if {words}" in told(tiny, wrong, code).words, words


def test_every_mistake_that_is_named_is_in_the_table_or_found_by_hand() -> None:
    for name, (_, tiny) in _checked().items():
        for words in tiny.mistakes.keys() - BY_HAND:
            assert any(words.startswith(one) for one in LIKE[name]), (name, words)


def test_a_pulse_moves_a_body_as_shaking_does_until_it_ends() -> None:
    every = dataclasses.replace(DEM.schemes[0], terms=frozenset(Term))
    known = {one.name: one for one in tiny_scenes(every)}
    pulse, shaken = known["pulse"], known["shaking"]
    t = np.linspace(0.0, 1.0, 21)
    (moved, speed), (on, fast) = pulse.motion(t), shaken.motion(t)
    assert pulse.mistakes["the pulse does not end"](t)[0] == pytest.approx(on)
    assert moved[:11] == pytest.approx(on[:11])  # until 0.5 s
    assert speed[:11] == pytest.approx(fast[:11])
    assert speed[11:] == pytest.approx(np.tile(fast[10], (10, 1)))
    assert moved[11:] == pytest.approx(on[10] + np.outer(t[11:] - 0.5, fast[10]))


def test_forces_that_act_the_wrong_way_move_a_body_as_their_equations_do() -> None:
    t = np.linspace(0.0, 0.5, 11)
    skid, roll = (_checked()[name][1] for name in ("skid", "roll"))
    law, mass = skid.scene.contact, skid.scene.spheres.mass[0]
    limit = law.mu * 60.0  # N, of what presses

    def driven(_: float, state: Any) -> list[float]:
        return [state[1], min(law.ks * state[0], limit) / mass]

    path = solve_ivp(driven, (0.0, 0.5), [0.0, 1.0], t_eval=t, rtol=1e-9, atol=1e-12).y
    moved, speed = skid.mistakes["the shear force is reversed"](t)
    assert np.linalg.norm(moved, axis=1) == pytest.approx(path[0], rel=1e-6, abs=1e-9)
    assert np.linalg.norm(speed, axis=1) == pytest.approx(path[1], rel=1e-6)
    way = roll.mistakes["the shear force is reversed"](t)[0]  # slip: 3.5 times what it loses
    slip = 3.5 * (np.linalg.norm(way, axis=1) - t) + t
    assert slip == pytest.approx(path[0], rel=1e-6, abs=1e-9)

    rolls = roll.scene.contact

    def spun_up(_: float, state: Any) -> list[float]:  # slip grows by (5/2 - 1) F/m
        force = min(rolls.ks * state[0], rolls.mu * 60.0)
        return [state[1], 1.5 * force / mass, state[3], -force / mass]

    back = roll.mistakes["friction turns it the other way"](t)[0]
    path = solve_ivp(spun_up, (0.0, 0.5), [0.0, 1.0, 0.0, 1.0], t_eval=t, rtol=1e-9, atol=1e-12).y
    assert np.linalg.norm(back, axis=1) == pytest.approx(path[2], rel=1e-6, abs=1e-9)
    block = _checked()["slide of a block"][1].mistakes["friction pulls along"](t)[0]
    assert np.linalg.norm(block, axis=1) == pytest.approx(t + (6.0 + 0.4 * 8.0) * t**2 / 2)


def test_an_answer_a_little_off_is_not_taken_for_axes_in_their_own_order() -> None:
    known = {one.name: one for one in tiny_scenes(DEM.schemes[0])}
    assert told(known["roll"], _times("ks", 1.12)).words.startswith("wrong by")
    assert "x, y, z" not in told(known["roll"], _times("ks", 1.12)).words
