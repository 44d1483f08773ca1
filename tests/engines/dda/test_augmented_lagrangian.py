"""Claims about dda/augmented-lagrangian: no sinking, no influence of kn, no rebound."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from tests.scenes.blocks.dda_scenes import (
    ALL,
    DOWN,
    FLOOR,
    NONE,
    G,
    asked,
    box,
    closes,
    moved,
    rates,
    run,
    shaken,
    slope,
    stack,
)
from vv.ask import Ask, Displacement, History, Knobs, Run
from vv.base.metrics import observed_order
from vv.case import Series
from vv.engines.dda import BORNE, DEFAULT, refuses
from vv.engines.dda.general.augmented.forces import EPS, ROUNDINGS
from vv.engines.dda.limits import HELD
from vv.engines.dda.solve import LEAPT
from vv.plan.project import find
from vv.scene import Contact, Scene, Vector

STEPS = (4e-3, 2e-3, 1e-3)
WEDGE, SHAKEN_WEDGE, INCLINE, RESPONDING = (
    find().load_case(name) for name in ("wedge", "shaken-wedge", "incline", "responding-block")
)
SHAKEN = shaken((0.3, 0.2, 0.0), (1.0, 1.3, 1.0), 0.3)
STACK = stack(NONE)
STILL = dataclasses.replace(
    STACK,
    bodies=(
        FLOOR,
        *(dataclasses.replace(block, velocity=0 * block.velocity) for block in STACK.blocks),
    ),
)


def wedge(xi: float, dip: float, held: float, knobs: Knobs) -> Ask:
    given = {**WEDGE.defaults("xi-1"), "xi": xi, "dip": dip, "held": held}
    return WEDGE.declare("xi-1", given).study.ask(knobs)


def deepest(done: Run) -> float:
    assert done.ledger is not None
    return done.ledger.audits["penetration [m]"][0]


RESTING = {
    "block": (slope(20, 25), 4),
    "turning block": (slope(20, 25, spin=True), 4),
    "stack": (STILL, 4),
    "wedge": (wedge(1.0, 0.0, 0.5, Knobs(1e-3, 1e6)).scene, 4),
}


@pytest.mark.shows("until the springs carry only 1e-10 of them")
@pytest.mark.parametrize("kn", [1e7, 1e9, 1e11])
@pytest.mark.parametrize("name", RESTING)
def test_what_rests_no_longer_sinks_by_its_weight_over_the_springs(name: str, kn: float) -> None:
    """Its springs carry at most HELD of the force, or their gap is rounding."""
    scene, points = RESTING[name]
    weight = G * sum(block.mass for block in scene.blocks)
    far = max(float(np.linalg.norm(block.vertices, axis=1).max()) for block in scene.blocks)
    ask = asked(scene, 1e-3, kn, 0.2)
    sunk, held = run(ask, DEFAULT), run(ask, BORNE)
    assert deepest(sunk) >= 0.9 * weight * math.cos(math.radians(20)) / (points * kn)
    bound = max(HELD * weight / kn, ROUNDINGS * EPS * far)
    assert deepest(held) <= bound
    assert np.abs(moved(held)).max() <= bound
    closes(held)


def test_answers_do_not_depend_on_the_springs_over_six_decades() -> None:
    """Forces have a relative error of HELD, and rounding of gaps adds 2 blur/dt^2 to g."""
    paths = [moved(run(asked(SHAKEN, 1e-3, kn, 1.0), BORNE)) for kn in (1e6, 1e8, 1e10, 1e12)]
    (block,) = SHAKEN.blocks
    far = float(np.linalg.norm(block.vertices, axis=1).max()) + 0.6  # displacement of the base
    blur = 2 * ROUNDINGS * EPS * far / 1e-3**2 / G
    for path in paths[1:]:
        assert np.abs(path - paths[0]).max() <= (HELD + blur) * np.abs(paths[0]).max()
    soft, stiff = (moved(run(asked(SHAKEN, 1e-3, kn, 1.0), DEFAULT)) for kn in (1e6, 1e8))
    assert np.abs(soft - stiff).max() > 1e-3 * np.abs(stiff).max()


def order(scene: Scene, see: object) -> float:
    assert callable(see)
    right = see(run(asked(scene, 2e-5, 1e9, 0.4, 0.02), BORNE))
    errors = []
    for dt in STEPS:
        off: Vector = see(run(asked(scene, dt, 1e9, 0.4, 0.02), BORNE)) - right
        errors.append(float(np.abs(off).max()))
    found = observed_order(list(STEPS), errors)
    assert found is not None
    return found.order


@pytest.mark.shows(
    "the scheme is of first order, and of second in positions where slip stays on a line"
)
def test_it_is_of_first_order_and_of_second_in_places_where_a_slide_does_not_turn() -> None:
    straight = slope(20, 15, 2.0, velocity=1.0)
    assert order(SHAKEN, moved) == pytest.approx(1.0, abs=0.1)
    assert order(straight, rates) == pytest.approx(1.0, abs=0.1)
    assert order(straight, moved) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize(
    "scene", [SHAKEN, slope(20, 22, 5.0), slope(30, 25, velocity=0.5, spin=True), STACK]
)
def test_every_joule_has_a_term_and_laws_are_kept(scene: Scene) -> None:
    done = run(asked(scene, 2e-3, 1e8, 0.4, 0.02), BORNE)
    closes(done)
    assert done.ledger is not None
    assert done.ledger.terms["normal elastic"] == done.ledger.terms["shear elastic"] == 0.0
    assert done.ledger.terms["friction dissipation"] > 0.0


@pytest.mark.shows("A block that lands stays down, because a step passes on its mid-step velocity")
def test_a_block_that_lands_stays_down_and_its_blow_takes_all_of_its_energy() -> None:
    """On springs with DDA's own step it would rebound; here it is at rest within a step."""
    height = 0.1
    falls = box((0.2, 0.2, 0.1), 2000.0, np.array([0.0, 0.0, 0.1 + height]))
    scene = Scene((FLOOR, falls), Contact(math.inf, mu=0.5), gravity=DOWN)
    done = run(asked(scene, 1e-3, 1e8, 0.4), BORNE)
    closes(done)
    assert done.ledger is not None
    down = moved(done)[:, 2]
    landed = round(math.sqrt(2 * height / G) / 0.01) + 1
    assert np.abs(down[landed:] + height).max() <= ROUNDINGS * EPS
    assert done.ledger.terms[LEAPT] == pytest.approx(falls.mass * G * height, rel=1e-9)
    thrown = moved(run(asked(scene, 1e-3, 1e8, 0.4), DEFAULT))[landed:, 2]
    assert thrown.max() > -0.9 * height


