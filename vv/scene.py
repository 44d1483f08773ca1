"""What is simulated: frozen data in SI units that checks itself at birth."""

from __future__ import annotations

import dataclasses
import enum
import functools
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from vv.digest import digest

Vector = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


class Term(enum.Enum):
    """A physical effect that a scene contains; a scheme runs a scene only if it declares all."""

    SPHERE_CONTACT = "contact between spheres"
    WALL_CONTACT = "contact with a plane wall"
    FRICTION = "shear spring capped by Coulomb friction"
    DRAG = "viscous drag -eta v"
    GRAVITY = "gravity"
    LOAD = "dead loads"
    ROTATION = "free rotation"
    OBLIQUE_LOCK = "motion locked along directions oblique to the frame"


@dataclass(frozen=True, eq=False)
class Spheres:
    """A group of n spheres (discs of unit thickness in a plane scene).

    position, velocity, spin: (n, 3) [m, m/s, 1/s]; radius, mass, inertia: (n,)
    [m, kg, kg m2]; load: (n, 3) dead forces [N]. free, free_spin: (n, 3) booleans: the
    translations and rotations left free, along the scene's axes. Mass and inertia are data,
    never derived from the radius. Raises ValueError for data no sphere can have.
    """

    position: Vector
    velocity: Vector
    radius: Vector
    mass: Vector
    free: Mask
    inertia: Vector = None  # type: ignore[assignment]  # filled at birth: 2/5 m r2
    spin: Vector = None  # type: ignore[assignment]  # filled at birth: zeros
    free_spin: Mask = None  # type: ignore[assignment]  # filled at birth: none
    load: Vector = None  # type: ignore[assignment]  # filled at birth: zeros

    def __post_init__(self) -> None:
        n = len(np.atleast_1d(self.radius))
        _freeze(self, "radius", (n,), "m")
        _freeze(self, "mass", (n,), "kg")
        zeros = np.zeros((n, 3))
        defaults = {"inertia": 0.4 * self.mass * self.radius**2, "spin": zeros, "load": zeros}
        for name, value in defaults.items():
            if getattr(self, name) is None:
                object.__setattr__(self, name, value)
        if self.free_spin is None:
            object.__setattr__(self, "free_spin", np.zeros((n, 3), bool))
        _freeze(self, "inertia", (n,), "kg m2")
        for name, unit in (("position", "m"), ("velocity", "m/s"), ("spin", "1/s"), ("load", "N")):
            _freeze(self, name, (n, 3), unit)
        for name in ("free", "free_spin"):
            _freeze(self, name, (n, 3), "", bool)
        for name, unit in (("radius", "m"), ("mass", "kg"), ("inertia", "kg m2")):
            _require_positive(self, name, unit)

    def __len__(self) -> int:
        return len(self.radius)


@dataclass(frozen=True, eq=False)
class Wall:
    """A fixed half-space bounded by a plane: point (3,) [m] on it, unit normal (3,) outward."""

    point: Vector
    normal: Vector

    def __post_init__(self) -> None:
        _freeze(self, "point", (3,), "m")
        _freeze(self, "normal", (3,), "")
        length = float(np.linalg.norm(self.normal))
        if abs(length - 1.0) > 1e-12:
            raise ValueError(f"Wall.normal has length {length!r}; it must be 1 to 1e-12")

    def __len__(self) -> int:
        return 1


@dataclass(frozen=True)
class Contact:
    """Linear contact without tension: kn, ks [N/m], Coulomb coefficient mu.

    Fn = kn U for an overlap U > 0; the shear spring ks is charged by the tangential motion and
    capped at mu Fn (Li et al. 2018, Eqs. 4-8). ks = 0 or mu = 0 means no shear force.
    """

    kn: float
    ks: float = 0.0
    mu: float = 0.0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.kn) and self.kn > 0):
            raise ValueError(f"Contact.kn = {self.kn!r} N/m; a stiffness must be positive")
        for name, unit in (("ks", " N/m"), ("mu", "")):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise ValueError(f"Contact.{name} = {value!r}{unit}; it must be zero or more")


