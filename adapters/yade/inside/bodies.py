"""Makes the bodies of a scene in YADE: spheres, clumps of spheres, polyhedra and walls."""

from typing import Any

import numpy as np

from adapters.yade.inside.session import O, utils, yd

FACETS = 1  # the material of spheres, where walls have another


def sphere(body: dict[str, Any]) -> int:
    """Append a sphere with the given mass and inertia instead of those of its volume."""
    made = utils.sphere(body["position"], body["radius"])
    start(made.state, body, [body["inertia"]] * 3)
    return int(O.bodies.append(made))


def clump(body: dict[str, Any]) -> int:
    """Append a rigid body of spheres that touch walls and points that touch nothing."""
    parts = [(part, 1) for part in body["touching"]] + [(part, 0) for part in body["points"]]
    members = []
    for part, mask in parts:
        material = yd.FrictMat(density=part["density"], frictionAngle=O.materials[0].frictionAngle)
        members.append(utils.sphere(part["position"], part["radius"], material=material, mask=mask))
    number, numbers = O.bodies.appendClumped(members)
    body["feet"] = numbers[: len(body["touching"])]
    start(O.bodies[number].state, body, body["inertia"])
    return int(number)


def polyhedron(body: dict[str, Any]) -> int:
    """Append a convex polyhedron with its corners about its centroid."""
    from yade import polyhedra_utils  # a slow import that is rarely needed

    made = polyhedra_utils.polyhedra(O.materials[0], v=body["vertices"])
    made.state.pos = made.state.refPos = body["position"]
    start(made.state, body, made.state.inertia)
    return int(O.bodies.append(made))


def start(state: Any, body: dict[str, Any], inertia: list[float]) -> None:
    """Give a body its mass, its motion and its locks."""
    state.mass, state.inertia = body["mass"], inertia
    state.vel, state.angVel = body["velocity"], body["spin"]
    state.blockedDOFs = body["blocked"]


def wall(body: dict[str, Any]) -> int:
    """Append an infinite wall across an axis, acting on its normal's side."""
    axis = int(np.argmax(np.abs(body["normal"])))
    sense = 1 if body["normal"][axis] > 0 else -1
    return int(O.bodies.append(utils.wall(body["point"], axis, sense=sense, material=0)))


def facet(body: dict[str, Any]) -> int:
    """Append a triangle in the plane of an oblique wall, far larger than the scene.

    It is moved to its place after its creation, so that the rounding of its corners does not move
    the plane.
    """
    made = utils.facet(body["corners"], material=FACETS if len(O.materials) > FACETS else 0)
    made.state.pos = made.state.refPos = body["point"]
    return int(O.bodies.append(made))


TOUCHED = {"clump": "sphere"}  # the collision shape, if it is another


SHAPES = {"sphere": sphere, "clump": clump, "polyhedron": polyhedron, "wall": wall, "facet": facet}


def charge(wall: int, sphere: int, force: list[float]) -> None:
    """Create a contact before the first step, with the tangential force on the sphere.

    The second body of the contact, on which a force is given, is always the sphere.
    """
    contact = utils.createInteraction(wall, sphere)
    contact.phys.shearForce = force
