"""The rates at which four bonded elements separate when inclined bonds slide under a falling top.

The top pushes base elements without bonds outwards. At the radius r and the height z of the top, an
inclined contact has the length L = sqrt(r^2 + z^2), the normal force N = kn (d - L) and the
friction mu N against the outward slip: m r'' = N (r - mu z)/L - eta r', z' = -|v|, with the speed v
of the top.
"""

from collections.abc import Callable
from math import cos, hypot, sin

from reference_solutions.bonds.lattice_material import Element
from reference_solutions.bonds.tetrahedral_unit import A0, sliding_failure
from reference_solutions.parameters import require_finite, require_positive

FINE = 0.05  # Runge-Kutta step, over the shorter of the times sqrt(m/kn) and m/eta
LONGEST = 5_000  # steps of sliding after which bonds count as not separating


def separation_rates(
    element: Element, d: float, *, m: float, eta: float, rate: float
) -> tuple[float, float]:
    """The rates [m/s] at which surfaces open and slide as an inclined contact ends.

    m: mass of an element [kg]; eta: viscosity on it [N s/m]; rate: strain rate of the unit [1/s].
    Both rates are 0 where viscosity slows the base so much that the top does not separate from it
    and the contact slides on. Raises ValueError outside the range of `sliding_failure`, and for a
    mass that is not positive.
    """
    require_positive("kg", m=m)
    require_finite("N s/m, 1/s", eta=eta, rate=rate)
    kn, mu = element.kn, element.mu_p
    begin = sliding_failure(element, d)
    r, v = d * sin(A0) * (1.0 + begin.lateral), 0.0
    z, fall = d * cos(A0) * (1.0 + begin.strain), abs(rate) * d * cos(A0)
    step = FINE / ((kn / m) ** 0.5 + eta / m)

    def pushed(r: float, v: float, z: float) -> float:
        length = hypot(r, z)
        return (kn * (d - length) * (r - mu * z) / length - eta * v) / m

    opened = False
    for _ in range(LONGEST):
        length = hypot(r, z)
        opening, slip = (r * v - z * fall) / length, (z * v + r * fall) / length
        if length >= d:
            return opening, slip
        if opened and opening <= 0.0:
            break
        opened = opening > 0.0
        r, v, z = _stepped(pushed, r, v, z, fall, step)
    return 0.0, 0.0


def _stepped(
    pushed: Callable[[float, float, float], float],
    r: float, v: float, z: float, fall: float, step: float,
) -> tuple[float, float, float]:  # fmt: skip
    """r, v and z after a Runge-Kutta step; pushed: r'' as a function of r, v and z."""
    half, end = z - 0.5 * step * fall, z - step * fall
    a1 = pushed(r, v, z)
    v2 = v + 0.5 * step * a1
    a2 = pushed(r + 0.5 * step * v, v2, half)
    v3 = v + 0.5 * step * a2
    a3 = pushed(r + 0.5 * step * v2, v3, half)
    v4 = v + step * a3
    a4 = pushed(r + step * v3, v4, end)
    r += step / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
    v += step / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
    return r, v, end


def unexplained_energy(
    element: Element, d: float, dt: float, *, m: float, eta: float, rate: float
) -> float:
    """The largest error [J] of the energy balance when three contacts end within a step dt [s].

    With the overlap U of the previous step and the rates v of opening and w of slip, the normal
    force does the work kn U v dt/2 where its spring stores kn U^2/2. As U < v dt, the gain is at
    most kn (v dt)^2/8. The friction mu kn U causes a loss of mu kn U w dt/2 and of the energy
    (mu kn U)^2/(2 ks) of its spring. Gain and loss have opposite signs.
    """
    kn, ks, _, _, mu = element
    opening, slip = separation_rates(element, d, m=m, eta=eta, rate=rate)
    gained = kn * opening**2 / 8.0
    taken = 0.5 * mu * kn * opening * (slip + mu * kn * opening / ks)
    return 3.0 * max(gained, taken) * dt**2
