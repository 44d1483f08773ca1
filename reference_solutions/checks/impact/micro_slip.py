"""An oblique impact with partial slip, by rates and collocation: the second route.

T is integrated from its rate T' = -S (c s' + h e U' (sqrt(U) - c)), with slip of sign e outside of
c: the rate of Mindlin's stiffness where the contact sticks, and of the limit of slip elsewhere (the
form of Mindlin and Deresiewicz 1953 and of Thornton and Yin 1991). The state has the polar
coordinates and the variable of `reference_solutions.checks.impact.rebound`, in which all functions
are smooth. At c, the value of e s - h U equals the one at which the contact grew to c or slipped
back to it; for `Grown` c is found by bisection in the panels of that time. The code of
`reference_solutions.impact.micro_slip`, which has T in closed form from its history and integrates
in time, is not used.
"""

from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre

from reference_solutions.checks.impact.rebound import (
    _FIT,
    INSIDE,
    NODES,
    WHOLE,
    Array,
    Strike,
    _read,
)

HALVINGS, PANELS = 44, 48
GO, CLOSE = 0.5, 1e-8  # shares of a panel: advance to the end of a part, and its accuracy


class Slipped(NamedTuple):
    """A part that slipped in the direction `sign` outside of sqrt(d) = start.

    overlap, slide: U and the slide at which it stuck.
    """

    sign: float
    start: float
    overlap: float
    slide: float


class Grown(NamedTuple):
    """A part that grew while it stuck.

    panels: Legendre coefficients (NODES, 2, p) of q and slide in p panels of s.
    """

    panels: Array


Parts = list[Slipped | Grown]


class Contact(NamedTuple):
    """The bodies, the law and the parts that stick, innermost first."""

    strike: Strike
    parts: Parts

    @property
    def h(self) -> float:
        """The factor h of the largest stretch, h (U - d)."""
        return 1.5 * self.strike.mu * self.strike.K / self.strike.S

    def inner(self, y: Array, sign: float) -> Array:
        """c (k,) in states (9, k) with slip in the direction `sign`."""
        if not self.parts:
            return np.zeros(y.shape[1])
        part, overlap = self.parts[-1], y[0] ** 4
        if isinstance(part, Slipped):
            twice = part.overlap + overlap + part.sign * (y[8] - part.slide) / self.h
            return np.asarray(np.sqrt(np.clip(0.5 * twice, part.start**2, part.overlap)))
        wanted = sign * y[8] - self.h * overlap
        low, high = np.zeros(y.shape[1]), np.full(y.shape[1], float(part.panels.shape[2]))
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            q, slide = grown(part, middle)
            later = sign * slide - self.h * q**4 > wanted  # decreases as the contact grows
            low, high = np.where(later, middle, low), np.where(later, high, middle)
        return np.asarray(grown(part, 0.5 * (low + high))[0] ** 2)

    def slopes(self, y: Array, sign: float) -> Array:
        """dy/ds (9, k); sign: direction of slip outside of c, 0 if the whole contact sticks."""
        slope = self.strike.slopes(y[:8], 0.0)
        q = y[0]
        slide = np.divide(-slope[5], self.strike.S * q**2, out=np.zeros_like(q), where=q != 0.0)
        if sign:
            c = self.inner(y, sign)
            growth = -(q**3) * y[1]
            slope[5] = -self.strike.S * (c * slide + self.h * sign * growth * (q**2 - c))
        return np.vstack([slope, slide])

    def panel(self, y: Array, length: float, sign: float) -> tuple[Array, Array]:
        """The state at the end of a panel in s, and the states at its nodes."""
        at = np.repeat(y[:, None], NODES, axis=1)
        for _ in range(100):
            new = y[:, None] + length * self.slopes(at, sign) @ INSIDE.T
            scale = np.abs(new).max(axis=1)[:, None]
            done = bool((np.abs(new - at) <= 4e-16 * scale).all())
            at = new
            if done:
                break
        return y + length * self.slopes(at, sign) @ WHOLE, at

    def margins(self, y: Array, sign: float) -> tuple[float, float, float]:
        """Margins of three events, each negative once its event has occurred.

        They are: the bodies separate; slip reverses or begins; all of the outermost stuck part
        slips.
        """
        slope = self.slopes(y[:, None], sign)[:, 0]
        slide, growth = float(slope[8] / y[0] ** 3) if y[0] else 0.0, float(-self.h * y[1])
        turns = sign * slide - growth if sign else growth - abs(slide)
        if not sign or not self.parts:
            return float(y[0]), turns, 1.0
        part, overlap = self.parts[-1], float(y[0]) ** 4
        if isinstance(part, Slipped):
            left = self.h * (part.overlap + overlap - 2.0 * part.start**2)
            return float(y[0]), turns, left + part.sign * float(y[8] - part.slide)
        q, slid = grown(part, np.zeros(1))
        begun = sign * slid[0] - self.h * q[0] ** 4
        return float(y[0]), turns, float(begun - (sign * y[8] - self.h * overlap))


