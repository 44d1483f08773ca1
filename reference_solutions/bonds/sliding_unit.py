"""The rates at which four bonded elements separate when inclined bonds slide under a falling top.

Base elements without bonds are pushed outwards by the top. At the radius r and with the top at
the height z, an inclined contact has length L = sqrt(r^2 + z^2), pushes with N = kn (d - L) and
rubs with mu N against the slip, which goes outwards: m r'' = N (r - mu z)/L - eta r', z' = -|v|.
"""

from collections.abc import Callable
from math import cos, hypot, sin

from reference_solutions.bonds.lattice_material import Element
from reference_solutions.bonds.tetrahedral_unit import A0, sliding_failure
from reference_solutions.parameters import require_finite, require_positive

FINE = 0.05  # of the shorter of the times sqrt(m/kn) and m/eta: a step of Runge and Kutta
LONGEST = 5_000  # steps; bonds that slide for so long do not separate


def separation_rates(
    element: Element, d: float, *, m: float, eta: float, rate: float
) -> tuple[float, float]:
    """The rates [m/s] at which surfaces open and slide as an inclined contact ends.

    m: mass of an element [kg]; eta: viscosity on it [N s/m]; rate: strain rate of the unit [1/s].
    Zeros where viscosity lets the top follow, so that the contact slides on and does not end.
    Raises ValueError outside the range of `sliding_failure`, and for a mass that is not positive.
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
    """r, v and z after a step of Runge and Kutta; pushed: r'' from r, v and z."""
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
    """The largest energy [J] that three contacts leave unexplained when they end within a step [s].

    The push kn U of the step before gives kn U v dt/2 where its spring holds kn U^2/2; U < v dt, so
    the gain is kn (v dt)^2/8 at most. Friction mu kn U on the slip w takes mu kn U w dt/2 and what
    its spring holds, (mu kn U)^2/(2 ks). The two have opposite signs.
    """
    kn, ks, _, _, mu = element
    opening, slip = separation_rates(element, d, m=m, eta=eta, rate=rate)
    gained = kn * opening**2 / 8.0
    taken = 0.5 * mu * kn * opening * (slip + mu * kn * opening / ks)
    return 3.0 * max(gained, taken) * dt**2
