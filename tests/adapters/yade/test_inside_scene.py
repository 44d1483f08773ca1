"""Claims about scenes as the program inside YADE builds them, by hand."""

from __future__ import annotations

import math
from typing import Any

import pytest

from tests.support.adapters.inside_yade import OMEGA, UTILS, asked, part, sphere, wall


def test_drag_and_shaking_are_engines_of_like_spheres_that_move(driver: Any) -> None:
    fixed = sphere(blocked="xyzXYZ", radius=0.75)
    bodies = [
        wall(), sphere(), sphere(radius=0.25, shaken=3.0), fixed,
        sphere(blocked="xyz", carried=[1.0, 0.0, 0.0], radius=0.25),
    ]  # fmt: skip
    sine = {"A": [1.0, 0.0, 2.0], "f": 3.0, "fi": 0.5}
    driver.build(asked(*bodies, drag=6.0, shaking=[sine], ends=7))
    found = {one.kind: [e for e in OMEGA.engines if e.kind == one.kind] for one in OMEGA.engines}
    drags = [(one.nu, one.ids) for one in found["LinearDragEngine"]]
    assert drags == [(pytest.approx(2 / math.pi), [1]), (pytest.approx(4 / math.pi), [2, 4])]
    shakes = [(one.A, one.f, one.fi, one.ids) for one in found["HarmonicForceEngine"]]
    assert shakes == [
        ([1.8, 0.0, 3.6], [3.0] * 3, [0.5] * 3, [1, 4]),
        ([3.0, 0.0, 6.0], [3.0] * 3, [0.5] * 3, [2]),
    ]
    (runner,) = found["PyRunner"]
    assert (runner.firstIterRun, runner.iterPeriod, runner.nDo) == (7, 1, 1)
    newton = OMEGA.engines[-1]
    assert (newton.kind, newton.damping, newton.gravity) == (
        "NewtonIntegrator",
        0,
        [1.0, 0.0, -5.0],
    )
    driver.build(asked(*bodies))
    assert {one.kind for one in OMEGA.engines} == {
        "ForceResetter", "InsertionSortCollider", "InteractionLoop", "NewtonIntegrator"
    }  # fmt: skip


def test_a_moving_wall_has_its_sines_and_an_oblique_one_its_place(driver: Any) -> None:
    sine = {"A": [0.1, 0.0, 0.2], "f": 3.0, "fi": 0.5}
    down = wall(normal=[0.0, -1.0, 0.0], motion=[sine])
    facet = {"kind": "facet", "corners": [[1.0] * 3] * 3, "point": [1.0, 2.0, 3.0],
             "normal": [0.6, 0.0, 0.8]}  # fmt: skip
    driver.build(asked(wall(), down, facet, sphere()))
    (engine,) = [one for one in OMEGA.engines if one.kind == "CombinedKinematicEngine"]
    assert engine.ids == [1]
    (harmonic,) = engine.comb
    assert (harmonic.A, harmonic.f, harmonic.fi) == ([0.1, 0.0, 0.2], [3.0] * 3, [0.5] * 3)
    assert [(one.axis, one.sense) for one in OMEGA.bodies[:2]] == [(2, 1), (1, -1)]
    assert (OMEGA.bodies[2].material, OMEGA.bodies[2].state.pos) == (0, [1.0, 2.0, 3.0])
    young = {"young": 1e9, "walls_young": 2e9, "facets_young": 3e9, "poisson": 0.25}
    driver.build(asked(facet, sphere(), hertz=young))
    assert OMEGA.bodies[0].material == 1
    assert [one.young for one in OMEGA.materials[0]] == [2e9, 3e9]
    assert (OMEGA.materials[1].young, OMEGA.materials[1].poisson) == (1e9, 0.25)
    assert OMEGA.materials[1].frictionAngle == pytest.approx(math.atan(0.5))


