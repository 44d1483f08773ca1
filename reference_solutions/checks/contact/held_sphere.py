"""A sphere held between two walls by friction, by a leapfrog: the second route."""


def after(
    t: float, *, m: float, ks: float, mu: float, pressed: float, g: float, steps: int
) -> float:
    """The upward displacement [m] at the time t [s]; its error falls as steps**-2."""
    z, spring, most, dt = 0.0, 0.0, mu * pressed, t / steps
    speed = -g * dt / 2
    for _ in range(steps):
        z += speed * dt
        spring = max(-most, min(most, spring - ks * speed * dt))
        speed += (2 * spring / m - g) * dt
    return z
