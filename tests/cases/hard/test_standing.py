"""Claims about structures that stand: the thinnest arch by two routes, and results of codes."""

import dataclasses
from types import ModuleType

import numpy as np
import pytest

from reference_solutions.checks.hard import arch as programme
from reference_solutions.checks.hard import falling_arch as energetic
from reference_solutions.hard import arch as thrust
from reference_solutions.hard import falling_arch as falling
from tests.support.turned_signs import caught, signs, turned
from vv.ask import Ask, Displacement, History, Knobs, Run, Status
from vv.case import Level, Series
from vv.engines import dda, rigid
from vv.plan.project import find
from vv.scene import Contact, Scene

CASE = find().load_case("standing")


def scene(variant: str, **changed: float) -> Scene:
    return CASE.declare(variant, {**CASE.defaults(variant), **changed}).study.scene


def test_the_thinnest_arches_are_those_known() -> None:
    assert thrust.thinnest_of_arcs(10) == pytest.approx(0.1074601, abs=5e-8)
    assert thrust.thinnest_of_arcs(1000) == pytest.approx(0.10747803810748, abs=2e-6)
    assert thrust.thinnest_of_chords(1000) == pytest.approx(0.10747803810748, abs=2e-6)


@pytest.mark.parametrize("n", [6, 10, 14])
def test_the_two_routes_agree(n: int) -> None:
    assert programme.thinnest(n) == pytest.approx(thrust.thinnest_of_chords(n), abs=1e-7)


@pytest.mark.parametrize("part", [1.001, 1.01, 1.3, 3.0])
@pytest.mark.parametrize("n", [6, 10])
def test_both_routes_have_an_arch_slide_apart_below_the_same_friction(n: int, part: float) -> None:
    t = part * thrust.thinnest_of_chords(n)
    least = programme.least_friction(n, t)
    assert thrust.stands(n, t, 1.00001 * least)
    assert not thrust.stands(n, t, 0.99999 * least)


@pytest.mark.parametrize("n", [7, 9])
def test_an_arch_without_a_joint_at_its_crown_slides_apart_below_the_same_friction(n: int) -> None:
    least = programme.least_friction(n, 0.3)
    assert thrust.stands(n, 0.3, 1.00001 * least)
    assert not thrust.stands(n, 0.3, 0.99999 * least)


@pytest.mark.parametrize("part", [1.01, 1.3])
def test_rigid_contact_slides_apart_below_that_friction_and_stands_above(part: float) -> None:
    least = programme.least_friction(10, part * thrust.thinnest_of_chords(10))
    for mu, stands in ((1.001 * least, True), (0.99 * least, False)):
        made = CASE.declare("arch", {**CASE.defaults("arch"), "part": part})
        contact = Contact(np.inf, mu=mu)
        slippery = dataclasses.replace(made.study.scene, contact=contact)
        ask = Ask(slippery, History(0.3, 0.1), (Displacement(5),), Knobs(1e-2))
        moved = np.abs(rigid.solve(ask).values[Displacement(5)]).max()
        assert bool(moved < 1e-10) == stands


def test_they_agree_on_round_voussoirs_as_chords_become_arcs() -> None:
    off = [programme.thinnest(10, fine) - thrust.thinnest_of_arcs(10) for fine in (5, 10)]
    assert off[0] / off[1] == pytest.approx(4.0, rel=0.05)


def drop(part: float, solve: object, kn: float | None = None) -> tuple[float, Run]:
    """The displacement by which the crown of an arch sinks in 0.15 s, in mean radii."""
    crown = Displacement(5)
    variant = "arch" if part > 1 else "arch-thin"
    ask = Ask(scene(variant, part=part), History(0.15, 0.05), (crown,), Knobs(2.5e-3, kn))
    run: Run = solve(ask)  # type: ignore[operator]
    return -float(run.values[crown][-1, 2]), run


