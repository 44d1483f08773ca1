"""Claims about asks that programs cannot represent although they have every term: each is named."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from adapters import kratos, liggghts, pybullet, yade
from tests.adapters.kratos.test_kratos import struck
from tests.scene.test_scene import ALL, PARTLY, TURNED, balls, block, scene
from vv.ask import Ask, Displacement, History, Knobs, Reaction
from vv.codes import Adapter
from vv.scene import Contact, Harmonic, Hertz, Spheres, Wall

X, Y, Z = np.eye(3)
CODES: dict[str, Adapter] = {
    "kratos": kratos.ADAPTER, "liggghts": liggghts.ADAPTER, "yade": yade.ADAPTER,
}  # fmt: skip
FREE, HELD = np.ones(3, bool), np.zeros(3, bool)
ALONG = np.array([True, False, True])  # locked along the second axis of the frame
Told = dict[str, str]


def asked(*bodies: Spheres | Wall, body: int = 0, kind: Any = Displacement, **given: Any) -> Ask:
    one = scene(*bodies, **given)
    return Ask(one, History(0.1, 0.01), (kind(body),), Knobs(1e-3))


def on(codes: str, why: str) -> Told:
    """The same words of several codes."""
    return dict.fromkeys(codes.split(), why)


SPHERES = "kratos liggghts yade"
SPIN = "a velocity or spin in a locked freedom, which LIGGGHTS would maintain"
SIX = balls(spin=np.full((1, 3), 6.0))
REFUSED: list[tuple[str, Ask, Told]] = [
    ("nothing", asked(balls()), {}),
    ("a wall that is watched", asked(Wall(-9 * X, X), balls()),
     on(SPHERES, "body 0 is not a sphere")),
    ("a centre behind a wall", asked(balls(), Wall(X, X), body=0),
     on(SPHERES, "the centre of sphere 0 lies behind wall 0")),
    ("a spin that is locked", asked(SIX), {
        **on("kratos yade", "a sphere has a spin in a locked freedom"), "liggghts": SPIN,
    }),
    ("the same spin, free", asked(dataclasses.replace(SIX, free_spin=np.ones((1, 3), bool))), {}),
    ("rotations locked in a turned frame", asked(balls(free_spin=PARTLY), axes=TURNED), {
        **on("kratos yade", "rotation is locked about some axes of a turned frame"),
        "liggghts": "a sphere can rotate about some axes only",
    }),
    ("a slanted lock that is shaken",
     asked(balls(free=ALONG), axes=TURNED, shaking=Harmonic(Y, Y, axes=TURNED)),
     on(SPHERES, "oblique to the frame, and driven along it")),
    ("a slanted lock that is shaken elsewhere",
     asked(balls(free=ALONG), axes=TURNED, shaking=Harmonic(X, X, axes=TURNED)), {}),
    ("a slanted lock whose force is asked for",
     asked(balls(free=ALONG), axes=TURNED, kind=Reaction), {"yade": "reaction of oblique locks"}),
    ("a velocity that is locked", asked(balls(free=ALONG, velocity=Y)), {"liggghts": SPIN}),
    ("nothing that is free", asked(balls(free=HELD)), {"liggghts": "no sphere is free to move"}),
    ("a hollow sphere that turns",
     asked(dataclasses.replace(balls(free_spin=FREE), inertia=np.array([1.0]))),
     {"liggghts": "is not 2/5 m r2"}),
]  # fmt: skip


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize(("ask", "told"), [row[1:] for row in REFUSED], ids=[r[0] for r in REFUSED])
def test_what_a_code_of_spheres_cannot_represent_is_refused_by_name(
    code: str, ask: Ask, told: Told
) -> None:
    why = CODES[code].refuses(ask, "default")
    assert (why is None) is (code not in told), why
    assert told.get(code, "") in (why or "")


@pytest.mark.parametrize("code", ["liggghts", "yade"])
def test_half_a_step_of_drag_needs_drag(code: str) -> None:
    adapter = CODES[code]
    assert "there is no drag" in (adapter.refuses(asked(balls()), "half-step-mass") or "")
    assert adapter.refuses(asked(balls(), eta=0.5), "half-step-mass") is None


@pytest.mark.parametrize(
    ("ratio", "fits"), [(0.0, True), (0.16, False), (0.17, True), (0.33, True), (0.34, False)]
)
def test_kratos_has_a_material_for_ratios_of_moduli_from_a_sixth_to_a_third(
    ratio: float, fits: bool
) -> None:
    """G/E = (1 - nu)/(4 - 2 nu) is 1/6 at nu = 1/2 and 1/3 at nu = -1; 0 is no shear at all."""
    why = kratos.ADAPTER.refuses(struck(Hertz(1e9, ratio * 1e9)), "default")
    assert (why is None) is fits
    assert fits or "Kratos derives contacts from materials" in (why or "")


def standing(*walls: Wall, seen: int) -> Ask:
    """A block above walls; seen: the body whose displacement is asked for."""
    one = scene(*walls, block(free=ALL), contact=Contact(np.inf, mu=0.5))
    return Ask(one, History(0.1, 0.01), (Displacement(seen),), Knobs(1e-3))


def test_the_walls_of_pybullet_move_alike_and_are_not_watched() -> None:
    swung = Harmonic(0.01 * X, X)
    floor, side = Wall(-9 * Z, Z), Wall(-9 * X, X)
    moved = [dataclasses.replace(wall, motion=swung) for wall in (floor, side)]
    refuses = pybullet.ADAPTER.refuses
    for pair in ((floor, side), (moved[0], moved[1])):
        assert "move alike" not in (refuses(standing(*pair, seen=2), "default") or "")
    for pair in ((floor, moved[1]), (moved[0], side)):
        assert "all must move alike" in (refuses(standing(*pair, seen=2), "default") or "")
    why = refuses(standing(floor, side, seen=1), "default")
    assert why == "body 1 is a wall, for which PyBullet reports nothing"
    assert refuses(standing(floor, seen=1), "default") is None
