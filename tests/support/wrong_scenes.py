"""Scenes with one mistake each: what a code that makes a known mistake solves."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from vv.codes.tiny_scenes import friction
from vv.codes.tiny_scenes.flights import FLUID
from vv.codes.tiny_scenes.tiny_scene import MASS, RADIUS
from vv.scene import Bonds, Fluid, Harmonic, Hertz, Pulse, Scene, Wall

LOOSE, STRONG = 1e-9, 1e9  # times, which stand for nil and for no limit
Change = Callable[[Scene], Scene]


def contact(**times: float) -> Change:
    """Constants of the contact law multiplied."""

    def change(scene: Scene) -> Scene:
        law = scene.contact
        own = {name: getattr(law, name) * by for name, by in times.items()}
        return dataclasses.replace(scene, contact=dataclasses.replace(law, **own))

    return change


def elastic(modulus: float = 1.0, damping: float = 1.0) -> Change:
    """Constants of a contact of elastic spheres multiplied."""

    def change(scene: Scene) -> Scene:
        own = scene.contact.hertz
        assert own is not None
        law = Hertz(own.modulus * modulus, damping=own.damping * damping)
        return dataclasses.replace(scene, contact=dataclasses.replace(scene.contact, hertz=law))

    return change


def bond(**times: float) -> Change:
    """Constants of bonds multiplied."""

    def change(scene: Scene) -> Scene:
        one = scene.bonds
        assert isinstance(one, Bonds)
        own = {name: getattr(one, name) * by for name, by in times.items()}
        return dataclasses.replace(scene, bonds=dataclasses.replace(one, **own))

    return change


def put(**given: Any) -> Change:
    """Another value of a scene, or what a function makes of its own."""

    def change(scene: Scene) -> Scene:
        made = {
            name: value(getattr(scene, name)) if callable(value) else value
            for name, value in given.items()
        }
        return dataclasses.replace(scene, **made)

    return change


def body(**given: Any) -> Change:
    """Another value of the last body, or what a function makes of its own."""

    def change(scene: Scene) -> Scene:
        last = scene.bodies[-1]
        made = {
            name: value(getattr(last, name)) if callable(value) else value
            for name, value in given.items()
        }
        return dataclasses.replace(
            scene, bodies=(*scene.bodies[:-1], dataclasses.replace(last, **made))
        )

    return change


def wall(motion: Harmonic | None) -> Change:
    """Another motion of the wall."""

    def change(scene: Scene) -> Scene:
        first = scene.bodies[0]
        assert isinstance(first, Wall)
        return dataclasses.replace(
            scene, bodies=(dataclasses.replace(first, motion=motion), *scene.bodies[1:])
        )

    return change


def far_walls(scene: Scene) -> Scene:
    """Walls that nothing reaches."""
    bodies = tuple(
        dataclasses.replace(one, point=one.point - 9.0 * one.normal)
        if isinstance(one, Wall)
        else one
        for one in scene.bodies
    )
    return dataclasses.replace(scene, bodies=bodies)


def wave(**given: Any) -> Change:
    """Other values of the shaking."""

    def change(scene: Scene) -> Scene:
        assert isinstance(scene.shaking, Harmonic)
        return dataclasses.replace(scene, shaking=dataclasses.replace(scene.shaking, **given))

    return change


def times(factor: float) -> Callable[[Any], Any]:
    return lambda value: factor * value


def endless(shaking: Any) -> Any:
    assert isinstance(shaking, Pulse)
    return shaking.wave


ALL_FREE = np.ones((1, 3), bool)
GRAVITY = {
    "gravity is left out": put(gravity=times(0.0)),
    "gravity is reversed": put(gravity=times(-1.0)),
    "gravity is taken twice": put(gravity=times(2.0)),
}
LOAD = {
    "the load is left out": body(load=times(0.0)),
    "the load is reversed": body(load=times(-1.0)),
}
SPRING = {
    "contact is left out": contact(kn=LOOSE),
    "contact is twice as stiff": contact(kn=2.0),
    "contact is half as stiff": contact(kn=0.5),
    "contact has another mass, such as that of a radius and a density": body(
        mass=np.array([4 / 3 * np.pi * RADIUS**3])
    ),
}
FRICTION = {
    "friction is left out": contact(mu=0.0),
    "friction is half as strong": contact(mu=0.5),
}
WRONG: dict[str, dict[str, Change]] = {
    "free flight": {
        **GRAVITY,
        "gravity is a force, not an acceleration": put(gravity=times(1 / MASS)),
    },
    "dead load": {
        **LOAD,
        "the load is taken twice": body(load=times(2.0)),
        "the load is an acceleration, not a force": body(load=times(MASS)),
    },
    "bounce": SPRING,
    "collision": SPRING,
    "lock": {"the lock is not kept": body(free=ALL_FREE)},
    "oblique lock": {"the lock is not kept": body(free=ALL_FREE)},
    "carried": {"locked directions stand still": body(velocity=lambda v: v * [0.0, 1.0, 0.0])},
    "drag": {
        "drag is left out": put(eta=0.0),
        "drag is twice as strong": put(eta=times(2.0)),
        "drag is half as strong": put(eta=times(0.5)),
        "drag is a rate, not divided by the mass": put(eta=times(MASS)),
    },
    "fluid": {
        "the fluid is left out": put(fluid=None),
        "drag grows as the speed alone": put(fluid=None, eta=6 * np.pi * FLUID.viscosity * RADIUS),
        # the same Reynolds number, at which all of the drag is as the viscosity
        "drag of the fluid is twice as strong": put(
            fluid=Fluid(2 * FLUID.density, 2 * FLUID.viscosity)
        ),
        "drag of the fluid is half as strong": put(
            fluid=Fluid(FLUID.density / 2, FLUID.viscosity / 2)
        ),
    },
    "shaking": {
        "shaking is left out": put(shaking=None),
        "shaking is reversed": lambda scene: wave(amplitude=-scene.shaking.amplitude)(scene),  # type: ignore[union-attr]
        "the phase of shaking is left out": wave(phase=np.zeros(3)),
    },
    "pulse": {"the pulse does not end": put(shaking=endless)},
    "moving wall": {"the wall stands still": wall(None)},
    "dashpot": {
        "the dashpot is left out": contact(eta_n=0.0),
        "the dashpot is twice as strong": contact(eta_n=2.0),
        "the dashpot is half as strong": contact(eta_n=0.5),
    },
    "Hertz's contact": {
        "contact is left out": elastic(LOOSE),
        "contact is twice as stiff": elastic(2.0),
        "contact is half as stiff": elastic(0.5),
    },
    "viscous Hertz": {"viscosity is left out": elastic(damping=0.0)},
    "skid": {
        **FRICTION,
        "the shear spring is twice as stiff": contact(ks=2.0),
        "the shear spring is half as stiff": contact(ks=0.5),
        friction.UNLIMITED: contact(mu=2.0),
    },
    "roll": {
        **FRICTION,
        friction.UNLIMITED: contact(mu=2.0),
        "rotation is left out": body(free_spin=~ALL_FREE),
    },
    "viscous skid": {
        "friction is left out": contact(mu=0.0),
        "friction is twice as strong": contact(mu=2.0),
    },
    "bond": {
        "the bond is left out": put(bonds=None),
        "the bond is twice as stiff": bond(kn=2.0),
        "the bond is half as stiff": bond(kn=0.5),
    },
    "shear of a bond": {
        "a bond resists no shear": bond(ks=0.0),
        "a bond is as stiff across as along": bond(ks=1 / 0.4),
        "a bond is twice as stiff across": bond(ks=2.0),
        "a bond is half as stiff across": bond(ks=0.5),
    },
    "breakage": {
        "the bond does not break": bond(tension=STRONG),
        "the bond is left out": put(bonds=None),
    },
    "flight of a block": GRAVITY,
    "dead load on a block": LOAD,
    "slide of a block": {
        "contact is left out": far_walls,
        "friction is left out": contact(mu=0.0),
        "friction is twice as strong": contact(mu=2.0),
        "friction is half as strong": contact(mu=0.5),
    },
}
