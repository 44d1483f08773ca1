"""Writes an ask as a LIGGGHTS deck: text alone, which needs no file besides itself to run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from adapters.liggghts.clumps import rigid_commands
from adapters.liggghts.drives import move_commands, shake_commands
from adapters.liggghts.harmonic import BONDED_STYLE, bond_commands, bonded_atoms
from adapters.liggghts.outputs import count_commands, output_commands
from adapters.liggghts.translate import (
    CLUMP,
    Space,
    charges,
    loads,
    locks,
    moving,
    represented,
    shaken,
    space,
    spinning,
)
from adapters.liggghts.walls import wall_commands
from adapters.liggghts.words import AXES, bounds, group, numbers
from vv.ask import Ask
from vv.scene import Scene, Spheres, Vector

DOMAIN = """\
units           si
atom_style      {style}
atom_modify     map array sort 0 0
boundary        f f f
newton          off
communicate     single vel yes"""


def deck(ask: Ask, scheme: str, history: str) -> str:
    """A deck that solves an ask and writes the file `history`: a row per output after t = 0.

    A row holds the step, the number of spheres that are where they may be, and three numbers
    for each of `watched(ask)`: the displacement [m] or the velocity [m/s].
    """
    observed = [
        "",
        "modify_timing   on",
        *count_commands(ask, scheme),
        *output_commands(ask, scheme, history),
    ]
    return _text([*_prepared(ask, scheme), *observed, _run(ask), "unfix history"])


def silent_deck(ask: Ask, scheme: str, around: Sequence[str] = ()) -> str:
    """The same solve without any output, for timing; around: commands before and after its run."""
    return _text([*_prepared(ask, scheme), *around, _run(ask), *around])


def _text(lines: Iterable[str]) -> str:
    return "\n".join(lines) + "\n"


def _run(ask: Ask) -> str:
    return f"run             {ask.goal.steps(ask.dt)}"


def _prepared(ask: Ask, scheme: str) -> Iterator[str]:
    """Everything up to the first step."""
    scene = represented(ask, scheme)
    room, charged = space(ask, scheme), charges(ask, scheme)
    yield from _domain(scene, room, scheme)
    yield ""
    yield from _spheres(scene, charged)
    yield ""
    yield from _contact(scene)
    yield from wall_commands(scene.walls, room.triangles, _model(scene), _damping(scene))
    yield f"timestep        {ask.dt!r}"
    yield "thermo_style    custom step atoms"
    yield "thermo          0"
    if charged:
        yield ""
        yield from _charging(ask, scene, charged)
    yield ""
    for number, wall in enumerate(scene.walls):
        if wall.motion is not None:
            yield from move_commands(f"wall{number}", wall.motion, ask.dt)
    yield from _motion(ask, scheme, scene)


UNCOUNTED, COUNTED = "charging shear springs", "shear springs are charged"


def _charging(ask: Ask, scene: Scene, charged: Mapping[int, Vector]) -> Iterator[str]:
    """A step in which spheres are slid to where they start, their walls at rest.

    It puts into shear springs what they hold at t = 0, which no command can; then time starts.
    """
    yield f'print "{UNCOUNTED}"'
    for i, way in charged.items():
        yield group(f"slid{i}", [i])
        yield f"fix slid{i} slid{i} move linear {numbers(way / ask.dt)} units box"
    yield "run             1"
    for i in charged:
        yield f"unfix slid{i}"
        yield f"group slid{i} delete"
        yield f"set             atom {i + 1} {_parts('v', scene.spheres.velocity[i])}"
    yield "reset_timestep  0"
    yield f'print "{COUNTED}"'


def _domain(scene: Scene, room: Space, scheme: str) -> Iterator[str]:
    """A box far larger than the scene; neighbours are sought anew when half the skin is used up."""
    radius = float(scene.spheres.radius.max())
    longest = float((room.outer[1] - room.outer[0]).max())
    bonded = scene.bonds is not None
    yield DOMAIN.format(style=BONDED_STYLE if bonded else "granular")
    if bonded:
        yield from bonded_atoms(scene, room.outer)
    else:
        yield f"region          box block {bounds(*room.outer)} units box"
        yield "create_box      1 box"
    yield f"neighbor        {0.2 * radius!r} bin"
    # few bins for so large a box
    yield f"neigh_modify    delay 0 binsize {max(2 * radius, longest / 20)!r}"
    if scheme == CLUMP:
        yield "neigh_modify    exclude group all all"


def _spheres(scene: Scene, charged: Mapping[int, Vector]) -> Iterator[str]:
    """Atoms in body order, so that ids are sphere numbers from 1; masses override densities."""
    spheres = scene.spheres
    for i, position in enumerate(spheres.position if scene.bonds is None else ()):
        yield f"create_atoms    1 single {numbers(position - charged.get(i, 0.0))} units box"
    yield "set             group all density 1"
    for i in range(len(spheres)):
        size, mass = 2 * float(spheres.radius[i]), float(spheres.mass[i])
        yield f"set             atom {i + 1} diameter {size!r} mass {mass!r}"
    for name, rows in (("v", spheres.velocity), ("omega", spheres.spin)):
        for row in np.flatnonzero(rows.any(axis=1)):
            yield f"set             atom {row + 1} {_parts(name, rows[row])}"


def _parts(name: str, vector: Vector) -> str:
    """A vector as `set` takes it."""
    return " ".join(f"{name}{a} {x!r}" for a, x in zip(AXES, vector.tolist(), strict=True))


def _contact(scene: Scene) -> Iterator[str]:
    """kn and ks are the springs themselves [N/m]; only what is viscous is damped."""
    if scene.bonds is not None:
        yield from bond_commands(scene)
        return
    ks, mu = (scene.contact.ks, scene.contact.mu) if scene.contact.carries_shear else (0.0, 0.0)
    damping = "_abs" if scene.contact.eta_n > 0 else ""
    values = {"kn": scene.contact.kn, "kt": ks}
    values |= {f"gamman{damping}": scene.contact.eta_n, f"gammat{damping}": 0.0}
    for name, value in {**values, "coefficientFriction": mu}.items():
        yield f"fix {name} all property/global {name} peratomtypepair 1 {float(value)!r}"
    yield f"pair_style      gran {_model(scene)} {_damping(scene)}"
    yield "pair_coeff      * *"


def _model(scene: Scene) -> str:
    return f"model hooke/stiffness tangential {'history' if scene.contact.carries_shear else 'off'}"


def _damping(scene: Scene) -> str:
    """A viscous contact is given its coefficient [N s/m] itself, and may not pull."""
    viscous = " absolute_damping on limitForce on" if scene.contact.eta_n > 0 else ""
    return f"tangential_damping off{viscous}"


def _motion(ask: Ask, scheme: str, scene: Scene) -> Iterator[str]:
    """Forces in the order in which LIGGGHTS must add them: locks last, to cancel all others."""
    spheres, rigid = scene.spheres, scheme == CLUMP
    yield from () if rigid else _integrated(spheres)
    if scene.eta > 0:
        yield f"fix drag all viscous {float(scene.eta)!r}"
    if scene.gravity.any():
        size = float(np.linalg.norm(scene.gravity))
        yield f"fix weight all gravity {size!r} vector {numbers(scene.gravity / size)}"
    for number, (load, carriers) in enumerate(loads(spheres).items()):
        yield group(f"load{number}", carriers)
        yield f"fix load{number} load{number} addforce {numbers(load)}"
    if scene.shaking is not None:
        for number, (mass, those) in enumerate(shaken(ask, scheme).items()):
            yield group(f"shake{number}", those)
            yield from shake_commands(f"shake{number}", scene.shaking, mass, ask.dt)
    for pattern, held in ({} if rigid else locks(spheres)).items():
        name = "lock_" + "".join(a for a, locked in zip(AXES, pattern, strict=True) if locked)
        yield group(name, held)
        parts = " ".join("0" if locked else "NULL" for locked in pattern)
        yield f"fix {name} {name} setforce {parts}"
    if rigid:  # last, too: its first half step sees the forces of fixes before it only
        yield from rigid_commands(scene, ask.scene.blocks[0])


def _integrated(spheres: Spheres) -> Iterator[str]:
    """What moves the spheres that move."""
    turning = spinning(spheres)
    for name, style, members in (
        ("shifted", "nve", moving(spheres) & ~turning),
        ("turned", "nve/sphere", turning),
    ):
        if members.any():
            yield group(name, np.flatnonzero(members))
            yield f"fix {name} {name} {style}"
