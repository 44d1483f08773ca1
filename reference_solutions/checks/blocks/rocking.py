"""A rocking block by small Runge-Kutta steps, with impacts by bisection: the second route.

The positions of the corners determine when the block meets the floor, and the conservation of
angular momentum about the landing corner determines its rate after the impact. Apart from the
geometry no formulas of the first route are used.
"""

from math import atan2, cos, hypot, pi, sin


# The case passes its parameters by name, one for one.
def leans(
    t: float,
    *,
    b: float,
    h: float,
    g: float,
    A: float,
    w: float,
    T: float,
    theta: float,
    steps: int,
) -> float:
    """The lean [rad] after a time t [s] in `steps` steps, initially at rest at theta > 0.

    With theta = 0 the motion starts when the sine first lifts the block towards +x.
    """
    x, rate, now, side, dt = theta, 0.0, 0.0, 1.0, t / steps
    while now < t - 1e-12:
        if x == rate == 0.0 and pushed(0.0, side, now, b, h, g, A, w, T) <= 0.0:
            now += dt  # The block stands.
            continue
        span = min(dt, t - now)
        if now < T < now + span:
            span = T - now
        one = stepped(x, rate, side, now, span, (b, h, g, A, w, T))
        if one[0] < 0.0:
            low, high = 0.0, span
            for _ in range(60):
                span = 0.5 * (low + high)
                one = stepped(x, rate, side, now, span, (b, h, g, A, w, T))
                low, high = (low, span) if one[0] < 0.0 else (span, high)
            rises = landed(one[1], b, h)
            one = (0.0, rises if rises > 1e-7 else 0.0)
            side = -side
        x, rate = one
        now += span
    return side * x


def landed(rate: float, b: float, h: float) -> float:
    """The rate [1/s] about the other corner of a block that lands with -rate about the first.

    The angular momentum about the landing corner, r x v + I w for a unit mass, is conserved.
    """
    about = (b * b + h * h) / 3.0
    speed = (h * rate, -b * rate)  # of the centre, which moves down for rate < 0
    before = h * speed[0] + b * speed[1] + about * rate
    return abs(before) / (about + b * b + h * h)


# The moments depend on all of these.
def pushed(
    x: float, side: float, now: float, b: float, h: float, g: float, A: float, w: float, T: float
) -> float:
    """The angular acceleration [1/s2] at a lean x towards `side`, from moments of the forces."""
    lean, r = atan2(b, h) - x, hypot(b, h)
    level = side * A * sin(w * now) if now < T else 0.0
    return (level * r * cos(lean) - g * r * sin(lean)) / (4.0 / 3.0 * r * r)


def stepped(
    x: float, rate: float, side: float, now: float, dt: float, law: tuple[float, ...]
) -> tuple[float, float]:
    """One step of the classical Runge-Kutta method of fourth order: the lean and its rate."""
    b, h, g, A, w, T = law
    T = T + 1e-12 if now + dt <= T + 1e-12 else (0.0 if now >= T - 1e-12 else T)

    def push(y: float, at: float) -> float:
        return pushed(y, side, at, b, h, g, A, w, T)

    k1, j1 = rate, push(x, now)
    k2, j2 = rate + dt / 2 * j1, push(x + dt / 2 * k1, now + dt / 2)
    k3, j3 = rate + dt / 2 * j2, push(x + dt / 2 * k2, now + dt / 2)
    k4, j4 = rate + dt * j3, push(x + dt * k3, now + dt)
    return x + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4), rate + dt / 6 * (j1 + 2 * j2 + 2 * j3 + j4)


def overturns(
    A: float, *, b: float, h: float, g: float, w: float, steps: int, patience: float = 12.0
) -> bool:
    """Whether a half sine overturns the block before it returns to the upright position."""
    law, T = (b, h, g, A, w, pi / w), pi / w
    x, rate, now, dt = 0.0, 0.0, 0.0, pi / w / steps
    while now < patience:
        if x == rate == 0.0 and pushed(0.0, 1.0, now, *law) <= 0.0:
            now += dt
            continue
        span = min(dt, T - now) if now < T - 1e-12 else dt
        x, rate = stepped(x, rate, 1.0, now, span, law)
        now += span
        if x > atan2(b, h) and rate > 0 and now > T:
            return True
        if x <= 0.0 and now > T:
            return False
    raise ValueError(f"A = {A} m/s2; neither after {patience} s")
