"""An oblique impact of a sphere on a wall or another sphere, with partial slip in the contact.

The normal force, the equations of motion and the lever arms are those of
`reference_solutions.impact.rebound` for elastic spheres without losses. The tangential force T
follows from the method of dimensionality reduction: a point at x on a line through the contact, at
the depth d = x^2/R, touches as the overlap U exceeds d. Its spring is stretched by the relative
tangential displacement (slide) since then, at most by h (U - d), at which it slips, with h = 3 mu
K/(2 S). T is -S times the integral of the stretch over sqrt(d) from 0 to sqrt(U) (Popov and Hess
2015; Jaeger 1993). For a single loading this agrees with the annulus of slip of Cattaneo (1938) and
Mindlin (1949), for other paths with Mindlin and Deresiewicz (1953).

All points that slip in one direction stick at the same instant, when the rate of slide falls below
h U'; points that stick begin to slip from the edge inwards. At any time the contact therefore
sticks as a whole (while it grows), slips as a whole, or slips outside of one point and sticks
inside of it. The inner part has the state at which this point was last at the edge of the contact,
or slipped. Between such changes the equations are integrated by an explicit method of order 8. T
follows in closed form from the states stored, unless the whole contact sticks.
"""

from collections.abc import Callable
from functools import cache
from math import copysign, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from reference_solutions.impact.rebound import MOST, RELATIVE, WALL, After, Impact, Law, Sphere

Array = NDArray[np.float64]
Inner = tuple[float, float, float]
"""sqrt(d) of the innermost point that slips, and the slide and T when it was the edge."""
NEAR = 1e-9  # accuracy of stored times over the duration; the error of T is its square
STEPS = 50  # least number of steps in the loading and unloading of a contact


class Slipped(NamedTuple):
    """A part that slipped outside of sqrt(d) = start until it stuck at this U, slide and T.

    sign: the direction of that slip.
    """

    sign: float
    start: float
    overlap: float
    slide: float
    force: float


class Grown(NamedTuple):
    """A part that stuck while the contact grew: states and rates between `begin` and `end` [s]."""

    begin: float
    end: float
    state: Callable[[float], Array]


@cache
def rebound(
    law: Law,
    sphere: Sphere,
    *,
    vn: float,
    vt: float = 0.0,
    spin: float = 0.0,
    partner: Sphere = WALL,
    partner_spin: float = 0.0,
) -> After:
    """The state after an impact; parameters as for `reference_solutions.impact.rebound.rebound`.

    Raises ValueError for a law other than Hertz without losses, RuntimeError if the integration
    fails.
    """
    if law.p != 1.5 or law.z or law.h or not law.S or not law.mu:
        raise ValueError(f"{law}; micro-slip is known for Hertz with p = 1.5, S and mu, z = h = 0")
    contact = _Contact(law, sphere, partner, vn)
    y = np.array([0.0, 0.0, -vn, vt, spin, partner_spin, 0.0, 0.0])
    first = contact.rate_of_slide(y)
    mode = copysign(1.0, first) if abs(first) > contact.h * vn else 0.0
    contact.parts.clear()
    time = 0.0
    for _ in range(2 * MOST):
        time, y, event = contact.next_change(time, y, mode)
        if event == "apart":
            return After(y[2], y[3], y[4], y[5], time, time)
        mode = contact.after(event, y, mode)
    raise RuntimeError(f"the contact changed more than {2 * MOST} times how it sticks and slips")


