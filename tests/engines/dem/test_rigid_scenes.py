"""Claims about the DEM engine on rigid scenes: a block on springs, shaken or on a moving wall."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from adapters.dem import ADAPTER, LEAPFROGS, SCHEMES
from reference_solutions.blocks import incline, responding_block
from tests.scenes.blocks.driven_blocks import THREE, UP, G, carried, off, sines, slope
from tests.scenes.small_scenes import FLOOR, ball
from tests.scenes.spheres.dem_contacts import unknowns_passed
from vv.ask import Ask, Displacement, History, Knobs, Method, Run, Status
from vv.codes import Scheme, unsupported
from vv.engines import dem
from vv.engines.dem.pressed.model import Pressed, pressed
from vv.engines.dem.space.model import Space, space
from vv.scene import Contact, Harmonic, Scene, Term, rotated, rotation_about_z
from vv.standins.stand_in import SHEAR

KN = 1e10
DT = 2e-5  # a tenth of the largest stable step at KN
BLOCK = Displacement(1)


def asked(scene: Scene, dt: float = DT, kn: float | None = KN, duration: float = 5.0) -> Ask:
    return Ask(scene, History(duration, 0.02), (BLOCK,), Knobs(dt, kn))


def solved(scene: Scene, dt: float = DT, kn: float = KN, duration: float = 5.0) -> Run:
    run = dem.solve_default(asked(scene, dt, kn, duration))
    assert run.status is Status.RAN, run.reason
    return run


def newmark(phi: float, **knobs: float) -> float:
    scene = slope(20.0, phi, sines((5.0, 1.0)))
    run = solved(scene, **knobs)
    exact = incline.newmark(run.times, alpha=20.0, phi=phi, A=5.0, f=1.0, g=G, v0=0.0)
    return off(run.values[BLOCK] @ scene.axes[0], exact)


def responding(D: float, f: float, mu: float, **knobs: float) -> float:
    run = solved(carried((D, f), mu=mu), **knobs)
    exact = responding_block.one_direction(run.times, D=D, f=f, mu=mu, g=G)
    return off(run.values[BLOCK][:, 0], exact)


@pytest.mark.parametrize("phi", [22.0, 30.0, 35.0])
def test_newmark_histories_come_within_1e_4_and_nearer_as_springs_stiffen(phi: float) -> None:
    soft, stiff = newmark(phi, kn=1e9, dt=5e-5), newmark(phi)
    assert stiff < 3e-5
    assert stiff < 0.3 * soft


@pytest.mark.parametrize(("D", "f", "mu"), [(0.2, 2.0, 0.6), (0.2, 5.0, 0.6), (0.5, 1.0, 0.1)])
def test_a_responding_block_comes_within_1e_3(D: float, f: float, mu: float) -> None:
    assert responding(D, f, mu) < 1e-3


def test_the_floor_of_a_responding_block_goes_with_the_root_of_the_stiffness() -> None:
    floors = [responding(0.2, 2.0, 0.6, kn=kn, dt=2.0 / kn**0.5) for kn in (1e9, 1e10, 1e11)]
    assert np.polyfit([9, 10, 11], np.log10(floors), 1)[0] == pytest.approx(-0.5, abs=0.03)


def test_a_block_that_its_base_carries_two_or_three_ways_comes_within_1e_3() -> None:
    run = solved(carried((0.3, 2.0), (0.2, 4.0), free=THREE))
    exact = responding_block.two_directions(run.times, Dx=0.3, fx=2, Dy=0.2, fy=4, mu=0.6, g=G)
    assert off(run.values[BLOCK][:, :2], exact) < 4e-4
    run = solved(carried((0.1, 2.0), (0.1, 4.0), (0.1, 1.0), free=THREE))
    shape = {"Dx": 0.1, "fx": 2.0, "Dy": 0.1, "fy": 4.0, "Dz": 0.1, "fz": 1.0}
    exact = responding_block.three_directions(run.times, **shape, mu=0.6, g=G)
    assert off(run.values[BLOCK], exact) < 3e-4


def test_a_block_pushed_down_dip_and_along_strike_comes_within_1e_4() -> None:
    scene = slope(45.0, 50.0, sines((2.0, 1.0), (1.0, 2.0)), free=THREE)
    run = solved(scene)
    exact = incline.two_directions(run.times, alpha=45, phi=50, ax=2, fx=1, ay=1, fy=2, g=G)
    assert off(run.values[BLOCK] @ scene.axes[:2].T, exact) < 1e-4


def uncharged(scene: Scene) -> Run:
    """The run with springs that start without shear."""
    program = dem.prepare(asked(scene, duration=1.0), dem.CENTRED)
    without = pressed(program.stand_in.scene)
    assert without is not None
    bare = dataclasses.replace(program, system=without)
    return bare.run(bare.solve())


@pytest.mark.parametrize(("phi", "v0"), [(15.0, 0.0), (25.0, 0.0), (25.0, 0.1)])
def test_sliding_under_gravity_is_exact_from_charged_springs_alone(phi: float, v0: float) -> None:
    scene = slope(28.0, phi, v0=v0)
    run = solved(scene, duration=1.0)
    exact = incline.gravity(run.times, alpha=28.0, phi=phi, g=G, v0=v0)
    assert off(run.values[BLOCK] @ scene.axes[0], exact) < 1e-12
    assert off(uncharged(scene).values[BLOCK] @ scene.axes[0], exact) > 1e-5


@pytest.mark.parametrize("phi", [28.0, 40.0])
def test_a_block_that_holds_stands_still_from_charged_springs_alone(phi: float) -> None:
    scene = slope(28.0, phi)
    assert np.abs(solved(scene, duration=1.0).values[BLOCK]).max() < 1e-12
    assert np.abs(uncharged(scene).values[BLOCK]).max() > 1e-8


@pytest.mark.parametrize(("phi", "v0"), [(40.0, 0.0), (15.0, 0.0), (15.0, -1.0)])
def test_the_charge_is_the_friction_of_rigid_contact(phi: float, v0: float) -> None:
    scene = slope(28.0, phi, v0=v0)
    charged = dem.prepare(asked(scene), dem.CENTRED).stand_in.charged
    assert charged is not None
    alpha, weight = np.radians(28.0), 2500.0 * G
    cap = weight * np.cos(alpha) * np.tan(np.radians(phi))
    held = -min(weight * np.sin(alpha), cap) if v0 == 0 else cap
    assert charged[0] @ scene.axes[0] == pytest.approx(held, rel=1e-12)


SHAKEN = slope(20.0, 30.0, sines((5.0, 1.0)))
DRAGGED = carried((0.2, 2.0))
TURNING = carried((0.1, 2.0), (0.1, 4.0), (0.1, 1.0), free=THREE)
DIPPING = slope(45.0, 50.0, sines((2.0, 1.0), (1.0, 2.0)), free=THREE)


def order(scene: Scene, solve: Callable[[Ask], Run]) -> float:
    """The order in dt at one stiffness: relative to the springs, and not to rigid contact."""
    # slip reverses within a step, so that errors scatter: many steps average this
    ladder = 0.02 / np.array([100, 200, 400, 700, 1000, 2000, 4000])
    fine = solve(asked(scene, 1e-6, 1e9, 0.7)).values[BLOCK]
    errors = [np.abs(solve(asked(scene, dt, 1e9, 0.7)).values[BLOCK] - fine).max() for dt in ladder]
    return float(np.polyfit(np.log(ladder), np.log(errors), 1)[0])


@pytest.mark.parametrize("scene", [SHAKEN, DRAGGED, TURNING], ids=["shaken", "dragged", "turning"])
def test_default_is_second_order_at_a_given_stiffness(scene: Scene) -> None:
    assert order(scene, dem.solve_default) > 1.7


def test_published_starts_half_a_step_late_and_is_of_first_order() -> None:
    assert order(DRAGGED, dem.solve_published) == pytest.approx(1.0, abs=0.2)


@pytest.mark.parametrize("scene", [SHAKEN, DRAGGED], ids=["shaken", "dragged"])
def test_two_unknowns_give_what_the_general_kernel_gives(scene: Scene) -> None:
    least = dem.prepare(asked(scene, duration=1.0), dem.CENTRED)
    assert isinstance(least.system, Pressed)
    general = dataclasses.replace(least, system=space(least.stand_in.scene, least.stand_in.charged))
    one, two = (program.run(program.solve()) for program in (least, general))
    assert off(one.values[BLOCK], two.values[BLOCK]) < 1e-11
    assert one.ledger is not None
    assert two.ledger is not None
    assert list(one.ledger.terms) == list(two.ledger.terms)
    for name, joules in one.ledger.terms.items():
        assert joules == pytest.approx(two.ledger.terms[name], rel=1e-6, abs=1e-6 * 2500.0)


@pytest.mark.parametrize("scene", [SHAKEN, DRAGGED, TURNING, DIPPING])
def test_the_work_of_shaking_and_of_the_base_closes_the_ledger(scene: Scene) -> None:
    run = solved(scene, duration=1.0)
    assert run.ledger is not None
    work = "shaking" if scene.shaking else "moving walls"
    assert -run.ledger.terms[f"less work of {work}"] > 0.1 * run.ledger.peak
    assert run.ledger.unaccounted < 1e-7 * run.ledger.peak
    if run.ledger.bound is not None:
        assert run.ledger.unaccounted <= run.ledger.bound < 1e-5 * run.ledger.peak


def test_a_ledger_without_drives_does_not_name_their_work() -> None:
    run = solved(slope(28.0, 15.0), duration=0.1)
    assert run.ledger is not None
    assert not [name for name in run.ledger.terms if "work" in name]


def test_a_turned_scene_gives_the_turned_answer() -> None:
    tilt = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    for scene in (DIPPING, TURNING, DRAGGED):
        turn = rotation_about_z(0.7) @ tilt
        one = solved(scene, duration=0.5).values[BLOCK]
        two = solved(rotated(scene, turn), duration=0.5).values[BLOCK]
        assert off(two, one @ turn.T) < 1e-8


def test_a_base_that_shakes_across_a_locked_direction_still_drags() -> None:
    # friction turns with the slip, so that its part in the free direction is smaller
    both = solved(carried((0.2, 2.0), (0.2, 2.0)), duration=0.1).values[BLOCK]
    alone = solved(carried((0.2, 2.0)), duration=0.1).values[BLOCK]
    assert 0.6 * alone[-1, 0] < both[-1, 0] < 0.8 * alone[-1, 0]


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
def test_rigid_contact_makes_either_scheme_a_penalty_method_with_two_unknowns(
    scheme: Scheme, tmp_path: Path
) -> None:
    assert scheme.knobs == ("dt", "kn")
    for scene, unknowns in ((SHAKEN, 2), (DRAGGED, 2), (TURNING, 3)):
        terms = scene.terms()
        assert unsupported(scheme, terms) == frozenset()
        assert scheme.method_for(terms) is Method.PENALTY
        program = dem.prepare(asked(scene), LEAPFROGS[scheme.name])
        assert unknowns_passed(program) == program.model.unknowns == unknowns
        assert program.model.terms == terms | {Term.SPHERE}  # which stands for the block
        assert f"ks = {SHEAR * KN:g} N/m" in program.model.note
    (run,) = ADAPTER.run([asked(SHAKEN)], scheme.name, tmp_path, 0.0)
    assert run.status is Status.RAN


def test_the_critical_step_is_that_of_the_stiffer_spring() -> None:
    stood = dem.prepare(asked(SHAKEN), dem.CENTRED).stand_in.scene
    assert dem.critical_step(stood, dem.CENTRED) == pytest.approx(2 / (SHEAR * KN / 2500) ** 0.5)


def _with_block(scene: Scene, **changes: object) -> Scene:
    block = dataclasses.replace(scene.blocks[0], **changes)  # type: ignore[arg-type]
    return dataclasses.replace(scene, bodies=(*scene.walls, block))


def test_what_springs_and_spheres_cannot_stand_for_is_refused_with_the_reason() -> None:
    at_rest = slope(28.0, 15.0)
    block = at_rest.blocks[0]
    lifted = block.vertices + 1e-3 * at_rest.walls[0].normal
    elsewhere = ball(np.full(3, 5.0), np.zeros(3))
    alone = dataclasses.replace(at_rest, bodies=(*at_rest.walls, elsewhere, elsewhere))
    scenes = {
        "may turn": _with_block(at_rest, free_spin=np.ones(3, bool)),
        "off its wall": _with_block(at_rest, vertices=lifted),
        "leaves its wall": _with_block(at_rest, velocity=at_rest.walls[0].normal),
        "locked along the normal": _with_block(at_rest, free=np.array([True, False, False])),
        "may touch each other face to face": dataclasses.replace(
            at_rest, bodies=(*at_rest.bodies, block)
        ),
        "one body and one wall": alone,
    }
    for words, scene in scenes.items():
        reason = ADAPTER.refuses(asked(scene), "default")
        assert reason is not None, words
        assert words in reason
    reason = ADAPTER.refuses(asked(at_rest, kn=None), "default")
    assert reason is not None
    assert "these settings give no kn" in reason


def test_the_knob_kn_means_nothing_to_a_scene_with_springs_of_its_own() -> None:
    scene = Scene((FLOOR, ball(0.99 * UP, -UP)), Contact(1e5, 1e5, 0.3))
    one, two = (dem.solve_default(asked(scene, 1e-4, kn, 0.1)) for kn in (None, 1e9))
    assert np.array_equal(one.values[BLOCK], two.values[BLOCK])
    assert one.model == two.model


def test_a_shaken_sphere_without_contact_follows_its_closed_form() -> None:
    # no contact: u'' = A sin(w t + p), which a leapfrog follows to second order
    A, w, p = 3.0, 2 * np.pi * 1.5, 0.4
    shaking = Harmonic(np.array([0.0, 0.0, A]), np.full(3, 1.5), np.full(3, p))
    scene = Scene((ball(UP, np.zeros(3)),), Contact(1e5), shaking=shaking)
    errors = []
    for dt in (2e-3, 1e-3):
        ask = Ask(scene, History(1.0, 0.02), (Displacement(0),), Knobs(dt))
        program = dem.prepare(ask, dem.CENTRED)
        assert isinstance(program.system, Space)
        run = program.run(program.solve())
        t = run.times
        exact = A / w**2 * (np.sin(p) - np.sin(w * t + p)) + A / w * np.cos(p) * t
        errors.append(np.abs(run.values[Displacement(0)][:, 2] - exact).max())
    assert errors[1] < 1e-5
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.02)
    assert Term.SHAKING in program.model.terms


@pytest.mark.parametrize("scene", [SHAKEN, DRAGGED, TURNING], ids=["shaken", "dragged", "turning"])
def test_friction_and_overlap_are_audited_in_a_run_with_one_contact(scene: Scene) -> None:
    ledger = solved(scene).ledger
    assert ledger is not None
    for law in ("Coulomb: friction beyond mu N [N]", "penetration [m]"):
        seen, allowed = ledger.audits[law]
        assert seen <= allowed
    assert 0 < ledger.audits["penetration [m]"][0] < 1e-2
