"""A compressed block of bonds: its pressure as observed, and that of slow histories."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np

from cases.bonds.parts._quartzite import element_of
from reference_solutions.bonds import lattice_failure, lattice_strength
from reference_solutions.bonds.close_packed_lattice import Lattice
from reference_solutions.bonds.tetrahedral_unit import sliding_failure
from vv.ask import Reaction, Run
from vv.case import Parameters
from vv.scene import Vector

FINE = 100_000  # number of strains at which the slow history is computed
HOLDS = 0.9  # of the strain at which inclined bonds slide: none slides yet
SWINGS = 2.0  # times the displacement at rest, after a load that is applied at once
BEHIND = 2e-3  # of the pressure: one pair of bonds in a block of 82 costs twice as much
SLID = (
    "the wave of the last opening may let inclined bonds slide, after which they share the load "
    "unequally: they slide at less than twice its strain"
)
PULLED = (
    "on weak shear springs inclined bonds are pulled and may open as well, at rest or in the wave "
    "of another opening; the others then share the load unequally"
)


def strain_at_sliding(p: Parameters) -> float:
    """The strain, pressing positive, at which inclined bonds slide."""
    return abs(sliding_failure(element_of(p), p["d"]).strain)


def may_pull(histories: tuple[lattice_failure.History, ...]) -> bool:
    """Whether inclined bonds may be pulled open, if openings pull them as far as `SWINGS` says."""
    return SWINGS * max(way.pulled for way in histories) >= 1.0


def _before_the_fall(stress: Vector) -> float:
    """The stress at the start of its largest fall."""
    highest = np.maximum.accumulate(stress)
    return float(highest[int(np.argmax(highest - stress))])


@dataclasses.dataclass(frozen=True)
class Pressed:
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
        low, high = 1.1 * last, min(2.0 * last, HOLDS * strain_at_sliding(self.p))
        if not low < 0.9 * high:
            raise ValueError(f"xb = {self.p['xb']!r} m; bonds slide soon after the last one opens")
        return low, high

    def waves_slide(self) -> bool:
        """Whether the wave of an opening may let inclined bonds slide.

        A bond opens at once, and others then swing up to twice as far as under its load at rest.
        """
        return SWINGS * float(self.history().strain[-1]) >= strain_at_sliding(self.p)

    def uneven(self) -> str:
        """Why inclined bonds may bear unequal loads with all level bonds open; empty if not."""
        if self.waves_slide():
            return SLID
        return PULLED if may_pull(self.histories()) else ""

    def after(self, run: Run) -> float:
        """The slope of the pressure with all level bonds open."""
        (low, high), strains = self.window(), self.strains(run)
        there = (strains > low) & (strains < high)
        return float(np.polyfit(strains[there], self.seen(run)[there], 1)[0])

    def softer(self) -> float:
        """The exact slope with all level bonds open."""
        p = self.p
        return lattice_strength.opened_slope(self.block, element_of(p), p["d"], self.window())