def test_an_arch_a_percent_too_thin_falls_and_one_a_percent_thicker_stands() -> None:
    assert drop(0.99, rigid.solve)[0] == pytest.approx(5.7e-4, rel=0.02)
    assert abs(drop(1.01, rigid.solve)[0]) < 1e-6
    for solve in (dda.solve_default, dda.solve_published):
        assert drop(0.99, solve, 1e9)[0] > 5e-4
        assert abs(drop(1.01, solve, 1e9)[0]) < 1e-5


def test_the_two_routes_of_the_fall_agree() -> None:
    """One follows the mechanism by the forces in its hinges, the other by its energy."""
    thick, t = 0.99 * thrust.thinnest_of_chords(10), np.array([0.05, 0.1, 0.3])
    due = energetic.crown_drop(t, n=10, thick=thick, size=1.3, g=9.81)
    assert falling.crown_drop(t, n=10, thick=thick, size=1.3, g=9.81) == pytest.approx(
        due, rel=5e-6
    )


def test_the_fall_begins_as_the_square_of_time() -> None:
    """Before the first rotation that the second route integrates, and after it."""
    thick = 0.9 * thrust.thinnest_of_chords(10)
    joint = energetic._joint(10, thick)
    first = energetic._time(1e-6, 10, thick, joint)
    turns = [energetic._turn(part * first, 10, thick, joint) for part in (0.5, 1.0, 1.001, 2.0)]
    assert turns == pytest.approx([2.5e-7, 1e-6, 1.001**2 * 1e-6, 4e-6], rel=1e-4)


def test_an_arch_on_the_brink_does_not_fall() -> None:
    """At the least thickness the initial acceleration of the mechanism is zero."""
    thick = thrust.thinnest_of_chords(10)
    with pytest.raises(ValueError, match=r"such an arch of n = 10 stands"):
        falling.crown_drop(np.ones(1), n=10, thick=1.0001 * thick, size=1.0, g=9.81)
    late = [falling.crown_drop(np.array([0.05]), n=10, thick=part * thick, size=1.0, g=9.81)[0]
            for part in (0.999, 0.9999)]  # fmt: skip
    assert late[0] / late[1] == pytest.approx(10.0, rel=0.05)


def test_rigid_contact_falls_as_the_mechanism_does() -> None:
    study = CASE.declare("arch-thin", CASE.defaults("arch-thin")).study
    (sunk,) = CASE.declare("arch-thin", CASE.defaults("arch-thin")).quantities
    assert isinstance(sunk, Series)
    assert sunk.reference is not None
    errors = []
    for knobs in study.rungs[Level.DEFAULT]:
        run = rigid.solve(study.ask(knobs))
        due = sunk.reference(run.times)
        errors.append(np.abs(sunk.observe(run) - due) / due.max())
    assert errors[0].max() < 1.1e-4  # of second order; tolerances of contacts add up
    assert 3.4 < errors[0][1] / errors[1][1] < 4.2  # at later times, the tolerances hide it


def falls(route: ModuleType) -> bool:
    """Whether a route has the fall on which both agree."""
    law = {"n": 10, "thick": 0.99 * KNOWN_TEN, "size": 1.3, "g": 9.81}
    return bool(np.allclose(route.crown_drop(np.array([0.2]), **law), FALLEN, rtol=1e-5, atol=0))


KNOWN_TEN = thrust.thinnest_of_chords(10)
FALLEN = energetic.crown_drop(np.array([0.2]), n=10, thick=0.99 * KNOWN_TEN, size=1.3, g=9.81)


# signs without effect, in moments of inertia and in areas, equal for all voussoirs
@pytest.mark.parametrize("sign", signs(falling, (), ("at - middle", "b - a")))
def test_any_wrong_sign_in_the_fall_is_caught(sign: int) -> None:
    with np.errstate(all="ignore"):
        assert caught(lambda: falls(turned(falling, sign)))


@pytest.mark.parametrize("dt", [5e-3, 2.5e-3, 1.25e-3])
def test_dda_solves_for_friction_in_the_arch_that_falls(dt: float) -> None:
    """Its hinges open about edges that stay closed, where open-close iterations do not end."""
    ask = Ask(
        scene("arch-thin", part=0.99), History(0.15, 0.05), (Displacement(5),), Knobs(dt, 1e9)
    )
    run = dda.solve_default(ask)
    assert run.ledger is not None
    assert run.model is not None
    assert all(seen <= allowed for seen, allowed in run.ledger.audits.values())
    assert "0 parts of steps kept unconverged" in run.model.note


