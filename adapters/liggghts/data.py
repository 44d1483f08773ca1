"""Translates many spheres for LIGGGHTS into a data file, which the deck itself writes and reads.

A command for each sphere would search all spheres, so that the time grows with the square of their
number: 7 s for 40 000 spheres, where the file takes 0.3 s.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from adapters.liggghts.setup import CLUMP, OVERLAPPED, Setup
from adapters.liggghts.words import AXES, numbers, printed
from vv.scene import Vector

MANY = 1000  # spheres; fewer are created one by one, so that a small deck is easy to read
FILE = "spheres.data"


def many(setup: Setup) -> bool:
    """Whether spheres are written to a data file: if they are many, of the plain atom style."""
    bonded = setup.scene.bonds is not None or setup.scheme in (CLUMP, OVERLAPPED)
    return len(setup.spheres) >= MANY and not bonded


def read_data(setup: Setup, places: Vector) -> Iterator[str]:
    """Commands that make the box and the spheres at places (n, 3) [m], in the order of bodies.

    LIGGGHTS takes densities and computes masses from them, which rounds them.
    """
    yield from printed(FILE, _lines(setup, places))
    yield f"read_data       {FILE}"


def _lines(setup: Setup, places: Vector) -> Iterator[str]:
    spheres, (low, high) = setup.spheres, setup.room.outer
    density = spheres.mass / (4.0 / 3.0 * math.pi * spheres.radius**3)
    yield from ("spheres", "", f"{len(spheres)} atoms", "1 atom types", "")
    for axis, ends in zip(AXES, zip(low, high, strict=True), strict=True):
        yield f"{numbers(ends)} {axis}lo {axis}hi"
    yield from ("", "Atoms", "")
    sizes = zip(2 * spheres.radius, density, strict=True)
    for number, (size, place) in enumerate(zip(sizes, places, strict=True), 1):
        yield f"{number} 1 {numbers(size)} {numbers(place)}"
    yield from ("", "Velocities", "")
    for number, both in enumerate(zip(spheres.velocity, spheres.spin, strict=True), 1):
        yield f"{number} {numbers(both[0])} {numbers(both[1])}"
