"""Spheres, walls and their prescribed motion: frozen data that checks itself at birth."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from vv.scene.arrays import Mask, Vector, freeze


@dataclass(frozen=True, eq=False)
class Spheres:
    """A group of n spheres (discs of unit thickness in a plane scene).

    position, velocity, spin: (n, 3) [m, m/s, 1/s]; radius, mass, inertia: (n,)
    [m, kg, kg m2]; load: (n, 3) dead forces [N]. free, free_spin: (n, 3) booleans: the
    translations and rotations left free, along the scene's axes; a locked translation keeps the
    velocity that it has. Mass and inertia are data,
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


@dataclass(frozen=True, eq=False)
class Harmonic:
    """A sum of one sine per direction: amplitude_i sin(2 pi frequency_i t + phase_i) axes_i.

    amplitude, frequency [Hz], phase [rad]: (3,); axes: (3, 3), the directions as rows.
    """

    amplitude: Vector
    frequency: Vector
    phase: Vector = (0.0, 0.0, 0.0)  # type: ignore[assignment]  # frozen to an array at birth
    axes: Vector = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))  # type: ignore[assignment]

    def __post_init__(self) -> None:
        for name, unit in (("amplitude", ""), ("frequency", "Hz"), ("phase", "rad")):
            freeze(self, name, (3,), unit)
        freeze(self, "axes", (3, 3), "")
        if (self.frequency < 0).any():
            raise ValueError(f"Harmonic.frequency = {self.frequency} Hz; it must not be negative")

    def sines(self) -> Iterator[tuple[Vector, float, float]]:
        """Each sine that is not nil: amplitude (3,) in the frame, frequency [Hz], phase [rad]."""
        for k in np.flatnonzero(self.amplitude):
            along = self.amplitude[k] * self.axes[k]
            yield along, float(self.frequency[k]), float(self.phase[k])


@dataclass(frozen=True, eq=False)
class Wall:
    """A half-space bounded by a plane: point (3,) [m] on it, unit normal (3,) outward.

    motion: None for a fixed wall, else its displacement [m] is motion(t) - motion(0).
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
    def triangle(self) -> Vector:
        """(3, 3) the corners of an equilateral triangle across the normal, which they run round.

        They lie at distance 1 about the origin: the shape of a facet that stands for the wall.
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
