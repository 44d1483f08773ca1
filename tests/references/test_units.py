"""References to contacts and impacts give the same in other units, to rounding."""

from collections.abc import Callable
from typing import Any

import pytest

from reference_solutions.checks.contact import bounce as bounce_2
from reference_solutions.checks.contact import dashpot as dashpot_2
from reference_solutions.checks.contact import settling as settling_2
from reference_solutions.checks.contact import shaken_spring as shaken_spring_2
from reference_solutions.checks.impact import dropped as dropped_2
from reference_solutions.checks.impact import sinking as sinking_2
from reference_solutions.checks.impact import viscous as viscous_2
from reference_solutions.contact import (
    bounce,
    bouncing_pair,
    oblique_dashpot,
    settling,
    shaken_spring,
    skid,
)
from reference_solutions.impact import dropped, micro_slip, rebound, sinking, viscous
from tests.references.units import (
    DENSITY,
    DRAG,
    FORCE,
    GRAVITY,
    HERTZ,
    LENGTH,
    MASS,
    NONE,
    RATE,
    SPEED,
    SPHERES,
    SPRING,
    STICKY,
    STRUCK,
    TIME,
    Array,
    Claim,
    alone,
    apart,
    at,
)

LOCATED = 2e-13  # scipy locates events to 4 rounding errors of a second, of the 0.01 s they take
STEPS = 115  # of the spheres that part, 95 until slip ends and some 20 until they are apart
STEPPED = STEPS * rebound.RELATIVE  # rounding may choose other steps, which err by this together
BALL = {"m": (2.0, MASS), "kn": (3e4, SPRING)}
FALLS = {**BALL, "eta": (90.0, DRAG), "g": (9.81, GRAVITY), "height": (0.02, LENGTH)}
FLOOR = {
    "rho": (2500.0, DENSITY), "r": (0.1, LENGTH), "kn": (2e8, SPRING), "ks": (1.6e8, SPRING),
    "mu": (0.3, NONE), "g": (9.81, GRAVITY), "gap": (1e-4, LENGTH), "v_n": (0.02, SPEED),
    "v_t": (0.04, SPEED), "w": (-1.0, RATE),
}  # fmt: skip
PAIR = {
    "rho": (2500.0, DENSITY), "r1": (0.1, LENGTH), "r2": (0.07, LENGTH), "kn": (5e6, SPRING),
    "ks": (4e6, SPRING), "mu": (0.3, NONE), "gap": (1e-4, LENGTH), "v_n": (0.04, SPEED),
    "v_t": (0.03, SPEED), "w1": (0.2, RATE), "w2": (-0.4, RATE), "load": (26.0, FORCE),
}  # fmt: skip


def struck(route: Any, z: float = 0.0) -> Callable[..., Any]:
    """An impact of two spheres on Hertz' springs."""

    def answer(
        K: float, S: float, mu: float, r1: float, m1: float, r2: float, m2: float, **start: float
    ) -> Any:
        law = rebound.Law(K, S, mu, z=z)
        return route(law, rebound.Sphere(r1, m1), partner=rebound.Sphere(r2, m2), **start)

    return answer


def shaken(route: Any) -> Callable[..., Any]:
    """A mass that is shaken, and whose spring is moved at its end."""

    def answer(t: Array, w: float, pushed: float, base: float, **law: float) -> Any:
        drives = {"shaking": [(pushed, w, 0.4)], "base": [(base, 1.5 * w, 1.1)]}
        told = {k: [shaken_spring.Sine(*one) for one in v] for k, v in drives.items()}
        return (route(t, **law, **told),)

    return answer


