"""Claims about the tiny scenes of `vv check`: right answers pass, and mistakes are named."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from vv.ask import Ask, Displacement, Method, Observable, Run, Status, Velocity
from vv.codes import Scheme
from vv.codes.tiny_scene_check import Answered, CheckResult, judged
from vv.codes.tiny_scenes import STEPS, TinyScene, friction, tiny_scenes, unasked
from vv.codes.tiny_scenes.tiny_scene import MASS
from vv.plan.project import find
from vv.scene import Term, Vector

BOTH = frozenset({Displacement, Velocity})
ALL = Scheme("default", "", Method.SECOND_ORDER, frozenset(Term), observables=BOTH)
SCENES = {one.name: one for one in tiny_scenes(ALL)}
# How a body moves does not show strain; and no motion with micro-slip is known by heart.
UNSHOWN = {Term.STRAIN, Term.STRAINED_START, Term.MICRO_SLIP}
EXACT = (
    "free flight", "dead load", "bounce", "collision", "lock", "oblique lock", "drag", "dashpot",
    "skid", "bond", "shear of a bond", "slide of a block",
)  # fmt: skip
Wrong = Callable[[Ask, TinyScene], tuple[Vector, Vector]]


def shaken(tiny: TinyScene, wrong: Wrong, scheme: Scheme = ALL) -> CheckResult:
    """What is said of a code that reports what `wrong` gives: displacement and velocity."""
    runs = []
    for ask in tiny.asks(scheme):
        moved, speed = wrong(ask, tiny)
        seen: tuple[Observable, ...] = (Displacement(tiny.body), Velocity(tiny.body))
        values = dict(zip(seen, (moved, speed), strict=True))
        runs.append(Run(Status.RAN, times=ask.goal.times(ask.dt), values=values))
    return judged(scheme, tiny, runs)


def right(ask: Ask, tiny: TinyScene) -> tuple[Vector, Vector]:
    return tiny.motion(ask.goal.times(ask.dt))


def test_all_effects_that_a_scheme_declares_are_asked_of_it_and_no_other() -> None:
    assert set().union(*(one.scene.terms() for one in SCENES.values())) == frozenset(Term) - UNSHOWN
    assert unasked(ALL) == UNSHOWN
    bare = dataclasses.replace(ALL, terms=frozenset({Term.SPHERE, Term.WALL_CONTACT}))
    assert [one.name for one in tiny_scenes(bare)] == ["free flight", "bounce", "lock"]
    assert not any(one.scene.gravity.any() for one in tiny_scenes(bare))
    assert tiny_scenes(dataclasses.replace(ALL, observables=frozenset())) == []


@pytest.mark.parametrize("name", EXACT)
def test_the_answers_known_by_heart_are_those_of_the_exact_engine(name: str) -> None:
    exact = find().load_adapter("exact")
    tiny = SCENES[name]
    scheme = dataclasses.replace(exact.schemes[name == "shear of a bond"], knobs=())
    (ask,) = tiny.asks(scheme)
    runs = list(exact.run([ask], scheme.name, None, 0.0))  # type: ignore[arg-type]  # it needs none
    found = judged(scheme, tiny, runs)
    assert found.answered is Answered.RIGHT
    assert float(found.words.rpartition(" ")[2]) < 1e-13


@pytest.mark.parametrize("name", SCENES)
def test_what_a_mistake_looks_like_is_said(name: str) -> None:
    tiny = SCENES[name]
    assert shaken(tiny, right).answered is Answered.RIGHT
    for words, mistaken in tiny.mistakes.items():
        motion = dataclasses.replace(tiny, motion=mistaken)
        found = shaken(tiny, lambda ask, _, motion=motion: right(ask, motion))  # type: ignore[misc]
        assert found.answered is Answered.WRONG
        assert f"it looks as if {words}" in found.words


def late(ask: Ask, tiny: TinyScene) -> tuple[Vector, Vector]:
    moved, speed = right(ask, tiny)
    return np.concatenate([moved[:1], moved[:-1]]), speed


MISTAKES: dict[str, Wrong] = {
    "nothing moves": lambda ask, g: (0 * right(ask, g)[0], 0 * right(ask, g)[1]),
    "all signs are reversed": lambda ask, g: (-right(ask, g)[0], -right(ask, g)[1]),
    "positions are written": lambda ask, g: (
        right(ask, g)[0] + g.scene.spheres.position[-1],
        right(ask, g)[1],
    ),
    "velocities are written": lambda ask, g: (right(ask, g)[1], right(ask, g)[1]),
    "rows are one output late": late,
    "x, y, z are y, x, z": lambda ask, g: (right(ask, g)[0][:, [1, 0, 2]], right(ask, g)[1]),
}


@pytest.mark.parametrize("words", MISTAKES)
def test_mistakes_of_the_table_are_told_apart(words: str) -> None:
    found = shaken(SCENES["drag"], MISTAKES[words])
    assert found.answered is Answered.WRONG
    assert f"it looks as if {words}" in found.words


@pytest.mark.parametrize("name", SCENES)
def test_a_velocity_known_by_heart_is_that_of_the_displacement(name: str) -> None:
    tiny = SCENES[name]
    t = np.linspace(0.0, tiny.duration, 4001)
    moved, speed = tiny.motion(t)
    assert not moved[0].any()
    seen = np.gradient(moved, t, axis=0)
    rough = np.abs(np.diff(speed, axis=0)).max()  # a force that sets in at once
    assert np.abs(seen - speed)[1:-1].max() <= rough + 1e-6 * np.abs(speed).max()


def test_a_sphere_that_sticks_swings_on_its_shear_spring() -> None:
    """Until it slips, at 4.97 ms, it has the energy of its start."""
    moved, speed = SCENES["viscous skid"].motion(np.linspace(0.0, 4.9e-3, 9))
    way, fast = moved @ friction.ACROSS, speed @ friction.ACROSS
    energy = fast**2 + friction.STIFF / MASS * way**2
    np.testing.assert_allclose(energy, friction.FAST**2, rtol=1e-12)


def off_by(power: float, size: float) -> Wrong:
    """Right but for an error of an order in dt."""
    return lambda ask, g: tuple(part * (1 + size * ask.dt**power) for part in right(ask, g))


def test_an_order_that_falls_short_of_the_claim_is_named() -> None:
    found = shaken(SCENES["drag"], off_by(1, 0.1))
    assert found.answered is Answered.WRONG
    assert "it claims order 2 in dt, and 1.0 was seen" in found.words
    modest = dataclasses.replace(ALL, method=Method.FIRST_ORDER)
    assert "right" in shaken(SCENES["drag"], off_by(1, 0.1), modest).words
    assert "order in dt 2.0" in shaken(SCENES["drag"], off_by(2, 0.1)).words


def only_at(ask_is: Callable[[int], bool], wrong: Wrong) -> Wrong:
    """Right but where the number of steps of a run is such."""

    def answer(ask: Ask, tiny: TinyScene) -> tuple[Vector, Vector]:
        return (wrong if ask_is(round(tiny.duration / ask.dt)) else right)(ask, tiny)

    return answer


def test_the_finest_step_decides_and_coarser_ones_may_be_as_wrong_as_their_order() -> None:
    drag = SCENES["drag"]
    per_step = 0.1 / drag.asks(ALL)[0].dt ** 2
    found = shaken(drag, off_by(2, per_step))
    assert found.answered is Answered.RIGHT
    assert "order in dt 2.0" in found.words


def test_the_finest_run_shows_what_a_mistake_looks_like() -> None:
    late_only_if_coarse = only_at(lambda n: n < STEPS[-1], late)
    found = shaken(SCENES["drag"], late_only_if_coarse)
    assert "looks as if" not in found.words
    only_fine = only_at(lambda n: n == STEPS[-1], MISTAKES["all signs are reversed"])
    assert "it looks as if all signs are reversed" in shaken(SCENES["drag"], only_fine).words


@pytest.mark.parametrize("part", [0, 1], ids=["displacement", "velocity"])
def test_what_is_not_a_number_is_wrong(part: int) -> None:
    def missing(ask: Ask, tiny: TinyScene) -> tuple[Vector, Vector]:
        both = [np.array(one) for one in right(ask, tiny)]
        both[part][-1] = np.nan
        return both[0], both[1]

    found = shaken(SCENES["drag"], missing)
    assert (found.answered, found.words) == (Answered.WRONG, "wrong by nan of the largest value")


def test_a_scheme_is_held_to_the_order_that_it_claims_for_the_scene() -> None:
    lowered = dataclasses.replace(ALL, lowered={Term.DRAG: Method.FIRST_ORDER})
    drag = SCENES["drag"]
    assert shaken(drag, off_by(1, 0.1), lowered).answered is Answered.RIGHT
    assert shaken(SCENES["bounce"], off_by(1, 0.1), lowered).answered is Answered.WRONG


def test_what_looks_like_nothing_known_is_only_called_wrong() -> None:
    found = shaken(SCENES["bounce"], off_by(0, 0.3))
    assert found.words == "wrong by 0.3 of the largest value"


@pytest.mark.parametrize(
    ("status", "answered"), [(Status.REFUSED, Answered.REFUSED), (Status.DIVERGED, Answered.FAILED)]
)
def test_what_did_not_run_says_why(status: Status, answered: Answered) -> None:
    runs = [Run(status, "for a reason")]
    assert judged(ALL, SCENES["lock"], runs) == CheckResult(
        answered, f"{status.value}: for a reason"
    )


def test_what_skids_yields_and_stops_at_outputs_and_is_told_so_at_every_step() -> None:
    """At a tenth and four tenths of the run, where no step ends within a phase."""
    tiny = SCENES["skid"]
    _, speed = tiny.motion(tiny.duration * np.array([0.1, 0.4 - 1e-6, 0.4, 0.4 + 1e-6]))
    way = speed @ friction.ACROSS
    law = tiny.scene.contact
    assert way[0] == pytest.approx(np.cos(friction.SLIPS), rel=1e-9)
    assert law.mu * friction.PRESSED == pytest.approx(
        MASS * friction.RATE * np.sin(friction.SLIPS), rel=1e-9
    )
    assert way[1] > 0.0 > way[3]
    assert way[2] == pytest.approx(0.0, abs=1e-5)
