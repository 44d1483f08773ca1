"""Builds the general model: spheres that move and turn in space, with all their contacts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vv.ask import Displacement, Observable, Reaction
from vv.engines.dem.bonds.blocks import Blocks
from vv.engines.dem.bonds.layout import bonded, near
from vv.engines.dem.leapfrog import Leapfrog
from vv.engines.dem.rows import Index, projected, projectors, triple
from vv.scene import Harmonic, Mask, Scene, Term, Vector

if TYPE_CHECKING:
    from vv.engines.dem.bonds.law import Frail, Springs
    from vv.engines.dem.space.driven import Base
    from vv.engines.dem.space.neighbours import Near
    from vv.engines.dem.terms.contact_law import Pairs, Walls
    from vv.engines.kernels.drive import Drive


class SpaceState(NamedTuple):
    """What `move_in_space` receives about the scene, in its order, shapes and units."""

    velocity: Vector
    spin: Vector | None
    mass: Vector
    inertia: Vector
    gravity: tuple[float, float, float] | None
    load: Vector | None
    hold: Vector | None
    hold_spin: Vector | None
    pairs: Pairs | None
    walls: Walls | None
    kn: float
    friction: tuple[float, float] | None
    eta: float | None
    eta_n: float | None
    charged: Vector | None
    shaking: Drive | None
    base: Base | None
    grounds: Index | None
    carried: Vector | None
    springs: Springs | None
    bond_ks: Vector | None
    blocks: Blocks | None
    frail: Frail | None
    near: Near | None
    threads: int | None = None


@dataclass(frozen=True, eq=False)
class Space:
    """The spheres that can move, in rows 0 to m - 1; row[sphere] is m for those that cannot."""

    row: Index
    state: SpaceState
    terms: frozenset[Term]
    words: str

    @property
    def unknowns(self) -> tuple[Vector, ...]:
        """The arrays that hold a number per unknown; locked components are carried along."""
        spin = self.state.spin
        return (self.state.velocity,) if spin is None else (self.state.velocity, spin)

    def outputs(self, rows: int, spheres: tuple[int, ...]) -> tuple[Vector | Index, ...]:
        """What the kernel fills, path and energy, and the rows it watches."""
        watched = self.row[np.array(spheres, np.intp)]
        s = self.state
        width = 3 + 3 * len(self.unknowns) + (0 if s.hold is None else 3)
        books = 9 if s.shaking is not None or s.base is not None else 7
        books = 12 if s.carried is not None or s.frail is not None else books
        return np.empty((rows, len(watched), width)), np.zeros((rows, books)), watched

    def kernel(self) -> Callable[..., int]:
        """The compiled kernel; the first call imports numba."""
        from vv.engines.dem.space.kernel import move_in_space

        return move_in_space

    def observed(self, path: Vector, index: int, sphere: int, what: Observable) -> Vector:
        """An observable (k, 3) of a sphere, which was the index-th one watched."""
        if isinstance(what, Reaction):
            held = self.state.hold is not None
            return np.array(path[:, index, -3:]) if held else np.zeros((len(path), 3))
        first = 0 if isinstance(what, Displacement) else 3
        return np.array(path[:, index, first : first + 3])

    def held(self, path: Vector, energy: Vector) -> Vector:
        """The ledger's terms [J], (k, 7), (k, 9) or (k, 12) as the kernel wrote them."""
        signs = np.array([1.0] * 5 + [-1.0] * 5 + [1.0] * 2)
        return np.asarray(energy * signs[: energy.shape[1]] + 0.0)

    def put_in(self, energy: Vector) -> float:
        """Kinetic and elastic energy [J] at t = 0, of bonds that break at once too."""
        s = self.state
        kinetic = 0.5 * float(s.mass @ (s.velocity**2).sum(axis=1))
        if s.spin is not None:
            kinetic += 0.5 * float(s.inertia @ (s.spin**2).sum(axis=1))
        return kinetic + float(energy[0, 1] + energy[0, 2] + energy[0, 10:].sum())

    def bound(self, energy: Vector, leapfrog: Leapfrog, dt: float) -> float | None:
        """None: where contacts turn, the energy is near one conserved but no bound is known."""
        return None


