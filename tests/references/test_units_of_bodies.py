"""References to rigid bodies, bonds and springs give the same in other units, to rounding."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from reference_solutions.bonds import tetrahedral_unit, turned_unit, unlike_row
from reference_solutions.checks.hard import painleve_rod as painleve_rod_2
from reference_solutions.contact import chain, held_sphere, resting_lattice, single_contact
from reference_solutions.hard import (
    falling_arch,
    painleve_rod,
    shaken_wedge,
    tumbling,
    wedge_on_springs,
)
from reference_solutions.impact import hertz, pressed_pair, slip_to_roll, spring
from tests.references.units import (
    DRAG,
    FORCE,
    GRAVITY,
    GROOVE,
    HERTZ,
    INTEGRATED,
    LENGTH,
    MASS,
    NONE,
    RATE,
    ROUNDING,
    SPEED,
    SPRING,
    TIME,
    Claim,
    alone,
    apart,
    at,
)

FLAT = (1.0, -2.0, 0.0)  # the density of a disc
LOOSER = ("rod that slides", "arch that falls", "row across", "unit that turns")
ROD = {"slope": (2.0, NONE), "half": (0.7, LENGTH), "V": (1.6, SPEED), "g": (9.81, GRAVITY)}
BALL = {"rho": (2500.0, FLAT), "r": (0.1, LENGTH), "kn": (2e8, SPRING)}
CORNERS = np.array([[0.0, 0.0, 0.8], [0.6, 0.0, 0.0], [-0.3, 0.5, 0.0], [-0.3, -0.5, 0.1]])
EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [2, 3], [1, 3]])
THREE = {
    "m": (np.array([2.0, 5.0, 1.0]), MASS), "x": (np.array([0.0, 0.5, 1.3]), LENGTH),
    "kn": (np.array([4e4, 1e4]), SPRING), "v": (np.array([0.1, -0.05, 0.2]), SPEED),
}  # fmt: skip


def row(kind: str) -> Callable[..., Any]:
    """Three unlike spheres on two unlike bonds."""

    def answer(t: Any, m: Any, x: Any, kn: Any, v: Any, **of: Any) -> Any:
        built = unlike_row.Row(m, x, np.array([[1, 0], [1, 2]]), kn)
        if kind == "across":
            return (unlike_row.across(t, built, v=np.outer(v, [0.6, 0.8]), **of),)
        length = np.diff(x) * [1.01, 0.99]
        if kind == "slowed":
            return (unlike_row.slowed(t, built, length=length, v=v, **of),)
        return unlike_row.along(t, built, length=length, v=v, held=True, **of)

    return answer


def landed(size: Any, m: Any, w: Any, height: Any, V: Any, latest: Any) -> Any:
    """A box that rotates about no axis of its own and lands on a corner."""
    sides = size * np.array([1.0, 0.6, 0.35])
    signs = np.array([[i, j, k] for i in (-0.5, 0.5) for j in (-0.5, 0.5) for k in (-0.5, 0.5)])
    inertia = m / 12.0 * ((sides**2).sum() - sides**2)
    body = tumbling.Body(m, inertia, signs * sides, np.eye(3))
    met = tumbling.landing(
        body, w, np.array([1.0, 2.0, 2.0]) / 3.0, height=height, V=V, latest=latest
    )
    return met.t, met.gain, met.w, met.axes


CLAIMS = {
    **{
        f"rod that {what}": Claim(
            alone(painleve_rod.middle),
            {**at(0.002, 0.01, 0.03), **ROD, "mu": (mu, NONE)}, (LENGTH,),
        )
        for what, mu in (("slides", 0.9), ("jams", 2.0))
    },
    "rod that slides, stepped": Claim(
        lambda slope, half, V, g, end: (
            painleve_rod_2.slide(end, 20, mu=0.9, theta=np.arctan(slope), half=half, V=V, g=g)[:2],
            *painleve_rod_2.jam(mu=2.0, theta=np.arctan(slope), half=half, V=V),
        ),
        {**ROD, "end": (0.004, TIME)}, (LENGTH, RATE, SPEED),
    ),
    "arch that falls": Claim(
        alone(lambda t, size, g: falling_arch.crown_drop(t, n=10, thick=0.1, size=size, g=g)),
        {**at(0.1, 0.3), "size": (1.3, LENGTH), "g": (9.81, GRAVITY)}, (LENGTH,),
    ),
    **{
        f"wedge that is shaken {i}": Claim(
            alone(route),
            {**at(0.3, 0.9, 1.6), **GROOVE, "A": (12.0, GRAVITY), "f": (1.3, RATE)}, (LENGTH,),
        )
        for i, route in enumerate((shaken_wedge.along, shaken_wedge.level))
    },
    "wedge on springs": Claim(
        alone(wedge_on_springs.slid),
        {**at(1e-3, 0.3), **GROOVE, "m": (2.0, MASS), "ks": (3e6, SPRING)}, (LENGTH,),
    ),
    "landing": Claim(
        landed,
        {
            "size": (1.3, LENGTH), "m": (12.0, MASS), "w": (np.array([2.5, 0.8, -0.4]), RATE),
            "height": (1.1, LENGTH), "V": (2.0, SPEED), "latest": (0.6, TIME),
        },
        (TIME, SPEED, RATE, NONE),
    ),
    "row along": Claim(
        row("along"), {**at(0.01, 0.2), **THREE, "g": (9.81, GRAVITY)}, (LENGTH, FORCE)
    ),
    "row that is slowed": Claim(
        row("slowed"), {**at(0.01, 0.2), **THREE, "eta": (3.0, DRAG)}, (LENGTH,)
    ),
    "row across": Claim(
        row("across"),
        {
            **at(0.01, 0.2), **THREE, "r": (np.array([0.2, 0.22, 0.4]), LENGTH),
            "ks": (np.array([1e4, 3e3]), SPRING), "spin": (np.array([20.0, -5.0, 12.0]), RATE),
        },
        (LENGTH,),
    ),
    "unit that turns": Claim(
        lambda t, d, v, **of: (
            turned_unit.path(d * CORNERS, EDGES, v * (CORNERS[:, ::-1] - 0.1), **of)(t),
        ),
        {
            **at(0.1, 0.9), "d": (1.1, LENGTH), "v": (0.3, SPEED), "m": (2.0, MASS),
            "kn": (700.0, SPRING), "ks": (300.0, SPRING),
        },
        (LENGTH,),
    ),
    "unit under a load": Claim(
        lambda fz, **of: (tetrahedral_unit.loaded(fz, **of).strain,),
        {"fz": (-40.0, FORCE), "kn": (3e5, SPRING), "ks": (1e5, SPRING), "d": (1.3, LENGTH)},
        (NONE,),
    ),
    "normal contact": Claim(
        alone(single_contact.t2),
        {**at(1e-3, 2e-3, 9e-3), **BALL, "eta": (300.0, DRAG), "v_a": (-0.4, SPEED)}, (LENGTH,),
    ),
    "held sphere": Claim(
        lambda **of: (held_sphere.height(**of), held_sphere.height(**{**of, "mu": 0.03})),
        {**at(1e-3, 9e-3), "m": (1.3, MASS), "ks": (8e5, SPRING), "pressed": (42.7, FORCE),
         "g": (9.81, GRAVITY), "mu": (0.25, NONE)},
        (LENGTH, LENGTH),
    ),
    "lattice at rest": Claim(
        lambda **of: resting_lattice.at_rest(n=3, rows=3, squeeze=1e-3, **of),
        {"r": (0.05, LENGTH), "m": (1.3, MASS), "kn": (1e6, SPRING), "g": (9.81, GRAVITY)},
        (LENGTH, LENGTH),
    ),
    "chain": Claim(
        lambda t, v, m, K: (
            *chain.motion(t, [v, 0.5 * v, -v], [m, 3.0 * m, 2.0 * m], K),
            chain.frequency(2, 3, m, K),
        ),
        {**at(0.1, 0.7), "v": (0.3, SPEED), "m": (2.0, MASS), "K": (60.0, SPRING)},
        (LENGTH, SPEED, RATE),
    ),
    "hertz": Claim(
        lambda t, **of: (
            hertz.overlap(t, **of), hertz.deepest(**of), hertz.largest_force(**of),
            hertz.contact_time(**of),
        ),
        {**at(1e-3, 9e-2), "m": (2.0, MASS), "K": (3e5, HERTZ), "v": (0.7, SPEED)},
        (LENGTH, LENGTH, FORCE, TIME),
    ),
    "spring": Claim(
        lambda m, kn, v: (
            spring.cleared(m=m, kn=kn, z=0.3), spring.deepest(m=m, kn=kn, z=0.3, v=v),
            spring.largest_force(m=m, kn=kn, z=0.3, v=v),
        ),
        {"m": (2.0, MASS), "kn": (3e5, SPRING), "v": (0.7, SPEED)}, (TIME, LENGTH, FORCE),
    ),
    "pressed pair": Claim(
        lambda t, R, m, **of: (
            pressed_pair.heights(t, (0.9 * R, 2.7 * R), masses=(m, 0.6 * m), H=3.6 * R, R=R, **of),
        ),
        {**at(1e-3, 4e-2), "R": (0.05, LENGTH), "m": (0.2, MASS), "k": (3e4, SPRING),
         "g": (9.81, GRAVITY)},
        (LENGTH,),
    ),
    "sphere set down sliding": Claim(
        lambda t, **of: (slip_to_roll.speed(t, slip_to_roll.Sliding(**of)),),
        {
            **at(1e-3, 0.01, 0.05), "m": (2.0, MASS), "ks": (1e6, SPRING), "mu": (0.2, NONE),
            "g": (9.81, GRAVITY), "v0": (0.13, SPEED),
        },
        (SPEED,),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CLAIMS)
def test_in_other_units_it_is_the_same_to_rounding(name: str) -> None:
    assert apart(CLAIMS[name]) <= (INTEGRATED if name in LOOSER else ROUNDING)
