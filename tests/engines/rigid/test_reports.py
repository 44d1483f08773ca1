"""Claims about energy in `rigid`, which residuals bound, and about what else a run reports."""

from __future__ import annotations

import numpy as np
import pytest

from tests.scenes.blocks.block_scenes import DOWN, FLOOR, HELD, box
from vv.ask import Ask, Displacement, History, Knobs, Ledger
from vv.engines import rigid
from vv.engines.rigid import PreparedRigidBlocks
from vv.engines.rigid.limits import CONVERGED
from vv.engines.rigid.point.model import Point
from vv.engines.rigid.scales import scales
from vv.engines.rigid.solve import LEDGER
from vv.gate.judgement import breaches
from vv.plan.project import find
from vv.scene import Contact, Scene

WEDGE = find().load_case("wedge")
DT, OUTPUT = 1e-3, 0.02  # s


def ledger(variant: str, knobs: Knobs, **given: float) -> Ledger:
    """The ledger of a wedge in a groove."""
    trial = WEDGE.declare(variant, {**WEDGE.defaults(variant), **given})
    found = rigid.solve(trial.study.ask(knobs)).ledger
    assert found is not None
    return found


@pytest.mark.parametrize("variant", ["xi-1", "xi-0.1", "xi-1e-06"])
@pytest.mark.parametrize("dt", [1e-2, 5e-3])
@pytest.mark.parametrize("g", [9.81, 3.3])
def test_what_rests_breaks_no_law(variant: str, dt: float, g: float) -> None:
    found = ledger(variant, Knobs(dt), dip=0.0, g=g)
    assert not [*breaches(found)]


def test_what_a_residual_gives_is_beside_the_energy_of_what_moves() -> None:
    found = ledger("xi-1", Knobs(1e-2))
    assert found.bound is not None
    assert found.bound <= 1e-11 * np.abs(list(found.terms.values())).max()


@pytest.mark.parametrize("g", [9.81, 0.981])
def test_energies_close_to_rounding_whatever_contacts_leave(g: float) -> None:
    found = ledger("xi-1e-06", Knobs(1e-2), g=g)
    seen, allowed = found.audits["energy beyond rounding [J]"]
    assert found.bound is not None
    assert seen <= allowed < 1e-3 * found.bound


def solved(*boxes: str) -> PreparedRigidBlocks:
    """Boxes side by side on a floor, which cannot rotate."""
    bodies = [
        box(name, [3.0 * k, 0.0, 0.5], [0.5] * 3, free_spin=HELD) for k, name in enumerate(boxes)
    ]
    scene = Scene((FLOOR, *bodies), Contact(np.inf, mu=0.5), gravity=DOWN)
    program = rigid.prepare(Ask(scene, History(0.1, OUTPUT), (Displacement(1),), Knobs(DT)))
    program.solve()
    return program


def test_what_residuals_leave_is_force_times_residual_over_time() -> None:
    program = solved("one")
    (force,) = np.linalg.norm(program.reactions, axis=2).max(axis=0)
    program.report[:, 0] = 0.0
    program.report[2:4, 0] = 3e-6, 1e-6
    assert program._left_by_contacts() == pytest.approx(force * 4e-6 * OUTPUT)
    assert solved("one", "other")._left_by_contacts() == 0.0


def test_friction_and_blows_that_give_energy_back_create_it() -> None:
    """Together they fall by 1 J twice; friction alone falls by 2 J, but blows take half of that."""
    program = solved("one")
    assert isinstance(program.system, Point)
    friction, blows = (LEDGER.index(f"{name} dissipation") for name in ("friction", "impact"))
    terms = np.zeros_like(program.energies)
    terms[:, friction] = [0.0, 5.0, 3.0, 4.0, 4.0, 4.0]
    terms[:, blows] = [0.0, 0.0, 1.0, 1.0, 1.0, 0.0]
    terms[:, 0] = 10.0 - terms[:, friction]
    program.report[:, 0] = 2e-6
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(PreparedRigidBlocks, "energies", property(lambda _: terms))
        ledger = program._ledger()
    rounding = 64 * 2.0**-52 * 101 * 11.0  # of as many rows as steps and one, of 11 J at most
    assert ledger.audits["energy created [J]"] == pytest.approx((2.0, rounding))
    mass, kinetic = program.ask.scene.blocks[0].mass, 10.0  # J, at most
    moved = (2 * mass * kinetic) ** 0.5 * program.report[:, 0].sum()
    assert ledger.audits["energy beyond rounding [J]"] == pytest.approx((1.0, rounding + moved))
    residual = ledger.audits["residual of contact [m/s]"]
    assert residual == pytest.approx((2e-6, CONVERGED * scales(program.ask.scene).speed))
    assert ledger.unaccounted == pytest.approx(1.0)
    assert ledger.peak == pytest.approx(10.0)
    left = program._left_by_contacts()
    assert ledger.bound == pytest.approx(rounding + left)
    program.report[:, 0] = 0.0
    assert "energy beyond rounding [J]" not in program._ledger().audits


def test_the_worst_step_is_that_of_all_rows_and_divisions_are_counted() -> None:
    program = solved("one")
    program.report[:] = 0.0
    program.report[1] = 3e-6, 7.0, 2e-3, 2.0
    program.report[3] = 1e-6, 9.0, 1e-3, 3.0
    said = program._worst(len(program.report))
    assert said.startswith("worst step: residual 3e-06 m/s after 9 sweeps, penetration 0.002 m; 5 ")
    assert program._worst(2).endswith("2 divisions of steps at landings and ends of slip")


def test_a_divergence_is_told_by_the_steps_until_its_row() -> None:
    run = solved("one").run(3)
    assert (run.steps, run.reason) == (60, "by step 60: the state is not finite")
    assert len(run.times) == 3
    assert solved("one").run(6).steps == 100
