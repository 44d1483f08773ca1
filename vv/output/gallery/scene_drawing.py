"""Draws a scene as SVG, from the scene itself: bodies, walls, bonds, locks, motion and loads.

Seen along the direction in which the scene has least to show. Grey: held in all directions; dashes
beside a body: the directions in which it may move, where some are locked; blue: initial velocity;
red: a dead load; green: driven motion, or the acceleration of a shaken scene; g: gravity.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from vv.scene import Block, Mask, Scene, Spheres, Vector

SIZE = 320.0  # pixels of the longer side that bodies take
MARGIN = 48.0  # about them, for arrows
MOST = 150  # bodies that are drawn
ARROW = 34.0  # pixels of every arrow: they show directions, not sizes
LEAST = 0.2  # of a direction that lies in the drawing's plane; what points at us is left out
STYLE = (
    "<style>.w{stroke:#555;stroke-width:2}.b{stroke:#a60;stroke-width:2}"
    ".body{fill:#9ec5e8;fill-opacity:.55;stroke:#247;stroke-width:1.2}.held{fill:#bbb}"
    ".rail{stroke:#777;stroke-width:1.5;stroke-dasharray:4 3}.v{stroke:#0645c8;fill:#0645c8}"
    ".f{stroke:#c00;fill:#c00}.m{stroke:#080;fill:#080}.g{stroke:#222;fill:#222}"
    "text{font:13px sans-serif;stroke:none}</style>"
)


def drawing(scene: Scene) -> str:
    """The SVG of a scene; '' where it has more bodies than can be told apart."""
    if sum(map(len, scene.bodies)) > MOST:
        return ""
    return _Drawing(scene).svg()


class _Drawing:
    """A scene in the plane: right and up are unit vectors (3,) of the frame."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.right, self.up = plane(scene)
        points = _extent(scene, self.right, self.up)
        across, upwards = points @ self.right, points @ self.up
        self.corner = np.array([across.min(), upwards.max()])
        spans = np.array([np.ptp(across), np.ptp(upwards)])
        self.scale = SIZE / max(spans.max(), 1e-300)
        self.width, self.height = spans * self.scale + 2 * MARGIN

    def svg(self) -> str:
        """The whole drawing."""
        size = f'width="{self.width:.0f}" height="{self.height:.0f}"'
        box = f'viewBox="0 0 {self.width:.0f} {self.height:.0f}"'
        parts = [*self._walls(), *self._bonds(), *self._bodies(), *self._fields()]
        head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} {box}>'
        return "\n".join([head, STYLE, *parts, "</svg>", ""])

    def _at(self, point: Vector) -> Vector:
        """Where a point (3,) [m] is drawn, (2,) pixels."""
        x, y = point @ self.right - self.corner[0], self.corner[1] - point @ self.up
        return np.asarray(np.array([x, y]) * self.scale + MARGIN)

    def _along(self, direction: Vector) -> Vector | None:
        """The unit direction (2,) in pixels of a vector (3,); None where it points at us."""
        flat = np.array([direction @ self.right, -(direction @ self.up)])
        size = float(np.linalg.norm(flat))
        return flat / size if size > LEAST * float(np.linalg.norm(direction)) else None

    def _walls(self) -> Iterator[str]:
        for wall in self.scene.walls:
            normal = self._along(wall.normal)
            if normal is None:
                continue
            middle = np.array([self.width, self.height]) / 2
            foot = self._at(wall.point)
            foot = foot + (middle - foot) @ _turned(normal) * _turned(normal)
            reach = (SIZE / 2 + MARGIN / 2) * _turned(normal)
            yield _line("w", foot - reach, foot + reach)
            for share in np.linspace(-1, 1, 17):
                start = foot + share * reach
                yield _line("w", start, start - 9 * normal + 5 * _turned(normal), 0.8)
            if wall.motion is not None:
                for along, _, _ in wall.motion.sines():
                    yield from self._double("m", foot + 0.7 * reach - 18 * normal, along)

    def _bonds(self) -> Iterator[str]:
        places = self.scene.spheres.position
        for i, j in self.scene.bonded_pairs.tolist():
            yield _line("b", self._at(places[i]), self._at(places[j]))

    def _bodies(self) -> Iterator[str]:
        for group in self.scene.bodies:
            if isinstance(group, Spheres):
                for k in range(len(group)):
                    x, y = self._at(group.position[k])
                    radius = max(2.0, group.radius[k] * self.scale)
                    held = "" if group.free[k].any() or group.free_spin[k].any() else " held"
                    shape = (
                        f'<circle class="body{held}" cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}"/>'
                    )
                    yield shape
                    yield from self._marks(
                        group.position[k], radius, group.free[k], group.velocity[k], group.load[k]
                    )
            elif isinstance(group, Block):
                yield from self._block(group)

    def _block(self, block: Block) -> Iterator[str]:
        held = "" if block.free.any() or block.free_spin.any() else " held"
        for face in block.faces:
            points = [self._at(block.vertices[i]) for i in face]
            text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
            yield f'<polygon class="body{held}" points="{text}"/>'
        size = float(np.ptp(block.vertices @ self.up)) * self.scale / 2
        yield from self._marks(block.centroid(), size, block.free, block.velocity, block.load)

    def _marks(
        self, place: Vector, radius: float, free: Mask, velocity: Vector, load: Vector
    ) -> Iterator[str]:
        """The free directions of a body where some are locked, its velocity and its load."""
        centre = self._at(place)
        if free.any() and not free.all():
            for axis in self.scene.axes[np.flatnonzero(free)]:
                along = self._along(axis)
                if along is not None:
                    far = (radius + 14) * along
                    yield _line("rail", centre - far, centre + far)
        for kind, vector in (("v", velocity), ("f", load)):
            along = self._along(vector) if vector.any() else None
            if along is not None:
                yield from _arrow(kind, centre, centre + (min(radius, 12) + ARROW) * along)

    def _double(self, kind: str, middle: Vector, vector: Vector) -> Iterator[str]:
        """An arrow with two heads along a vector."""
        along = self._along(vector)
        if along is not None:
            yield from _arrow(kind, middle, middle + 0.7 * ARROW * along)
            yield from _arrow(kind, middle, middle - 0.7 * ARROW * along)

    def _fields(self) -> Iterator[str]:
        """What acts on all bodies, in the corner."""
        corner = np.array([MARGIN / 2, MARGIN / 2])
        along = self._along(self.scene.gravity) if self.scene.gravity.any() else None
        if along is not None:
            yield from _arrow("g", corner, corner + ARROW * along)
            yield f'<text class="g" x="{corner[0] + 8:.1f}" y="{corner[1] + 6:.1f}">g</text>'
        if self.scene.wave is not None:
            for vector, _, _ in self.scene.wave.sines():
                yield from self._double("m", np.array([self.width - MARGIN, MARGIN / 2]), vector)


