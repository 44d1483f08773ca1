"""Claims, without LIGGGHTS, about each number of what it is given, computed by hand.

Masses, radii, loads and directions are unlike, so that none can stand for another.
"""

from __future__ import annotations

import dataclasses
import math
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from adapters.liggghts import data, space
from adapters.liggghts.clumps import as_atoms, members
from adapters.liggghts.overlaps import overlapped, why_not_overlapped
from adapters.liggghts.refusals import _too_many_groups
from adapters.liggghts.setup import Setup, set_up
from adapters.liggghts.terms import bonds
from adapters.liggghts.terms.hertz import restitution, why_not_viscous
from tests.scenes.spheres.bonded_scenes import KN, D, M, elements, tied, unit
from tests.support.adapters.liggghts_asks import CLUMP, PLAIN, ball, ball_ask, deck_of, words
from tests.support.adapters.small_asks import FREE, UP
from vv.scene import Bonds, Contact, Harmonic, Hertz, Pulse, Scene, Spheres, Wall
from vv.standins.clump import Clump

PAIR = Spheres(
    position=np.array([[0.0, 1.0, 0.0], [2.0, 5.0, -1.0]]),
    velocity=np.array([[3.0, 0.0, 4.0], [0.0, 0.0, 0.0]]),
    radius=np.array([0.1, 0.3]),
    mass=np.array([2.0, 4.0]),
    free=np.array([[True] * 3, [False] * 3]),
    load=np.array([[0.0, 0.0, 8.0], [1e6, 0.0, 0.0]]),
)


def test_bonds_are_numbered_from_one_with_their_kind_and_spheres() -> None:
    place = np.array([[0.0, 0.0, 0.0], [0.2, 0.0, 0.0], [0.5, 0.0, 0.0]])
    row = Spheres(place, 0 * place, np.full(3, 0.1), np.ones(3), np.ones((3, 3), bool))
    tied_up = Bonds(
        np.array([[0, 1], [2, 1]]), np.array([0.2, 0.3]), np.array([2e4, 1e4]), np.ones(2)
    )
    lines = [*bonds._data(Scene((row,), Contact(1e4), bonds=tied_up), (place[0], place[2]))]
    assert lines[:4] == ["bonded spheres", "", "3 atoms", "2 bonds"]
    assert lines[lines.index("Bonds") + 2 :] == ["1 2 1 2", "2 1 3 2"]


def test_the_atoms_of_clumps_share_mass_load_and_springs() -> None:
    corners = [np.full((4, 3), 1.0), np.full((4, 3), 2.0)]
    made = [
        cast(Clump, SimpleNamespace(corners=c, points=np.full((8, 3), 10.0 * k), radius=r))
        for k, (c, r) in enumerate(zip(corners, (0.01, 0.02), strict=True), 1)
    ]
    scene = as_atoms(Scene((UP, PAIR), Contact(8e6, 4e6, 0.5)), made)
    assert (scene.contact.kn, scene.contact.ks, scene.contact.mu) == (2e6, 1e6, 0.5)
    assert scene.walls == (UP,)
    atoms = scene.spheres  # both centres, then corners and points of the first, then the second's
    assert atoms.mass == pytest.approx(
        [2e-18, 4e-18, *[2e-18] * 4, *[0.25] * 8, *[4e-18] * 4, *[0.5] * 8], rel=1e-12, abs=0.0
    )
    assert atoms.radius == pytest.approx(
        [1e-5, 2e-5, *[0.01] * 4, *[1e-5] * 8, *[0.02] * 4, *[2e-5] * 8], rel=1e-12, abs=0.0
    )
    loads = [0.0] * 14 + [0.0] * 4 + [1e6 / 8] * 8
    assert atoms.load[:, 0] == pytest.approx(loads)
    assert atoms.load[:, 2] == pytest.approx([*[0.0] * 6, *[1.0] * 8, *[0.0] * 12])
    assert atoms.position[[0, 1]].tolist() == PAIR.position.tolist()
    assert atoms.position[2:, 0].tolist() == [1.0] * 4 + [10.0] * 8 + [2.0] * 4 + [20.0] * 8
    assert members(made) == [[0, *range(2, 14)], [1, *range(14, 26)]]


