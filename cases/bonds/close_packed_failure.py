"""Stress and strain of close-packed blocks compressed until bonds open and others slide."""

from __future__ import annotations

import dataclasses
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
from cases.bonds.parts._quartzite import BRITTLE, element_of
from cases.bonds.parts._specimens import block_of, on_tops, specimen
from reference_solutions.bonds import lattice_failure, lattice_material, lattice_strength
from reference_solutions.bonds.close_packed_lattice import Lattice
from reference_solutions.bonds.tetrahedral_unit import sliding_failure
from vv.ask import History, Knobs, Observable, Reaction, Run
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
    duration = BEYOND * _strain_at_sliding(p) / abs(p["rate"])
    counted = variant.endswith("counted")
    own = p == CASE.defaults(variant)
    (tops,) = on_tops(block)[:1]
    watched: tuple[Observable, ...] = () if counted else tuple(tops)
    energies = (Form.BROKEN_NORMAL,) if counted else ()
    goal = History(duration, duration / OUTPUTS)
    study = Ladder(specimen(p, block, (1.0,)), goal, watched, LEVELS, energies=energies)
    histories = functools.cache(functools.partial(_histories, p, block))
    if counted:
        return Trial(study, _counts(p, block, histories, own))
    return Trial(study, _stresses(_Pressed(p, block, histories, tops), own))


def _histories(p: Parameters, block: Lattice) -> tuple[lattice_failure.History, ...]:
    """Slow histories for each of TIES: no balance decides which of nearly equal bonds opens."""
    return tuple(
        lattice_failure.pressed(block, p["kn"], p["ks"], p["xb"], together) for together in TIES
    )


def _strain_at_sliding(p: Parameters) -> float:
    """The strain, pressing positive, at which inclined bonds slide."""
    return abs(sliding_failure(element_of(p), p["d"]).strain)


def _apart(p: Parameters) -> float:
    """The strain between two outputs."""
    return BEYOND * _strain_at_sliding(p) / OUTPUTS


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
               Shown(PULLED) if not own and _pull(histories()) else STRETCHED),
        Scalar("half opened", "e_half", "", "strain at which half of all level bonds are open",
               half, half_due, half_due, Shown(TIED)),
        Scalar("half beyond", "d e_half", "", "difference of that strain from the nearest slow "
               "history",
               outside, 0.0, half_due,
               after_openings(p, block, _apart(p), own)),
    )  # fmt: skip


def _pull(histories: tuple[lattice_failure.History, ...]) -> bool:
    """Whether inclined bonds may be pulled open, if openings pull them as far as `SWINGS` says."""
    return SWINGS * max(way.pulled for way in histories) >= 1.0


def _before_the_fall(stress: Vector) -> float:
    """The stress at the start of its largest fall."""
    highest = np.maximum.accumulate(stress)
    return float(highest[int(np.argmax(highest - stress))])


def _before(run: Run) -> int:
    """The output after three quarters of the duration."""
    return 3 * len(run.times) // 4