def plane(scene: Scene) -> tuple[Vector, Vector]:
    """Right and up (3,) of the drawing: it shows most of normals, velocities, loads and extent."""
    shown = _directions(scene)
    skew = np.linalg.eigh(shown.T @ shown)[1][:, 0]
    skew = skew * np.sign(skew[np.abs(skew).argmax()])
    axes = np.vstack([np.eye(3)[::-1], scene.axes[::-1], skew])
    hidden = [float(((shown @ axis) ** 2).sum()) for axis in axes]
    sight = axes[int(np.argmin(np.round(hidden, 9)))]
    if scene.gravity.any():
        up = -scene.gravity
    else:
        up = next((w.normal for w in scene.walls if abs(w.normal @ sight) < 0.5), np.eye(3)[1])
    up = up - (up @ sight) * sight
    if np.linalg.norm(up) < 1e-6:
        up = np.eye(3)[int(np.argmin(np.abs(sight)))]
        up = up - (up @ sight) * sight
    up = up / np.linalg.norm(up)
    return np.cross(up, sight), up


def _directions(scene: Scene) -> Vector:
    """(n, 3) unit vectors of what a drawing should show; of bodies, how they are spread."""
    found = [wall.normal for wall in scene.walls for _ in range(4)]
    found += [scene.gravity, *scene.spheres.velocity, *scene.spheres.load]
    found += [v for block in scene.blocks for v in (block.velocity, block.load)]
    found += [along for along, _, _ in scene.wave.sines()] if scene.wave else []
    moves = [wall.motion for wall in scene.walls if wall.motion is not None]
    found += [along for motion in moves for along, _, _ in motion.sines()]
    units = [v / np.linalg.norm(v) for v in found if np.linalg.norm(v) > 0]
    places = _extent(scene, *np.eye(3))
    spread = places - places.mean(axis=0)
    size = float(np.abs(spread).max()) or 1.0
    return np.vstack([*units, spread / size / np.sqrt(len(spread))])


def _extent(scene: Scene, *axes: Vector) -> Vector:
    """(n, 3) points [m] that bound the bodies along some directions, walls left out."""
    spheres = scene.spheres
    reach = [s * spheres.radius[:, None] * axis for axis in axes for s in (-1, 1)]
    points = [spheres.position + step for step in reach] if len(spheres) else []
    return np.vstack([*points, *(block.vertices for block in scene.blocks)])


def _turned(direction: Vector) -> Vector:
    return np.array([-direction[1], direction[0]])


def _line(kind: str, start: Vector, end: Vector, width: float = 0.0) -> str:
    thin = f' style="stroke-width:{width:g}"' if width else ""
    ends = f'x1="{start[0]:.1f}" y1="{start[1]:.1f}" x2="{end[0]:.1f}" y2="{end[1]:.1f}"'
    return f'<line class="{kind}" {ends}{thin}/>'


def _arrow(kind: str, start: Vector, end: Vector) -> Iterator[str]:
    """A line with a head at its end."""
    along = (end - start) / max(float(np.linalg.norm(end - start)), 1e-9)
    side = 4 * _turned(along)
    yield _line(kind, start, end - 6 * along, 2.0)
    tip = [end, end - 9 * along + side, end - 9 * along - side]
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in tip)
    yield f'<polygon class="{kind}" points="{points}"/>'