def test_a_file_of_spheres_holds_box_sizes_densities_places_and_speeds() -> None:
    spins = np.array([[0.5, 0.0, -0.25], [0.0, 0.0, 0.0]])
    pair = dataclasses.replace(PAIR, spin=spins, free_spin=np.ones((2, 3), bool), load=0 * spins)
    setup = set_up(ball_ask(pair), PLAIN)
    *printed, read = data.read_data(setup, pair.position + 7.0)
    assert read.split() == ["read_data", "spheres.data"]
    rows = [line.partition('"')[2].partition('"')[0].split() for line in printed]
    assert rows[2:4] == [["2", "atoms"], ["1", "atom", "types"]]
    low, high = setup.room.outer
    assert [[*map(float, row[:2]), *row[2:]] for row in rows[5:8]] == [
        [low[k], high[k], f"{axis}lo", f"{axis}hi"] for k, axis in enumerate("xyz")
    ]
    assert rows[9] == ["Atoms"]
    # 2 kg in 4.18879e-3 m3 and 4 kg in 0.113097 m3
    assert [list(map(float, row)) for row in rows[11:13]] == [
        pytest.approx([1, 1, 0.2, 477.464829, 7.0, 8.0, 7.0]),
        pytest.approx([2, 1, 0.6, 35.3677651, 9.0, 12.0, 6.0]),
    ]
    assert rows[14] == ["Velocities"]
    assert [list(map(float, row)) for row in rows[16:]] == [
        [1, 3.0, 0.0, 4.0, 0.5, 0.0, -0.25], [2, 0, 0, 0, 0, 0, 0]
    ]  # fmt: skip


def test_only_a_thousand_plain_spheres_are_a_file() -> None:
    for count, scheme, written in ((1000, PLAIN, True), (999, PLAIN, False), (1000, CLUMP, False)):
        setup = SimpleNamespace(
            spheres=range(count), scene=SimpleNamespace(bonds=None), scheme=scheme
        )
        assert data.many(cast(Setup, setup)) is written
    bonded = SimpleNamespace(spheres=range(1000), scene=SimpleNamespace(bonds=1), scheme=PLAIN)
    assert not data.many(cast(Setup, bonded))


SLID = Harmonic(np.array([0.0, 0.1, 0.0]), np.full(3, 2.5 / math.pi))  # 0.5 m/s at most
ROOM = Scene(
    (Wall(np.array([0.0, 0.92, 0.0]), np.array([0.0, 1.0, 0.0]), SLID), PAIR),
    Contact(1e3),
    gravity=np.array([0.0, -10.0, 0.0]),
    shaking=Harmonic(np.array([1.0, -2.0, 2.0]), np.ones(3)),
)


def test_the_room_is_ten_radii_and_twice_the_longest_path() -> None:
    # The wall pushes 20 N up on 2 kg against gravity; the load gives 4 and shaking 5 m/s2 at most.
    # In 0.5 s: (5 + 0.5) 0.5 + 9 0.5^2/2 = 3.875 m; the other sphere cannot move
    room = space.space(ROOM, 0.5)
    reach = 3.0 + 2 * 3.875
    assert room.low == pytest.approx(np.array([0.0, 1.0, -1.0]) - reach)
    assert room.high == pytest.approx(np.array([2.0, 5.0, 0.0]) + reach)
    margin = 0.01 * reach + 2 * 0.1
    (corners,) = room.triangles.values()
    every = np.vstack([room.low, room.high, corners])
    assert room.outer[0] == pytest.approx(every.min(axis=0) - margin)
    assert room.outer[1] == pytest.approx(every.max(axis=0) + margin)


def test_the_edges_of_a_wall_s_triangle_pass_the_farthest_corner_of_the_box() -> None:
    wall = Wall(np.array([0.0, 0.0, 3.0]), np.array([0.0, 0.6, 0.8]))
    low, high = np.array([-1.0, -2.0, -2.0]), np.array([3.0, 6.0, 4.0])
    corners = space.triangle(wall, low, high)
    # the box is centred at (1, 2, 1) and its half diagonal is sqrt(29); its centre lies
    # 0.6 2 + 0.8 (1 - 3) = -0.4 off the plane
    foot = np.array([1.0, 2.0 + 0.24, 1.0 + 0.32])
    assert corners.mean(axis=0) == pytest.approx(foot)
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        way = (end - start) / np.linalg.norm(end - start)
        off = np.linalg.norm(np.cross(foot - start, way))
        assert off == pytest.approx(math.sqrt(29) + 0.4)


def test_a_turned_wall_is_a_mesh_but_for_rounding() -> None:
    for normal, mesh in (([0.0, 1.0, 1.2e-15], True), ([0.0, 1.0, 0.8e-15], False)):
        assert space.is_mesh(Wall(np.zeros(3), np.array(normal))) is mesh
    assert space.is_mesh(Wall(np.zeros(3), np.array([0.0, 1.0, 0.0]), SLID))


