"""Convex blocks, rigid or elastic: polyhedra, their mass properties, and boxes."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from vv.scene.arrays import Mask, Vector, freeze

FLATNESS = 1e-9  # of a block's size: how far a vertex may lie off the plane of a face


@dataclass(frozen=True)
class Elastic:
    """Isotropic elasticity: Young's modulus [Pa] and Poisson's ratio, checked by the Block.

    relaxed: at t = 0 the block is strained in equilibrium with its loads and joints; otherwise
    unstrained.
    """

    young: float
    poisson: float
    relaxed: bool = False


@dataclass(frozen=True, eq=False)
class Block:
    """One convex polyhedron, rigid unless `elastic` is given.

    vertices: (k, 3) [m] in the scene's frame; faces: vertex numbers, counter-clockwise seen from
    outside; mass [kg]; inertia: (3, 3) about the centroid [kg m2]; velocity, spin: (3,)
    [m/s, 1/s]; load: (3,) dead load at the centroid [N]. free, free_spin: (3,) booleans, the free
    translations and rotations along the scene's axes. In a plane scene a block is a prism that
    can move in the plane only.

    elastic: None for a rigid block. Otherwise the block strains uniformly (Shi 1992: u is linear
    in x) along the directions in which it is free, with no strain at t = 0, unless it is relaxed,
    and no stress along the locked ones. Raises ValueError naming the block, and the face or value
    that is wrong.
    """

    name: str
    vertices: Vector
    faces: tuple[tuple[int, ...], ...]
    mass: float
    inertia: Vector
    velocity: Vector
    free: Mask
    free_spin: Mask
    spin: Vector = (0.0, 0.0, 0.0)  # type: ignore[assignment]  # becomes an array (3,)
    load: Vector = (0.0, 0.0, 0.0)  # type: ignore[assignment]  # becomes an array (3,)
    elastic: Elastic | None = None

    def __post_init__(self) -> None:
        freeze(self, "vertices", (len(self.vertices), 3), "m")
        freeze(self, "inertia", (3, 3), "kg m2")
        for name, unit in (("velocity", "m/s"), ("spin", "1/s"), ("load", "N")):
            freeze(self, name, (3,), unit)
        for name in ("free", "free_spin"):
            freeze(self, name, (3,), "", bool)
        if not (np.isfinite(self.mass) and self.mass > 0):
            raise ValueError(f"block '{self.name}': mass = {self.mass!r} kg; it must be positive")
        if np.linalg.eigvalsh(self.inertia).min() <= 0 or not np.allclose(
            self.inertia, self.inertia.T, rtol=1e-12, atol=0
        ):
            raise ValueError(f"block '{self.name}': inertia must be symmetric and positive")
        self._check_elastic()
        self._check_faces()

    def __len__(self) -> int:
        return 1

    def centroid(self) -> Vector:
        """The centre of the volume, (3,) [m]."""
        return self._centroid

    @functools.cached_property
    def _centroid(self) -> Vector:
        return volume_and_centroid(self.vertices, self.faces)[1]

    @functools.cached_property
    def normals(self) -> Vector:
        """The outward unit normals of the faces, (f, 3)."""
        return np.array([face_normal(self.vertices, face) for face in self.faces])

    @property
    def strains(self) -> tuple[tuple[int, int], ...]:
        """Pairs i <= j of the scene's axes along which it has a strain (i = j) or shear angle."""
        along = np.flatnonzero(self.free).tolist() if self.elastic else []
        return tuple((i, j) for i in along for j in along if i <= j)

    def _check_elastic(self) -> None:
        law = self.elastic
        if law and not (np.isfinite(law.young) and law.young > 0):
            raise ValueError(
                f"block '{self.name}': young = {law.young!r} Pa; it must be positive and finite"
            )
        if law and not -1 < law.poisson < 0.5:
            raise ValueError(
                f"block '{self.name}': poisson = {law.poisson!r}; -1 < poisson < 0.5 must hold"
            )

    def _check_faces(self) -> None:
        size = float(np.ptp(self.vertices, axis=0).max())
        rounds = [list(zip(face, (*face[1:], face[0]), strict=True)) for face in self.faces]
        edges = [edge for edges in rounds for edge in edges]
        open_edges = [sum(edges.count((b, a)) != 1 for a, b in edges_of) for edges_of in rounds]
        if any(open_edges):
            number = open_edges.index(max(open_edges))
            raise ValueError(
                f"block '{self.name}', face {number}: the faces do not enclose a volume; one is "
                "missing, or this one is listed clockwise"
            )
        for number, face in enumerate(self.faces):
            normal = face_normal(self.vertices, face)
            height = (self.vertices - self.vertices[face[0]]) @ normal
            where = f"block '{self.name}', face {number}"
            if np.abs(height[list(face)]).max() > FLATNESS * size:
                raise ValueError(f"{where}: its vertices do not lie in one plane")
            if height.min() >= -FLATNESS * size:
                raise ValueError(f"{where}: it points inwards; list it counter-clockwise")
            if height.max() > FLATNESS * size:
                raise ValueError(f"{where}: vertex {int(height.argmax())} lies outside; not convex")


def face_normal(vertices: Vector, face: Sequence[int]) -> Vector:
    """The outward unit normal (3,) of a face, from Newell's sum over its edges."""
    corners = vertices[list(face)] - vertices[face[0]]  # far from the origin products lose digits
    area = _cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    return np.asarray(area / np.linalg.norm(area))


def volume_and_centroid(vertices: Vector, faces: Sequence[Sequence[int]]) -> tuple[float, Vector]:
    """Volume [m3] and centroid (3,) [m] of a closed polyhedron, as a sum of tetrahedra."""
    apex = vertices.mean(axis=0)
    a, b, c = (vertices[corner] - apex for corner in _triangles(faces).T)
    parts = np.einsum("ti,ti->t", a, _cross(b, c)) / 6
    volume = float(parts.sum())
    return volume, apex + parts @ (a + b + c) / (4 * volume)


def polyhedron_inertia(
    vertices: Vector, faces: Sequence[Sequence[int]], density: float
) -> tuple[float, Vector]:
    """Mass [kg] and inertia (3, 3) about the centroid [kg m2] of a uniform polyhedron."""
    volume, centre = volume_and_centroid(vertices, faces)
    a, b, c = (vertices[corner] - centre for corner in _triangles(faces).T)
    parts = np.einsum("ti,ti->t", a, _cross(b, c)) / 120
    corners = np.array([a, b, c, a + b + c])
    second = np.einsum("t,kti,ktj->ij", parts, corners, corners)
    second = 0.5 * (second + second.T)  # rounding is not symmetric
    inertia = density * (np.trace(second) * np.eye(3) - second)
    return density * volume, inertia


def _triangles(faces: Sequence[Sequence[int]]) -> npt.NDArray[np.intp]:
    """Vertex numbers (t, 3) of triangles into which the faces are divided."""
    fans = [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
    return np.array(fans, np.intp)


def _cross(a: Vector, b: Vector) -> Vector:
    """Cross products of rows (k, 3); np.cross takes ten times as long for a few rows."""
    x, y, z = a.T
    u, v, w = b.T
    return np.stack((y * w - z * v, z * u - x * w, x * v - y * u), axis=-1)


def box_geometry(
    centre: Vector, half: Vector, axes: Vector
) -> tuple[Vector, tuple[tuple[int, ...], ...]]:
    """Vertices (8, 3) [m] and faces of a box; half: (3,) half sides [m] along rows of axes."""
    signs = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], float)
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return np.asarray(centre) + (signs * np.asarray(half)) @ np.asarray(axes), faces