@pytest.mark.shows(
    "In `dda` it falls through at 1e-3 rad, whereas `dda/augmented-lagrangian` supports it at "
    "1e-6 rad with an error below 1e-9"
)
@pytest.mark.parametrize("xi", [1.0, 1e-2, 1e-4, 1e-6])
def test_a_wedge_slides_down_the_narrowest_groove(xi: float) -> None:
    """Errors are those of forces, HELD, over the part of the driving force that friction leaves."""
    ask = wedge(xi, 30.0, 0.5, Knobs(1e-2, 1e9))
    done = run(ask, BORNE)
    way = moved(done) @ ask.scene.axes[0]
    due = 0.5 * (0.5 * G * math.sin(math.radians(30.0))) * done.times**2
    assert np.abs(way - due).max() <= 10 * HELD * due[-1]
    closes(done)


@pytest.mark.parametrize("held", [1.47, 1.48])
def test_a_wedge_that_friction_holds_stays_in_the_narrowest_groove(held: float) -> None:
    """A pass that did not converge was taken for one that rounding limits, with its forces."""
    done = run(wedge(1e-6, 30.0, held, Knobs(1e-2, 1e9)), BORNE)
    rounded = EPS / 1e-6**2  # the force on a side is rounded so, over the weight
    assert np.abs(moved(done)).max() <= rounded * 0.5 * G * done.times[-1] ** 2
    assert done.ledger is not None
    excess, allowed = done.ledger.audits["Coulomb: friction beyond mu N [N]"]
    assert excess <= allowed