def test_the_room_of_a_crowd_ends_ten_radii_behind_planes(monkeypatch: pytest.MonkeyPatch) -> None:
    walls = (
        Wall(np.array([-1.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0])),
        Wall(np.array([2.5, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0])),
        Wall(np.array([0.0, -90.0, 0.0]), np.array([0.0, 1.0, 0.0])),  # farther than they reach
        Wall(np.array([0.0, 90.0, 0.0]), np.array([0.0, -1.0, 0.0])),
        Wall(np.array([0.0, 0.0, -9.0]), np.array([0.0, 0.6, 0.8])),
    )
    still = dataclasses.replace(PAIR, velocity=np.zeros((2, 3)), load=np.zeros((2, 3)))
    fast = dataclasses.replace(still, velocity=PAIR.velocity)
    monkeypatch.setattr(space, "CROWD", 2)
    room = space.space(Scene((*walls, fast), Contact(1e3)), 1.0)
    assert room.low == pytest.approx([-4.0, 1.0 - 13.0, -1.0 - 13.0])
    assert room.high == pytest.approx([5.5, 5.0 + 13.0, 0.0 + 13.0])
    monkeypatch.setattr(space, "CROWD", 3)
    assert space.space(Scene((*walls, fast), Contact(1e3)), 1.0).low[0] == -13.0


def test_hertzian_moduli_are_factors_of_kn_and_kt() -> None:
    contact = Contact(0.0, mu=0.3, hertz=Hertz(6e9, 2e9))
    ask = ball_ask(ball(), UP)
    ask = dataclasses.replace(ask, scene=dataclasses.replace(ask.scene, contact=contact))
    given = {line[0]: float(line[-1]) for line in words(deck_of(ask, PLAIN), "fix")
             if "property/global" in line}  # fmt: skip
    assert [given["kn"], given["kt"]] == pytest.approx([8e9, 1.6e10])


@pytest.mark.shows("Elastic spheres with losses (Tsuji) follow the same law in YADE")
@pytest.mark.parametrize(
    ("damping", "e"),
    [(0.5, 0.127881), (0.3, 0.335159), (0.1, 0.707351), (0.629, 0.050445)],
)
def test_restitution_is_that_of_a_contact_which_loses_by_its_share_of_critical(
    damping: float, e: float
) -> None:
    """exp(-pi s/sqrt(1 - s^2)), s = sqrt(6/5) damping: 0.5 gives 0.547723/0.836660 = 0.654654."""
    assert restitution(damping) == pytest.approx(e, rel=1e-5)


def viscous(damping: float, **changes: object) -> Scene:
    law = Contact(0.0, mu=0.3, hertz=Hertz(6e9, 1.5e9, damping))
    return Scene((UP, ball(**changes)), law)


def test_what_no_restitution_stands_for_is_refused() -> None:
    assert why_not_viscous(viscous(0.629)) is None  # e = 0.0502
    assert "no restitution up to 0.05" in (why_not_viscous(viscous(0.631)) or "")
    assert "no restitution up to 0.05" in (why_not_viscous(viscous(0.95)) or "")
    assert why_not_viscous(viscous(0.0)) is None
    held = ball(free=~FREE, position=[[0.0, 0.3, 0.0]])
    pair = dataclasses.replace(viscous(0.3), bodies=(UP, ball(), held))
    assert "a sphere cannot move" in (why_not_viscous(pair) or "")
    elastic = dataclasses.replace(viscous(0.0), bodies=(UP, ball(), held))
    assert why_not_viscous(elastic) is None
    assert why_not_viscous(dataclasses.replace(elastic, contact=Contact(1e6))) is None
    with pytest.raises(ValueError, match="less than sqrt"):
        restitution(0.92)


@pytest.mark.parametrize(("until", "last"), [(0.0505, 51), (0.05, 50), (0.05 + 1.2e-9, 51)])
def test_a_pulse_ends_at_the_first_step_at_or_behind_its_end(until: float, last: int) -> None:
    pulse = Pulse(Harmonic(np.array([1.0, 0.0, 0.0]), np.ones(3)), until)
    text = deck_of(ball_ask(ball(), shaking=pulse), PLAIN)
    ((_, kind, formula),) = [w for w in words(text, "variable") if w[0] == "shake0_x"]
    assert (kind, formula) == ("equal", f"v_shake0_sine_x*(step<{last})")


