"""The step of generalised alpha on a harmonic oscillator: the roots of its characteristic cubic.

Let S be the shift by one step D. Newmark's formulas for x and v with beta and gamma, from which v
is eliminated by means of two successive steps, and the equation of motion are

(S - 1)^2 x = D^2 (beta S^2 + (1/2 + gamma - 2 beta) S + 1/2 - gamma + beta) a
((1 - alpha_m) S + alpha_m) a = -w^2 ((1 - alpha_f) S + alpha_f) x

with the acceleration a. Together they give a cubic in S, whose roots are those of a step with the
angle w D (Chung and Hulbert 1993, Eq. 14). Its coefficients follow from the spectral radius at
infinite angle (their Eqs. 17, 20, 25). Every function raises ValueError for parameters outside
their ranges.
"""

from cmath import phase

from reference_solutions.parameters import require_positive

Cubic = tuple[float, float, float, float]


def polynomial(angle: float, radius: float) -> Cubic:
    """The coefficients of the cubic, from the highest power down, divided by the first."""
    require_positive("rad", angle=angle)
    if not 0.0 <= radius <= 1.0:
        raise ValueError(f"radius = {radius}; it must lie between 0 and 1")
    inertia, force = (2.0 - radius) / (1.0 + radius), 1.0 / (1.0 + radius)  # 1 - alpha of each
    gamma = 0.5 + inertia - force
    beta = (0.5 + gamma) ** 2 / 4.0
    s, middle, last = angle * angle, 0.5 + gamma - 2.0 * beta, 0.5 - gamma + beta
    lead = inertia + s * force * beta
    return (
        1.0,
        (1.0 - 3.0 * inertia + s * (force * middle + (1.0 - force) * beta)) / lead,
        (3.0 * inertia - 2.0 + s * (force * last + (1.0 - force) * middle)) / lead,
        (1.0 - inertia + s * (1.0 - force) * last) / lead,
    )


def swinging_root(angle: float, radius: float) -> complex:
    """The root with positive imaginary part, which is an oscillation, by Newton's iteration.

    The iteration starts at a small angle, where the root is exp(i angle), and follows the root as
    the angle increases.
    """
    steps = max(1, int(20.0 * angle))
    root = complex(1.0, 0.0)
    for k in range(1, steps + 1):
        a = angle * k / steps
        if k == 1:
            root = complex(1.0 - a * a / 2.0, a)
        _, b, c, d = polynomial(a, radius)
        for _ in range(30):
            value = ((root + b) * root + c) * root + d
            root -= value / ((3.0 * root + 2.0 * b) * root + c)
    return root


def spectral_radius(angle: float, radius: float) -> float:
    """The modulus of that root, by which a step multiplies the amplitude."""
    return abs(swinging_root(angle, radius))


def slowing(angle: float, radius: float) -> float:
    """The period over the exact one, which is the angle of a step over that of the root."""
    return angle / phase(swinging_root(angle, radius))
