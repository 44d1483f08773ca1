"""Bonds in YADE: contacts that hold in tension, made before the first step with their springs."""

from typing import Any

from adapters.yade.inside.session import O, utils, yd


def bonded_contacts() -> list[Any]:
    """Finds contacts of spheres, and presses, pulls and shears them by linear springs.

    Contacts that are no bonds are made without cohesion, by the springs that `cohesive` gives.
    """
    touch = yd.Ig2_Sphere_Sphere_ScGeom6D(avoidGranularRatcheting=False)
    spring = yd.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys()
    law = yd.Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=True)
    return [
        yd.InsertionSortCollider([yd.Bo1_Sphere_Aabb()]),
        yd.InteractionLoop([touch], [spring], [law]),
    ]


def tie(ask: dict[str, Any]) -> None:
    """Bond the spheres, which are there, as are the engines."""
    material = {}
    for body in ask["bodies"]:
        radius = body["radius"]
        if radius not in material:
            material[radius] = cohesive(ask, radius)
            O.materials.append(material[radius])
        O.bodies[body["id"]].material = material[radius]
    for bond in ask["bonds"]:
        first, second = (ask["bodies"][number]["id"] for number in bond["pair"])
        phys = utils.createInteraction(first, second).phys
        phys.kn, phys.ks, phys.unp = bond["kn"], bond["ks"], bond["overlap"]
        phys.fragile, phys.cohesionBroken = True, False
        phys.normalAdhesion, phys.shearAdhesion = bond["tension"], bond["shear"]


def cohesive(ask: dict[str, Any], radius: float) -> Any:
    """The material of spheres of a radius: two in series have the springs of the contact law."""
    made = yd.CohFrictMat(momentRotationLaw=False, isCohesive=True)
    made.young, made.poisson = ask["kn"] / radius, ask["ks"] / ask["kn"]
    made.frictionAngle = O.materials[0].frictionAngle
    return made
