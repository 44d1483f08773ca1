"""Second route to the bouncing sphere and the bouncing pair: numerical integration of all stages.

Nothing is assumed about the sequence of stages: the next stage follows from the state at the end of
a stage, and each end is located as the root of a guard function. On the floor the spin is an
unknown. The pair is described in polar coordinates about the common centre of mass, with the
reduced mass; the spins follow from the integrals J of the shear force F and K of U F/2, since F
acts in the middle of the overlap U; the centre of mass moves at a constant velocity. Parameters are
those of the first routes `bounce` and `bouncing_pair`, whose code is not used.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import copysign, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Rates = Callable[[Array, float, float], list[float]]

RTOL = 3e-14  # the least that solve_ivp accepts is 2.2e-14
STEP = 0.06  # largest step times the rate of the normal spring in contact
FLIGHT = 400  # least number of steps of the whole time in flight
MOST = 1000  # stages


@dataclass(frozen=True)
class Touch:
    """A contact by functions of the state, whose last component is the shear force F [N] in stick.

    rates: the rates of the state without F', from the state, the normal force and F [N].
    """

    overlap: Callable[[Array], float]
    closing: Callable[[Array], float]
    slip: Callable[[Array], float]
    rates: Rates
    kn: float
    ks: float
    mu: float
    k: float  # rate of the normal spring [1/s]
    scale: Sequence[float]

    def excess(self, z: Array, way: float) -> float:
        """The rate of the spring force less that of its limit, in the direction of F [N/s]."""
        return -way * self.ks * self.slip(z) - self.mu * self.kn * self.closing(z)

    def margin(self, z: Array) -> float:
        """The friction limit less |F| [N]."""
        return self.mu * self.kn * self.overlap(z) - abs(float(z[-1]))


# The case passes its parameters by name, one for one.
def floor(
    t: ArrayLike,
    *,
    rho: float,
    r: float,
    kn: float,
    ks: float,
    mu: float,
    g: float,
    gap: float,
    v_n: float,
    v_t: float,
    w: float,
) -> Array:
    """Displacements (..., 2) [m] along the floor and up; state: x, z, v_x, v_z, w, F."""
    m = rho * pi * (2.0 * r) ** 3 / 6.0
    inertia = 2.0 * m * r * r / 5.0
    touch = Touch(
        overlap=lambda z: float(-gap - z[1]),
        closing=lambda z: float(-z[3]),
        slip=lambda z: float(z[2] - r * z[4]),
        rates=lambda z, press, f: [z[2], z[3], f / m, press / m - g, -r * f / inertia],
        kn=kn, ks=ks, mu=mu, k=(kn / m) ** 0.5,
        scale=[gap, gap, (g * gap) ** 0.5, (g * gap) ** 0.5, (g * gap) ** 0.5 / r],
    )  # fmt: skip
    return _march(t, np.array([0.0, 0.0, v_t, -v_n, w, 0.0]), touch)[..., :2]


# The case passes its parameters by name, one for one.
def pair(
    t: ArrayLike, *, rho: float, r1: float, r2: float, kn: float, ks: float, mu: float,
    gap: float, v_n: float, v_t: float, w1: float, w2: float, load: float,
) -> Array:  # fmt: skip
    """Displacements (..., 4) [m]; state: change of distance, angle, their rates, J, K, F."""
    m1, m2 = (rho * pi * (2.0 * r) ** 3 / 6.0 for r in (r1, r2))
    m, start = m1 * m2 / (m1 + m2), gap + r1 + r2
    pull = load / m

    def rates(z: Array, press: float, f: float) -> list[float]:
        far = start + z[0]
        outward = far * z[3] ** 2 + press / m - pull * np.cos(z[1])
        around = (f / m + pull * np.sin(z[1]) - 2.0 * z[2] * z[3]) / far
        return [z[2], z[3], outward, around, f, -(gap + z[0]) / 2.0 * f]

    def slip(z: Array) -> float:
        u, around = -gap - z[0], (start + z[0]) * z[3]
        for r, m_i, w in ((r1, m1, w1), (r2, m2, w2)):
            around -= (r - u / 2.0) * (w - 2.5 * (r * z[4] - z[5]) / (m_i * r * r))
        return float(around)

    touch = Touch(
        overlap=lambda z: float(-gap - z[0]),
        closing=lambda z: float(-z[2]),
        slip=slip,
        rates=rates,
        kn=kn, ks=ks, mu=mu, k=(kn / m) ** 0.5,
        scale=[gap, gap / start, v_n, v_n / start, m * v_n, gap * m * v_n],
    )  # fmt: skip
    z = _march(t, np.array([0.0, 0.0, -v_n, v_t / start, 0.0, 0.0, 0.0]), touch)
    apart = _parted(z[..., 0], z[..., 1], start)
    carried = np.multiply.outer(np.asarray(t), np.array([-v_n, v_t])) * m2 / (m1 + m2)
    return np.concatenate([carried - m / m1 * apart, carried + m / m2 * apart], axis=-1)


def _parted(far: Array, angle: Array, start: float) -> Array:
    """The change (..., 2) [m] of the vector between the centres; far: change of its length."""
    x = far * np.cos(angle) - 2.0 * start * np.sin(angle / 2.0) ** 2
    y = (far + start) * np.sin(angle)
    return np.stack([x, y], axis=-1)


def _march(t: ArrayLike, z: Array, touch: Touch) -> Array:
    """The states (..., n) at times t, stage after stage."""
    from scipy.integrate import solve_ivp

    t, now = np.asarray(t, dtype=np.float64), 0.0
    states, way, touching = np.full((*t.shape, len(z)), np.nan), 0.0, False
    force = touch.kn * touch.scale[2] / touch.k
    for _ in range(MOST):
        rate, guards = _mode(touch, touching, way)
        run = solve_ivp(
            rate,
            (now, float(t.max()) * (1.0 + 1e-12) + 1e-12),
            z,
            method="DOP853",
            dense_output=True,
            events=[_falling(guard) for guard in guards],
            rtol=RTOL,
            atol=RTOL * np.array([*touch.scale, force]),
            max_step=STEP / touch.k if touching else float(t.max()) / FLIGHT,
        )
        here = (now <= t) & (t <= run.t[-1])
        if run.sol is not None and here.any():
            states[here] = run.sol(t[here]).T
        if run.status == 0:
            return states
        if run.status < 0:
            raise RuntimeError(f"from t = {now} s; {run.message}")
        now, z = run.t[-1], np.array(run.y[:, -1])
        first = bool(len(run.t_events[0]))
        touching, way, z[-1] = _choose(touch, z, touching, way, first)
    raise RuntimeError(f"{MOST} stages did not reach t = {t.max()} s")


def _mode(
    touch: Touch, touching: bool, way: float
) -> tuple[Callable[[float, Array], list[float]], list[Callable[[Array], float]]]:
    """The rates of a stage, and the guards that end it at zero: first that of the contact."""
    if not touching:
        return lambda _, z: [*touch.rates(z, 0.0, 0.0), 0.0], [lambda z: -touch.overlap(z)]
    if not way:

        def stuck(_: float, z: Array) -> list[float]:
            return [*touch.rates(z, touch.kn * touch.overlap(z), z[-1]), -touch.ks * touch.slip(z)]

        return stuck, [touch.overlap, touch.margin]
    grip = way * touch.mu * touch.kn

    def slipping(_: float, z: Array) -> list[float]:
        press = touch.kn * touch.overlap(z)
        return [*touch.rates(z, press, grip * touch.overlap(z)), 0.0]

    return slipping, [touch.overlap, lambda z: touch.excess(z, way)]


def _choose(
    touch: Touch, z: Array, touching: bool, way: float, first: bool
) -> tuple[bool, float, float]:
    """The next stage: whether there is contact, the sign of F in slip (0 in stick), F in stick."""
    if touching and first:
        return False, 0.0, 0.0
    if touching and way:
        return True, 0.0, way * touch.mu * touch.kn * touch.overlap(z)
    if touching:
        return True, copysign(1.0, float(z[-1])), 0.0
    way = -copysign(1.0, touch.slip(z))
    return True, way if touch.excess(z, way) > 0.0 else 0.0, 0.0


def _falling(guard: Callable[[Array], float]) -> Callable[[float, Array], float]:
    """The guard as a terminal event of solve_ivp."""

    def event(_: float, z: Array) -> float:
        return guard(z)

    event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
    return event
