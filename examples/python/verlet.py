"""Spheres and walls by velocity Verlet: reads ask.json, writes series.csv and result.json."""

from __future__ import annotations

import csv
import json
import sys
import time
from collections.abc import Iterator
from typing import Any

Vector = list[float]


def main() -> int:
    """Answer one question; exit code 3 says that it is refused, and the last line why."""
    with open("ask.json") as file:
        ask = json.load(file)
    if ask["scene"]["contact"]["mu"] > 0:
        print("it has no friction", file=sys.stderr)
        return 3
    begun = time.process_time()
    rows = list(solve(ask["scene"], ask["knobs"]["dt"], ask["steps"], ask["stride"]))
    spent = time.process_time() - begun
    bodies = ask["scene"]["spheres"]["body"]
    kinds = ("displacement", "velocity")
    with open("series.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["t", *(f"{k}_{b}_{axis}" for k in kinds for b in bodies for axis in "xyz")])
        table.writerows(rows)
    with open("result.json", "w") as file:
        json.dump({"solve_cpu": spent, "note": "velocity Verlet, drag of half a step ago"}, file)
    return 0


def solve(scene: dict[str, Any], dt: float, steps: int, stride: int) -> Iterator[Vector]:
    """A row for every output: t, all displacements, all velocities."""
    spheres = scene["spheres"]
    start, x, v = spheres["position"], spheres["position"], spheres["velocity"]
    a = accelerations(scene, x, v)
    for step in range(steps + 1):
        if step % stride == 0:
            moved = [plus(new, -1, old) for new, old in zip(x, start, strict=True)]
            yield [step * dt, *(part for vector in (*moved, *v) for part in vector)]
        v = [plus(speed, dt / 2, push) for speed, push in zip(v, a, strict=True)]
        x = [plus(place, dt, speed) for place, speed in zip(x, v, strict=True)]
        a = accelerations(scene, x, v)
        v = [plus(speed, dt / 2, push) for speed, push in zip(v, a, strict=True)]


def accelerations(scene: dict[str, Any], x: list[Vector], v: list[Vector]) -> list[Vector]:
    """Of every sphere along the directions in which it is free; they are those of the frame."""
    spheres, found = scene["spheres"], []
    for i, free in enumerate(spheres["free"]):
        force = plus(spheres["load"][i], -scene["drag"], v[i])
        for depth, away in contacts(scene, x, i):
            force = plus(force, scene["contact"]["kn"] * depth, away)
        pull = plus(scene["gravity"], 1 / spheres["mass"][i], force)
        found.append([part * one for part, one in zip(pull, free, strict=True)])
    return found


def contacts(scene: dict[str, Any], x: list[Vector], i: int) -> Iterator[tuple[float, Vector]]:
    """How deep sphere i is in each wall and sphere that it touches, and the way out."""
    radius = scene["spheres"]["radius"]
    for wall in scene["walls"]:
        depth = radius[i] - dot(plus(x[i], -1, wall["point"]), wall["normal"])
        if depth > 0:
            yield depth, wall["normal"]
    for j in range(len(x)):
        apart = plus(x[i], -1, x[j])
        distance = dot(apart, apart) ** 0.5
        if j != i and distance < radius[i] + radius[j]:
            yield radius[i] + radius[j] - distance, [part / distance for part in apart]


def plus(a: Vector, factor: float, b: Vector) -> Vector:
    """The vector a + factor b."""
    return [p + factor * q for p, q in zip(a, b, strict=True)]


def dot(a: Vector, b: Vector) -> float:
    """The scalar product."""
    return sum(p * q for p, q in zip(a, b, strict=True))


if __name__ == "__main__":
    sys.exit(main())
