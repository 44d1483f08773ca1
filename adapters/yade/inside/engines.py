"""Assembles the engines of a YADE step: contacts, drag and motion, as the scene needs them."""

import math
from typing import Any

from adapters.yade.inside.bonds import bonded_contacts
from adapters.yade.inside.session import yd


def engines(ask: dict[str, Any], kinds: set[str]) -> list[Any]:
    """The engines of a YADE step: contacts, drag and motion, as the scene needs them."""
    return [
        yd.ForceResetter(),
        *pulse_end(ask),
        *touching(ask, sorted(kinds)),
        *drag(ask),
        *shaking(ask),
        *motion(ask),
        yd.NewtonIntegrator(damping=0, gravity=ask["gravity"]),
    ]


def touching(ask: dict[str, Any], kinds: list[str]) -> list[Any]:
    """Engines that detect contacts and bonds, and compute their forces."""
    if ask["bonds"]:
        return bonded_contacts()
    return overlaps() if ask["volumes"] else contacts(ask, kinds)


def contacts(ask: dict[str, Any], kinds: list[str]) -> list[Any]:
    """Engines that detect contacts of spheres, with normal and shear forces of linear springs."""
    bounds = {"sphere": yd.Bo1_Sphere_Aabb, "wall": yd.Bo1_Wall_Aabb, "facet": yd.Bo1_Facet_Aabb}
    geometry = {
        "sphere": lambda: yd.Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False),
        "wall": lambda: yd.Ig2_Wall_Sphere_ScGeom(noRatch=False),
        "facet": yd.Ig2_Facet_Sphere_ScGeom,
    }
    physics, law = law_of(ask)
    return [
        yd.InsertionSortCollider([bounds[kind]() for kind in kinds]),
        yd.InteractionLoop([geometry[kind]() for kind in kinds], [physics], [law]),
    ]


def law_of(ask: dict[str, Any]) -> tuple[Any, Any]:
    """The functors that give contacts their stiffness and their force law."""
    if ask["hertz"]:
        parts = {name: yd.MatchMaker(algo="val", val=share) for name, share in damped(ask)}
        physics = yd.Ip2_FrictMat_FrictMat_MindlinPhys(**parts)
        return physics, yd.Law2_ScGeom_MindlinPhys_Mindlin(preventGranularRatcheting=False)
    return viscous() if ask["eta_n"] else elastic(ask)


def damped(ask: dict[str, Any]) -> list[tuple[str, float]]:
    """The fractions of critical damping of elastic contact along and across the normal, if any."""
    share = ask["hertz"].get("damping", 0.0)
    return [("betan", share), ("betas", 0.0)] if share else []


def elastic(ask: dict[str, Any]) -> tuple[Any, Any]:
    """Linear springs of the given stiffnesses, and Coulomb friction."""
    physics = yd.Ip2_FrictMat_FrictMat_FrictPhys(
        kn=yd.MatchMaker(algo="val", val=ask["kn"]), ks=yd.MatchMaker(algo="val", val=ask["ks"])
    )
    return physics, yd.Law2_ScGeom_FrictPhys_CundallStrack()


def viscous() -> tuple[Any, Any]:
    """A spring and a dashpot along the normal, with the constants of the material.

    The normal force never pulls, and all of it counts in the limit of friction.
    """
    return yd.Ip2_ViscElMat_ViscElMat_ViscElPhys(), yd.Law2_ScGeom_ViscElPhys_Basic()


def overlaps() -> list[Any]:
    """Engines that detect overlaps of polyhedra and walls; forces follow from the volumes."""
    return [
        yd.InsertionSortCollider([yd.Bo1_Polyhedra_Aabb(), yd.Bo1_Wall_Aabb()], verletDist=0.05),
        yd.InteractionLoop(
            [yd.Ig2_Wall_Polyhedra_PolyhedraGeom()],
            [yd.Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
            [yd.Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()],
        ),
    ]


def drag(ask: dict[str, Any]) -> list[Any]:
    """Stokes' drag 6 pi nu R v = drag v, with an engine for each radius of the moving spheres."""
    return [
        yd.LinearDragEngine(nu=ask["drag"] / (6 * math.pi * radius), ids=ids)
        for radius, ids in moving(ask, "radius").items()
        if ask["drag"]
    ]


def shaking(ask: dict[str, Any]) -> list[Any]:
    """The force m A sin(2 pi f t + fi) at the time of the positions; one engine for each sine."""
    return [
        yd.HarmonicForceEngine(
            A=[mass * part for part in sine["A"]], f=[sine["f"]] * 3, fi=[sine["fi"]] * 3, ids=ids
        )
        for sine in ask["shaking"]
        for mass, ids in moving(ask, "shaken").items()
    ]


def pulse_end(ask: dict[str, Any]) -> list[Any]:
    """The engine that switches the sines off before the first step after the pulse."""
    if ask["ends"] is None:
        return []
    sines = "(e for e in O.engines if isinstance(e, yd.HarmonicForceEngine))"
    off = f"for e in {sines}: e.dead = True"
    return [yd.PyRunner(command=off, iterPeriod=1, firstIterRun=ask["ends"], nDo=1)]


def moving(ask: dict[str, Any], name: str) -> dict[float, list[int]]:
    """The numbers of spheres that may move or have a steady velocity, grouped by a property."""
    alike: dict[float, list[int]] = {}
    for body in ask["bodies"]:
        held = set("xyz") <= set(body.get("blocked", "xyz")) and not any(body.get("carried", ()))
        if "mass" in body and not held:
            alike.setdefault(body[name], []).append(body["id"])
    return alike


def motion(ask: dict[str, Any]) -> list[Any]:
    """The engine that sets the velocities of moving walls for the next step."""
    engines = []
    for body in ask["bodies"]:
        sines = [
            yd.HarmonicMotionEngine(A=sine["A"], f=[sine["f"]] * 3, fi=[sine["fi"]] * 3)
            for sine in body.get("motion", ())
        ]
        if sines:
            engines.append(yd.CombinedKinematicEngine(comb=sines, ids=[body["id"]]))
    return engines
