"""Translates prescribed sinusoidal motion for LIGGGHTS: forces on shaken bodies, moving meshes."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from adapters.liggghts.sections import Deck
from adapters.liggghts.setup import Setup
from adapters.liggghts.words import AXES, group
from vv.scene import Harmonic, Pulse

ON_TIME = 1e-6  # relative to a step: a time that is later by less belongs to the step


def shaken(deck: Deck, setup: Setup) -> Deck:
    """A body acceleration as the force mass a(t) [N] on each group of like masses."""
    commands: list[str] = []
    for number, ((mass,), those) in enumerate(setup.shaken.items()):
        name = f"shake{number}"
        commands.append(group(name, those))
        if setup.scene.wave is not None:
            commands += _force(name, setup.scene.wave, mass, setup.ask.dt, _acts(setup))
    note = "body accelerations by fix addforce at the time of the positions"
    return deck.with_more(forces=commands, notes=[note])


def _acts(setup: Setup) -> str:
    """A factor that is 0 after the end of a pulse; none for shaking without an end."""
    pulse = setup.scene.shaking
    if not isinstance(pulse, Pulse):
        return ""
    return f"*(step<{math.ceil(pulse.until / setup.ask.dt - ON_TIME)})"


def _force(name: str, shaking: Harmonic, mass: float, dt: float, acts: str) -> Iterator[str]:
    """The commands for the force mass a(t) [N] on the group `name`, at the time of positions."""
    yield from _variables(f"{name}_sine" if acts else name, shaking, mass, "sin", f"step*{dt!r}")
    if acts:
        for axis in AXES:
            yield f"variable {name}_{axis} equal v_{name}_sine_{axis}{acts}"
    forces = " ".join(f"v_{name}_{axis}" for axis in AXES)
    yield f"fix {name} {name} addforce {forces}"


def moving_walls(deck: Deck, setup: Setup) -> Deck:
    """Walls with prescribed motion, as meshes that move from step 0 on."""
    commands: list[str] = []
    for number, wall in enumerate(setup.scene.walls):
        if wall.motion is not None:
            commands += _move(f"wall{number}", wall.motion, setup.ask.dt)
    note = "meshes moved by fix move/mesh, with each step's mean velocity"
    return deck.with_more(moves=commands, notes=[note])


def _move(name: str, motion: Harmonic, dt: float) -> Iterator[str]:
    """The commands that move a wall's mesh, from step 0 on.

    LIGGGHTS moves a mesh by v dt in a step, with v from variables evaluated at the step's end. They
    give the mean velocity of the step that ends then, (u(t) - u(t - dt))/dt, so that the mesh has
    the exact position after each step, to rounding.
    """
    # A (sin b - sin a) = 2 A sin((b - a)/2) cos((a + b)/2)
    yield from _variables(f"{name}_v", motion, 1.0, "cos", f"(step-0.5)*{dt!r}", dt)
    speeds = " ".join(f"v_{name}_v_{axis}" for axis in AXES)
    yield f"fix {name}_move all move/mesh mesh {name}_mesh linear/variable {speeds}"


def _variables(
    name: str, motion: Harmonic, factor: float, function: str, time: str, dt: float | None = None
) -> Iterator[str]:
    """Variables name_x, name_y, name_z: factor times a sum of sines, or of means over a step."""
    parts: dict[str, list[str]] = {axis: [] for axis in AXES}
    for along, f, phase in motion.sines():
        scale = factor if dt is None else 2 * float(np.sin(np.pi * f * dt)) / dt
        for axis, size in zip(AXES, (scale * along).tolist(), strict=True):
            if size:
                parts[axis].append(f"({size!r})*{function}(2*PI*{f!r}*{time}+({phase!r}))")
    for axis, sines in parts.items():
        yield f"variable {name}_{axis} equal {'+'.join(sines) or '0'}"