def test_an_arch_that_dda_bursts_within_an_output_is_said_to_diverge() -> None:
    """One step throws its blocks 1e13 m apart, and the next one could not search for contacts."""
    ask = Ask(
        scene("arch-thin", part=0.99), History(0.2, 0.02), (Displacement(5),), Knobs(5e-3, 1e10)
    )
    run = dda.solve_lagged(ask)
    assert run.status is Status.DIVERGED
    assert "kinetic and elastic" in run.reason


@pytest.mark.parametrize("solve", [dda.solve_default, dda.solve_lagged, dda.solve_published])
def test_a_hundred_blocks_stand_on_springs_for_ten_seconds(solve: object) -> None:
    top = Displacement(100)
    ask = Ask(scene("stack-10", n=100), History(10.0, 1.0), (top,), Knobs(0.1, 1e9))
    run: Run = solve(ask)  # type: ignore[operator]
    assert np.abs(run.values[top]).max() < 1e-10


@pytest.mark.parametrize("dt", [0.1, 0.01])
def test_a_hundred_blocks_stand_in_rigid_contact(dt: float) -> None:
    """Sweeps transmit loads by one block each; Newton steps solve for all of them at once."""
    top = Displacement(100)
    ask = Ask(scene("stack-10", n=100), History(0.5, 0.1), (top,), Knobs(dt))
    run = rigid.solve(ask)
    assert run.ledger is not None
    residual, _ = run.ledger.audits["residual of contact [m/s]"]
    assert residual <= 1e-7
    assert np.abs(run.values[top]).max() < 1e-4


@pytest.mark.parametrize(("size", "g"), [(1e-2, 9.81), (1e-6, 9.81), (1.0, 1e3), (8.0, 9.81)])
def test_stacks_of_blocks_of_any_size_and_weight_creep_alike(size: float, g: float) -> None:
    """In steps of 0.05 s weight moves blocks of 1 cm by their own size."""
    given = {**CASE.defaults("stack-20"), "size": size, "g": g}
    trial = CASE.declare("stack-20", given)
    (moved,) = trial.quantities
    for knobs in trial.study.rungs[Level.DEFAULT]:
        run = rigid.solve(trial.study.ask(knobs))
        assert moved.observe(run) <= 1e-7 * size
        assert run.ledger is not None
        assert all(seen <= allowed for seen, allowed in run.ledger.audits.values())


@pytest.mark.parametrize(("size", "g"), [(1e-2, 9.81), (1.0, 1e3)])
def test_an_arch_of_any_size_and_weight_sinks_alike_into_its_springs(size: float, g: float) -> None:
    """Times are halved until weight moves a block by at most 1.2 times as much as usual."""
    given = {**CASE.defaults("arch"), "size": size, "g": g}
    trial = CASE.declare("arch", given)
    (moved,) = trial.quantities
    run = dda.solve_default(trial.study.ask(trial.study.rungs[Level.DEFAULT][0]))
    assert run.status is Status.RAN, run.reason
    assert 0.3 < moved.observe(run) / (1.61e-8 * size) < 1.2


def test_blocks_that_touch_few_others_are_numbered_in_a_chain() -> None:
    """Any numbering in the scene is replaced, so that equations of Newton steps are banded."""
    whole = scene("stack-10", n=30)
    mixed = np.random.default_rng(1).permutation(30)
    bodies = (*whole.walls, *(whole.blocks[k] for k in mixed))
    top = Displacement(1 + int(np.flatnonzero(mixed == 29)[0]))
    shuffled = Scene(bodies, whole.contact, gravity=whole.gravity)
    run = rigid.solve(Ask(shuffled, History(0.5, 0.1), (top,), Knobs(0.1)))
    assert run.ledger is not None
    assert run.ledger.audits["residual of contact [m/s]"][0] <= 1e-7
    assert np.abs(run.values[top]).max() < 1e-5