def test_bins_are_a_twentieth_of_the_box_or_hold_few_of_a_crowd(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ask = ball_ask(dataclasses.replace(PAIR, velocity=10 * PAIR.velocity))
    sides = np.subtract(*set_up(ask, PLAIN).room.outer[::-1])
    text = deck_of(ask, PLAIN)
    (skin,), (rest,) = words(text, "neighbor"), words(text, "neigh_modify")
    assert float(skin[0]) == pytest.approx(0.2 * 0.3)
    assert float(rest[-1]) == pytest.approx(sides.max() / 20)
    monkeypatch.setattr("adapters.liggghts.atoms.CROWD", 2)
    monkeypatch.setattr("adapters.liggghts.atoms.BINS", 10)
    (rest,) = words(deck_of(ask, PLAIN), "neigh_modify")
    assert float(rest[-1]) == pytest.approx(np.cbrt(sides.prod() / (10 * 2)))
    monkeypatch.setattr("adapters.liggghts.atoms.BINS", 10**9)
    (rest,) = words(deck_of(ask, PLAIN), "neigh_modify")
    assert float(rest[-1]) == pytest.approx(2.25 * 0.3)


def test_an_overlap_takes_the_first_bond_s_springs_and_a_ten_thousandth_of_its_length() -> None:
    scene = overlapped(unit())
    assert scene.spheres.radius == pytest.approx(np.full(4, D * 1.0001 / 2), rel=1e-14)
    assert scene.contact.mu == 1e9
    assert scene.bonds is None


def test_bonds_that_may_stretch_by_half_an_overlap_are_refused() -> None:
    # two of the four are pulled by 0.4 and 0.3 N along x; weight adds m g to each of three others
    loads = np.zeros((4, 3))
    loads[0, 0], loads[1, 2] = 0.4, -0.3
    speed = np.array([[3.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 0.0]])
    most = 2 * 0.7 / KN + math.sqrt(2 * (M * 25 / 2) / KN)
    reason = why_not_overlapped(unit(elements(load=loads, velocity=speed))) or ""
    assert f"bonds may stretch by {most:.3g} m" in reason
    assert "up to 5e-08 m" in reason
    pulled = [why_not_overlapped(unit(elements(load=loads * part))) for part in (1.6, 1.7)]
    assert [bool(one) for one in pulled] == [False, True]  # 2 0.7 1.671/KN is half of 1e-7 m
    heavy = why_not_overlapped(unit(gravity=np.array([0.0, 0.0, -1e6]))) or ""
    assert f"may stretch by {2 * 4 * M * 1e6 / KN:.3g} m" in heavy


@pytest.mark.parametrize(("off", "refused"), [(1.2e-9, True), (0.8e-9, False)])
def test_bonds_are_alike_to_a_billionth(off: float, refused: bool) -> None:
    for name, value in (("kn", KN), ("length", D)):
        scene = unit(bonds=tied(**{name: value * (1 + off * np.eye(6)[0])}))
        assert bool(why_not_overlapped(scene)) is refused, name
    base = np.array([[0.0, 0.0, 0.0], [D, 0.0, 0.0], [0.0, 5 * D, 0.0]])
    for apart, near in ((1.009, True), (1.011, False)):
        third = base.copy()
        third[2] = [0.0, apart * D, 0.0]
        bonds = tied(pairs=np.array([[0, 1]]))
        said = why_not_overlapped(unit(elements(third), bonds)) or ""
        assert ("as close as bonded ones" in said) is near


def test_more_than_eight_loads_are_a_property_of_the_atoms_that_carry_them() -> None:
    balls = [ball(position=[[k, 0, 0]], load=[[k, 0, 2.0]]) for k in range(1, 10)]
    text = deck_of(ball_ask(*balls), PLAIN)
    rows = [row for row in words(text, "set", "atom") if row[1] == "property/atom"]
    assert [[int(row[0]), *map(float, row[3:])] for row in rows] == [
        [k, k, 0.0, 2.0] for k in range(1, 10)
    ]
    assert not words(text, "fix", "load0")


@pytest.mark.parametrize(
    ("loads", "locks", "shaken", "clumps", "counted"),
    [
        (8, 11, 10, 0, 29),
        (8, 11, 11, 0, 30),
        (9, 15, 14, 1, 29),  # many loads are no groups, and one clump alone is none
        (9, 15, 15, 1, 30),
        (0, 14, 14, 2, 30),
        (8, 10, 9, 2, 29),
    ],
)
def test_groups_are_of_few_loads_of_locks_of_shaken_masses_and_of_several_clumps(
    loads: int, locks: int, shaken: int, clumps: int, counted: int
) -> None:
    setup: Any = SimpleNamespace(
        loads=range(loads), locks=range(locks), shaken=range(shaken), clumps=range(clumps)
    )
    reason = _too_many_groups(setup) or ""
    assert (f"{counted} different dead loads" in reason) is (counted > 29)
