"""Stress and strain of close-packed blocks compressed until bonds open and others slide."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np

from cases._papers import LIU_2017
from cases.bonds.parts._failure_bounds import (
    after_openings,
    bounds,
    first_opening,
    history_bounds,
    slope_bounds,
)
from cases.bonds.parts._pressed_block import PULLED, Pressed, may_pull, strain_at_sliding
from cases.bonds.parts._quartzite import BRITTLE, slower_lattice
from cases.bonds.parts._specimens import block_of, on_tops, specimen
from reference_solutions.bonds import lattice_failure, lattice_material
from reference_solutions.bonds.close_packed_lattice import Lattice
from vv.ask import History, Knobs, Observable, Run
from vv.case import (
    Case,
    Ladder,
    Level,
    Parameter,
    Parameters,
    Quantity,
    Scalar,
    Series,
    Shown,
    Source,
    Trial,
    Variant,
)
from vv.scene import Form, Vector

OUTPUTS = 2000


def _declare(variant: str, p: Parameters) -> Trial:
    if not p["rate"] < 0:
        raise ValueError(
            f"rate = {p['rate']!r} 1/s; it must be negative, since the block is compressed"
        )
    block = block_of(int(variant.partition("-")[0]), p["d"])
    duration = BEYOND * strain_at_sliding(p) / abs(p["rate"])
    counted = variant.endswith("counted")
    own = p == CASE.defaults(variant)
    (tops,) = on_tops(block)[:1]
    watched: tuple[Observable, ...] = () if counted else tuple(tops)
    energies = (Form.BROKEN_NORMAL,) if counted else ()
    goal = History(duration, duration / OUTPUTS)
    study = Ladder(specimen(p, block, (1.0,)), goal, watched, _levels(p), energies=energies)
    histories = functools.cache(functools.partial(_histories, p, block))
    if counted:
        return Trial(study, _counts(p, block, histories, own))
    return Trial(study, _stresses(Pressed(p, block, histories, tops), own))


def _levels(p: Parameters) -> dict[Level, tuple[Knobs, ...]]:
    """The error depends on the rate and hardly on the step, as two stable steps show."""
    coarsest = COARSEST * min(1.0, slower_lattice(p["kn"], p["ks"], p["m"]))
    rungs = tuple(Knobs(dt=coarsest / 2**i) for i in range(2))
    return {Level.QUICK: rungs[:1], Level.DEFAULT: rungs[:1], Level.PAPER: rungs}


def _histories(p: Parameters, block: Lattice) -> tuple[lattice_failure.History, ...]:
    """Slow histories for each of TIES: no balance decides which of nearly equal bonds opens."""
    return tuple(
        lattice_failure.pressed(block, p["kn"], p["ks"], p["xb"], together) for together in TIES
    )


def _apart(p: Parameters) -> float:
    """The strain between two outputs."""
    return BEYOND * strain_at_sliding(p) / OUTPUTS


def _counts(
    p: Parameters,
    block: Lattice,
    histories: Callable[[], tuple[lattice_failure.History, ...]],
    own: bool,
) -> tuple[Quantity, ...]:
    """The number of open bonds, from the heat of their normal springs, kn xb^2/2 each.

    own: as of `_stresses`.
    """
    level = int((np.ptp(block.position[block.bonds][:, :, 2], axis=1) < 0.1 * p["d"]).sum())

    def opened(run: Run) -> Vector:
        return np.asarray(run.energies[Form.BROKEN_NORMAL] / (p["kn"] * p["xb"] ** 2 / 2))

    def half(run: Run) -> float:
        """The strain at which half of all level bonds are open."""
        return abs(p["rate"]) * float(run.times[int(np.argmax(opened(run) >= level / 2))])

    def half_due(way: lattice_failure.History | None = None) -> float:
        way = way or histories()[0]
        return float(way.strain[int(np.argmax(way.opened >= level / 2))])

    def outside(run: Run) -> float:
        """The difference of that strain from the nearest slow history."""
        return min((half(run) - half_due(way) for way in histories()), key=abs)

    return (
        Series("opened", "n", "", "number of open bonds, each of which converts kn xb^2/2 to heat",
               opened, None, Shown(MOMENT)),
        Scalar("all opened", "n/n_level", "", "bonds that open before inclined bonds slide, over "
               "all level bonds", lambda run: float(opened(run)[_before(run)]) / level, 1.0, 1.0,
               Shown(PULLED) if not own and may_pull(histories()) else STRETCHED),
        Scalar("half opened", "e_half", "", "strain at which half of all level bonds are open",
               half, half_due, half_due, Shown(TIED)),
        Scalar("half beyond", "d e_half", "", "difference of that strain from the nearest slow "
               "history",
               outside, 0.0, half_due,
               after_openings(p, block, _apart(p), own)),
    )  # fmt: skip


def _before(run: Run) -> int:
    """The output after three quarters of the duration."""
    return 3 * len(run.times) // 4


def _stresses(pressed: Pressed, own: bool) -> tuple[Quantity, ...]:
    """The pressure over time, and its landmarks A3, A1 and A2 of Fig. 5.

    own: the parameters are the case's, at which no wave lets bonds slide or pulls inclined ones
    open, and the histories that are computed are those that blocks follow.
    """
    p, block, one = pressed.p, pressed.block, pressed
    uneven = "" if own else one.uneven()
    printed = lattice_material.opening_strength(p["kn"], p["ks"], p["xb"], p["d"])
    slid = lattice_material.sliding_strength(p["fs0"], p["mu_p"], p["d"])
    return (
        Series("sigma", "sigma", "Pa", "pressure on the hull's area", one.seen, None,
               Shown(BEYOND_A2)),
        Scalar("history", "mean|e|", "Pa", "mean distance from the pressure of the slow network",
               one.off, 0.0, one.largest,
               history_bounds(block, own)),
        Scalar("A3", "sigma(A3)", "Pa", "pressure at which the first bond opens", one.first,
               one.lowest, one.lowest,
               first_opening(p, block, _apart(p), None if own else one.opens())
               if own or one.is_seen() else Shown(UNSEEN)),
        Scalar("A1", "sigma(A1)", "Pa", "pressure before its largest fall", one.top,
               one.largest, one.largest, Shown(TIED)),
        Scalar("A1 beyond", "d sigma(A1)", "Pa", "difference of A1 from the nearest slow history",
               one.outside, 0.0, one.largest,
               after_openings(p, block, _apart(p), own)),
        Scalar("E after", "E'", "Pa", "slope of the pressure with all level bonds "
               "open", one.after, one.softer,
               one.softer, Shown(uneven) if uneven else slope_bounds(p)),
        Scalar("A1 over Eq. 8", "A1/C_open - 1", "", "A1 over C_open of Eq. 8, less 1",
               lambda run: one.top(run) / printed - 1.0, None, 1.0, Shown(FACES)),
        Scalar("A3 over Eq. 8", "A3/C_open - 1", "", "A3 over C_open of Eq. 8, less 1",
               lambda run: one.first(run) / printed - 1.0, None, 1.0, Shown(FACES)),
        Scalar("A2 over Eq. 14", "A2/C_u - 1", "", "the largest pressure over C_u of Eq. 14, "
               "less 1", lambda run: float(one.seen(run).max()) / slid - 1.0, None, 1.0,
               Shown(FACES)),
    )  # fmt: skip


BEYOND = 1.1  # of the strain at which inclined bonds slide
UNSEEN = (
    "where shear springs are nearly as stiff as normal ones, the first bonds to open lower the "
    "pressure by less than 2e-3; it falls so far behind at later openings alone"
)
MOMENT = "bonds open one after another while a wave passes, in an order that is not determined"
BEYOND_A2 = (
    "no slow history is known where inclined bonds slide; up to there the curve is judged in parts"
)
FACES = "the equation is for a lattice without faces; shown for comparison with the paper"


# of the largest stretch: bonds within it open together; the first is shown
TIES = (0.02, 0.005, 0.08)
TIED = (
    "which of several nearly equal bonds opens first is not determined, and the value may depend "
    "on it"
)
STRETCHED = bounds(
    5e-2,
    "a bond opens up to a step after its stretch exceeds xb, and stretches faster where "
    "others open",
)
COARSEST = 8e-8  # s
NETWORK = "the network's stress under its strain, its most stretched bonds taken out at xb"
NO_SIZE = {
    "d": "forces depend on springs and strengths, not on the size; the case divides them by areas"
}
STRONG = dict.fromkeys(("fs0", "mu_p"), "level bonds open long before inclined ones slide")
CASE = Case(
    name="close-packed-failure",
    title="Stress and strain of close-packed blocks through failure",
    source=Source(
        *LIU_2017,
        "Fig. 5: the pressure grows linearly to A1, falls as level bonds open, and grows to A2, "
        "where inclined ones slide; A3 is a small drop before A1. The reference is the slow "
        "history of a network whose bonds are removed as they open. The paper's block has 2166 "
        "elements; the rate is chosen, slow enough for waves to decay. Stress is the force over "
        "the hull of the centres.",
    ),
    parameters=(*BRITTLE, Parameter("rate", -1.0, "1/s", "strain rate, tension positive")),
    variants=tuple(
        Variant(name, what, NETWORK, inert=frozenset({"m", "rate"}), level=level,
                unseen={**NO_SIZE, **STRONG})
        for name, what, level in (
            ("82", "82 elements, stress", Level.QUICK),
            ("82-counted", "82 elements, number of open bonds", Level.DEFAULT),
            ("255", "255 elements, stress", Level.PAPER),
            ("2166", "2166 elements, as in the paper, stress", Level.PAPER),
            ("255-counted", "255 elements, number of open bonds", Level.PAPER),
        )
    ),
    declare=_declare,
    published={
        "Fig. 5": "a line to A1, where microcracks open and the stress falls; a drop A3 before "
        "C_open; failure by sliding at A2 (2166 elements)",
    },
)  # fmt: skip