def test_a_stack_without_friction_that_is_pushed_is_seen() -> None:
    study = CASE.declare("stack-10", CASE.defaults("stack-10")).study
    tilted = Ask(
        Scene(study.scene.bodies, study.scene.contact, gravity=np.array([7.0, 0.0, -9.81])),
        study.goal, study.observables, study.rungs[Level.DEFAULT][-1],
    )  # fmt: skip
    (moved,) = CASE.declare("stack-10", CASE.defaults("stack-10")).quantities
    assert moved.observe(rigid.solve(tilted)) > 0.1


def same(route: ModuleType) -> bool:
    """Whether a route has the known least thicknesses of arches."""
    if hasattr(route, "outlines"):
        middle = route.centroid(np.array([[1.0, 1.0], [3.0, 1.0], [3.0, 2.0], [1.0, 4.0]]))
        good = np.allclose(middle, [11 / 6, 25 / 12], rtol=1e-12)  # of a trapezium
        good = good and abs(route.thinnest(8) - thrust.thinnest_of_chords(8)) < 1e-7
        return bool(good and abs(route.least_friction(8, 1.3 * KNOWN) - LEAST) < 1e-9)
    found = [route.thinnest_of_chords(8), route.thinnest_of_arcs(10)]
    sure = np.allclose(found, [KNOWN, 0.1074601], rtol=0, atol=5e-8)
    sure = sure and all(route.stands(9, *one) == stands for one, stands in ODD)
    return bool(sure and all(route.stands(8, *one) == stands for one, stands in SLIDES))


KNOWN = programme.thinnest(8)
ODD = [((0.3, times * programme.least_friction(9, 0.3)), times > 1) for times in (0.999, 1.001)]
ODD += [((times * programme.thinnest(9), 10.0), times > 1) for times in (0.9999, 1.0001)]
LEAST = programme.least_friction(8, 1.3 * KNOWN)
SLIDES = [
    ((part * KNOWN, times * programme.least_friction(8, part * KNOWN)), times > 1)
    for part in (1.01, 1.3, 3.0)
    for times in (0.999, 1.001)
] + [((0.999 * KNOWN, 10.0), False)]


@pytest.mark.parametrize("sign", signs(thrust))
def test_any_wrong_sign_in_the_line_of_thrust_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(thrust, sign)))


@pytest.mark.parametrize("sign", signs(programme, ("outlines", "centroid", "_stands"), ("-1",)))
def test_any_wrong_sign_in_the_programme_is_caught(sign: int) -> None:
    assert caught(lambda: same(turned(programme, sign)))


def test_odd_and_few_voussoirs_are_refused() -> None:
    for n in (4, 9):
        with pytest.raises(ValueError, match=f"n = {n}; an even number"):
            thrust.thinnest_of_chords(n)
    with pytest.raises(ValueError, match="n = 5; at least 6"):
        thrust.stands(5, 0.2, 0.5)


@pytest.mark.parametrize(("variant", "knobs"), [
    ("stack-10", Knobs(2e-2, 1e9)), ("arch", Knobs(5e-3, 1e9)),
])  # fmt: skip
@pytest.mark.parametrize("g", [1e-12, 1e-300])
def test_energy_that_springs_have_of_rounded_positions_is_no_divergence(
    variant: str, knobs: Knobs, g: float
) -> None:
    """Weights press springs by 1e-17 m, where a gap of metres is rounded by 1e-16 m."""
    ask = CASE.declare(variant, {**CASE.defaults(variant), "g": g}).study.ask(knobs)
    run = dda.solve(ask, dda.DEFAULT)
    assert run.status is Status.RAN, run.reason
    assert max(float(np.abs(way).max()) for way in run.values.values()) <= 1e-12  # m


def test_a_fall_must_exceed_the_rounding_of_positions() -> None:
    given = CASE.defaults("arch-thin")
    CASE.declare("arch-thin", {**given, "g": 3.5e-8})
    for g in (3.3e-8, 1e-300):
        with pytest.raises(ValueError, match="below the rounding of positions"):
            CASE.declare("arch-thin", {**given, "g": g})
