"""Bounds of the energy balance of units and blocks that are loaded until bonds break."""

from __future__ import annotations

import math

from cases._energy_balance import balance
from cases.bonds.parts._loading import RATES
from cases.bonds.parts._quartzite import KN, M
from cases.bonds.parts._rate_errors import RADIUS
from cases.bonds.parts._touching import TOUCHING
from reference_solutions.bonds import lattice_material, sliding_unit
from reference_solutions.bonds.lattice_material import Element
from vv.ask import Method
from vv.case import Parameters, Scalar, Tolerance


def judged_balance(
    bound: float, slack: str = "", dt: float = 1e-8, both: bool = False, started: float = 0.0,
    turned: float = 0.0, touched: float = 0.0,
) -> Scalar:  # fmt: skip
    """The quantity `balance`, judged with a bound at the step dt [s].

    both: schemes of first order are allowed the error of second order as well, which they have.
    started, turned: what the start adds per step [1/s] in schemes of first order, see
    `begun_with_drag`, and its part in those of second order, per step [1/s]. touched: what broken
    bonds add that act as contacts, see `_touching`.
    """
    said = _said(started, touched)
    second = Tolerance(
        bound + touched + started * turned * dt**2, said, dt=dt, order=2, slack=slack
    )
    if both:
        late = bound / dt + started
        first = Tolerance(
            bound + touched, f"{said}. Both orders occur", dt=dt, order=2, late=late, slack=slack
        )
    else:
        first = Tolerance(bound, said, dt=dt, order=1, late=started, slack=slack)
    return balance({Method.SECOND_ORDER: second, Method.FIRST_ORDER: first})


def begun_with_drag(p: Parameters, held: float) -> float:
    """What half a step of drag at the start adds to the balance of units, per step [1/s].

    held: the energy that a unit stores [J]. Both units start with the speeds of their bases, under
    drag. A scheme that charges drag half a step late charges eta v^2 dt/2 too little or too much.
    """
    nu = lattice_material.poissons_ratio(p["kn"], p["ks"])
    out = nu * p["rate"] * RADIUS * p["d"]
    power = 3.0 * p["eta"] * out**2 * sum(times**2 for times in RATES)
    return float(power / (2.0 * held))


def turned_by_drag(p: Parameters) -> float:
    """The rate [1/s] at which drag slows an element, half of which a step of second order errs."""
    return float(p["eta"] / (2.0 * p["m"]))


def sliding_balance(p: Parameters, element: Element, held: float, dt: float) -> Scalar:
    """The quantity `balance` of units that slide; held: energy that one stores until then [J].

    dt: the coarsest step [s]. A scheme of first order has the error of second order too, in w dt of
    the bonds.
    """
    ends = sum(
        sliding_unit.unexplained_energy(
            element, p["d"], dt, m=p["m"], eta=p["eta"], rate=times * p["rate"]
        )
        for times in RATES
    )
    orders = {Method.SECOND_ORDER: 2, Method.FIRST_ORDER: 1}
    turned = 1e8 * dt * math.sqrt(p["kn"] / p["m"] / (KN.value / M.value))
    started = begun_with_drag(p, held) * dt
    begun = {2: started * turned_by_drag(p) * dt, 1: started}
    rotating = {n: sum(2e-7 * turned**order for order in range(n, 3)) for n in orders.values()}
    return balance({
        method: Tolerance(
            rotating[n] + begun[n] + ends / held, f"{PARTED}. {STARTED}",
            dt=dt, order=n, slack=FEW,
        )
        for method, n in orders.items()
    })  # fmt: skip


def _said(started: float, touched: float) -> str:
    more = (STARTED if started else "", AGAIN if touched else "")
    return ". ".join((BOOKED, *filter(None, more)))


BOOKED = (
    "the energy of breaking bonds is recorded as the scheme computes it; the rest is due to bonds "
    "that rotate and contacts that close within a step"
)
PARTED = (
    f"{BOOKED}. A contact that opens within a step also adds or removes energy that its springs do "
    "not store, in proportion to the squares of the step and of the speed at which the unit flies "
    "apart"
)
STARTED = (
    "Drag acts from the start, and half a step of its power is charged too early or too late in "
    "schemes of first order, and eta dt/2m of that in those of second order"
)
AGAIN = f"At other parameters than the case's own {TOUCHING}"
FEW = "in tension the bonds of the unit hardly rotate"
