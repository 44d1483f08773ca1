"""References to blocks give the same in other units, to rounding."""

from collections.abc import Callable
from typing import Any

import pytest

from reference_solutions.blocks import (
    elastic_block,
    incline,
    laden_block,
    responding_block,
    rocking,
    shear_wave,
)
from reference_solutions.checks.blocks import elastic_block as elastic_block_2
from reference_solutions.checks.blocks import incline as incline_2
from reference_solutions.checks.blocks import responding_block as responding_block_2
from reference_solutions.checks.blocks import shear_wave as shear_wave_2
from reference_solutions.contact import shaken_spring
from tests.references.units import (
    DENSITY,
    GRAVITY,
    INTEGRATED,
    LADEN,
    LADEN_GIVES,
    LENGTH,
    NONE,
    RATE,
    ROUNDING,
    SPEED,
    TIME,
    Claim,
    alone,
    apart,
    at,
)

PRESSURE = (1.0, -1.0, -2.0)
LOOSER = ("rocking", "overturning", "elastic block 1")
SLOPE = {"alpha": (20.0, NONE), "phi": (30.0, NONE), "g": (9.81, GRAVITY)}
SHAKEN = {**SLOPE, "A": (20.0, GRAVITY), "f": (1.3, RATE), "v0": (0.5, SPEED)}
PLANE = {
    **SLOPE, "ax": (20.0, GRAVITY), "fx": (1.3, RATE), "ay": (15.0, GRAVITY), "fy": (0.7, RATE),
}  # fmt: skip
BASE = {"D": (0.3, LENGTH), "f": (1.7, RATE), "mu": (0.6, NONE), "g": (9.81, GRAVITY)}
SPACE = {
    "Dx": (0.1, LENGTH), "fx": (1.7, RATE), "Dy": (0.06, LENGTH), "fy": (0.9, RATE),
    "Dz": (0.07, LENGTH), "fz": (1.3, RATE), "mu": (0.8, NONE), "g": (9.81, GRAVITY),
}  # fmt: skip
BLOCK = {"b": (0.2, LENGTH), "h": (0.6, LENGTH), "g": (9.81, GRAVITY)}
COLUMN = {
    "height": (13.0, LENGTH), "c": (254.0, SPEED), "D": (0.7, LENGTH), "F": (3.1, RATE)
}  # fmt: skip
SOLID = {
    "x": (1.3, LENGTH), "y": (0.7, LENGTH), "z": (0.8, LENGTH), "rho": (2000.0, DENSITY),
    "young": (3e9, PRESSURE), "poisson": (0.3, NONE),
}  # fmt: skip


def solid(route: Callable[..., Any], **fixed: Any) -> Callable[..., Any]:
    """The strains of a block of three sides."""
    return lambda x, y, z, **of: (route(sides=(x, y, z), **fixed, **of),)


def laden(t: Any, wide: Any, rate: Any, v: Any, g: Any) -> Any:
    """A block that slips along a wall that rises, while both are shaken."""
    sine = shaken_spring.Sine
    told: dict[str, Any] = {
        "constant": (-0.3 * g, -g), "shaking": (sine(0.1 * g, rate, 0.4), sine(0.2 * g, rate, 1.0)),
        "lifting": sine(wide, 1.5 * rate, 0.3),
    }  # fmt: skip
    return *laden_block.motion(t, v=v, mu=0.2, **told), laden_block.pressure(t, **told)


CLAIMS = {
    "incline, gravity": Claim(
        alone(incline.gravity), {**at(0.1, 0.9), **SLOPE, "v0": (0.7, SPEED)}, (LENGTH,)
    ),
    **{
        f"incline {i}": Claim(alone(route), {**at(0.2, 0.9, 1.7), **SHAKEN}, (LENGTH,))
        for i, route in enumerate((incline.newmark, incline_2.newmark))
    },
    "incline that touches rest": Claim(
        alone(incline.newmark),
        {**at(0.2, 0.9, 3.7), **SHAKEN, "A": (5.0, GRAVITY), "phi": (20.0, NONE),
         "v0": (0.0, SPEED)},
        (LENGTH,),
    ),
    "incline in two directions": Claim(
        alone(incline.two_directions), {**at(0.2, 0.9, 1.3), **PLANE}, (LENGTH,)
    ),
    **{
        f"responding block {i}": Claim(alone(route), {**at(0.2, 0.9, 2.1), **BASE}, (LENGTH,))
        for i, route in enumerate(
            (responding_block.one_direction, responding_block_2.one_direction)
        )
    },
    "responding block in space": Claim(
        alone(responding_block.three_directions), {**at(0.2, 0.9, 1.3), **SPACE}, (LENGTH,)
    ),
    "laden block": Claim(
        laden,
        LADEN, LADEN_GIVES,
    ),
    "rocking": Claim(
        alone(rocking.leans),
        {**at(0.3, 0.7, 1.4), **BLOCK, "A": (4.5, GRAVITY), "w": (6.3, RATE), "T": (0.5, TIME)},
        (NONE,),
    ),
    "overturning": Claim(
        lambda w, **of: (
            rocking.threshold(w=w, **of), rocking.linear_threshold(w=w, **of),
            rocking.overturns(w=w, A=1.1 * rocking.threshold(w=w, **of), **of),
        ),
        {**BLOCK, "w": (6.3, RATE)}, (GRAVITY, GRAVITY, TIME),
    ),
    **{
        f"shear wave {i}": Claim(
            lambda y, s=route, **of: (
                s.displacement(y=y, **of), s.layered_displacement(number=3, layers=5, **of),
            ),
            {**at(0.05, 0.2, 0.4), **COLUMN, "y": (8.0, LENGTH)}, (LENGTH, LENGTH),
        )
        for i, route in enumerate((shear_wave, shear_wave_2))
    },
    **{
        f"shear wave in steps {i}": Claim(
            lambda height, c, F, dt, D, s=route: (
                s.stepped_displacement(40, number=3, layers=5, height=height, c=c, F=F, dt=dt, D=D),
                abs(s.layered_ratio(layers=5, height=height, c=c, F=F, dt=dt)),
            ),
            {**COLUMN, "dt": (4e-3, TIME)}, (LENGTH, NONE),
        )
        for i, route in enumerate((shear_wave, shear_wave_2))
    },
    "elastic block at rest": Claim(
        solid(elastic_block.resting), {**SOLID, "g": (9.81, GRAVITY)}, (NONE,)
    ),
    **{
        f"elastic block {i}": Claim(
            solid(route), {**at(1e-4, 3e-4, 1e-3), **SOLID, "g": (9.81, GRAVITY)}, (NONE,)
        )
        for i, route in enumerate((elastic_block.standing, elastic_block_2.standing))
    },
    "elastic block that spins": Claim(
        solid(elastic_block.spinning), {**at(1e-4, 3e-4), **SOLID, "spin": (20.0, RATE)}, (NONE,)
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CLAIMS)
def test_in_other_units_it_is_the_same_to_rounding(name: str) -> None:
    assert apart(CLAIMS[name]) <= (INTEGRATED if name in LOOSER else ROUNDING)