class _Contact:
    """The equations of a contact with partial slip; states (8,): displacement, velocity, spins, T,
    slide.

    parts: the parts that stick, innermost first.
    """

    def __init__(self, law: Law, sphere: Sphere, partner: Sphere, vn: float) -> None:
        self.law, self.impact = law, Impact(law, sphere, partner, vn)
        self.longest = self.impact.longest
        self.h = 1.5 * law.mu * law.K / law.S
        self.parts: list[Slipped | Grown] = []
        sizes = self.impact.sizes
        self.sizes = np.array([*sizes, self.h * sizes[0]])

    def rate_of_slide(self, y: Array) -> float:
        """The rate of slide s [m/s]."""
        return self.impact.slip(y)

    def growth(self, y: Array) -> float:
        """h U' [m/s]."""
        return self.h * self.impact.closing(y)[1]

    def overlap(self, y: Array) -> float:
        """U [m], at least 0."""
        return max(self.impact.frame(y)[2], 0.0)

    def inner(self, t: float, y: Array, sign: float) -> Inner:
        """sqrt(d) of the innermost point that slips in this direction, its stored slide and T."""
        overlap = self.overlap(y)
        if not self.parts:
            return 0.0, 0.0, 0.0
        part = self.parts[-1]
        if isinstance(part, Slipped):
            deep = 0.5 * (part.overlap + overlap + part.sign * (y[7] - part.slide) / self.h)
            edge = sqrt(min(max(deep, part.start**2), part.overlap))
            lost = part.sign * self.h * full(edge, sqrt(part.overlap), part.overlap)
            return edge, part.slide, part.force + self.law.S * lost
        old = part.state(self.moment(part, sign * y[7] - self.h * overlap, t, sign))
        return sqrt(self.overlap(old)), float(old[7]), float(old[6])

    def moment(self, part: Grown, wanted: float, t: float, sign: float) -> float:
        """The time in the growth of a part at which sign times slide less h U was `wanted`.

        Newton's method starts as long before the end of the growth as t is after it.
        """
        low, high = part.begin, part.end
        time = max(high - max(t - high, NEAR * self.longest), low)
        for _ in range(80):
            y = part.state(time)
            off = sign * y[7] - self.h * self.overlap(y) - wanted  # decreases with time
            rate = sign * self.rate_of_slide(y) - self.growth(y)
            low, high = (time, high) if off > 0.0 else (low, time)
            new = time - off / rate if rate < 0.0 else low - 1.0
            new = new if low <= new <= high else 0.5 * (low + high)
            near = abs(new - time) <= NEAR * self.longest / 20.0
            time = float(new)
            if near:
                break
        return float(time)

    def force(self, t: float, y: Array, sign: float) -> float:
        """T of a contact that slips in the direction `sign`, in part or as a whole."""
        overlap = self.overlap(y)
        edge, slide, within = self.inner(t, y, sign)
        outside = sign * self.h * full(edge, sqrt(overlap), overlap)
        return float(within - self.law.S * (edge * (float(y[7]) - slide) + outside))

    def rates(self, t: float, y: Array, mode: float) -> Array:
        """The derivative y'; mode: the sign of slip, 0 if the whole contact sticks."""
        whole = y.copy()
        whole[6] = self.force(t, y, mode) if mode else y[6]
        slope, slide = self.impact.slope(whole[:7], 0.0), self.rate_of_slide(y)
        charging = 0.0 if mode else -self.law.S * sqrt(self.overlap(y)) * slide
        return np.array([*slope[:6], charging, slide])

    def next_change(self, time: float, y: Array, mode: float) -> tuple[float, Array, str]:
        """Time, state and name of the next change; what stuck while the contact grew is stored."""
        from scipy.integrate import solve_ivp

        def apart(t: float, y: Array) -> float:
            return self.impact.frame(y)[2]

        def turns(t: float, y: Array) -> float:
            slide, growth = self.rate_of_slide(y), self.growth(y)
            return mode * slide - growth if mode else growth - abs(slide)

        def through(t: float, y: Array) -> float:
            return self.left(t, y, mode) if mode and self.parts else 1.0

        events = (apart, turns, through)
        for event in events:
            event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
        found = solve_ivp(
            lambda t, y: self.rates(t, y, mode), (time, time + self.longest), y, "DOP853",
            events=events, rtol=RELATIVE, atol=1e-15 * self.sizes, dense_output=not mode,
            first_step=1e-6 * self.longest, max_step=self.longest / 10.0 / STEPS,
        )  # fmt: skip
        if found.status != 1:
            raise RuntimeError(f"the contact did not end within {self.longest:.3g} s")
        end, state = float(found.t[-1]), found.y[:, -1].copy()
        name = next(e.__name__ for e, at in zip(events, found.t_events, strict=True) if len(at))
        if mode:
            state[6] = self.force(end, state, mode)
        else:
            self.parts.append(Grown(time, end, found.sol))
        return end, state, name

    def left(self, t: float, y: Array, sign: float) -> float:
        """The slide [m] left until all of the outermost stuck part slips; negative after that."""
        part, overlap = self.parts[-1], self.overlap(y)
        if isinstance(part, Slipped):
            deep = self.h * (part.overlap + overlap - 2.0 * part.start**2)
            return float(deep + part.sign * (y[7] - part.slide))
        old = part.state(part.begin)
        past = self.h * (overlap - self.overlap(old))
        return float(past - sign * (y[7] - old[7]))

    def after(self, event: str, y: Array, mode: float) -> float:
        """The mode of the contact after a change."""
        if event == "through":
            self.parts.pop()
            if self.parts and isinstance(last := self.parts[-1], Slipped) and last.sign == mode:
                self.parts.pop()
            return mode
        if not mode:
            return copysign(1.0, self.rate_of_slide(y))
        edge = self.inner(0.0, y, mode)[0] if self.parts else 0.0
        self.parts.append(Slipped(mode, edge, self.overlap(y), float(y[7]), float(y[6])))
        return 0.0 if self.growth(y) > 0.0 else -mode


def full(start: float, edge: float, overlap: float) -> float:
    """The integral of U - d over sqrt(d) from start to edge."""
    return overlap * (edge - start) - (edge**3 - start**3) / 3.0
