"""The scene: bodies, contact law, gravity, shaking and bonds, in SI units."""

from __future__ import annotations

import dataclasses
import functools
from dataclasses import dataclass

import numpy as np

from vv.base.digest import digest
from vv.scene.arrays import Vector, freeze
from vv.scene.block import Block
from vv.scene.bodies import NO_SPHERES, Harmonic, Pulse, Spheres, Wall
from vv.scene.bonds import Bonds, Pairs
from vv.scene.contact import Contact
from vv.scene.fluid import Fluid
from vv.scene.hertz import Hertz
from vv.scene.rising import rises_into
from vv.scene.terms import Term


@dataclass(frozen=True, eq=False)
class Scene:
    """Bodies, their contact law, and the loads on them.

    bodies: groups in order; bodies are numbered through all groups, a wall or block is one body.
    eta: drag [N s/m], a force -eta v on every sphere. gravity: (3,) [m/s2]. shaking: an additional
    acceleration of every free body [m/s2] that varies in time, or None. axes: (3, 3), the rows are
    the orthonormal directions to which `free` and `free_spin` refer. bonds: None, or the bonds; a
    bonded pair has no contact. A bond that can break must have the contact's kn and ks, and the
    sum of the radii as its length, so that forces do not jump when contact replaces it. fluid:
    None, or what spheres move in. A wall in rigid contact must not rise into a block that is
    locked along the wall's normal.
    Raises ValueError naming the field and the value that is wrong.
    """

    bodies: tuple[Spheres | Wall | Block, ...]
    contact: Contact
    eta: float = 0.0
    gravity: Vector = dataclasses.field(default_factory=lambda: np.zeros(3))
    axes: Vector = dataclasses.field(default_factory=lambda: np.eye(3))
    shaking: Harmonic | Pulse | None = None
    bonds: Bonds | None = None
    fluid: Fluid | None = None

    def __post_init__(self) -> None:
        if not (np.isfinite(self.eta) and self.eta >= 0):
            raise ValueError(f"Scene.eta = {self.eta!r} N s/m; drag must be zero or more")
        freeze(self, "gravity", (3,), "m/s2")
        freeze(self, "axes", (3, 3), "")
        if np.abs(self.axes @ self.axes.T - np.eye(3)).max() > 1e-12:
            raise ValueError("Scene.axes is not orthonormal; rows must be unit and perpendicular")
        if not any(isinstance(group, Spheres | Block) for group in self.bodies):
            raise ValueError("Scene.bodies has walls only; at least one sphere or block is needed")
        if self.bonds is not None:
            _check_bonds(self, self.bonds)
        if not np.isfinite(self.contact.kn):
            why = rises_into(self.walls, self.blocks, self.axes)
            if why:
                raise ValueError(f"Scene.bodies: {why}")

    @functools.cached_property
    def spheres(self) -> Spheres:
        """All spheres as one group, in body order."""
        groups = [group for group in self.bodies if isinstance(group, Spheres)] or [NO_SPHERES]
        names = [field.name for field in dataclasses.fields(groups[0])]
        joined = {name: np.concatenate([getattr(g, name) for g in groups]) for name in names}
        return dataclasses.replace(groups[0], **joined)

    @functools.cached_property
    def locked_velocity(self) -> Vector:
        """The velocities (n, 3) [m/s] of the spheres along locked directions, constant in time."""
        parts = np.where(self.spheres.free, 0.0, self.spheres.velocity @ self.axes.T)
        size = np.abs(self.spheres.velocity).max(axis=1, keepdims=True, initial=0.0)
        return np.asarray(np.where(np.abs(parts) > LOCKED_SPEED * size, parts, 0.0) @ self.axes)

    @functools.cached_property
    def wave(self) -> Harmonic | None:
        """The sines of the shaking, without the end of a Pulse; None without shaking."""
        return self.shaking.wave if isinstance(self.shaking, Pulse) else self.shaking

    @functools.cached_property
    def walls(self) -> tuple[Wall, ...]:
        """All walls, in body order."""
        return tuple(group for group in self.bodies if isinstance(group, Wall))

    @functools.cached_property
    def blocks(self) -> tuple[Block, ...]:
        """All blocks, in body order."""
        return tuple(group for group in self.bodies if isinstance(group, Block))

    @functools.cached_property
    def bonded_pairs(self) -> Pairs:
        """(b, 2) indices within `spheres` of the bonded pairs."""
        empty = np.zeros((0, 2), np.int64)
        return empty if self.bonds is None else self._indices()[self.bonds.pairs]

    def _indices(self) -> Pairs:
        """Index within `spheres` of every body, -1 for walls and blocks."""
        kinds = [np.full(len(group), isinstance(group, Spheres)) for group in self.bodies]
        sphere = np.concatenate(kinds)
        return np.where(sphere, np.cumsum(sphere) - 1, -1)

    def body_numbers(self, kind: type[Spheres] | type[Wall] | type[Block]) -> list[int]:
        """Body numbers of all bodies of a kind, ascending."""
        kinds = [isinstance(group, kind) for group in self.bodies for _ in range(len(group))]
        return [number for number, fits in enumerate(kinds) if fits]

    def sphere_index(self, body: int) -> int:
        """Index within `spheres` of a body number; raises ValueError if the body is no sphere."""
        first = sphere = 0
        for group in self.bodies:
            if first <= body < first + len(group) and isinstance(group, Spheres):
                return sphere + body - first
            first += len(group)
            sphere += len(group) if isinstance(group, Spheres) else 0
        raise ValueError(f"body {body} is not a sphere of this scene, which has {first} bodies")

    def terms(self) -> frozenset[Term]:
        """The physical effects in the scene, derived from its data."""
        return self._terms

    @functools.cached_property
    def _terms(self) -> frozenset[Term]:
        spheres, blocks, bonds = self.spheres, self.blocks, self.bonds
        present = {
            Term.SPHERE: len(spheres) > 0,
            Term.SPHERE_CONTACT: self._may_touch(),
            Term.WALL_CONTACT: bool(self.walls),
            Term.FRICTION: self.contact.carries_shear,
            Term.DRAG: self.eta > 0,
            Term.FLUID: self.fluid is not None and len(spheres) > 0,
            Term.GRAVITY: bool(self.gravity.any()),
            Term.LOAD: bool(spheres.load.any() or any(b.load.any() for b in blocks)),
            Term.ROTATION: bool(spheres.free_spin.any() or any(b.free_spin.any() for b in blocks)),
            Term.OBLIQUE_LOCK: self._locks_obliquely(),
            Term.BLOCK: bool(blocks),
            Term.STRAIN: any(block.elastic for block in blocks),
            Term.STRAINED_START: any(b.elastic and b.elastic.relaxed for b in blocks),
            Term.RIGID_CONTACT: not np.isfinite(self.contact.kn),
            Term.SHAKING: self.shaking is not None,
            Term.PULSE: isinstance(self.shaking, Pulse),
            Term.BASE_MOTION: any(wall.motion is not None for wall in self.walls),
            Term.BOND: bonds is not None,
            Term.BOND_SHEAR: bonds is not None and bool(bonds.ks.any()),
            Term.BREAKAGE: bonds is not None and bool(bonds.breakable.any()),
            Term.CARRIED: bool(self.locked_velocity.any()),
            Term.CONTACT_VISCOSITY: self.contact.eta_n > 0,
            Term.HERTZ: self.contact.hertz is not None,
            Term.MICRO_SLIP: (self.contact.hertz or NO_HERTZ).micro_slip and self.contact.mu > 0,
            Term.HERTZ_VISCOSITY: (self.contact.hertz or NO_HERTZ).damping > 0,
            Term.VISCOUS_FRICTION: self.contact.viscous and self.contact.carries_shear,
        }
        return frozenset(term for term, there in present.items() if there)

    def unknowns(self) -> int:
        """Number of degrees of freedom: free translations and rotations, and strains of blocks."""
        masks = [self.spheres.free, self.spheres.free_spin]
        masks += [mask for block in self.blocks for mask in (block.free, block.free_spin)]
        return int(sum(mask.sum() for mask in masks)) + sum(len(b.strains) for b in self.blocks)

    def digest(self) -> str:
        """SHA-256 digest of all data of the scene."""
        return self._digest

    @functools.cached_property
    def _digest(self) -> str:
        return digest(self)

    def _may_touch(self) -> bool:
        """Whether some two spheres can be in contact: not held by an unbreakable bond."""
        n = len(self.spheres)
        held = 0 if self.bonds is None else int((~self.bonds.breakable).sum())
        return held < n * (n - 1) // 2

    def _locks_obliquely(self) -> bool:
        aligned = np.abs(self.axes).max(axis=1).min() > 1 - 1e-15
        masks = [*self.spheres.free, *(block.free for block in self.blocks)]
        return not aligned and any(mask.any() and not mask.all() for mask in masks)