@pytest.mark.parametrize(
    ("changes", "physics", "law"),
    [
        ({}, "Ip2_FrictMat_FrictMat_FrictPhys", "Law2_ScGeom_FrictPhys_CundallStrack"),
        ({"eta_n": 7.0}, "Ip2_ViscElMat_ViscElMat_ViscElPhys", "Law2_ScGeom_ViscElPhys_Basic"),
        (
            {"hertz": dict.fromkeys(("young", "walls_young", "facets_young", "poisson"), 0.25)},
            "Ip2_FrictMat_FrictMat_MindlinPhys", "Law2_ScGeom_MindlinPhys_Mindlin",
        ),
        ({"volumes": True}, "Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys",
         "Law2_PolyhedraGeom_PolyhedraPhys_Volumetric"),
    ],
)  # fmt: skip
def test_each_law_of_contact_has_its_parts_and_its_stuff(
    driver: Any, changes: dict[str, Any], physics: str, law: str
) -> None:
    driver.build(asked(wall(), sphere(), **changes))
    (loop,) = [one for one in OMEGA.engines if one.kind == "InteractionLoop"]
    _, (made_of,), (acts,) = loop.given
    assert (made_of.kind, acts.kind) == (physics, law)
    material = OMEGA.materials[-1]
    if not changes:
        assert (made_of.kn.val, made_of.ks.val) == (3e6, 1.5e6)
        assert material.frictionAngle == pytest.approx(math.atan(0.5))
    if "eta_n" in changes:
        assert (material.kn, material.ks, material.cn, material.cs) == (6e6, 3e6, 14.0, 0)
    if "volumes" in changes:
        assert (material.young, material.poisson) == (6e6, 0.5)


@pytest.mark.shows("Elastic spheres with losses (Tsuji) follow the same law in YADE")
def test_elastic_contact_is_damped_along_its_normal_only(driver: Any) -> None:
    engines = part(driver, "engines")
    young = dict.fromkeys(("young", "walls_young", "facets_young", "poisson"), 0.25)
    physics, _ = engines.law_of(asked(hertz=young | {"damping": 0.3}))
    assert (physics.betan.val, physics.betas.val) == (0.3, 0.0)
    assert not hasattr(engines.law_of(asked(hertz=young))[0], "betan")


def test_contacts_are_charged_where_a_foot_is_pressed(driver: Any) -> None:
    held = {"wall": 0, "body": 1, "forces": [[0.0, 2.0, 0.0]]}
    driver.build(asked(wall(), sphere(), charged=[held]))
    ((first, second, phys),) = UTILS.interactions
    assert (first, second, phys.shearForce) == (0, 1, [0.0, 2.0, 0.0])
    UTILS.interactions.clear()
    foot = {"position": [0.0] * 3, "radius": 0.125, "density": 5.0}
    point = {"position": [1.0] * 3, "radius": 0.25, "density": 6.0}
    clump = sphere(kind="clump", touching=[foot] * 2, points=[point], inertia=[1.0, 2.0, 3.0])
    held = {"wall": 0, "body": 1, "forces": [[0.0] * 3, [1.0, 0.0, 0.0]]}
    driver.build(asked(wall(), clump, charged=[held]))
    ((first, second, phys),) = UTILS.interactions
    assert (first, second, phys.shearForce) == (0, 2, [1.0, 0.0, 0.0])
    assert [(b.radius, b.material.density, b.mask) for b in OMEGA.bodies[1:4]] == [
        (0.125, 5.0, 1), (0.125, 5.0, 1), (0.25, 6.0, 0)
    ]  # fmt: skip
    state = OMEGA.bodies[4].state
    assert (state.mass, state.inertia, state.blockedDOFs) == (2.0, [1.0, 2.0, 3.0], "yXYZ")
    assert part(driver, "stepping").unknowns() == 6 + 2  # of a wall, and of the clump


def test_bonds_have_their_springs_and_spheres_those_of_contacts(driver: Any) -> None:
    bond = {"pair": [1, 0], "kn": 5.0, "ks": 6.0, "overlap": 0.1, "tension": 7.0, "shear": 8.0}
    driver.build(asked(sphere(), sphere(radius=0.25), bonds=[bond], kn=4.0, ks=2.0))
    ((first, second, phys),) = UTILS.interactions
    assert (first, second) == (1, 0)
    assert vars(phys) == {
        "kn": 5.0, "ks": 6.0, "unp": 0.1, "fragile": True, "cohesionBroken": False,
        "normalAdhesion": 7.0, "shearAdhesion": 8.0,
    }  # fmt: skip
    assert [(one.material.young, one.material.poisson) for one in OMEGA.bodies] == [
        (8.0, 0.5),
        (16.0, 0.5),
    ]
    alike = asked(sphere(), sphere(), bonds=[bond])
    driver.build(alike)
    assert OMEGA.bodies[0].material is OMEGA.bodies[1].material
