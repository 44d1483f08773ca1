"""Bonds in YADE: contacts that carry tension, created before the first step with their springs."""

from typing import Any

from adapters.yade.inside.session import O, utils, yd


def bonded_contacts() -> list[Any]:
    """Engines that detect contacts of spheres, with normal and shear forces of linear springs.

    Contacts other than bonds are created without cohesion, with the springs of `cohesive`.
    """
    touch = yd.Ig2_Sphere_Sphere_ScGeom6D(avoidGranularRatcheting=False)
    spring = yd.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys()
    law = yd.Law2_ScGeom6D_CohFrictPhys_CohesionMoment(useIncrementalForm=True)
    return [
        yd.InsertionSortCollider([yd.Bo1_Sphere_Aabb()]),
        yd.InteractionLoop([touch], [spring], [law]),
    ]


def tie(ask: dict[str, Any]) -> None:
    """Bond the spheres; bodies and engines must exist already."""
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
    """The material for a radius: two such spheres in series have the springs of the contact law."""
    made = yd.CohFrictMat(momentRotationLaw=False, isCohesive=True)
    made.young, made.poisson = ask["kn"] / radius, ask["ks"] / ask["kn"]
    made.frictionAngle = O.materials[0].frictionAngle
    return made