@dataclass(frozen=True, eq=False)
class Scene:
    """Groups of bodies, how they touch, and what acts on them.

    bodies: groups in order; body numbers run through them, a wall counting one. eta: drag
    [N s/m] on every sphere. gravity: (3,) [m/s2]. axes: (3, 3) rows are the orthonormal
    directions along which `free` and `free_spin` are stated. Raises ValueError.
    """

    bodies: tuple[Spheres | Wall, ...]
    contact: Contact
    eta: float = 0.0
    gravity: Vector = dataclasses.field(default_factory=lambda: np.zeros(3))
    axes: Vector = dataclasses.field(default_factory=lambda: np.eye(3))

    def __post_init__(self) -> None:
        if not (np.isfinite(self.eta) and self.eta >= 0):
            raise ValueError(f"Scene.eta = {self.eta!r} N s/m; drag must be zero or more")
        _freeze(self, "gravity", (3,), "m/s2")
        _freeze(self, "axes", (3, 3), "")
        if np.abs(self.axes @ self.axes.T - np.eye(3)).max() > 1e-12:
            raise ValueError("Scene.axes is not orthonormal; rows must be unit and perpendicular")
        if not any(isinstance(group, Spheres) for group in self.bodies):
            raise ValueError("Scene.bodies holds no spheres; at least one must be there to move")

    @functools.cached_property
    def spheres(self) -> Spheres:
        """All spheres as one group, in body order."""
        groups = [group for group in self.bodies if isinstance(group, Spheres)]
        names = [field.name for field in dataclasses.fields(Spheres)]
        joined = {name: np.concatenate([getattr(g, name) for g in groups]) for name in names}
        return Spheres(**joined)

    @functools.cached_property
    def walls(self) -> tuple[Wall, ...]:
        """All walls, in body order."""
        return tuple(group for group in self.bodies if isinstance(group, Wall))

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
        spheres = self.spheres
        present = {
            Term.SPHERE_CONTACT: len(spheres) > 1,
            Term.WALL_CONTACT: bool(self.walls),
            Term.FRICTION: self.contact.ks > 0 and self.contact.mu > 0,
            Term.DRAG: self.eta > 0,
            Term.GRAVITY: bool(self.gravity.any()),
            Term.LOAD: bool(spheres.load.any()),
            Term.ROTATION: bool(spheres.free_spin.any()),
            Term.OBLIQUE_LOCK: self._locks_obliquely(),
        }
        return frozenset(term for term, there in present.items() if there)

    def unknowns(self) -> int:
        """How many freedoms the scene leaves."""
        return int(self.spheres.free.sum() + self.spheres.free_spin.sum())

    def digest(self) -> str:
        """Fingerprint of everything a solver can see."""
        return digest(self)

    def _locks_obliquely(self) -> bool:
        aligned = np.abs(self.axes).max(axis=1).min() > 1 - 1e-15
        partly = np.logical_xor(self.spheres.free.any(axis=1), self.spheres.free.all(axis=1))
        return not aligned and bool(partly.any())


def _freeze(owner: Any, name: str, shape: tuple[int, ...], unit: str, kind: type = float) -> None:
    """Replace a field by a read-only array of the right shape; refuse anything not finite."""
    array: npt.NDArray[Any] = np.array(getattr(owner, name), dtype=kind)
    label = f"{type(owner).__name__}.{name}"
    if array.shape != shape:
        raise ValueError(f"{label} has shape {array.shape}; it must be {shape}")
    if not np.isfinite(array).all():
        where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise ValueError(f"{label}{list(where)} = {array[where]} {unit}; values must be finite")
    array.flags.writeable = False
    object.__setattr__(owner, name, array)


def _require_positive(owner: Any, name: str, unit: str) -> None:
    values = getattr(owner, name)
    for index in np.flatnonzero(values <= 0)[:1]:
        plural = {"radius": "radii", "mass": "masses", "inertia": "moments of inertia"}[name]
        value = float(values[index])
        raise ValueError(
            f"{type(owner).__name__}.{name}[{index}] = {value!r} {unit}; {plural} must be positive"
        )
