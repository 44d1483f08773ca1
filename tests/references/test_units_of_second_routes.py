"""Second routes to references give the same in other units, to what their tolerances allow."""

from typing import Any

import numpy as np
import pytest

from reference_solutions.checks.blocks import incline, laden_block, responding_block, rocking
from reference_solutions.checks.contact import (
    chain,
    held_sphere,
    resting_lattice,
    single_contact,
    skid,
)
from reference_solutions.checks.hard import shaken_wedge, wedge_on_springs
from reference_solutions.checks.impact import dropped, hertz, micro_slip, rebound
from tests.references.units import (
    DRAG,
    FORCE,
    GRAVITY,
    GROOVE,
    HERTZ,
    INTEGRATED,
    LADEN,
    LADEN_GIVES,
    LENGTH,
    MASS,
    NONE,
    RATE,
    ROUNDING,
    SPEED,
    SPHERES,
    SPRING,
    STRUCK,
    TIME,
    Claim,
    alone,
    apart,
    at,
)

LOOSER = ("incline", "responding block")
BALL = {
    "rho": (2500.0, (1.0, -2.0, 0.0)), "r": (0.1, LENGTH), "kn": (2e8, SPRING),
    "ks": (1.6e8, SPRING),
    "mu": (0.3, NONE), "eta": (300.0, DRAG), "v_b": (0.4, SPEED),
}  # fmt: skip


def struck(
    K: float, S: float, mu: float, r1: float, m1: float, r2: float, m2: float, **start: float
) -> Any:
    """An impact of two spheres on Hertz' springs with drag."""
    return rebound.after(rebound.Strike(K, S, mu, 1.5, 0.1, r1, m1, r2, m2), **start)


def skidded(**of: float) -> Any:
    """The times, places and velocities of a body that skids."""
    times, rows = skid.contact(steps=40, **of)
    return times, rows[:, :2], rows[:, 2:]


def laden(t: Any, wide: Any, rate: Any, v: Any, g: Any) -> Any:
    """A block that slips along a wall that rises, while both are shaken."""
    told: dict[str, Any] = {
        "constant": (-0.3 * g, -g), "shaking": ((0.1 * g, rate, 0.4), (0.2 * g, rate, 1.0)),
        "lifting": (wide, 1.5 * rate, 0.3),
    }  # fmt: skip
    way = laden_block.motion(t, v=v, mu=0.2, sliding=(wide, rate, 0.0), **told)
    return *way, laden_block.pressure(t, **told)


