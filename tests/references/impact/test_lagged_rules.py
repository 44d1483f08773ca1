"""Claims about the error of impacts where the lever arm of the shear spring is that of a step's
end.

YADE and Kratos increment the slip by dt times the velocity half a step earlier. They take the lever
arm, and YADE the stiffness too, from the end of the step. This rule is integrated here on its own:
it has the errors of the codes to their printed digits, and converges to the exact solution of their
law, so that they have no floor.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import pytest

from reference_solutions.impact import hertz
from reference_solutions.impact.rebound import Law, Sphere, rebound

ALUMINA = Sphere(0.0025, 4000 * 4.0 / 3.0 * math.pi * 0.0025**3)
NORMAL, SHEAR = (
    1.0 / (1.0 / of(380e9, 0.23) + 1.0 / of(70e9, 0.25))
    for of in (hertz.effective_modulus, hertz.effective_shear_modulus)
)
ON_GLASS = Law(
    hertz.normal_factor(modulus=NORMAL, radius=0.0025),
    hertz.shear_factor(modulus=SHEAR, radius=0.0025),
    0.092, a=1.0, b=1.0,
)  # fmt: skip
YADE = {  # degrees of kharaz:hertz at 3.9 m/s: errors over the speed, for each of STEPS
    2.24: (2.277e-4, 1.148e-4, 5.866e-5, 1.486e-5, 3.751e-6),
    4.22: (5.116e-4, 2.632e-4, 1.350e-4, 3.459e-5, 8.768e-6),
    6.0025: (4.125e-4, 2.503e-4, 1.460e-4, 4.459e-5, 1.221e-5),
    20.22: (2.322e-4, 1.118e-4, 5.782e-5, 1.436e-5, 3.595e-6),
}
STEPS = (100, 200, 400, 1600, 6400)  # steps in a normal impact
GRAIN = Sphere(1e-5, 1400 * 4.0 / 3.0 * math.pi * 1e-5**3)
SOFT = Law(2071.242175301532, 1553.431631476149, 0.3, 1.0, a=1.0, b=1.0)
KRATOS = (6.557e-5, 2.602e-5, 1.427e-5, 3.581e-6, 9.167e-7)  # along-polyethylene-linear, slip 4


def stepped(
    law: Law, one: Sphere, vn: float, vt: float, dt: float, late: float = 1.0, softens: bool = False
) -> tuple[float, float]:
    """Velocities along the normal and across it after an impact on a wall, by leapfrog.

    late: the point of the step whose stiffness and arm apply to the slip; 0.5 is of second order.
    softens: whether the shear force falls with the stiffness where the contact unloads (Thornton).
    """
    inertia, arm, before, spring = 0.4 * one.mass * one.radius**2, one.radius, 0.0, 0.0
    out, across, spin = -vn, vt, 0.0
    while True:
        deep = before - out * dt
        if deep <= 0.0:
            return out, across
        seen = before + late * (deep - before)
        if softens and deep < before:
            spring *= (deep / before) ** (law.p - 1.0)
        spring -= law.S * seen ** (law.p - 1.0) * (across + (arm - seen) * spin) * dt
        push = law.K * deep**law.p
        spring = math.copysign(min(abs(spring), law.mu * push), spring)
        out += push / one.mass * dt
        across += spring / one.mass * dt
        spin += (arm - deep) * spring / inertia * dt
        before = deep


def _errors(
    law: Law, one: Sphere, start: tuple[float, float], unit: float,
    steps: Sequence[int] = STEPS, late: float = 1.0,
) -> list[float]:  # fmt: skip
    """Errors over the speed before the impact, at these numbers of steps in a unit of time [s]."""
    due = rebound(law, one, vn=start[0], vt=start[1])
    found = [stepped(law, one, *start, unit / n, late) for n in steps]
    return [math.dist(each, (due.normal, due.tangential)) / math.hypot(*start) for each in found]


def _at(degrees: float) -> tuple[float, float]:
    way = math.radians(degrees)
    return 3.9 * math.cos(way), 3.9 * math.sin(way)


UNIT = hertz.contact_time(m=ALUMINA.mass, K=ON_GLASS.K, v=3.9)


@pytest.mark.shows(
    "4.5e-5 at 1600 steps and 1.2e-5 at 6400. The largest error falls more slowly than the step "
    "because at 6 degrees the spring starts at 0.98 of Coulomb's limit"
)
@pytest.mark.parametrize(("degrees", "seen"), YADE.items())
def test_yades_hertz_on_a_wall_is_its_rule_to_every_digit(
    degrees: float, seen: tuple[float, ...]
) -> None:
    assert _errors(ON_GLASS, ALUMINA, _at(degrees), UNIT) == pytest.approx(seen, rel=1e-3)


@pytest.mark.shows(
    "4.5e-5 at 1600 steps and 1.2e-5 at 6400. The largest error falls more slowly than the step "
    "because at 6 degrees the spring starts at 0.98 of Coulomb's limit"
)
def test_where_slip_begins_is_of_the_order_of_three_halves_beside_the_first() -> None:
    # at 6 degrees the spring starts at 0.98 of the limit, which the first 40 steps exceed
    a, b, c = (error * n for n, error in zip(STEPS[-3:], YADE[6.0025][-3:], strict=True))
    assert (b - a) / (c - b) == pytest.approx((0.05 - 0.025) / (0.025 - 0.0125), rel=0.1)
    start = 2.0 / 3.0 * ON_GLASS.S / (ON_GLASS.mu * ON_GLASS.K) * math.tan(math.radians(6.0025))
    assert start == pytest.approx(0.982, abs=1e-3)


@pytest.mark.shows("MindlinPhys computes shear increments with the stiffness at the end of a step")
def test_stiffness_and_arm_of_the_middle_of_a_step_end_yades_first_order() -> None:
    middle = _errors(ON_GLASS, ALUMINA, _at(2.24), UNIT, (400, 1600), late=0.5)
    assert middle[1] < 0.1 * YADE[2.24][3]


@pytest.mark.shows(
    "Like YADE and LIGGGHTS, Kratos loads a shear spring for the whole step",
    "With the arm at its middle a tenth of that error would remain",
)
def test_kratos_linear_spring_on_a_wall_is_its_rule_to_three_digits() -> None:
    start, unit = (5.0, 4.0 * 0.3 * 5.0), math.pi * math.sqrt(GRAIN.mass / SOFT.K)
    assert _errors(SOFT, GRAIN, start, unit) == pytest.approx(KRATOS, rel=2e-3)
    middle = _errors(SOFT, GRAIN, start, unit, late=0.5)
    assert middle[3] < 0.1 * KRATOS[3]


def test_the_rule_told_apart_from_arms_of_the_middle_of_the_overlap() -> None:
    errors = _errors(replace(SOFT, a=0.5, b=0.5), GRAIN, (5.0, 6.0), 1e-7)
    assert min(errors) > 1e-3
