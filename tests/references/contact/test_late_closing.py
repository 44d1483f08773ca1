"""Claims about the error of a bounce whose shear spring is loaded over the whole closing step.

YADE and LIGGGHTS increment the shear spring by the slip of the whole step in which the contact
closes. This rule is integrated here on its own and has the errors of both codes to their digits. If
the spring is loaded only for the part of the step in contact, at most a fifth of the error remains.
The error is therefore due to this rule, and is no floor.
"""

import math

import numpy as np
import pytest

from reference_solutions.contact import bounce

RADIUS, MU, G, GAP, SPEED, SPIN, KN, KS = 0.0843, 0.782, 9.89, 1.36e-4, 0.0147, 0.5, 2e10, 3e10
DENSITY, DURATION = 1760.0, 0.036
MASS = DENSITY * 4.0 / 3.0 * math.pi * RADIUS**3
CODES = {5e-7: 2.04e-3, 2.5e-7: 4.32e-4}  # step [s]: relative error of both codes


def _thrown(dt: float, whole: bool) -> float:
    """The tangential displacement [m] after DURATION, by leapfrog with the slip of half a step
    before.

    whole: load the spring for the whole step in which the contact closes, or for its part in
    contact.
    """
    inertia, way, height = 0.4 * MASS * RADIUS**2, 0.0, RADIUS + GAP
    along, up, spin, spring = SPEED, 0.5 * G * dt, SPIN, 0.0
    before = RADIUS - height
    for _ in range(round(DURATION / dt)):
        deep = RADIUS - height
        push = KN * max(deep, 0.0)
        if deep <= 0.0:
            spring = 0.0
        else:
            share = 1.0 if whole or before > 0.0 else deep / (deep - before)
            spring -= KS * (along - spin * (RADIUS - deep)) * dt * share
            spring = math.copysign(min(abs(spring), MU * push), spring)
        up += (push / MASS - G) * dt
        along += spring / MASS * dt
        spin -= (RADIUS - deep) * spring / inertia * dt
        before = deep
        height += up * dt
        way += along * dt
    return way


@pytest.mark.shows("A direct implementation of the rule gives these digits; if it counts")
@pytest.mark.parametrize(("dt", "seen"), CODES.items())
def test_a_spring_charged_for_the_whole_closing_step_has_the_digits_of_the_codes(
    dt: float, seen: float
) -> None:
    exact = bounce.floor(
        np.array([DURATION]), r=RADIUS, w=SPIN, rho=DENSITY, kn=KN, ks=KS, mu=MU, g=G, gap=GAP,
        v_n=0.0, v_t=SPEED,
    )[0, 0]  # fmt: skip
    off = abs(_thrown(dt, whole=True) - exact) / abs(exact)
    assert off == pytest.approx(seen, rel=0.03)
    assert abs(_thrown(dt, whole=False) - exact) < 0.2 * seen * abs(exact)
