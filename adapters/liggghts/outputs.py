"""The output of a deck: a row of numbers per output time, and the number of spheres not lost."""

from __future__ import annotations

from collections.abc import Iterator

from adapters.liggghts.setup import Setup
from adapters.liggghts.space import travel
from adapters.liggghts.words import AXES, bounds, group, numbers
from vv.ask import Displacement


def count_commands(setup: Setup) -> Iterator[str]:
    """Commands that count the spheres inside the box whose centres are before all walls.

    LIGGGHTS drops a sphere that leaves its box, and its walls push to both sides, so lost spheres
    would not be noticed otherwise.
    """
    scene, room = setup.scene, setup.room
    yield f"region          reach block {bounds(room.low, room.high)} units box"
    count = len(setup.springs.scene.spheres)  # only the first atom of each body is counted
    yield group("watched", range(count))
    fronts = [f"front{number}" for number in range(len(scene.walls))]
    for name, wall in zip(fronts, scene.walls, strict=True):
        rearmost = wall.point - travel(wall) * wall.normal
        yield f"region          {name} plane {numbers([*rearmost, *wall.normal])} units box"
    if fronts:
        yield f"region          allowed intersect {len(fronts) + 1} reach {' '.join(fronts)}"
    yield f"variable        count equal count(watched,{'allowed' if fronts else 'reach'})"


def output_commands(setup: Setup, history: str) -> Iterator[str]:
    """Commands that write rows; LIGGGHTS forms displacements as differences, with all 15 digits."""
    start, ask = setup.spheres.position, setup.ask
    yield "variable        step equal step"
    names = ["step", "count"]
    for number, (seen, i) in enumerate(setup.watched):
        for a, from_ in zip(AXES, start[i].tolist(), strict=True):
            shift = f"{a}[{i + 1}]-({from_!r})"
            formula = shift if isinstance(seen, Displacement) else f"v{a}[{i + 1}]"
            names.append(f"o{number}{a}")
            yield f"variable        {names[-1]} equal {formula}"
    row = " ".join(f"${{{name}}}" for name in names)
    stride = ask.goal.stride(ask.dt)
    title = f'title "# {_title(setup)}"'
    yield f'fix history all print {stride} "{row}" file {history} screen no {title}'


def _title(setup: Setup) -> str:
    """The names of a row's columns."""
    columns = [f"{type(seen).__name__.lower()} {seen.body} ({AXES})" for seen, _ in setup.watched]
    return ", ".join(["step", "spheres", *columns])
