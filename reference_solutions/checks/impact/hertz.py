"""Hertz's impact by quadrature of its energy integral, and by Runge-Kutta steps: second routes."""

from math import sqrt


def contact_time(*, m: float, K: float, v: float) -> float:
    """The duration [s], twice the time to the largest overlap.

    The rate follows from m u'^2/2 + 2/5 K u^(5/2) = const. The substitution u = U sin^2 s removes
    the singularity of the integrand at u = U.
    """
    from scipy.integrate import quad

    largest = (1.25 * m * v * v / K) ** 0.4
    half, _ = quad(_slowness, 0.0, 1.0, epsabs=1e-14, epsrel=1e-13)
    return float(2.0 * largest / v * half)


def _slowness(x: float) -> float:
    """d(t v/U)/dx with u/U = 1 - x^2, where 1 - (u/U)^(5/2) is x^2 times a smooth factor."""
    part = 1.0 - x * x
    factor = 2.5 if x == 0.0 else (1.0 - part**2.5) / (x * x)
    return 2.0 / sqrt(factor)


def stepped(t: float, *, m: float, K: float, v: float, steps: int) -> tuple[float, float]:
    """Overlap [m] and its rate [m/s] at time t [s] within the contact, by Runge-Kutta steps.

    With u = q^4 and dt = q^3 ds the equations are polynomials, also at the start of the contact.
    Steps are equal in s, apart from the last, which ends at t.
    """
    scale = (1.25 * m * v * v / K) ** 0.1
    state, ds = (0.0, v, 0.0), 16.0 * scale / v / steps
    for _ in range(10 * steps):
        ahead = _step(state, ds, m, K)
        if ahead[2] > t:
            break
        state = ahead
    low, high = 0.0, ds
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _step(state, middle, m, K)[2] <= t else (low, middle)
    q, rate, _ = _step(state, 0.5 * (low + high), m, K)
    return q**4, rate


State = tuple[float, float, float]


def _slope(state: State, m: float, K: float) -> State:
    """The derivatives by s of q, of the rate of overlap and of time."""
    q, rate, _ = state
    return 0.25 * rate, -K / m * q**9, q**3


def _step(state: State, ds: float, m: float, K: float) -> State:
    """A Runge-Kutta step of fourth order."""
    one = _slope(state, m, K)
    two = _slope(_along(state, 0.5 * ds, one), m, K)
    three = _slope(_along(state, 0.5 * ds, two), m, K)
    four = _slope(_along(state, ds, three), m, K)
    mean = [
        (a + 2.0 * b + 2.0 * c + d) / 6.0 for a, b, c, d in zip(one, two, three, four, strict=True)
    ]
    return _along(state, ds, (mean[0], mean[1], mean[2]))


def _along(state: State, ds: float, slope: State) -> State:
    return (
        state[0] + ds * slope[0],
        state[1] + ds * slope[1],
        state[2] + ds * slope[2],
    )
