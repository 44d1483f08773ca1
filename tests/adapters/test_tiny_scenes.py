"""Claims about the tiny scenes of `vv check`: codes get them right, and any wrong term is seen."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import adapters.dda
import adapters.dem
from tests.support.installed import require
from tests.support.wrong_scenes import (
    ALL_FREE,
    WRONG,
    Change,
    body,
    bond,
    contact,
    elastic,
    far_walls,
    put,
    times,
    wall,
)  # fmt: skip
from vv.codes import Adapter
from vv.codes.tiny_scene_check import Answered, CheckResult, judged
from vv.codes.tiny_scenes import TinyScene, tiny_scenes
from vv.plan.project import find
from vv.scene import Scene, Spheres, Term

FIRST_ORDER = "it claims order 2 in dt, and 1.0 was seen"  # of drag, which is on record
DEM = adapters.dem.ADAPTER


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


def _aside(scene: Scene) -> Scene:
    """The held sphere where the other does not meet it."""
    held, flying = scene.bodies
    assert isinstance(held, Spheres)
    away = dataclasses.replace(held, position=held.position + np.array([1.0, 0.0, 0.0]))
    return dataclasses.replace(scene, bodies=(away, flying))


def _fluid(**factors: float) -> Change:
    """Constants of the fluid multiplied."""

    def change(scene: Scene) -> Scene:
        one = scene.fluid
        assert one is not None
        own = {name: getattr(one, name) * by for name, by in factors.items()}
        return dataclasses.replace(scene, fluid=dataclasses.replace(one, **own))

    return change


TERMS: dict[Term, tuple[Change, ...]] = {
    Term.SPHERE: (body(velocity=times(0.9)),),
    Term.SPHERE_CONTACT: (_aside, contact(kn=1.5)),
    Term.WALL_CONTACT: (far_walls, contact(kn=1.5)),
    Term.FRICTION: (contact(mu=2.0), contact(mu=0.5), contact(ks=2.0), contact(mu=0.0)),
    Term.DRAG: (put(eta=times(0.0)), put(eta=times(0.8)), put(eta=times(1.2))),
    Term.FLUID: (put(fluid=None), _fluid(viscosity=1.2), _fluid(density=1.2)),
    Term.GRAVITY: (put(gravity=times(1.1)),),
    Term.LOAD: (body(load=times(1.1)),),
    Term.ROTATION: (body(free_spin=~ALL_FREE),),
    Term.OBLIQUE_LOCK: (body(free=ALL_FREE),),
    Term.SHAKING: (put(shaking=None),),
    Term.BASE_MOTION: (wall(None),),
    Term.BOND: (bond(kn=1.5), put(bonds=None)),
    Term.BOND_SHEAR: (bond(ks=1.5), bond(ks=0.0)),
    Term.BREAKAGE: (bond(tension=1.2), bond(tension=0.8)),
    Term.CARRIED: tuple(WRONG["carried"].values()),
    Term.CONTACT_VISCOSITY: (contact(eta_n=1.2), contact(eta_n=0.0)),
    Term.HERTZ: (elastic(1.3), elastic(0.7)),
    Term.HERTZ_VISCOSITY: (elastic(damping=0.0), elastic(damping=0.5)),
    Term.VISCOUS_FRICTION: (contact(mu=0.0), contact(mu=1.2)),
}


def told(tiny: TinyScene, wrong: Change, code: Adapter = DEM) -> CheckResult:
    """What is said of a code that has something wrong, as another scene is right."""
    scheme = code.schemes[0]
    (*_, ask) = tiny.asks(scheme)
    mistaken = dataclasses.replace(ask, scene=wrong(ask.scene))
    (run,) = code.run([mistaken], scheme.name, Path(), 0.0)
    return judged(scheme, tiny, [run])


def seen(tiny: TinyScene, wrong: Change) -> bool:
    """Whether a tiny scene tells a code that has something wrong."""
    if tiny.scene.digest() == wrong(tiny.scene).digest():
        return False
    return told(tiny, wrong).answered is Answered.WRONG


@pytest.mark.parametrize("term", TERMS, ids=lambda term: term.name)
def test_a_code_with_any_one_declared_term_wrong_is_told(term: Term) -> None:
    known = [one for one in tiny_scenes(DEM.schemes[0]) if term in one.scene.terms()]
    assert known
    for wrong in TERMS[term]:
        assert any(seen(one, wrong) for one in known), term


def test_a_wrong_answer_is_tried_for_every_term_that_spheres_show() -> None:
    shown = frozenset().union(*(one.scene.terms() for one in tiny_scenes(DEM.schemes[0])))
    assert shown - {Term.BLOCK, Term.RIGID_CONTACT} == set(TERMS)


NEITHER = {"pulse"}  # which neither `dda` nor `dem` takes
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


@pytest.mark.parametrize("name", sorted(WRONG.keys() - NEITHER))
def test_a_mistake_is_named_as_what_it_is_by_how_such_a_scene_moves(name: str) -> None:
    code, tiny = _checked()[name]
    for words, wrong in WRONG[name].items():
        assert f"it looks as if {words}" in told(tiny, wrong, code).words, words


def test_every_mistake_that_is_named_is_in_the_table_or_found_by_hand() -> None:
    for name, (_, tiny) in _checked().items():
        for words in tiny.mistakes.keys() - BY_HAND:
            assert words in WRONG[name], (name, words)


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
    assert told(known["roll"], contact(ks=1.12)).words.startswith("wrong by")
    assert "x, y, z" not in told(known["roll"], contact(ks=1.12)).words