CLAIMS = {
    "dashpot, integrated": Claim(
        dashpot_2.collision, {**at(0.01, 0.02, 0.05), **BALL, "z": (0.3, NONE), "v": (0.7, SPEED)},
        (LENGTH, NONE, TIME),
    ),
    "settling": Claim(alone(settling.settling), {**at(0.05, 0.15, 0.4), **FALLS}, (LENGTH,)),
    "settling, integrated": Claim(
        settling_2.settling, {**at(0.05, 0.15, 0.4), **FALLS}, (LENGTH, NONE)
    ),
    **{
        f"shaken spring {i}": Claim(
            shaken(route),
            {
                **at(0.3, 1.0, 4.0), "w": (2.0, RATE), "pushed": (0.3, GRAVITY),
                "base": (0.05, LENGTH), "m": (2.0, MASS), "k": (60.0, SPRING), "c": (3.0, DRAG),
                "v": (0.7, SPEED), "force": (5.0, FORCE),
            },
            (LENGTH,),
        )
        for i, route in enumerate((shaken_spring.displacement, shaken_spring_2.displacement))
    },
    **{
        f"floor {i}": Claim(alone(route), {**at(0.003, 0.006, 0.016), **FLOOR}, (LENGTH,))
        for i, route in enumerate((bounce.floor, bounce_2.floor))
    },
    **{
        f"pair {i}": Claim(alone(route), {**at(0.0026, 0.005, 0.016), **PAIR}, (LENGTH,))
        for i, route in enumerate((bouncing_pair.pair, bounce_2.pair))
    },
    "oblique dashpot": Claim(
        lambda t, **of: oblique_dashpot.motion(t, oblique_dashpot.Impact(**of)),
        {
            **at(0.01, 0.03, 0.05), "m": (2.0, MASS), "kn": (1e4, SPRING), "ks": (3e4, SPRING),
            "mu": (0.3, NONE), "z": (0.05, NONE), "v": (0.3, SPEED), "along": (0.1, SPEED),
        },
        (LENGTH, LENGTH),
    ),
    "skid": Claim(
        skid.motion,
        {
            **at(0.004, 0.008, 0.02), **BALL, "ks": (2e4, SPRING), "mu": (0.5, NONE),
            "vn": (0.3, SPEED), "vt": (0.9, SPEED),
        },
        (LENGTH, SPEED),
    ),
    "dropped": Claim(
        lambda height, **law: (dropped.Drop(**law).tops(height, 3),),
        {**BALL, "z": (0.1, NONE), "g": (9.81, GRAVITY), "height": (0.3, LENGTH)},
        (LENGTH,),
    ),
    "dropped, integrated": Claim(
        lambda height, **law: (dropped_2.tops(height, 3, pulls=False, **law),),
        {**BALL, "z": (0.1, NONE), "g": (9.81, GRAVITY), "height": (0.3, LENGTH)},
        (LENGTH,),
    ),
    **{
        f"sinking {i}": Claim(
            route,
            {
                **at(0.01, 0.1, 0.5), "d": (0.002, LENGTH),
                "rho": (2500.0, DENSITY), "rho_f": (1000.0, DENSITY), "mu": (1e-3, STICKY),
                "g": (9.81, GRAVITY), "v0": (0.01, SPEED),
            },
            (LENGTH, SPEED),
        )
        for i, route in enumerate((
            lambda t, **of: sinking.motion(t, sinking.Sinking(**of)),
            lambda t, **of: sinking_2.motion(times=t, **of),
        ))
    },
    "viscous": Claim(
        lambda **law: (
            viscous.deepest(0.2, **law), viscous.largest_force(0.2, **law),
            viscous.contact_time(0.2, **law), viscous.cleared(0.2, **law),
        ),
        {"m": (2.0, MASS), "K": (3e6, HERTZ), "v": (0.7, SPEED)}, (LENGTH, FORCE, TIME, TIME),
    ),
    "viscous, integrated": Claim(
        lambda **law: viscous_2.impact(0.2, **law),
        {"m": (2.0, MASS), "K": (3e6, HERTZ), "v": (0.7, SPEED)},
        (NONE, LENGTH, FORCE, TIME, TIME),
    ),
    "viscous on a spring": Claim(
        lambda **law: viscous_2.on_a_spring(0.2, **law), {**BALL, "v": (0.7, SPEED)},
        (NONE, LENGTH, FORCE, TIME, TIME),
    ),
    "rebound": Claim(struck(rebound.rebound, 0.1), SPHERES, STRUCK),
    "micro-slip": Claim(struck(micro_slip.rebound), SPHERES, STRUCK),
}  # fmt: skip


@pytest.mark.parametrize("name", CLAIMS)
def test_in_other_units_it_is_the_same_to_rounding(name: str) -> None:
    assert apart(CLAIMS[name]) <= (STEPPED if name == "rebound" else LOCATED)