def space(scene: Scene, charged: Vector | None = None) -> Space:
    """The general model, without what the scene does not have.

    charged: friction (n, 3) [N] of each sphere with its wall, of which there is one, at t = 0.
    Rotation is left out where no friction or bond can change it: no observable shows it, and of
    spheres without spin nothing is lost.
    """
    spheres, contact, carried = scene.spheres, scene.contact, scene.locked_velocity
    moves: Mask = np.any([spheres.free, spheres.free_spin, carried != 0.0], axis=(0, 2))
    row = np.where(moves, np.cumsum(moves) - 1, moves.sum())
    close, bonds = near(scene, moves, row), bonded(scene, moves, row)
    pairs = _pairs(scene, moves, row) if scene.bonds is None and close is None else None
    walls = _walls(scene, moves, row)
    touches = pairs is not None or close is not None
    rubs = Term.FRICTION in scene.terms() and (touches or walls is not None)
    viscous = contact.eta_n > 0 and (touches or walls is not None)
    turns = Term.ROTATION in scene.terms() and (rubs or bonds.ks is not None)
    load = spheres.load[moves]
    base = None if walls is None else _base(scene)
    state = SpaceState(
        velocity=projected(spheres.velocity[moves], scene.axes, spheres.free[moves])
        + carried[moves],
        spin=projected(spheres.spin[moves], scene.axes, spheres.free_spin[moves])
        if turns
        else None,
        mass=spheres.mass[moves],
        inertia=spheres.inertia[moves],
        gravity=triple(scene.gravity) if scene.gravity.any() else None,
        load=load if load.any() else None,
        hold=projectors(scene.axes, spheres.free[moves]),
        hold_spin=projectors(scene.axes, spheres.free_spin[moves]) if turns else None,
        pairs=pairs,
        walls=walls,
        kn=contact.kn,
        friction=(contact.ks, contact.mu) if rubs else None,
        eta=scene.eta if scene.eta > 0 else None,
        eta_n=contact.eta_n if viscous else None,
        charged=charged[moves] if charged is not None and charged.any() and rubs else None,
        shaking=_shaking(scene.shaking),
        base=base,
        grounds=None if base is None else _grounds(scene, moves),
        carried=carried[moves] if carried.any() else None,
        springs=bonds.springs,
        bond_ks=bonds.ks,
        blocks=bonds.blocks,
        frail=bonds.frail,
        near=close,
    )
    left_out = {
        Term.SPHERE_CONTACT: not touches,
        Term.WALL_CONTACT: walls is None,
        Term.FRICTION: not rubs,
        Term.ROTATION: not turns and bool(spheres.spin.any()),
        Term.BASE_MOTION: base is None,
        Term.CONTACT_VISCOSITY: not viscous,
    }
    terms = frozenset(term for term in scene.terms() if not left_out.get(term, False))
    count = len(state.velocity)
    words = f"{3 * count * (2 if turns else 1)} unknowns: {count} moving spheres"
    words += " that turn" if turns else ""
    words += "" if bonds.springs is None else f", {len(bonds.springs[0])} bonds"
    return Space(row, state, terms, words)


def _shaking(motion: Harmonic | None) -> Drive | None:
    if motion is None:
        return None
    from vv.engines.kernels.drive import drive

    return drive(motion)


def _base(scene: Scene) -> Base | None:
    """How all walls move, or None if none does."""
    motions = tuple(wall.motion for wall in scene.walls)
    if not any(motions):
        return None
    from vv.engines.kernels.drive import drives

    return drives(motions)


def _pairs(scene: Scene, moves: Mask, row: Index) -> Pairs | None:
    """All pairs of which one moves: rows, first offset, first gap, radii."""
    spheres = scene.spheres
    i, j = np.triu_indices(len(spheres), 1)
    kept = moves[i] | moves[j]
    i, j = i[kept], j[kept]
    if not len(i):
        return None
    offset = spheres.position[j] - spheres.position[i]
    radii = np.stack([spheres.radius[i], spheres.radius[j]], axis=1)
    gap = np.linalg.norm(offset, axis=1) - radii.sum(axis=1)
    return np.stack([row[i], row[j]], axis=1), offset, gap, radii


def _walls(scene: Scene, moves: Mask, row: Index) -> Walls | None:
    """Every moving sphere with every wall: row, normal, first gap, radius."""
    spheres = scene.spheres
    if not scene.walls or not moves.any():
        return None
    position, radius, count = spheres.position[moves], spheres.radius[moves], len(scene.walls)
    gaps = [(position - wall.point) @ wall.normal - radius for wall in scene.walls]
    normals = np.repeat([wall.normal for wall in scene.walls], len(radius), axis=0)
    return np.tile(row[moves], count), normals, np.concatenate(gaps), np.tile(radius, count)


def _grounds(scene: Scene, moves: Mask) -> Index:
    """The rows that hold how the walls of all contacts move: those after the spheres' own."""
    m = int(moves.sum())
    return np.repeat(m + 1 + np.arange(len(scene.walls)), m)
