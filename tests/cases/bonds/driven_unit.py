"""A unit of four with a driven top, integrated: the motion of its base with inertia and viscosity.

By symmetry the base has one radius r, and m r'' is the force of its springs less eta r'. Shear
springs change by S' = -L a', with the length L and the angle a of an inclined bond.
"""

from __future__ import annotations

from collections.abc import Callable
from math import hypot, sqrt

from vv.case import Parameters
from vv.scene import Vector

HEIGHT, RADIUS = sqrt(2.0 / 3.0), 1.0 / sqrt(3.0)
LONGEST = 0.1  # strain up to which a unit is loaded
Event = Callable[[float, Vector], float]


class Unit:
    """A unit loaded at a rate [1/s]; a state is (r less its start, over xb; its rate; S over xb).

    Times are in units of sqrt(m/kn).
    """

    def __init__(self, p: Parameters, rate: float) -> None:
        self.p, self.rate = p, rate
        self.unit = sqrt(p["m"] / p["kn"])
        self.speed = rate * HEIGHT * p["d"]

    def start(self) -> list[float]:
        """At rest but for the speed of small strains."""
        kn, ks = self.p["kn"], self.p["ks"]
        narrows = (kn - ks) / (5.0 * kn + ks) * self.rate * RADIUS * self.p["d"]
        return [0.0, -narrows * self.unit / self.p["xb"], 0.0]

    def shape(self, t: float, state: Vector) -> tuple[float, float, float]:
        """r and z [m], and the stretch of inclined bonds [m] without differences of lengths."""
        d, wider = self.p["d"], state[0] * self.p["xb"]
        higher = self.speed * t * self.unit
        r, z = RADIUS * d + wider, HEIGHT * d + higher
        longer = 2.0 * d * (RADIUS * wider + HEIGHT * higher) + wider**2 + higher**2
        return r, z, longer / (hypot(r, z) + d)

    def rates(self, bonded: bool) -> Callable[[float, Vector], list[float]]:
        """The rates of a state, with or without the bonds of the base."""
        kn, ks, xb = (self.p[name] for name in ("kn", "ks", "xb"))
        heavy = self.p["m"] / self.unit

        def told(t: float, state: Vector) -> list[float]:
            (r, z, stretch), (wider, moves, shear) = self.shape(t, state), state
            length, out = hypot(r, z), moves * xb / self.unit
            base = 3.0 * kn * wider * xb if bonded else 0.0
            inward = (kn * stretch * r - ks * shear * xb * z) / length + base
            slips = -(z * out - r * self.speed) / length
            pull = inward + self.p["eta"] * out
            return [moves, -pull / heavy * self.unit / xb, slips * self.unit / xb]

        return told

    def stress(self, t: float, state: Vector) -> float:
        """The size of the stress [Pa] under which the top moves, with its viscosity."""
        r, z, stretch = self.shape(t, state)
        shear = self.p["ks"] * state[2] * self.p["xb"]
        force = 3.0 * (self.p["kn"] * stretch * z + shear * r) / hypot(r, z)
        area = sqrt(3.0) / 2.0 * self.p["d"] ** 2
        return float(abs(force + self.p["eta"] * self.speed) / area)

    def until(
        self, begin: tuple[float, Vector | list[float]], bonded: bool, event: Event
    ) -> tuple[float, Vector]:
        """The time and the state at which `event` is zero."""
        from scipy.integrate import solve_ivp

        event.terminal = True  # type: ignore[attr-defined]
        end = LONGEST / abs(self.rate) / self.unit
        found = solve_ivp(
            self.rates(bonded), (begin[0], end), begin[1], "DOP853", events=event, rtol=1e-11,
            atol=1e-12,
        )  # fmt: skip
        assert len(found.t_events[0])
        return found.t[-1], found.y[:, -1]

    def tension(self) -> float:
        """The stress [Pa] at which inclined bonds open."""
        xb = self.p["xb"]
        return self.stress(
            *self.until((0.0, self.start()), True, lambda t, s: self.shape(t, s)[2] / xb - 1.0)
        )

    def pressures(self) -> tuple[float, float]:
        """The pressures [Pa] at which the base opens, and at which inclined bonds slide."""
        p = self.p

        def slides(t: float, state: Vector) -> float:
            shear = p["ks"] * abs(state[2]) * p["xb"]
            return float(shear + p["mu_p"] * p["kn"] * self.shape(t, state)[2]) / p["fs0"] - 1.0

        opened = self.until((0.0, self.start()), True, lambda _, s: sqrt(3.0) * s[0] - 1.0)
        return self.stress(*opened), self.stress(*self.until(opened, False, slides))
