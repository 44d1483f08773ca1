"""Writes an ask as a LIGGGHTS deck: text alone, which needs no file besides itself to run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from adapters.liggghts.translate import (
    Space,
    has_friction,
    loads,
    locks,
    moving,
    represented,
    space,
    spinning,
    step,
    watched,
)
from adapters.liggghts.walls import AXES, numbers, wall_commands
from vv.ask import Ask, Displacement
from vv.scene import Scene, Vector

DOMAIN = """\
units           si
atom_style      granular
atom_modify     map array sort 0 0
boundary        f f f
newton          off
communicate     single vel yes"""


def deck(ask: Ask, scheme: str, history: str) -> str:
    """A deck that solves an ask and writes the file `history`: a row per output after t = 0.

    A row holds the step, the number of spheres that are where they may be, and three numbers
    for each of `watched(ask)`: the displacement [m] or the velocity [m/s].
    """
    observed = ["", "modify_timing   on", *_allowed(ask, scheme), *_observed(ask, history)]
    return _text([*_prepared(ask, scheme), *observed, _run(ask), "unfix history"])


def silent_deck(ask: Ask, scheme: str) -> str:
    """The same solve without any output, for timing."""
    return _text([*_prepared(ask, scheme), _run(ask)])


def _text(lines: Iterable[str]) -> str:
    return "\n".join(lines) + "\n"


def _run(ask: Ask) -> str:
    return f"run             {ask.goal.steps(step(ask))}"


def _prepared(ask: Ask, scheme: str) -> Iterator[str]:
    """Everything up to the first step."""
    scene = represented(ask, scheme)
    room = space(ask, scene)
    yield from _domain(scene, room)
    yield ""
    yield from _spheres(scene)
    yield ""
    yield from _contact(scene)
    for number, wall in enumerate(scene.walls):
        yield from wall_commands(f"wall{number}", wall, room.triangles.get(number), _model(scene))
    yield ""
    yield from _motion(scene)
    yield f"timestep        {step(ask)!r}"
    yield "thermo_style    custom step atoms"
    yield "thermo          0"


def _domain(scene: Scene, room: Space) -> Iterator[str]:
    """A box far larger than the scene; neighbours are sought anew when half the skin is used up."""
    radius = float(scene.spheres.radius.max())
    longest = float((room.outer[1] - room.outer[0]).max())
    yield DOMAIN
    yield f"region          box block {_bounds(*room.outer)} units box"
    yield "create_box      1 box"
    yield f"neighbor        {0.2 * radius!r} bin"
    # few bins for so large a box
    yield f"neigh_modify    delay 0 binsize {max(2 * radius, longest / 20)!r}"


def _bounds(low: Vector, high: Vector) -> str:
    return numbers(np.column_stack([low, high]).ravel())


def _spheres(scene: Scene) -> Iterator[str]:
    """Atoms in body order, so that ids are sphere numbers from 1; masses override densities."""
    spheres = scene.spheres
    for position in spheres.position:
        yield f"create_atoms    1 single {numbers(position)} units box"
    yield "set             group all density 1"
    for i in range(len(spheres)):
        size, mass = 2 * float(spheres.radius[i]), float(spheres.mass[i])
        yield f"set             atom {i + 1} diameter {size!r} mass {mass!r}"
    for name, rows in (("v", spheres.velocity), ("omega", spheres.spin)):
        for row in np.flatnonzero(rows.any(axis=1)):
            parts = " ".join(
                f"{name}{a} {x!r}" for a, x in zip(AXES, rows[row].tolist(), strict=True)
            )
            yield f"set             atom {row + 1} {parts}"


def _contact(scene: Scene) -> Iterator[str]:
    """kn and ks are the springs themselves [N/m]; neither of them is damped."""
    ks, mu = (scene.contact.ks, scene.contact.mu) if has_friction(scene) else (0.0, 0.0)
    values = {"kn": scene.contact.kn, "kt": ks, "gamman": 0.0, "gammat": 0.0}
    for name, value in {**values, "coefficientFriction": mu}.items():
        yield f"fix {name} all property/global {name} peratomtypepair 1 {float(value)!r}"
    yield f"pair_style      gran {_model(scene)} tangential_damping off"
    yield "pair_coeff      * *"


def _model(scene: Scene) -> str:
    return f"model hooke/stiffness tangential {'history' if has_friction(scene) else 'off'}"


def _motion(scene: Scene) -> Iterator[str]:
    """Forces in the order in which LIGGGHTS must add them: locks last, to cancel all others."""
    spheres, turning = scene.spheres, spinning(scene.spheres)
    for name, style, members in (
        ("shifted", "nve", moving(spheres) & ~turning),
        ("turned", "nve/sphere", turning),
    ):
        if members.any():
            yield _group(name, np.flatnonzero(members))
            yield f"fix {name} {name} {style}"
    if scene.eta > 0:
        yield f"fix drag all viscous {float(scene.eta)!r}"
    if scene.gravity.any():
        size = float(np.linalg.norm(scene.gravity))
        yield f"fix weight all gravity {size!r} vector {numbers(scene.gravity / size)}"
    for number, (load, carriers) in enumerate(loads(spheres).items()):
        yield _group(f"load{number}", carriers)
        yield f"fix load{number} load{number} addforce {numbers(load)}"
    for pattern, held in locks(spheres).items():
        name = "lock_" + "".join(a for a, locked in zip(AXES, pattern, strict=True) if locked)
        yield _group(name, held)
        parts = " ".join("0" if locked else "NULL" for locked in pattern)
        yield f"fix {name} {name} setforce {parts}"


def _group(name: str, indices: Iterable[int]) -> str:
    return f"group           {name} id {' '.join(str(i + 1) for i in indices)}"


def _allowed(ask: Ask, scheme: str) -> Iterator[str]:
    """Counts the spheres that are where they may be: in reach and with centres before all walls.

    LIGGGHTS drops a sphere that leaves its box, and its walls push to both sides: what left the
    box or went through a wall would pass unnoticed.
    """
    scene = represented(ask, scheme)
    room = space(ask, scene)
    yield f"region          reach block {_bounds(room.low, room.high)} units box"
    fronts = [f"front{number}" for number in range(len(scene.walls))]
    for name, wall in zip(fronts, scene.walls, strict=True):
        yield f"region          {name} plane {numbers([*wall.point, *wall.normal])} units box"
    if fronts:
        yield f"region          allowed intersect {len(fronts) + 1} reach {' '.join(fronts)}"
    yield f"variable        count equal count(all,{'allowed' if fronts else 'reach'})"


def _observed(ask: Ask, history: str) -> Iterator[str]:
    """Displacements are differences formed by LIGGGHTS: its 15 digits all count."""
    yield "variable        step equal step"
    names = ["step", "count"]
    for number, (seen, i) in enumerate(watched(ask)):
        for a, start in zip(AXES, ask.scene.spheres.position[i].tolist(), strict=True):
            shift = f"{a}[{i + 1}]-({start!r})"
            formula = shift if isinstance(seen, Displacement) else f"v{a}[{i + 1}]"
            names.append(f"o{number}{a}")
            yield f"variable        {names[-1]} equal {formula}"
    row = " ".join(f"${{{name}}}" for name in names)
    stride = ask.goal.stride(step(ask))
    title = f'title "# {_title(ask)}"'
    yield f'fix history all print {stride} "{row}" file {history} screen no {title}'


def _title(ask: Ask) -> str:
    """The names of a row's columns."""
    columns = [f"{type(seen).__name__.lower()} {seen.body} ({AXES})" for seen, _ in watched(ask)]
    return ", ".join(["step", "spheres", *columns])
