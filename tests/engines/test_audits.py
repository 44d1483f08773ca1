"""Claims about audits of solvers: each law is broken once, in the arrays that the kernel filled."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scenes.blocks.sliding_blocks import Frame, incline
from tests.scenes.spheres.bonded_scenes import elements, tied, unit
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import rigid
from vv.engines.blocks.checks import size
from vv.engines.dda import DEFAULT
from vv.engines.dda.solve import PreparedBlocks
from vv.engines.dda.solve import prepare as prepare_dda
from vv.engines.dem.critical_step import critical_step
from vv.engines.dem.leapfrog import CENTRED, LAGGED, Leapfrog
from vv.engines.dem.solve import GAINED
from vv.engines.dem.solve import _audits as audits_of_dem
from vv.engines.dem.solve import prepare as prepare_dem
from vv.gate.judgement import breaches
from vv.scene import Contact, Scene, Spheres, Wall

ASK = Ask(incline(Frame(20.0), 15.0), History(0.05, 0.01), (Displacement(1),), Knobs(1e-3, 1e8))
DDA = ("energy created [J]", "Coulomb: friction beyond mu N [N]",
       "error of the momentum balance [N]", "penetration [m]")  # fmt: skip


def dda(created: float, excess: float, adrift: float, deepest: float) -> list[str]:
    """The laws that a block on a slope breaks where its kernel reported this of 1 J and 1000 N."""
    program: PreparedBlocks = prepare_dda(ASK, DEFAULT)
    report = np.array([0.0, 0.0, deepest, 0.0, 0.0, 0.0, excess, adrift, 1000.0])
    audits = dict(program._audits(report, created, 1e-9))
    return [law for law, (seen, allowed) in audits.items() if not seen <= allowed]


@pytest.mark.parametrize("law", range(4))
def test_each_law_of_dda_is_broken_by_what_its_kernel_reports_of_it_alone(law: int) -> None:
    allowed = np.array([1e-9, 1e-6, 1e-5, 0.01 * size(ASK.scene.blocks[0])])
    just = 0.99 * allowed
    assert dda(*just) == []
    for beyond in (1.01 * allowed[law], np.nan):
        just[law] = beyond
        assert dda(*just) == [DDA[law]]


def test_rigid_breaks_a_law_by_one_step_that_did_not_converge_or_gained() -> None:
    found = []
    for spoil in ("nothing", "residual", "energy"):
        program = rigid.prepare(ASK)
        program.solve()
        if spoil == "residual":
            program.report[2, 0] = 1e-3
        if spoil == "energy":
            program.arguments[1][3, 1:3] -= 1.0
        found.append([law for law, *_ in breaches(program._ledger())])
    assert found[0] == []
    assert found[1] == ["residual of contact [m/s]"]
    assert "energy created [J]" in found[2]


@pytest.mark.parametrize(
    ("leapfrog", "part"), [(CENTRED, 0.01), (LAGGED, 0.1)], ids=["second", "first"]
)
def test_dem_may_gain_what_the_order_of_its_step_lets_bonds_gain(
    leapfrog: Leapfrog, part: float
) -> None:
    """At a tenth of the critical step a known part of the stored energy, which was 2 J at t = 0."""
    scene = unit(elements(), tied())
    limit = critical_step(scene, leapfrog)
    ask = Ask(scene, History(limit, limit / 10), (Displacement(0),), Knobs(limit / 10))
    program = prepare_dem(ask, leapfrog)
    path, energy = program.arguments[:2]
    energy[:], energy[:, 1] = 0.0, 2.0
    allowed = 2.0 * part / (1.0 - part)  # of the 2 J and what is gained
    laws = []
    for gained in (0.99 * allowed, 1.01 * allowed):
        energy[-1, 1] = 2.0 + gained
        ledger = program._ledger(path, energy)
        laws.append([law for law, *_ in breaches(ledger)])
    assert laws == [[], [GAINED]]


@pytest.mark.parametrize(
    ("push", "drag", "laws"),
    [
        (100.0, 50.0, []),  # N on springs of 1e4 and 5e3 N/m, at a friction of 0.5
        (100.0, 50.1, ["Coulomb: friction beyond mu N [N]"]),
        (0.0, 0.1, ["Coulomb: friction beyond mu N [N]"]),
        (101.0, 0.0, ["penetration [m]"]),  # a tenth of the radius is 0.01 m
    ],
)
def test_dem_reads_friction_and_depth_from_the_energies_of_its_springs(
    push: float, drag: float, laws: list[str]
) -> None:
    one = Spheres(np.zeros((1, 3)), np.zeros((1, 3)), np.array([0.1]), np.ones(1),
                  np.ones((1, 3), bool))  # fmt: skip
    floor = Wall(np.array([0.0, 0.0, -0.1]), np.array([0.0, 0.0, 1.0]))
    scene = Scene((floor, one), Contact(1e4, 5e3, 0.5))
    terms = np.array([[0.0, 0.0, 0.0], [1.0, push**2 / 2e4 * (1 - 1e-12), drag**2 / 1e4]])
    seen = dict(audits_of_dem(scene, terms))
    assert [law for law, (most, allowed) in seen.items() if not most <= allowed] == laws
