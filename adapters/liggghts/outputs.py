"""What a deck has LIGGGHTS write: a row of numbers per output, and how many spheres count."""

from __future__ import annotations

from collections.abc import Iterator

from adapters.liggghts.setup import Setup
from adapters.liggghts.space import travel
from adapters.liggghts.words import AXES, bounds, group, numbers
from vv.ask import Displacement


def count_commands(setup: Setup) -> Iterator[str]:
    """Counts the spheres that are where they may be: in reach and with centres before all walls.

    LIGGGHTS drops a sphere that leaves its box, and its walls push to both sides: what left the
    box or went through a wall would pass unnoticed.
    """
    scene, room = setup.scene, setup.room
    yield f"region          reach block {bounds(room.low, room.high)} units box"
    count = len(setup.springs.scene.spheres)  # the first atoms; the rest of a body goes along
    yield group("watched", range(count))
    fronts = [f"front{number}" for number in range(len(scene.walls))]
    for name, wall in zip(fronts, scene.walls, strict=True):
        rearmost = wall.point - travel(wall) * wall.normal
        yield f"region          {name} plane {numbers([*rearmost, *wall.normal])} units box"
    if fronts:
        yield f"region          allowed intersect {len(fronts) + 1} reach {' '.join(fronts)}"
    yield f"variable        count equal count(watched,{'allowed' if fronts else 'reach'})"


def output_commands(setup: Setup, history: str) -> Iterator[str]:
    """Displacements are differences formed by LIGGGHTS: its 15 digits all count."""
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