NO_HERTZ = Hertz(1.0)  # which is neither stiff across the normal nor viscous
LOCKED_SPEED = 1e-12  # of the speed: a smaller component along a locked direction is rounding
SAME_LAW = (
    1e-9  # relative: by how much kn, ks and length of a breakable bond may differ from contact
)


def _check_bonds(scene: Scene, bonds: Bonds) -> None:
    """Raise ValueError for a bond on a wall or block, without direction, or unlike its contact."""
    index = scene._indices()
    known = index[np.minimum(bonds.pairs, len(index) - 1)] >= 0
    for k in np.flatnonzero((~known | (bonds.pairs >= len(index))).any(axis=1))[:1]:
        pair = bonds.pairs[k].tolist()
        raise ValueError(f"Bonds.pairs[{k}] = {pair}; bonds join spheres among the bodies")
    spheres, (i, j) = scene.spheres, index[bonds.pairs].T
    for k in np.flatnonzero(~(spheres.position[j] - spheres.position[i]).any(axis=1))[:1]:
        pair = bonds.pairs[k].tolist()
        raise ValueError(f"Bonds.pairs[{k}] = {pair} have one centre; a bond needs a direction")
    law, reach = scene.contact, spheres.radius[i] + spheres.radius[j]
    wanted = {"kn": np.full(len(i), law.kn), "ks": np.full(len(i), law.ks), "length": reach}
    for name, unit in (("kn", "N/m"), ("ks", "N/m"), ("length", "m")):
        values, contact = getattr(bonds, name), wanted[name]
        jumps = bonds.breakable & ~(np.abs(values - contact) <= SAME_LAW * values)
        for k in np.flatnonzero(jumps)[:1]:
            raise ValueError(
                f"Bonds.{name}[{k}] = {float(values[k])!r} {unit}, and {float(contact[k])!r} "
                f"{unit} once it is broken; where a bond can break they must be the same"
            )
