"""Projects a scene onto a plane, as a few shapes that can be drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from vv.scene.arrays import Vector
from vv.scene.bodies import Harmonic
from vv.scene.picture import view
from vv.scene.scene import Scene

MOST = 150  # the most bodies in a sketch; more would be too small to see
FEW = 8  # the most bodies with arrows
NEAR = 4.0  # extents of all bodies: a wall farther away is left out
DIGITS = 4
SEEN = 0.1  # the least projected length of a unit vector that is drawn
NIL = 1e-6  # fraction of a radius: bodies with a smaller gap touch
Spot = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Arrow:
    """An arrow for a load or a motion: its tail, its direction [-], and its meaning in words."""

    tail: Spot
    along: Spot
    what: str


@dataclass(frozen=True, slots=True)
class Sketch:
    """Bodies seen along one direction, in units of `size` [m], the larger extent of the picture.

    axes: names of the directions to the right and up, empty for an oblique view. circles: centre
    and radius; held: whether each is locked in all directions; polygons: corners of the faces of
    blocks that are seen; fixed: whether the block of each is locked; rails: a point and the only
    direction in which a body may move; touching: the points where bodies touch; walls: a point and
    the outward normal of each, as seen; bonds: ends of each. bodies: the number of bodies in the
    scene; those beyond a limit are not in the sketch.
    """

    size: float
    axes: tuple[str, ...]
    bodies: int
    circles: tuple[tuple[float, float, float], ...] = ()
    held: tuple[bool, ...] = ()
    polygons: tuple[tuple[Spot, ...], ...] = ()
    fixed: tuple[bool, ...] = ()
    rails: tuple[tuple[Spot, Spot], ...] = ()
    touching: tuple[Spot, ...] = ()
    walls: tuple[tuple[Spot, Spot], ...] = ()
    bonds: tuple[tuple[Spot, Spot], ...] = ()
    arrows: tuple[Arrow, ...] = ()


def sketch(scene: Scene) -> Sketch:
    """The sketch of a scene at t = 0."""
    plane = view.plane(scene)
    shown = _Shown(scene, plane)
    faces = [*shown.faces()]
    return Sketch(
        size=shown.size,
        axes=view.names(plane),
        bodies=sum(map(len, scene.bodies)),
        circles=tuple((*shown.spot(x), shown.length(r)) for x, r in shown.spheres()),
        held=tuple(not row.any() for row in scene.spheres.free[:MOST]),
        polygons=tuple(corners for corners, _ in faces),
        fixed=tuple(held for _, held in faces),
        rails=tuple(shown.rails()),
        touching=tuple(shown.touching()),
        walls=tuple(shown.walls()),
        bonds=tuple(shown.bonds()),
        arrows=tuple(shown.arrows()),
    )


def _points(scene: Scene) -> Vector:
    """Centres of spheres and corners of blocks, (k, 3) [m]."""
    return np.concatenate([scene.spheres.position, *(b.vertices for b in scene.blocks)])


def _feet(scene: Scene) -> list[Vector]:
    """The point (3,) [m] of each wall that is closest to the centre of the bodies."""
    middle = _points(scene).mean(axis=0)
    return [middle - (middle - w.point) @ w.normal * w.normal for w in scene.walls]


class _Shown:
    """A projected scene: positions from its centre, in units of its larger extent."""

    def __init__(self, scene: Scene, plane: Vector) -> None:
        self.scene, self.plane = scene, plane
        radius = scene.spheres.radius[:, None]
        seen = scene.spheres.position @ plane.T
        corners = [seen - radius, seen + radius, *(b.vertices @ plane.T for b in scene.blocks)]
        points = np.concatenate(corners)
        reach = NEAR * float(np.ptp(points, axis=0).max())
        self.near = [
            (foot, wall.normal)
            for foot, wall in zip(_feet(scene), scene.walls, strict=True)
            if np.linalg.norm(foot @ plane.T - points.mean(axis=0)) <= reach
        ]
        points = np.concatenate([points, *((foot @ plane.T)[None] for foot, _ in self.near)])
        self.middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
        self.size = float(np.ptp(points, axis=0).max()) or 1.0

    def spot(self, place: Vector) -> Spot:
        """The projection of a position [m]."""
        x, y = ((self.plane @ place - self.middle) / self.size).round(DIGITS).tolist()
        return x, y

    def length(self, metres: float) -> float:
        """A length [m] in units of the picture."""
        return round(float(metres) / self.size, DIGITS)

    def spheres(self) -> Iterator[tuple[Vector, float]]:
        """Centre [m] and radius [m] of the spheres that are shown."""
        group = self.scene.spheres
        yield from zip(group.position[:MOST], group.radius[:MOST].tolist(), strict=True)

    def faces(self) -> Iterator[tuple[tuple[Spot, ...], bool]]:
        """The faces of blocks that face the reader, and whether the block is locked."""
        for block in self.scene.blocks[:MOST]:
            for corners in view.faces(block, self.plane):
                yield tuple(map(self.spot, corners)), not block.free.any()

    def rails(self) -> Iterator[tuple[Spot, Spot]]:
        """The only visible free direction of each of the first bodies that has just one."""
        first, blocks = self.scene.spheres.part(slice(0, FEW)), self.scene.blocks[:FEW]
        rows = [*zip(first.position, first.free, strict=True)]
        rows += [(block.centroid(), block.free) for block in blocks]
        for place, free in rows:
            if free.any() and not free.all():
                along = self.scene.axes[np.flatnonzero(free)] @ self.plane.T
                seen = along[np.hypot(*along.T) > SEEN]
                if len(seen) == 1:
                    yield self.spot(place), self._direction(seen[0])

    def touching(self) -> Iterator[Spot]:
        """The points where the shown spheres touch each other and walls."""
        group = self.scene.spheres
        place, radius = group.position[:MOST], group.radius[:MOST]
        gaps = np.linalg.norm(place[:, None] - place[None], axis=2) - radius - radius[:, None]
        for i, j in np.argwhere(np.triu(gaps < NIL * radius.min(initial=np.inf), 1))[:MOST]:
            yield self.spot(place[i] + radius[i] / (radius[i] + radius[j]) * (place[j] - place[i]))
        for wall in self.scene.walls:
            off = (place - wall.point) @ wall.normal
            for k in np.flatnonzero(off - radius < NIL * radius)[:MOST]:
                yield self.spot(place[k] - off[k] * wall.normal)

    def walls(self) -> Iterator[tuple[Spot, Spot]]:
        """The foot and the normal of each nearby wall that is not seen head-on."""
        for foot, normal in self.near:
            along = self.plane @ normal
            if np.hypot(*along) > SEEN:
                yield self.spot(foot), self._direction(along)

    def bonds(self) -> Iterator[tuple[Spot, Spot]]:
        """The ends of the bonds between shown spheres."""
        pairs = self.scene.bonded_pairs
        place = self.scene.spheres.position
        kept = pairs[(pairs < MOST).all(axis=1)][: 2 * MOST]
        yield from ((self.spot(place[i]), self.spot(place[j])) for i, j in kept)

    def arrows(self) -> Iterator[Arrow]:
        """The arrows of gravity, shaking and driven walls, of velocities and of loads."""
        if self.scene.gravity.any():
            yield self._arrow(None, self.scene.gravity, "gravity")
        yield from self._driven(self.scene.wave, "shaking")
        for wall in self.scene.walls:
            yield from self._driven(wall.motion, "driven wall")
        first, blocks = self.scene.spheres.part(slice(0, FEW)), self.scene.blocks[:FEW]
        for what in ("velocity", "load"):
            rows = [*zip(first.position, getattr(first, what), strict=True)]
            rows += [(block.centroid(), getattr(block, what)) for block in blocks]
            yield from (self._arrow(place, row, what) for place, row in rows if row.any())

    def _driven(self, motion: Harmonic | None, what: str) -> Iterator[Arrow]:
        if motion is not None:
            yield from (self._arrow(None, along, what) for along, _, _ in motion.sines())

    def _arrow(self, place: Vector | None, along: Vector, what: str) -> Arrow:
        seen = self._direction(self.plane @ view.unit(along))
        return Arrow((0.0, 0.0) if place is None else self.spot(place), seen, what)

    def _direction(self, along: Vector) -> Spot:
        x, y = (along + 0.0).round(DIGITS).tolist()
        return x, y
