"""Linear contact: a normal spring, and a tangential spring limited by Coulomb friction."""

from __future__ import annotations

import math
from typing import NamedTuple

from vv.engines.dem.contact.friction import shear_force
from vv.engines.dem.contact.touch import Touch
from vv.engines.kernels.compiled import inlined
from vv.engines.kernels.triples import Triple, at, dot
from vv.scene import Vector


class Linear(NamedTuple):
    """kn [N/m]; friction: ks [N/m] and mu, or None (Li 2018, Eqs. 4-8); eta_n [N s/m], or None.

    The viscous force is computed in `dashpots.py`; here it only limits friction. at_run_time: see
    `law.py`.
    """

    kn: float
    friction: tuple[float, float] | None
    eta_n: float | None
    at_run_time: int | None = None

    @property
    def stiffness(self) -> tuple[float, float]:
        """kn and ks [N/m]."""
        return self.kn, 0.0 if self.friction is None else self.friction[0]

    @property
    def columns(self) -> int:
        """The count of numbers stored per contact: the tangential force [N] has three."""
        return 3


@inlined
def normal_force(law: Linear, overlap: float, radius: float) -> tuple[float, float]:
    """The normal force kn U [N], and its energy kn U^2/2 [J]."""
    return law.kn * overlap, 0.5 * law.kn * overlap * overlap


@inlined
def shear_stiffness(
    law: Linear, touch: Touch, radius: float, mass: float, spring: Triple
) -> tuple[float, tuple[float, float]]:
    """The tangential stiffness ks [N/m], and the limits mu Fn [N] before and after the step."""
    ks, mu = law.friction  # type: ignore[misc]  # has friction
    return ks, friction_limits(law.kn, mu, law.eta_n, touch, spring)


@inlined
def shear_energy(law: Linear, overlap: float, radius: float, force: Triple) -> float:
    """The energy [J] of the tangential spring, F^2/(2 ks)."""
    return 0.5 * dot(force, force) / law.friction[0]  # type: ignore[index]  # as above


@inlined
def friction_force(
    law: Linear, touch: Touch, radius: float, mass: float, kept: Vector, row: int, dt: float
) -> tuple[Triple, float, float]:
    """The tangential force [N] of a spring stretched by the slide, at most mu Fn; see `law.py`."""
    spring = at(kept, row)
    ks, limits = shear_stiffness(law, touch, radius, mass, spring)
    force, taken = shear_force(spring, touch, ks, limits, dt)
    return force, shear_energy(law, touch.overlap, radius, force), taken


@inlined
def friction_limits(
    kn: float, mu: float, eta_n: float | None, touch: Touch, spring: Triple
) -> tuple[float, float]:
    """The limits of friction mu Fn [N] before and after a step.

    The opening rates at both ends are extrapolated from the mean rates of two steps, to second
    order. The limit before the step is at least the friction found then, whatever the extrapolation
    gives.
    """
    before, now = touch.overlap + touch.opened, touch.overlap
    if eta_n is None:
        return mu * kn * before, mu * kn * now
    pushed = kn * before - eta_n * touch.rates[0], kn * now - eta_n * touch.rates[1]
    return max(mu * pushed[0], math.sqrt(dot(spring, spring))), max(mu * pushed[1], 0.0)


@inlined
def damping_at(law: Linear, before: float, overlap: float, radius: float, mass: float) -> float:
    """The coefficient eta_n [N s/m], times `closing_factor` in the step in which contact begins."""
    eta_n = 0.0 if law.eta_n is None else law.eta_n
    return eta_n * closing_factor(overlap, overlap - before) if before <= 0.0 else eta_n


@inlined
def closing_factor(overlap: float, closed: float) -> float:
    """The factor on eta_n in the step in which a contact closes by `closed` [m] to an overlap [m].

    It is 1/2 plus the fraction of the step for which the contact is closed; without it, the impulse
    would be of first order in dt.
    """
    return float(0.5 + min(overlap / closed, 1.0))
