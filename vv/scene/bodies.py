"""Spheres, walls and prescribed motion: frozen data, checked when it is created."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from vv.scene.arrays import Mask, Vector, freeze


@dataclass(frozen=True, eq=False)
class Spheres:
    """A group of n spheres (discs of unit thickness in a plane scene).

    position, velocity, spin: (n, 3) [m, m/s, 1/s]; radius, mass, inertia: (n,)
    [m, kg, kg m2]; load: (n, 3) dead loads, constant in time and direction [N].
    free, free_spin: (n, 3) booleans, the translations and rotations along the scene's axes that
    are free; along a locked direction a sphere keeps its initial velocity. The mass is given and
    never derived from the radius. Raises ValueError naming the field and the value that is wrong.
    """

    position: Vector
    velocity: Vector
    radius: Vector
    mass: Vector
    free: Mask
    inertia: Vector = None  # type: ignore[assignment]  # default: 2/5 m r2
    spin: Vector = None  # type: ignore[assignment]  # default: zeros
    free_spin: Mask = None  # type: ignore[assignment]  # default: none free
    load: Vector = None  # type: ignore[assignment]  # default: zeros

    def __post_init__(self) -> None:
        n = len(np.atleast_1d(self.radius))
        freeze(self, "radius", (n,), "m")
        freeze(self, "mass", (n,), "kg")
        zeros = np.zeros((n, 3))
        defaults = {"inertia": 0.4 * self.mass * self.radius**2, "spin": zeros, "load": zeros}
        for name, value in defaults.items():
            if getattr(self, name) is None:
                object.__setattr__(self, name, value)
        if self.free_spin is None:
            object.__setattr__(self, "free_spin", np.zeros((n, 3), bool))
        freeze(self, "inertia", (n,), "kg m2")
        for name, unit in (("position", "m"), ("velocity", "m/s"), ("spin", "1/s"), ("load", "N")):
            freeze(self, name, (n, 3), unit)
        for name in ("free", "free_spin"):
            freeze(self, name, (n, 3), "", bool)
        for name, unit in (("radius", "m"), ("mass", "kg"), ("inertia", "kg m2")):
            _require_positive(self, name, unit)

    def __len__(self) -> int:
        return len(self.radius)

    def part(self, rows: slice) -> Spheres:
        """The spheres of these rows, with all their data."""
        rest = {field.name: getattr(self, field.name)[rows] for field in fields(self)}
        return replace(self, **rest)


@dataclass(frozen=True, eq=False)
class Harmonic:
    """Sum over i of amplitude_i sin(2 pi frequency_i t + phase_i) axes_i.

    amplitude (in the unit of what varies), frequency [Hz], phase [rad]: (3,); axes: (3, 3), the
    directions as rows. Raises ValueError for a negative frequency.
    """

    amplitude: Vector
    frequency: Vector
    phase: Vector = (0.0, 0.0, 0.0)  # type: ignore[assignment]  # becomes an array (3,)
    axes: Vector = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))  # type: ignore[assignment]

    def __post_init__(self) -> None:
        for name, unit in (("amplitude", ""), ("frequency", "Hz"), ("phase", "rad")):
            freeze(self, name, (3,), unit)
        freeze(self, "axes", (3, 3), "")
        if (self.frequency < 0).any():
            raise ValueError(f"Harmonic.frequency = {self.frequency} Hz; it must not be negative")

    def sines(self) -> Iterator[tuple[Vector, float, float]]:
        """Sines of non-zero amplitude: amplitude (3,) in the frame, frequency [Hz], phase [rad]."""
        for k in np.flatnonzero(self.amplitude):
            along = self.amplitude[k] * self.axes[k]
            yield along, float(self.frequency[k]), float(self.phase[k])


@dataclass(frozen=True, eq=False)
class Pulse:
    """A sum of sines that ends: `wave` until a time `until` [s], nothing from there on.

    Raises ValueError unless `until` is positive and finite.
    """

    wave: Harmonic
    until: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.until) and self.until > 0):
            raise ValueError(f"Pulse.until = {self.until!r} s; it must be positive and finite")


@dataclass(frozen=True, eq=False)
class Wall:
    """A half-space bounded by a plane through point (3,) [m] with outward unit normal (3,).

    motion: None for a fixed wall; otherwise its displacement [m] is motion(t) - motion(0).
    Raises ValueError if the normal is not of unit length.
    """

    point: Vector
    normal: Vector
    motion: Harmonic | None = None

    def __post_init__(self) -> None:
        freeze(self, "point", (3,), "m")
        freeze(self, "normal", (3,), "")
        length = float(np.linalg.norm(self.normal))
        if abs(length - 1.0) > 1e-12:
            raise ValueError(f"Wall.normal has length {length!r}; it must be 1 to 1e-12")

    def __len__(self) -> int:
        return 1

    @property
    def facet_corners(self) -> Vector:
        """(3, 3) corners of an equilateral triangle in the plane of the wall, about the origin.

        They lie at distance 1 from it, counter-clockwise about the normal: the shape of a mesh
        facet that stands for the wall.
        """
        first = np.cross(self.normal, np.eye(3)[np.abs(self.normal).argmin()])
        first /= np.linalg.norm(first)
        turns = 2 * np.pi / 3 * np.arange(3)[:, None]
        return np.asarray(np.cos(turns) * first + np.sin(turns) * np.cross(self.normal, first))


def _require_positive(owner: Any, name: str, unit: str) -> None:
    values = getattr(owner, name)
    for index in np.flatnonzero(values <= 0)[:1]:
        plural = {"radius": "radii", "mass": "masses", "inertia": "moments of inertia"}[name]
        value = float(values[index])
        raise ValueError(
            f"{type(owner).__name__}.{name}[{index}] = {value!r} {unit}; {plural} must be positive"
        )


NO_SPHERES = Spheres(
    position=np.zeros((0, 3)),
    velocity=np.zeros((0, 3)),
    radius=np.zeros(0),
    mass=np.zeros(0),
    free=np.zeros((0, 3), bool),
)
