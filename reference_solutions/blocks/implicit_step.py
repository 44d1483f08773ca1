"""The implicit step of DDA on a harmonic oscillator and on a block under a constant force.

A step D has the increment d, the acceleration d'' = (2/D^2)(d - D v0) and the velocity
v = (2/D) d - v0 (Yagoda-Biran and Hatzor 2016, Eq. 5, corrected), with the spring force of the end
of the step. For m x'' = -K x and w^2 = K/m, the matrix of a step of the angle a = w D on (x, v) has
the trace (4 - a^2)/(2 + a^2) and the determinant 2/(2 + a^2). Its roots are conjugate below a = 4,
with the modulus (1 + a^2/2)^-1/2, and real from there on, where the larger modulus increases
towards 1 again. Every function raises ValueError for parameters outside their ranges.
"""

from math import acos, expm1, hypot, log, log1p, sqrt

from reference_solutions.parameters import require_finite, require_positive

SPLIT = 4.0
"""The angle from which on the roots are real: the motion alternates instead of oscillating."""


def spectral_radius(angle: float) -> float:
    """The greater modulus of the roots, by which a step multiplies the amplitude."""
    require_positive("rad", angle=angle)
    if angle <= SPLIT:
        return 1.0 / sqrt(1.0 + angle * angle / 2.0)
    s = angle * angle
    return (s - 4.0 + angle * sqrt(s - 16.0)) / (2.0 * (2.0 + s))


def damping_ratio(angle: float) -> float:
    """The damping ratio of an oscillation that decays as fast; angle/4 for small angles."""
    require_positive("rad", angle=angle)
    if angle >= SPLIT:
        raise ValueError(
            f"angle = {angle} rad; from 4 on nothing turns, and no damping ratio is defined"
        )
    decay = 0.5 * log1p(angle * angle / 2.0)
    turn = acos((4.0 - angle * angle) / (2.0 * sqrt(2.0 * (2.0 + angle * angle))))
    return decay / hypot(decay, turn)


def damped_drive(a: float, dt: float, steps: int, kept: float) -> float:
    """The displacement [m] of a block under an acceleration a [m/s2] in `steps` steps dt [s].

    kept: the fraction r of its velocity that the block keeps from one step to the next.

    After N steps the displacement is a dt^2 (N/2 + r/(1-r) (N - (1-r^N)/(1-r))). For r < 1 it tends
    to a t dt (1+r)/(2(1-r)), which vanishes with the step, whereas a t^2/2 is exact.
    """
    require_finite("m/s2", a=a)
    require_positive("s", dt=dt)
    if not 0.0 <= kept <= 1.0:
        raise ValueError(f"kept = {kept}; a step hands on a part between 0 and 1")
    if kept == 1.0:
        return 0.5 * a * (steps * dt) ** 2
    lost = 1.0 - kept
    handed = -expm1(steps * log(kept)) / lost if kept > 0.0 else 1.0
    return a * dt * dt * (steps / 2.0 + kept / lost * (steps - handed))
