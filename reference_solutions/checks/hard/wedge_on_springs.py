"""A sphere that slides down a groove on springs, by a leapfrog: the second route."""

from math import cos, radians, sin


def after(
    t: float, *, dip: float, xi: float, mu: float, g: float, m: float, ks: float, steps: int
) -> float:
    """The displacement [m] at the time t [s]; its error falls as steps**-2."""
    i, dt, s, spring = radians(dip), t / steps, 0.0, 0.0
    most = mu * m * g * cos(i) / (2 * sin(xi / 2))
    speed = g * sin(i) * dt / 2
    for _ in range(steps):
        s += speed * dt
        spring = max(-most, min(most, spring + ks * speed * dt))
        speed += (g * sin(i) - 2 * spring / m) * dt
    return s