CLAIMS = {
    "incline": Claim(
        alone(incline.two_directions),
        {
            **at(0.2, 0.9, 1.3), "alpha": (20.0, NONE), "phi": (30.0, NONE), "g": (9.81, GRAVITY),
            "ax": (20.0, GRAVITY), "fx": (1.3, RATE), "ay": (15.0, GRAVITY), "fy": (0.7, RATE),
        },
        (LENGTH,),
    ),
    "responding block": Claim(
        alone(responding_block.three_directions),
        {
            **at(0.2, 0.9, 1.3), "Dx": (0.1, LENGTH), "fx": (1.7, RATE), "Dy": (0.06, LENGTH),
            "fy": (0.9, RATE), "Dz": (0.07, LENGTH), "fz": (1.3, RATE), "mu": (0.8, NONE),
            "g": (9.81, GRAVITY),
        },
        (LENGTH,),
    ),
    "laden block": Claim(
        laden,
        LADEN, LADEN_GIVES,
    ),
    "rocking": Claim(
        lambda b, h, g, A, w, T, now, rate: (
            rocking.landed(rate, b, h), rocking.pushed(0.1, 1.0, now, b, h, g, A, w, T),
            *rocking.stepped(0.1, rate, -1.0, now, 0.1 * now, (b, h, g, A, w, T)),
        ),
        {
            "b": (0.2, LENGTH), "h": (0.6, LENGTH), "g": (9.81, GRAVITY), "A": (4.5, GRAVITY),
            "w": (6.3, RATE), "T": (0.5, TIME), "now": (0.3, TIME), "rate": (-3.0, RATE),
        },
        (RATE, (0.0, 0.0, -2.0), NONE, RATE),
    ),
    "chain": Claim(
        lambda t, v, m, K: (
            *chain.motion(t, [v, 0.5 * v, -v], [m, 3.0 * m, 2.0 * m], K),
            chain.reflected(0.7, m, 3.0 * m),
        ),
        {**at(0.1, 0.7), "v": (0.3, SPEED), "m": (2.0, MASS), "K": (60.0, SPRING)},
        (LENGTH, SPEED, NONE),
    ),
    "held sphere": Claim(
        lambda **of: (held_sphere.after(steps=90, **of),),
        {"t": (9e-3, TIME), "m": (1.3, MASS), "ks": (8e5, SPRING), "pressed": (42.7, FORCE),
         "g": (9.81, GRAVITY), "mu": (0.1, NONE)},
        (LENGTH,),
    ),
    "normal contact": Claim(
        lambda t, rho, r, kn, eta, v_b, **_: (
            single_contact.t2(t, rho=rho, r=r, kn=kn, eta=eta, v_a=-v_b),
        ),
        {**at(1e-3, 2e-3, 9e-3), **BALL}, (LENGTH,),
    ),
    **{
        f"contact that slips {i}": Claim(alone(route), {**at(1e-4, 2e-3), **BALL}, (LENGTH,))
        for i, route in enumerate((single_contact.t3, single_contact.t4))
    },
    "skid": Claim(
        skidded,
        {
            "m": (2.0, MASS), "kn": (3e4, SPRING), "ks": (2e4, SPRING), "mu": (0.5, NONE),
            "vn": (0.3, SPEED), "vt": (0.9, SPEED),
        },
        (TIME, LENGTH, SPEED),
    ),
    **{
        f"shaken wedge {level}": Claim(
            lambda level=level, **of: (shaken_wedge.slid(level=level, steps=300, **of),),
            {"t": (1.6, TIME), **GROOVE, "A": (12.0, GRAVITY), "f": (1.3, RATE)}, (LENGTH,),
        )
        for level in (False, True)
    },
    "wedge on springs": Claim(
        lambda **of: (wedge_on_springs.after(steps=300, **of),),
        {"t": (0.1, TIME), **GROOVE, "m": (2.0, MASS), "ks": (3e6, SPRING)}, (LENGTH,),
    ),
    "hertz": Claim(
        lambda t, **of: (*hertz.stepped(t, steps=90, **of), hertz.contact_time(**of)),
        {"t": (9e-3, TIME), "m": (2.0, MASS), "K": (3e5, HERTZ), "v": (0.7, SPEED)},
        (LENGTH, SPEED, TIME),
    ),
    "pressed pair": Claim(
        lambda t, R, m, **of: (
            dropped.pressed(t, (0.9 * R, 2.7 * R), masses=(m, 0.6 * m), H=3.6 * R, R=R, **of),
        ),
        {"t": (4e-2, TIME), "R": (0.05, LENGTH), "m": (0.2, MASS), "k": (3e4, SPRING),
         "g": (9.81, GRAVITY)},
        (LENGTH,),
    ),
    "sphere set down sliding": Claim(
        lambda **of: dropped.sliding(q=3.5, **of),
        {
            "t": (0.05, TIME), "m": (2.0, MASS), "ks": (1e6, SPRING), "mu": (0.2, NONE),
            "g": (9.81, GRAVITY), "v0": (0.13, SPEED),
        },
        (SPEED, TIME),
    ),
    "rebound": Claim(struck, SPHERES, STRUCK),
    "micro-slip": Claim(
        lambda K, S, mu, r1, m1, vn, vt, **_: micro_slip.after(
            rebound.Strike(K, S, mu, 1.5, 0.0, r1, m1), vn=vn, vt=vt
        ),
        SPHERES, STRUCK,
    ),
    "lattice at rest": Claim(
        lambda r, **of: (
            resting_lattice.moved(
                r * np.array([[1.0, 1.0], [3.0, 1.0], [2.0, 2.73]]), r=r, width=3.999 * r, **of
            ),
        ),
        {"r": (0.05, LENGTH), "m": (1.3, MASS), "kn": (1e6, SPRING), "g": (9.81, GRAVITY)},
        (LENGTH,),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CLAIMS)
def test_in_other_units_it_is_the_same_to_rounding(name: str) -> None:
    assert apart(CLAIMS[name]) <= (INTEGRATED if name in LOOSER else ROUNDING)