@pytest.mark.parametrize("held", [0.5, 0.9, 0.95, 1.1, 1.3])
@pytest.mark.parametrize("dip", [15.0, 20.0, 30.0, 40.0])
def test_a_wedge_in_the_narrowest_groove_is_pressed_in_a_fine_step_too(
    dip: float, held: float
) -> None:
    """Forces were taken for rounding that still grew, since their springs had just stiffened."""
    ask = wedge(1e-6, dip, held, Knobs(1e-3, 1e9))
    done = run(ask, BORNE)
    assert len(done.times) == 51, done.reason
    way = moved(done) @ ask.scene.axes[0]
    fall = 0.5 * G * done.times**2
    due = max(0.0, 1.0 - held) * math.sin(math.radians(dip)) * fall
    rounded = EPS / 1e-6**2 * (held * due[-1] / (1.0 - held) if held < 1.0 else fall[-1])
    assert np.abs(way - due).max() <= rounded
    if held < 1.0:  # at rest all energies are rounding, as is the path that bounds their error
        closes(done)


def test_a_wedge_that_friction_all_but_holds_begins_to_slide_as_it_should() -> None:
    """Its first slips are 1e-11 m; friction across them would hold it."""
    near = {**SHAKEN_WEDGE.defaults("level"), "dip": 33.2, "xi": 1.18, "A": 1.92, "duration": 0.3}
    trial = SHAKEN_WEDGE.declare("level", near)
    done = run(trial.study.ask(Knobs(1e-4, 1e10)), BORNE)
    (s,) = trial.quantities
    assert isinstance(s, Series)
    assert s.reference is not None
    way, due = s.observe(done), s.reference(done.times)
    assert np.abs(way - due).max() <= 5e-8
    closes(done)


def test_momentum_is_as_right_as_forces_are_in_fine_steps() -> None:
    """Stiffer springs, where the rest is rounding, would turn that of displacements into forces."""
    shaken_slope = INCLINE.defaults("newmark-30") | {"f": 2.0, "duration": 0.2}
    ask = INCLINE.declare("newmark-30", shaken_slope).study.ask(Knobs(1e-5, 1e8))
    ledger = run(ask, BORNE).ledger
    assert ledger is not None
    seen, _ = ledger.audits["error of the momentum balance [N]"]
    assert seen <= HELD * ask.scene.blocks[0].mass * G


@pytest.mark.parametrize("dt", [2.5e-4, 1e-4])
def test_momentum_is_as_right_where_four_corners_begin_to_slide(dt: float) -> None:
    """Springs stiffen until friction has turned, but do not leave rounding in the balance."""
    given = RESPONDING.defaults("3d-turning") | {"f": 1.56, "fy": 1.44, "duration": 0.23}
    ask = RESPONDING.declare("3d-turning", given).study.ask(Knobs(dt, 1e10))
    ledger = run(ask, BORNE).ledger
    assert ledger is not None
    seen, _ = ledger.audits["error of the momentum balance [N]"]
    assert seen <= HELD * ask.scene.blocks[0].mass * G


@pytest.mark.shows("It refuses scenes of several blocks that rotate, as in masonry and arches")
def test_springs_and_walls_of_stones_are_refused() -> None:
    knobs, goal = Knobs(1e-3, 1e8), History(1.0, 0.1)
    sprung = dataclasses.replace(slope(20, 25), contact=Contact(1e8, 1e8, 0.5))
    told = ((sprung, "contact on springs"), (stack(ALL), "'box' and 'box' can rotate"))
    for scene, words in told:
        ask = Ask(scene, goal, (Displacement(1),), knobs)
        assert words in (refuses(ask, BORNE) or "")
        assert refuses(ask, DEFAULT) is None
