"""What is simulated: frozen data in SI units that checks itself at birth."""

from __future__ import annotations

import dataclasses
import enum
import functools
from dataclasses import dataclass

import numpy as np

from vv.block import Block
from vv.bodies import NO_SPHERES, Harmonic, Spheres, Wall
from vv.digest import digest
from vv.frozen import Mask, Vector, freeze

__all__ = ["Block", "Contact", "Harmonic", "Mask", "Scene", "Spheres", "Term", "Vector", "Wall"]


class Term(enum.Enum):
    """A physical effect that a scene contains; a scheme runs a scene only if it declares all."""

    SPHERE = "spheres"
    SPHERE_CONTACT = "contact between spheres"
    WALL_CONTACT = "contact with a plane wall"
    FRICTION = "shear spring capped by Coulomb friction"
    DRAG = "viscous drag -eta v"
    GRAVITY = "gravity"
    LOAD = "dead loads"
    ROTATION = "free rotation"
    OBLIQUE_LOCK = "motion locked along directions oblique to the frame"
    BLOCK = "convex blocks"
    RIGID_CONTACT = "contact without elasticity"
    SHAKING = "a body acceleration that varies in time"
    BASE_MOTION = "walls that move as prescribed"


@dataclass(frozen=True)
class Contact:
    """Linear contact without tension: kn, ks [N/m], Coulomb coefficient mu.

    kn = inf is rigid contact: no elasticity, for which ks says nothing and the knob kn of a
    penalty scheme stands in.

    Fn = kn U for an overlap U > 0; the shear spring ks is charged by the tangential motion and
    capped at mu Fn (Li et al. 2018, Eqs. 4-8). ks = 0 or mu = 0 means no shear force.
    """

    kn: float
    ks: float = 0.0
    mu: float = 0.0

    def __post_init__(self) -> None:
        if not self.kn > 0:
            raise ValueError(f"Contact.kn = {self.kn!r} N/m; a stiffness must be positive")
        for name, unit in (("ks", " N/m"), ("mu", "")):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise ValueError(f"Contact.{name} = {value!r}{unit}; it must be zero or more")


@dataclass(frozen=True, eq=False)
class Scene:
    """Groups of bodies, how they touch, and what acts on them.

    bodies: groups in order; body numbers run through them, a wall counting one. eta: drag
    [N s/m] on every sphere. gravity: (3,) [m/s2]. shaking: a further acceleration of every free
    body [m/s2], None for none. axes: (3, 3) rows are the orthonormal
    directions along which `free` and `free_spin` are stated. Raises ValueError.
    """

    bodies: tuple[Spheres | Wall | Block, ...]
    contact: Contact
    eta: float = 0.0
    gravity: Vector = dataclasses.field(default_factory=lambda: np.zeros(3))
    axes: Vector = dataclasses.field(default_factory=lambda: np.eye(3))
    shaking: Harmonic | None = None

    def __post_init__(self) -> None:
        if not (np.isfinite(self.eta) and self.eta >= 0):
            raise ValueError(f"Scene.eta = {self.eta!r} N s/m; drag must be zero or more")
        freeze(self, "gravity", (3,), "m/s2")
        freeze(self, "axes", (3, 3), "")
        if np.abs(self.axes @ self.axes.T - np.eye(3)).max() > 1e-12:
            raise ValueError("Scene.axes is not orthonormal; rows must be unit and perpendicular")
        if not any(isinstance(group, Spheres | Block) for group in self.bodies):
            raise ValueError("Scene.bodies holds walls only; a body must be there to move")

    @functools.cached_property
    def spheres(self) -> Spheres:
        """All spheres as one group, in body order."""
        groups = [group for group in self.bodies if isinstance(group, Spheres)] or [NO_SPHERES]
        names = [field.name for field in dataclasses.fields(Spheres)]
        joined = {name: np.concatenate([getattr(g, name) for g in groups]) for name in names}
        return Spheres(**joined)

    @functools.cached_property
    def walls(self) -> tuple[Wall, ...]:
        """All walls, in body order."""
        return tuple(group for group in self.bodies if isinstance(group, Wall))

    @functools.cached_property
    def blocks(self) -> tuple[Block, ...]:
        """All blocks, in body order."""
        return tuple(group for group in self.bodies if isinstance(group, Block))

    def sphere_index(self, body: int) -> int:
        """The index within `spheres` of a body number; raises ValueError if it is no sphere."""
        first = sphere = 0
        for group in self.bodies:
            if first <= body < first + len(group) and isinstance(group, Spheres):
                return sphere + body - first
            first += len(group)
            sphere += len(group) if isinstance(group, Spheres) else 0
        raise ValueError(f"body {body} is no sphere of this scene, which has {first} bodies")

    def terms(self) -> frozenset[Term]:
        """The effects present, derived from the data."""
        spheres, blocks = self.spheres, self.blocks
        present = {
            Term.SPHERE: len(spheres) > 0,
            Term.SPHERE_CONTACT: len(spheres) > 1,
            Term.WALL_CONTACT: bool(self.walls),
            Term.FRICTION: self.contact.mu > 0
            and (self.contact.ks > 0 or not np.isfinite(self.contact.kn)),
            Term.DRAG: self.eta > 0,
            Term.GRAVITY: bool(self.gravity.any()),
            Term.LOAD: bool(spheres.load.any() or any(b.load.any() for b in blocks)),
            Term.ROTATION: bool(spheres.free_spin.any() or any(b.free_spin.any() for b in blocks)),
            Term.OBLIQUE_LOCK: self._locks_obliquely(),
            Term.BLOCK: bool(blocks),
            Term.RIGID_CONTACT: not np.isfinite(self.contact.kn),
            Term.SHAKING: self.shaking is not None,
            Term.BASE_MOTION: any(wall.motion is not None for wall in self.walls),
        }
        return frozenset(term for term, there in present.items() if there)

    def unknowns(self) -> int:
        """How many freedoms the scene leaves."""
        masks = [self.spheres.free, self.spheres.free_spin]
        masks += [mask for block in self.blocks for mask in (block.free, block.free_spin)]
        return int(sum(mask.sum() for mask in masks))

    def digest(self) -> str:
        """Fingerprint of everything a solver can see."""
        return self._digest

    @functools.cached_property
    def _digest(self) -> str:
        return digest(self)

    def _locks_obliquely(self) -> bool:
        aligned = np.abs(self.axes).max(axis=1).min() > 1 - 1e-15
        masks = [*self.spheres.free, *(block.free for block in self.blocks)]
        return not aligned and any(mask.any() and not mask.all() for mask in masks)
