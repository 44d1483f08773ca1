"""A substitute for YADE without contacts: bodies fly freely by leapfrog; calls are recorded."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np


class Thing(SimpleNamespace):
    """An object that YADE was asked to make: its class and its arguments."""

    kind: str
    given: tuple[Any, ...]


def made(kind: str, *given: Any, **named: Any) -> Thing:
    """A substitute object of that class."""
    return Thing(kind=kind, given=given, **named)


class Forces:
    """Permanent forces and torques by body."""

    def __init__(self) -> None:
        self.force: dict[int, Any] = {}
        self.torque: dict[int, Any] = {}
        self.last: dict[int, Any] = {}

    def setPermF(self, body: int, force: Any) -> None:  # noqa: N802
        self.force[body] = np.array(force, float)

    def setPermT(self, body: int, torque: Any) -> None:  # noqa: N802
        self.torque[body] = [*torque]

    def f(self, body: int) -> Any:
        """The force of the last step."""
        return self.last.get(body, np.zeros(3))


class Bodies(list[Any]):
    """Bodies by number."""

    def append(self, body: Any) -> int:  # type: ignore[override]
        super().append(body)
        return len(self) - 1

    def appendClumped(self, members: list[Any]) -> tuple[int, list[int]]:  # noqa: N802
        numbers = [self.append(member) for member in members]
        for member in members:
            member.isClumpMember = True
        return self.append(body("clump")), numbers


def body(kind: str, **named: Any) -> Thing:
    """A body at rest in the origin."""
    state = SimpleNamespace(
        pos=np.zeros(3), vel=np.zeros(3), angVel=np.zeros(3), blockedDOFs="", mass=1.0,
        inertia=(7.0, 8.0, 9.0),
    )  # fmt: skip
    return made(kind, state=state, isClumpMember=False, **named)


class Omega:
    """The scene: v += dt (F/m + g), then x += dt v, along axes that are not blocked."""

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        self.materials: list[Any] = []
        self.bodies, self.forces = Bodies(), Forces()
        self.engines: list[Any] = []
        self.iter, self.dt, self.contacts = 0, 0.0, 0
        self.interactions = SimpleNamespace(countReal=lambda: self.contacts)

    def step(self) -> None:
        gravity, self.forces.last = np.array(self.engines[-1].gravity), {**self.forces.force}
        for number, one in enumerate(self.bodies):
            state = one.state
            loose = np.array([axis not in state.blockedDOFs for axis in "xyz"])
            pull = self.forces.f(number) / state.mass + gravity
            state.vel = np.array(state.vel, float) + self.dt * np.where(loose, pull, 0.0)
            state.pos = np.array(state.pos, float) + self.dt * state.vel
        self.iter += 1


class Utils:
    """The functions that make bodies."""

    def __init__(self) -> None:
        self.interactions: list[tuple[int, int, Any]] = []

    def sphere(self, position: Any, radius: float, **named: Any) -> Thing:
        one = body("sphere", radius=radius, **named)
        one.state.pos = np.array(position, float)
        return one

    def wall(self, point: Any, axis: int, sense: int, material: int) -> Thing:
        one = body("wall", axis=axis, sense=sense, material=material)
        one.state.pos = np.array(point, float)
        return one

    def facet(self, corners: Any, material: int) -> Thing:
        return body("facet", corners=corners, material=material)

    def createInteraction(self, first: int, second: int) -> Any:  # noqa: N802
        contact = SimpleNamespace(phys=SimpleNamespace())
        self.interactions.append((first, second, contact.phys))
        return contact


def modules(omega: Omega, utils: Utils) -> dict[str, Any]:
    """The substitutes for YADE's Python modules."""
    config = SimpleNamespace(version="still")
    return {"yade": {"O": omega, "utils": utils, "config": config, "wrapper": _Wrapper()}}


class _Wrapper:
    def __getattr__(self, name: str) -> Any:
        return _maker(name)


def _maker(name: str) -> Any:
    return lambda *given, **named: made(name, *given, **named)