@dataclasses.dataclass(frozen=True)
class _Pressed:
    """A compressed block: its pressure over the strain, observed and of slow histories.

    tops: the reactions whose sum is the force on it.
    """

    p: Parameters
    block: Lattice
    histories: Callable[[], tuple[lattice_failure.History, ...]]
    tops: list[Reaction]

    def history(self) -> lattice_failure.History:
        return self.histories()[0]

    def strains(self, run: Run) -> Vector:
        return np.asarray(abs(self.p["rate"]) * run.times)

    def seen(self, run: Run) -> Vector:
        forces = (run.values[what][:, 2] for what in self.tops)
        return np.asarray(np.abs(sum(forces)) / self.block.area)

    def first(self, run: Run) -> float:
        """The pressure at which the observed curve leaves the straight line that it starts with."""
        stress, strain = self.seen(run), self.strains(run)
        opens = self.history().strain[0]
        straight = (strain > 0.2 * opens) & (strain < 0.8 * opens)
        slope, start = np.polyfit(strain[straight], stress[straight], 1)
        behind = stress < (1.0 - BEHIND) * (slope * strain + start)
        behind[: int(np.argmax(straight))] = False
        return float(stress[int(np.argmax(behind)) - 1])

    def opens(self) -> float:
        return float(self.history().strain[0])

    def is_seen(self) -> bool:
        """Whether the pressure falls as far behind at the first opening as `first` looks for.

        Bonds that open at the same strain as the first lower it together.
        """
        return all(
            way.modulus[way.strain <= way.strain[0]][-1] < (1.0 - BEHIND) * way.whole
            for way in self.histories()
        )

    def lowest(self) -> float:
        return float(self.history().before()[0])

    def top(self, run: Run) -> float:
        return _before_the_fall(self.seen(run)[self.strains(run) < self.history().strain[-1]])

    def largest(self, way: lattice_failure.History | None = None) -> float:
        way = way or self.history()
        return _before_the_fall(way.stress(np.linspace(0.0, way.strain[-1], FINE)))

    def outside(self, run: Run) -> float:
        """The difference of A1 from the nearest slow history."""
        return min((self.top(run) - self.largest(way) for way in self.histories()), key=abs)

    def off(self, run: Run) -> float:
        """The mean distance of the pressure from the slow histories, up to the last opening."""
        there = self.strains(run) < self.history().strain[-1]
        ways = np.array([way.stress(self.strains(run)[there]) for way in self.histories()])
        seen = self.seen(run)[there]
        return float(np.abs(seen - np.clip(seen, ways.min(axis=0), ways.max(axis=0))).mean())

    def window(self) -> tuple[float, float]:
        """The range of strains from the last opening to twice that, if no bond slides before."""
        last = float(self.history().strain[-1])
        low, high = 1.1 * last, min(2.0 * last, HOLDS * _strain_at_sliding(self.p))
        if not low < 0.9 * high:
            raise ValueError(f"xb = {self.p['xb']!r} m; bonds slide soon after the last one opens")
        return low, high

    def waves_slide(self) -> bool:
        """Whether the wave of an opening may let inclined bonds slide.

        A bond opens at once, and others then swing up to twice as far as under its load at rest.
        """
        return SWINGS * float(self.history().strain[-1]) >= _strain_at_sliding(self.p)

    def uneven(self) -> str:
        """Why inclined bonds may bear unequal loads with all level bonds open; empty if not."""
        if self.waves_slide():
            return SLID
        return PULLED if _pull(self.histories()) else ""

    def after(self, run: Run) -> float:
        """The slope of the pressure with all level bonds open."""
        (low, high), strains = self.window(), self.strains(run)
        there = (strains > low) & (strains < high)
        return float(np.polyfit(strains[there], self.seen(run)[there], 1)[0])

    def softer(self) -> float:
        """The exact slope with all level bonds open."""
        p = self.p
        return lattice_strength.opened_slope(self.block, element_of(p), p["d"], self.window())


def _stresses(pressed: _Pressed, own: bool) -> tuple[Quantity, ...]:
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


FINE = 100_000  # number of strains at which the slow history is computed
BEYOND = 1.1  # of the strain at which inclined bonds slide
HOLDS = 0.9  # of that strain: no bond slides yet
SWINGS = 2.0  # times the displacement at rest, after a load that is applied at once
SLID = (
    "the wave of the last opening may let inclined bonds slide, after which they share the load "
    "unequally: they slide at less than twice its strain"
)
PULLED = (
    "on weak shear springs inclined bonds are pulled and may open as well, at rest or in the wave "
    "of another opening; the others then share the load unequally"
)
UNSEEN = (
    "where shear springs are nearly as stiff as normal ones, the first bonds to open lower the "
    "pressure by less than 2e-3; it falls so far behind at later openings alone"
)
BEHIND = 2e-3  # of the pressure: one pair of bonds in a block of 82 costs twice as much
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
RUNGS = tuple(Knobs(dt=COARSEST / 2**i) for i in range(2))
LEVELS = {  # the error depends on the rate and hardly on the step, as two steps show
    Level.QUICK: RUNGS[:1],
    Level.DEFAULT: RUNGS[:1],
    Level.PAPER: RUNGS,
}
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