def grown(part: Grown, when: Array) -> tuple[Array, Array]:
    """q and slide (k,) at times (k,), which are counted in panels."""
    which = np.minimum(when.astype(int), part.panels.shape[2] - 1)
    x = 2.0 * (when - which) - 1.0
    basis = legendre.legvander(x, NODES - 1)
    values = np.einsum("kn,nvk->vk", basis, part.panels[:, :, which])
    return values[0], values[1]


def after(
    strike: Strike, *, vn: float, vt: float, spin: float = 0.0, partner_spin: float = 0.0
) -> tuple[float, ...]:
    """The state after an impact, as in `reference_solutions.checks.impact.rebound.after`."""
    contact = Contact(strike, [])
    deep = (1.25 * strike.reduced * vn**2 / strike.K) ** 0.4
    length = 16.0 * deep**0.25 / vn / PANELS
    y = np.array([0.0, -vn, vt, spin, partner_spin, 0.0, 0.0, 0.0, 0.0])
    first = vt - strike.radius * spin
    first -= strike.partner_radius * partner_spin if strike.partner_radius < np.inf else 0.0
    sign = float(np.sign(first)) if abs(first) > contact.h * vn else 0.0
    panels: list[Array] = []
    for _ in range(20 * PANELS):
        ahead, nodes = contact.panel(y, length, sign)
        crossed = [k for k, left in enumerate(contact.margins(ahead, sign)) if left < 0.0]
        event = -1
        if crossed:
            shares = [(_share(contact, y, length, sign, k), k) for k in crossed]
            share, event = min(shares)
            # c tends to 0 as the square root of the remainder: panels shrink towards its end
            part_way = event == 2 and share > CLOSE and len(contact.parts) == 1
            share, event = (GO * share, -1) if part_way else (share, event)
            ahead, nodes = contact.panel(y, share * length, sign)
        if not sign:
            panels.append(_FIT @ nodes[[0, 8]].T)
        y = ahead
        if event == 0:
            return _read(strike, y[:8])
        if event > 0:
            sign = _next(contact, y, sign, event, panels)
            panels = []
    raise RuntimeError("the contact did not end")


def _share(contact: Contact, y: Array, length: float, sign: float, which: int) -> float:
    """The fraction of a panel at which a margin becomes negative."""
    from scipy.optimize import brentq

    def margin(share: float) -> float:
        return contact.margins(contact.panel(y, share * length, sign)[0], sign)[which]

    start = 1e-9
    if margin(start) <= 0.0:
        return start
    rough = 1e-3 if which == 2 and len(contact.parts) == 1 else 1e-14  # panels shrink to it
    return float(brentq(margin, start, 1.0, xtol=1e-15, rtol=rough))


def _next(contact: Contact, y: Array, sign: float, event: int, panels: list[Array]) -> float:
    """The sign of slip after an event; parts that stick are stored."""
    parts = contact.parts
    if not sign:
        parts.append(Grown(np.stack(panels, axis=2)))
        slide = contact.slopes(y[:, None], 0.0)[8, 0]
        return float(np.sign(slide))
    if event == 2:
        parts.pop()
        if parts and isinstance(last := parts[-1], Slipped) and last.sign == sign:
            parts.pop()
        return sign
    start = float(contact.inner(y[:, None], sign)[0])
    parts.append(Slipped(sign, start, float(y[0]) ** 4, float(y[8])))
    return 0.0 if y[1] < 0.0 else -sign
