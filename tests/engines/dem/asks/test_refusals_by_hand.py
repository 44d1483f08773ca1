"""Claims about asks that DEM refuses or calls unstable, at both sides of each limit: by hand."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

from vv.ask import Ask, Displacement, History, Knobs, Reaction
from vv.engines import dem
from vv.engines.dem.deepest import deepest
from vv.engines.dem.idle import idle
from vv.engines.dem.refusals import refuses, unstable, wants_all
from vv.engines.dem.rows import projected, projectors
from vv.scene import Contact, Form, Scene, Spheres, Term, Wall
from vv.scene.scene import LOCKED_SPEED

KN, MASS, RADIUS = 1e5, np.array([2.0, 0.7, 5.0]), np.array([0.4, 0.35, 0.3])
PLACE = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
ALL = np.ones((3, 3), bool)
UP = np.array([0.0, 0.0, 1.0])


def scene(contact: Contact = Contact(KN), eta: float = 0.0, **changes: Any) -> Scene:  # noqa: B008
    """Three unlike spheres that do not touch."""
    given = {
        "position": PLACE, "velocity": 0.1 * ALL, "radius": RADIUS, "mass": MASS, "free": ALL,
    }  # fmt: skip
    return Scene((Spheres(**{**given, **changes}),), contact, eta)


def asked(one: Scene, dt: float = 1e-5, what: Any = Displacement(0)) -> Ask:  # noqa: B008
    return Ask(one, History(8 * dt, 8 * dt), (what,), Knobs(dt))


def test_a_scene_that_is_served_is_not_refused() -> None:
    assert refuses(asked(scene())) is None


def test_two_spheres_in_one_place_are_named_in_their_order() -> None:
    place = PLACE.copy()
    place[2] = place[0]
    told = refuses(asked(scene(position=place)))
    assert told is not None
    assert told.startswith("spheres 0 and 2 have the same centre")
    near = PLACE.copy()
    near[2] = [1e-12, 0.0, 0.0]
    assert refuses(asked(scene(position=near))) is None


@pytest.mark.parametrize(("part", "said"), [(0.4, False), (3.0, True)])
def test_a_locked_axis_must_not_turn_but_for_rounding(part: float, said: bool) -> None:
    """The largest component of a spin counts."""
    turn = ALL.copy()
    turn[1] = [True, False, True]
    spin = np.zeros((3, 3))
    spin[1] = [20.0, part * LOCKED_SPEED * 20.0, -1.0]
    told = refuses(asked(scene(Contact(KN, KN, 0.3), free_spin=turn, spin=spin)))
    assert (told is not None) == said
    if said:
        assert "Spheres.spin[1] has" in (told or "")


@pytest.mark.parametrize("late", [0.999, 1.001])
def test_a_step_in_half_of_which_a_dashpot_would_turn_motion_is_refused(late: float) -> None:
    """2 kn/(eta_n w^2), w^2 the largest kn (1/m1 + 1/m2)."""
    eta_n = 900.0
    w2 = KN * (1.0 / 2.0 + 1.0 / 0.7)
    told = refuses(asked(scene(Contact(KN, eta_n=eta_n)), late * 2.0 * KN / (eta_n * w2)))
    assert (told is not None) == (late > 1.0)
    if told is not None:
        assert "2 kn/(eta_n w^2)" in told


@pytest.mark.parametrize("free", [True, False])
def test_a_reaction_is_known_of_bodies_that_can_move_or_turn_or_are_carried(free: bool) -> None:
    held, turn = ALL.copy(), ALL.copy()
    held[0] = held[1] = False
    turn[0] = False
    turn[1] = free
    rough = Contact(KN, KN, 0.3)
    still: dict[str, Any] = {"velocity": np.zeros((3, 3)), "free": held, "free_spin": turn}
    told = [refuses(asked(scene(rough, **still), what=Reaction(i))) for i in range(3)]
    assert [one is None for one in told] == [False, free, True]
    assert "the reaction on body 0, which cannot move, is not modelled" in (told[0] or "")


@pytest.mark.parametrize("leapfrog", [dem.CENTRED, dem.LAGGED, dem.Leapfrog(0.52, 0.5)])
@pytest.mark.parametrize(
    ("contact", "eta"), [(Contact(KN), 0.0), (Contact(KN), 9.0), (Contact(KN, eta_n=30.0), 0.0)]
)
def test_a_step_beyond_the_largest_stable_one_is_told_with_its_rule(
    leapfrog: Any, contact: Contact, eta: float
) -> None:
    one = scene(contact, eta)
    limit = dem.critical_step(one, leapfrog)
    assert unstable(asked(one, limit), leapfrog) is None
    told = unstable(asked(one, 1.0001 * limit), leapfrog)
    assert told is not None
    late = leapfrog is not dem.CENTRED and (eta > 0.0 or contact.viscous)
    assert ("sqrt(n^2 + w^2)" in told) == late
    assert f"largest stable step {limit:.6g} s" in told
    assert f"{0.35 * limit:.3g} s is stable" in told
    assert dem.safe_step(one, leapfrog) == pytest.approx(0.35 * limit)
    never = dataclasses.replace(asked(one), knobs=Knobs())
    assert unstable(never, leapfrog) is None


def test_energies_and_reactions_ask_for_the_general_model() -> None:
    plain = asked(scene())
    assert not wants_all(plain)
    assert wants_all(dataclasses.replace(plain, energies=(Form.DRAG,)))
    assert wants_all(asked(scene(), what=Reaction(0)))


def test_what_changes_nothing_that_is_seen_is_idle() -> None:
    """Friction without contacts; contacts of what cannot move; not where friction turns it."""
    rough = Contact(KN, KN, 0.3)
    (spheres,) = scene().bodies
    assert isinstance(spheres, Spheres)
    alone = Scene((spheres.part(slice(0, 1)),), rough)
    assert idle(alone) == {Term.FRICTION} & alone.terms()
    assert idle(scene(rough)) == set()
    held: dict[str, Any] = {"free": ~ALL, "velocity": np.zeros((3, 3))}
    fixed = scene(rough, **held, free_spin=~ALL)
    assert idle(fixed) == fixed.terms() & {Term.SPHERE_CONTACT, Term.FRICTION}
    turning = scene(rough, **held, free_spin=ALL)
    assert Term.SPHERE_CONTACT not in idle(turning)


@pytest.mark.parametrize("wrong", [-1e-9, 1.0 + 1e-9])
@pytest.mark.parametrize("name", ["lag", "back"])
def test_weights_of_a_leapfrog_lie_between_zero_and_one(name: str, wrong: float) -> None:
    for right in (0.0, 1.0):
        assert getattr(dataclasses.replace(dem.CENTRED, **{name: right}), name) == right
    with pytest.raises(ValueError, match=rf"Leapfrog\.{name} = .* between 0 and 1"):
        dataclasses.replace(dem.CENTRED, **{name: wrong})


def test_vectors_are_projected_on_free_axes() -> None:
    axes = np.linalg.qr(np.array([[1.0, 0.5, 0.2], [-0.6, 1.0, 0.4], [0.1, -0.7, 1.0]]))[0]
    free = np.array([[True, False, True], [False, True, False]])
    vectors = np.array([[1.0, 2.0, 3.0], [-4.0, 5.0, 6.0]])
    due = ((vectors @ axes.T) * free) @ axes
    assert projected(vectors, axes, free) == pytest.approx(due)
    hold = projectors(axes, free)
    assert hold is not None
    assert np.einsum("mab,mb->ma", hold, vectors) == pytest.approx(due)
    assert projectors(axes, free | True) is None
    assert (projected(vectors, axes, free | True) == vectors).all()


def test_the_deepest_overlap_is_that_of_what_moves_with_spheres_and_walls() -> None:
    """Spheres 0 and 1 overlap by 0.05 m after they moved; two that are held overlap more."""
    place = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 9.0, 1.0], [0.1, 9.0, 1.0]])
    free = np.array([[True] * 3, [True, False, False], [False] * 3, [False] * 3])
    spheres = Spheres(place, 0.0 * place, np.array([0.4, 0.35, 0.3, 0.3]), np.ones(4), free)
    floor = Wall(np.array([0.0, 0.0, 0.5]), UP)
    moved = np.array([[0.1, 0.0, 0.0], [-0.2, 0.0, 0.0]])
    pair = Scene((spheres,), Contact(KN))
    assert deepest(pair, (0, 1), moved) == pytest.approx(0.05)
    assert deepest(pair, (1, 0), moved[::-1]) == pytest.approx(0.05)
    assert deepest(pair, (0,), moved[:1]) is None
    assert deepest(pair, (0, 1), 0.0 * moved) == 0.0
    walled = Scene((floor, spheres), Contact(KN))
    sunk = moved - [[0.0, 0.0, 0.17], [0.0, 0.0, 0.0]]
    apart = math.hypot(0.7, 0.17)
    due = max(0.4 - (1.0 - 0.17 - 0.5), 0.75 - apart)
    assert deepest(walled, (0, 1), sunk) == pytest.approx(due)
