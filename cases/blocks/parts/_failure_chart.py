"""The chart of first motions: its borders, and the points at which it is tested."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from reference_solutions.blocks import first_motion
from reference_solutions.blocks.first_motion import Mode, acceleration
from vv.case import Parameters, RegionMap

Point = tuple[float, float]  # psi, delta [degrees]
TURNS = 2e-3  # of the displacement: what the rotation of a block changes within the duration
NEAR, AWAY = 0.5, 2.0  # degrees from a border: of points beside it, and at least of all others
HALF = 0.5  # of a block's length along the strike, over half a diagonal
STEEPEST, SLENDEREST, STOUTEST = 75.0, 6.0, 70.0  # degrees: psi and delta of the chart
SEVERAL, UNDER_GRAVITY = 22, 17  # points for a friction angle, and for a slope
FINE = 40  # places along a curved border
MODES = "stays", "slides", "topples", "slides and topples"


def tested_points(variant: str, p: Parameters) -> list[Point]:
    """The tested points of the chart: on both sides of its borders, and all over it."""
    if variant.startswith("gravity"):
        beside = [angle + s * NEAR for angle in (p["alpha"], p["phi"]) for s in (-1, 1)]
        spread = np.linspace(SLENDEREST, STOUTEST, UNDER_GRAVITY - len(beside))
        slope = [(p["alpha"], float(delta)) for delta in (*beside, *spread)]
        return [
            point
            for point in dict.fromkeys(slope)
            if 0.0 < point[1] < 90.0 and _is_distinct(p, point) and _is_unique(p, point)
        ]
    plane = variant.startswith("2d")
    found = [
        point
        for point in _pairs_at_borders(p["phi"])
        if _on_chart(*point) and _is_distinct(p, point) and (plane or _is_unique(p, point))
    ]
    more = (
        point
        for point in _spread_points()
        if is_clear(p["phi"], *point) and (plane or _is_unique(p, point))
    )
    found = list(dict.fromkeys(found))
    return found + [next(more) for _ in range(SEVERAL - len(found))]


def _pairs_at_borders(phi: float) -> Iterator[Point]:
    """Pairs of points on the two sides of each border."""
    for part in (0.3, 0.7):
        stout = phi + part * (STOUTEST - phi)
        slender = SLENDEREST + part * (phi - SLENDEREST)
        yield from ((phi - NEAR, stout), (phi + NEAR, stout))
        yield from ((slender - NEAR, slender), (slender + NEAR, slender))
        if NEAR < phi < STEEPEST:
            steep = phi + NEAR + part * (STEEPEST - phi)
            yield from ((steep, phi - NEAR), (steep, phi + NEAR))
        if 0.0 < slender < phi:
            joins = first_motion.slip_joins(phi, slender)
            yield from ((joins - NEAR, slender), (joins + NEAR, slender))


def _is_distinct(p: Parameters, point: Point) -> bool:
    """Whether displacements distinguish the charted mode from all others, near borders too."""
    law = law_at(p, point)
    own = first_motion.mode(**law)
    due = acceleration(own, **law)
    others = (acceleration(mode, **law) for mode in Mode if mode is not own)
    return min(float(np.linalg.norm(other - due)) for other in others) > 2 * TURNS


def _is_unique(p: Parameters, point: Point) -> bool:
    """Whether Coulomb's law permits the charted motion only, and no turn in space."""
    return not first_motion.may_turn_aside(**law_at(p, point), half=HALF)


def _on_chart(psi: float, delta: float) -> bool:
    return 2.0 <= psi <= STEEPEST and SLENDEREST <= delta <= STOUTEST


def _spread_points() -> Iterator[Point]:
    """Points of a sequence that fills the chart evenly (Halton's, bases 2 and 3)."""
    number = 0
    while True:
        number += 1
        u, v = (_mirrored(number, base) for base in (2, 3))
        yield 2.0 + u * (STEEPEST - 2.0), SLENDEREST + v * (STOUTEST - SLENDEREST)


def _mirrored(number: int, base: int) -> float:
    """The digits of a number in a base, mirrored at the point."""
    found, place = 0.0, 1.0
    while number:
        number, digit = divmod(number, base)
        place /= base
        found += digit * place
    return found


def is_clear(phi: float, psi: float, delta: float) -> bool:
    """Whether a point lies well away from every border."""
    away = [abs(psi - delta) if psi < phi or delta < phi else AWAY]
    away.append(abs(psi - phi) if delta > phi else AWAY)
    away.append(abs(delta - phi) if psi > phi else AWAY)
    away.append(abs(psi - first_motion.slip_joins(phi, delta)) if delta < phi else AWAY)
    return min(away) >= AWAY


def borders_of(phi: float, points: Mapping[str, Point]) -> RegionMap:
    """The chart of a friction angle, with the exact borders between modes."""
    steep, stout = max(STEEPEST, phi), max(STOUTEST, phi)
    slender = np.linspace(0.1, phi, FINE, endpoint=False).tolist()
    joins = [(first_motion.slip_joins(phi, delta), delta) for delta in slender] + [(phi, phi)]
    borders: list[tuple[Point, ...]] = [((0.0, 0.0), (phi, phi)), tuple(joins)]
    borders += [((phi, phi), (phi, stout)), ((phi, phi), (steep, phi))]
    return RegionMap("psi [degrees]", "delta [degrees]", MODES, tuple(borders), points)


def law_at(p: Parameters, point: Point) -> dict[str, float]:
    return {"psi": point[0], "phi": p["phi"], "delta": point[1]}
