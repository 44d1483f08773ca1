"""The energy balance of blocks of bonded elements that are pulled or pressed to failure."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator

import numpy as np

from cases._papers import LIU_2017
from cases.bonds.parts._first_to_open import require_opening
from cases.bonds.parts._quartzite import BRITTLE, element_of, slower
from cases.bonds.parts._specimens import block_of, specimen, viscosity
from cases.bonds.parts._touching import TOUCHING, touching
from reference_solutions.bonds import lattice_material
from reference_solutions.bonds.close_packed_lattice import Lattice, static
from reference_solutions.bonds.lattice_strength import first_opening
from vv.ask import History, Knobs, Method, Run
from vv.case import (
    Case,
    Exact,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Series,
    Shown,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.scene import Form, Vector

EVERY = 1.6e-7  # s between outputs: kinetic energy has its peak within 1e-6 s
HISTORIES = (
    ("E_e", "elastic energy", (Form.NORMAL, Form.SHEAR)),
    ("E_k", "kinetic energy", (Form.KINETIC,)),
    ("Q_v", "viscous heat", (Form.DRAG,)),
    ("Q_bn", "breaking heat of normal springs", (Form.BROKEN_NORMAL,)),
    ("Q_bs", "breaking heat of shear springs", (Form.BROKEN_SHEAR,)),
    ("Q_f", "frictional heat", (Form.FRICTION,)),
)
KEPT = tuple(form for _, _, forms in HISTORIES for form in forms)
BROKEN = (Form.BROKEN_NORMAL, Form.BROKEN_SHEAR)
HALF = 0.5  # of the strain at which the first bond opens, if pulled


def _declare(variant: str, p: Parameters) -> Trial:
    way, size = variant.split("-")
    if not SIGNS[way] * p["rate"] > 0:
        raise ValueError(
            f"rate = {p['rate']!r} 1/s; it must be positive where a block is pulled, "
            "negative where it is pressed"
        )
    block = block_of(int(size), p["d"])
    kn, ks, d = p["kn"], p["ks"], p["d"]
    E = lattice_material.youngs_modulus(kn, ks, d)
    answer, slow = static(block, kn, ks), slower(p)
    opening = first_opening(block, answer, p["xb"]) / answer.E
    held = answer.E * opening**2 / 2 * block.area * block.height
    quantities: list[Quantity] = [*_balances(way, p, block, held), *_histories()]
    quantities.append(_elastic_energy(p, block, answer.E, HALF * opening))
    if way == "pulled":
        require_opening(block, answer, element_of(p), 0.0)
        printed = lattice_material.tensile_strength(kn, ks, p["xb"], d)
        strain = 1.1 * opening * answer.E / E
        quantities += _beside_fig_6(variant)
        strength = ("T_u over Eq. 7", printed, "the paper's mean over its blocks is -8.89 %")
    else:
        printed = lattice_material.sliding_strength(p["fs0"], p["mu_p"], d)
        strain = 2.2 * printed / E
        quantities += _sliding()
        strength = ("C_u over Eq. 14", printed, "the paper's mean over its blocks is -18.51 %")
    quantities.append(_strength(p, block, *strength))
    goal = History(abs(strain / p["rate"]), EVERY * slow)
    _require_soon(p, len(block.position), goal)
    levels = {level: tuple(Knobs(dt * slow) for dt in own) for level, own in LEVELS.items()}
    study = Ladder(specimen(p, block, (1.0,)), goal, (), levels, energies=(*KEPT, Form.CARRYING))
    return Trial(study, tuple(quantities))


def _require_soon(p: Parameters, elements: int, goal: History) -> None:
    """Raise ValueError where failure comes so late that it is not awaited."""
    steps = goal.duration / (FINEST * slower(p)) * elements
    if not steps <= MOST:
        raise ValueError(
            f"rate = {p['rate']!r} 1/s: the block fails within {goal.duration:.3g} s, which is "
            f"{steps:.3g} steps of one element; at most {MOST:g} are run"
        )


def energy(forms: tuple[Form, ...], run: Run) -> Vector:
    """The sum (k,) [J] of some forms of energy."""
    return np.asarray(sum(run.energies[form] for form in forms))


def work(run: Run) -> Vector:
    """The work of the platens (k,) [J]."""
    return -run.energies[Form.CARRYING]


def _balances(way: str, p: Parameters, block: Lattice, held: float) -> Iterator[Scalar]:
    """held: the energy [J] of the block as its first bond opens."""
    value, why = CLOSED[way]
    dt = FINEST * slower(p)
    closed = Tolerance(max(value, _turned(way, p, dt)), f"{why}; {TURN}", dt=dt, order=2)
    if way == "pressed":
        yield _balance("balance", UNEXPLAINED, closed, _all)
        return
    until = functools.partial(_rubs, math.sqrt(p["m"] / (2 * p["kn"])))
    yield _balance("balance", f"{UNEXPLAINED}, until broken bonds rub as contacts", closed, until)
    again = _met_again(p, block, held)
    yield _balance("balance of all", f"{UNEXPLAINED}, to the end", again, _all)


def _turned(way: str, p: Parameters, dt: float) -> float:
    """What bonds that turn as others break add to the balance at a step dt [s].

    The work in a step is the mean force times the displacement v dt, which misses F'' (v dt)^3/12.
    A bond of stiffness kn that turns has F'' of about kn/d. An element that broken bonds set free
    has v = w s, with w^2 = 2 kn/m and the displacement s at which they break, and is stopped within
    1/w by others that hold kn s^2 in all: the share is (w dt)^2 s/(12 d).
    """
    s = p["xb"] if way == "pulled" else p["fs0"] / p["ks"]
    return 2 * p["kn"] / p["m"] * dt**2 * s / (12 * p["d"])


def _balance(name: str, what: str, closed: Tolerance, until: Callable[[Run], int]) -> Scalar:
    def open_by(run: Run) -> float:
        return float(np.abs(gap(run)[: until(run)]).max() / work(run).max())

    judge = Exact(dict.fromkeys(CLASSES, closed))
    return Scalar(name, "|E - W|/max W", "", what, open_by, 0.0, 1.0, judge)


def _all(run: Run) -> int:
    return len(run.times)


def _rubs(unit: float, run: Run) -> int:
    """The number of outputs before contacts rub; unit: 1/w [s] of two elements on their contact.

    A contact may act for a swing before it slides, which alone is recorded.
    """
    rubs = np.flatnonzero(run.energies[Form.FRICTION] > 0.0)
    begins = run.times[rubs[0]] - 2 * np.pi * unit if len(rubs) else np.inf
    return max(1, int(np.searchsorted(run.times, begins)))


def _met_again(p: Parameters, block: Lattice, held: float) -> Tolerance:
    """The bound of the balance where broken bonds act as contacts; held: see `_balances`."""
    dt = FINEST * slower(p)
    return Tolerance(touching(p, block, dt) / held, TOUCHING, dt=dt, order=2, slack=NONE)


def gap(run: Run) -> Vector:
    """All energy and heat since t = 0 minus the work of the platens (k,) [J]."""
    kept = energy(KEPT, run)
    return np.asarray(kept - kept[0] - work(run))


def _histories() -> Iterator[Series | Scalar]:
    for name, what, forms in HISTORIES:
        yield Series(name, name, "J", what, functools.partial(energy, forms), None, Shown(UNKNOWN))
    yield Scalar("viscous share", "Q_v/Q", "", "viscous heat over all heat at the end",
                 _viscous, None, 1.0, Shown(UNKNOWN))  # fmt: skip
    yield Series("W", "W", "J", "work of the platens", work, None, Shown(UNKNOWN))
    yield Series("E - W", "E - W", "J", "energy that no form explains", gap, None, Shown(OPEN))


def _viscous(run: Run) -> float:
    """Viscous heat over all heat at the end."""
    heat = energy((Form.DRAG, Form.FRICTION, *BROKEN), run)[-1]
    return float(run.energies[Form.DRAG][-1] / heat) if heat > 0.0 else float("nan")


def _sliding() -> Iterator[Scalar]:
    """Quantities that the paper reports of the failure of its compressed block of 2166 elements."""
    yield Scalar("kinetic share", "max E_k/W", "", "largest kinetic energy over the work done "
                 "until then", _share, None, 1.0, Shown(OTHER_RATE))  # fmt: skip
    yield Scalar(
        "failure time", "t_f", "s", "time in which the breaking heat of shear springs grows from "
        "1 % to 99 %", functools.partial(_crossing, forms=(Form.BROKEN_SHEAR,)), None, 1e-4,
        Shown(OTHER_RATE),
    )  # fmt: skip


def _elastic_energy(p: Parameters, block: Lattice, E: float, strain: float) -> Scalar:
    """The elastic energy of a block before any bond breaks, E eps^2/2 per unit of volume."""
    exact = E * strain**2 / 2 * block.area * block.height

    def observe(run: Run) -> float:
        held = energy((Form.NORMAL, Form.SHEAR), run)
        return float(np.interp(strain / abs(p["rate"]), run.times, np.sqrt(held))) ** 2

    what = "elastic energy at half the strain of the first opening, in tension"
    drag = viscosity(p, block) * len(block.position) * abs(p["rate"]) * block.height
    viscous = (drag / (E * strain * block.area)) ** 2 / 45
    # pressed, a finite strain lowers the energy that viscosity adds to
    off = viscous + strain if p["rate"] > 0 else max(viscous, strain)
    judge = Exact(dict.fromkeys(CLASSES, Tolerance(off, SOON)))
    return Scalar("E_e(half)", "E_e(half)", "J", what, observe, exact, exact, judge)


def _beside_fig_6(variant: str) -> Iterator[Scalar]:
    """Quantities that the paper reports of its block of 2166 elements that is pulled in two."""
    share, time = (0.162, 2.83e-6) if variant == "pulled-2166" else (None, None)
    yield Scalar(
        "kinetic share", "max E_k/W", "", "largest kinetic energy over the work done until then",
        _share, share, 0.162, Shown(f"{OTHER_RATE}; the paper's block of 2166 has 16.2 %"),
    )  # fmt: skip
    yield Scalar(
        "crack time", "t_c", "s",
        "time in which the breaking heat grows from 1 % to 99 % of its final value",
        _crossing, time, 2.83e-6, Shown(f"{OTHER_RATE}; the paper's block of 2166 has 2.83e-6 s"),
    )  # fmt: skip


def _share(run: Run) -> float:
    kinetic = run.energies[Form.KINETIC]
    last = int(kinetic.argmax())
    return float(kinetic[last] / work(run)[last])


def _crossing(run: Run, forms: tuple[Form, ...] = BROKEN) -> float:
    """The time in which bonds break [s], interpolated between outputs."""
    heat = energy(forms, run)
    if not heat[-1] > 0.0:
        return float("nan")
    begin, end = (int(np.argmax(heat > part * heat[-1])) for part in (0.01, 0.99))
    first, last = (
        np.interp(part * heat[-1], heat[k - 1 : k + 1], run.times[k - 1 : k + 1])
        for part, k in ((0.01, begin), (0.99, end))
    )
    return float(last - first)


def _strength(p: Parameters, block: Lattice, name: str, printed: float, beside: str) -> Scalar:
    """The largest stress on the hull's area between two outputs, W'/(rate V), over an equation."""

    def observe(run: Run) -> float:
        power = np.diff(work(run)) / np.diff(run.times)
        stress = power / (abs(p["rate"]) * block.area * block.height)
        return float(stress.max()) / printed - 1.0

    return Scalar(name, name, "", f"{name}, minus 1; {beside}", observe, None, 1.0, Shown(AS_SEEN))


UNKNOWN = "no exact answer is known through failure; the balance of all forms is judged instead"
OPEN = "its largest value is judged as `balance`; this shows at which time it occurs"
OTHER_RATE = "the paper loads in steps, 25 times more slowly on average"
AS_SEEN = (
    "viscosity adds to the strength at this rate; close-packed-strength extrapolates to zero rate"
)
CLASSES = (Method.SECOND_ORDER, Method.FIRST_ORDER)
BOOKED = (
    "the energy of breaking bonds, drag and friction are recorded as the scheme computes them; "
    "the rest is due to bonds that rotate and contacts that close within a step"
)
CLOSED = {
    "pulled": (1e-6, BOOKED),
    "pressed": (1e-5, f"{BOOKED}, which are many in a block that slides"),
}
TURN = (
    "or, in bonds that are short beside the displacement s at which they break, more: the work of "
    "a bond that turns in a step is off by (w dt)^2 s/(12 d) of what it held, w^2 = 2 kn/m"
)
UNEXPLAINED = "the largest energy that no form explains, over the largest work"
NONE = "at the parameters of the case no broken bond is touched again"
SIGNS = {"pulled": 1.0, "pressed": -1.0}
SOON = (
    "the answer is linear, and that at rest. Drag in proportion to the height z changes the stress "
    "across the height H by S (z^2/2H^2 - 1/6), S the drag of all elements at the speed of the top "
    "over the area, and so the energy by (S/stress)^2/45; a finite strain changes it by about that"
)
STRONG = dict.fromkeys(
    ("xb", "fs0", "mu_p", "m"),
    "before a bond breaks the energy depends neither on strength nor on mass, and through failure "
    "only the balance is known; close-packed-strength judges strengths",
)
FINEST = 1e-8  # s, of the ladder
MOST = 2e9  # steps of one element at the finest setting, about two minutes of calculation
RUNGS = tuple(FINEST * 2**i for i in reversed(range(4)))
LEVELS = {Level.QUICK: RUNGS[:2], Level.DEFAULT: RUNGS, Level.PAPER: RUNGS}
BALANCE = "E_e + E_k + Q_v + Q_bn + Q_bs + Q_f - W does not change (Eqs. 16 to 26)"

CASE = Case(
    name="close-packed-energy",
    title="Energy of close-packed blocks through failure",
    source=Source(
        *LIU_2017,
        "Section 5.3 and Fig. 6. The scheme itself records all energies, and the breaking heat "
        "when a bond breaks. The paper moves the platens in steps; here they move steadily, and "
        "failure comes 25 times sooner. Eq. 28 gives the viscosity.",
    ),
    parameters=(*BRITTLE, Parameter("rate", 0.6, "1/s", "strain rate, tension positive")),
    variants=(
        Variant("pulled-82", "82 elements, pulled in two", BALANCE, unseen=STRONG),
        *(
            Variant(
                f"pulled-{size}", f"{size} elements", BALANCE, level=Level.PAPER, unseen=STRONG
            )
            for size in (255, 2166)
        ),
        *(
            Variant(
                f"pressed-{size}", f"{size} elements, pressed until they slide", BALANCE,
                {"rate": -8.0}, level=Level.QUICK if size == 82 else Level.PAPER, unseen=STRONG,
            )
            for size in (82, 2166)
        ),
    ),
    declare=_declare,
    published={
        "2166 elements, pulled": "16.2 % of the energy is kinetic at most; bonds part within "
        "2.83e-6 s; it breaks at 1.072e-2 s (section 5.3)",
        "2166 elements, pressed": "failure takes about 1e-4 s, with far less kinetic energy",
    },
)  # fmt: skip
