"""Claims that the in-house codes know no unit: in others of length, time or mass, answers stay.

Units that are powers of two change no rounding, so that not one bit may differ; a tolerance in m,
s or kg would make it. Millimetres, grams and milliseconds round the numbers of a scene anew: what
comes of that is known from units near metre, second and kilogram that round them anew, too, but
move no such tolerance by much. Units that differ by roundings alone would not do: they leave what
is a power of two as it is, and places of corners with it.
"""

from __future__ import annotations

from collections import defaultdict
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from tests.adapters.test_metamorphic import SCHEMES, ran
from tests.scenes.blocks.block_scenes import HELD, incline
from tests.scenes.metamorphic import in_units
from vv.ask import (
    Ask,
    Displacement,
    History,
    Knobs,
    Observable,
    Reaction,
    Run,
    Status,
    Strain,
    Velocity,
)
from vv.engines import rigid
from vv.engines.rigid.limits import GRAINS
from vv.plan.project import find
from vv.scene import Scene, Vector

PROJECT = find(Path(__file__))
OWN = [label for label in SCHEMES if label.split("/")[0] in ("exact", "dem", "dda", "rigid")]
SIZES = (2.0**-10, 2.0**10)
UNITS = [
    tuple(size if k == unit else 1.0 for k in range(3)) for unit in range(3) for size in SIZES
] + [(2.0**-8, 2.0**5, 2.0**9)]
WORDS = [f"length x {u[0]:g}, time x {u[1]:g}, mass x {u[2]:g}" for u in UNITS]
COARSE, FINE = Knobs(1e-3, 1e9), Knobs(1e-4, 1e9)
SCENES = {
    "single-contact:T2": (Knobs(1e-3), 400),
    "bounce:pair": (Knobs(2e-5), 600),
    "unlike-bonds:hung": (Knobs(1e-4), 200),
    "hertz-impact:glass": (Knobs(2e-7), 300),
    "incline:newmark-30": (FINE, 6000),
    "responding-block:2d": (FINE, 1500),
    "responding-block:3d-turning": (COARSE, 200),
    "slow-slide:slope": (FINE, 160),
    "shaken-wedge:level": (COARSE, 300),
    "rocking:released": (COARSE, 400),
    "tumbling:corner": (COARSE, 200),
    "painleve:mu-1.34": (FINE, 300),
    "standing:arch": (COARSE, 50),
    "damped-swing:unresolved": (Knobs(2e-2, 1e6), 100),
    "elastic-block:pressed": (COARSE, 200),
    "failure-modes:3d-40": (COARSE, 20),  # many blocks, which take Newton steps
}
SETTLES = "dda/published"  # it lets blocks settle for 2 s, whatever a second is
LAGS = "dda/lagged"  # its open-close iterations need not end, and rounding may decide where they do
EPS = float(np.finfo(float).eps)
DECIMAL = (1e3, 1e3, 1e3)  # in mm, ms and g
ROUNDED_ANEW = [(1.1, 0.9, 1.3), (0.7, 1.3, 1.1), (1.3, 1.1, 0.9)]  # m, s and kg, or nearly so


def scene_of(name: str) -> Scene:
    """The scene of a variant."""
    case, variant = name.split(":")
    found = PROJECT.load_case(case)
    return found.declare(variant, found.defaults(variant)).study.scene


AT_REST = {
    "a point mass on a slope": incline(20, 25, free_spin=HELD),
    "a cube on a slope": incline(20, 25),
    "a stack of ten": scene_of("standing:stack-10"),
}


def asked(name: str) -> Ask:
    """What a case asks, for so many steps of its own."""
    case, variant = name.split(":")
    (knobs, steps), found = SCENES[name], PROJECT.load_case(case)
    study = found.declare(variant, found.defaults(variant)).study
    assert knobs.dt is not None
    goal = History(steps * knobs.dt, steps * knobs.dt / 10)
    return Ask(study.scene, goal, study.observables, knobs)


def unit_of(what: Observable, units: tuple[float, ...]) -> float:
    """What a value is multiplied by in these units."""
    length, time, mass = units
    kinds = {
        Displacement: length,
        Velocity: length / time,
        Reaction: mass * length / time**2,
        Strain: 1.0,
    }
    return kinds[type(what)]


def values(run: Run, units: tuple[float, ...]) -> dict[Observable, Vector]:
    """What was observed, in the units of the scene that was not changed."""
    return {what: value / unit_of(what, units) for what, value in run.values.items()}


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("label", OWN)
def test_other_units_change_no_bit(label: str, name: str, tmp_path: Path) -> None:
    here = asked(name)
    tried = [here, *(in_units(here, units) for units in UNITS)]
    one, *others = ran(*SCHEMES[label], tried, tmp_path)
    if one.status is Status.REFUSED:
        pytest.skip(one.reason)
    assert one.status is Status.RAN, one.reason
    seen = zip(WORDS, UNITS, others, strict=True)
    for words, units, other in seen:
        if label == SETTLES and units[1] != 1.0:
            continue
        assert other.status is Status.RAN, (words, other.reason)
        for what, value in values(other, units).items():
            assert np.array_equal(value, one.values[what]), words


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("label", [one for one in OWN if one not in (SETTLES, LAGS)])
def test_decimal_units_change_no_more_than_rounding_does(
    label: str, name: str, tmp_path: Path
) -> None:
    here = asked(name)
    tried = [here, *(in_units(here, units) for units in (DECIMAL, *ROUNDED_ANEW))]
    one, other, *controls = ran(*SCHEMES[label], tried, tmp_path)
    if one.status is Status.REFUSED:
        pytest.skip(one.reason)
    assert one.status is other.status is Status.RAN, (one.reason, other.reason)
    rounded = max(
        apart(one, control, units) for control, units in zip(controls, ROUNDED_ANEW, strict=True)
    )
    assert apart(one, other, DECIMAL) <= max(1e-12, 30 * EPS * _places(here, one), 30 * rounded)


@pytest.mark.shows("In other units it moves alike, to 1e-12")
@pytest.mark.parametrize(
    "units", [DECIMAL, (1e3, 1.0, 1.0), (1.0, 1e3, 1.0), (1.0, 1.0, 1e3), *ROUNDED_ANEW]
)
def test_rigid_bears_a_wedge_in_a_groove_of_1e_6_rad_alike_in_all_units(
    units: tuple[float, float, float],
) -> None:
    """To 1e-12, since its contacts are given by normals, which no unit rounds.

    Velocities of each of the 100 steps are refined until they change by GRAINS (2e-15) of the
    largest, which two runs may add up to 3.6e-13. Roundings of a contact's impulse, 1e-11 of the
    speed and 1e6 times as much out of the groove, are no part of it.
    """
    case = PROJECT.load_case("wedge")
    study = case.declare("xi-1e-06", case.defaults("xi-1e-06")).study
    here = study.ask(Knobs(1e-2, 1e9))
    one, other = (rigid.solve(ask) for ask in (here, in_units(here, units)))
    assert one.status is other.status is Status.RAN
    assert apart(one, other, units) <= 2 * here.goal.steps(1e-2) * GRAINS


@pytest.mark.parametrize("units", [(1.0, 1.0, 1.0), DECIMAL, *ROUNDED_ANEW])
def test_a_wedge_in_a_groove_of_1e_6_rad_slides_as_exact_arithmetic_has_it(
    units: tuple[float, float, float],
) -> None:
    """Of the scene's normals, friction and gravity as they are rounded, in fractions.

    The bound is that between units for one run, and 4 eps for rounding of gravity and friction,
    whose effects cancel to half.
    """
    case = PROJECT.load_case("wedge")
    study = case.declare("xi-1e-06", case.defaults("xi-1e-06")).study
    ask = in_units(study.ask(Knobs(1e-2, 1e9)), units)
    (moved,) = rigid.solve(ask).values.values()
    wall, along = ask.scene.walls[0], ask.scene.axes[0]
    out = [Fraction(float(x)) for x in ask.scene.axes[2]]
    pull = [Fraction(float(x)) for x in ask.scene.gravity]
    lean = sum(Fraction(float(n)) * o for n, o in zip(wall.normal, out, strict=True))
    pressed = -sum(g * o for g, o in zip(pull, out, strict=True)) / lean  # by both sides, per mass
    down = sum(g * Fraction(float(e)) for g, e in zip(pull, along, strict=True))
    gained = down - Fraction(ask.scene.contact.mu) * pressed
    way = float(gained * Fraction(ask.goal.duration) ** 2 / 2)
    assert abs(moved[-1] @ along / way - 1.0) <= ask.goal.steps(ask.dt) * GRAINS + 4 * EPS


def apart(one: Run, other: Run, units: tuple[float, ...]) -> float:
    """How far a run in other units is off, over the largest value of each kind."""
    there = values(other, units)
    off: dict[type[Observable], float] = defaultdict(float)
    most: dict[type[Observable], float] = defaultdict(float)
    for what, value in one.values.items():
        kind = type(what)
        off[kind] = max(off[kind], float(np.abs(value - there[what]).max()))
        most[kind] = max(most[kind], float(np.abs(value).max()))
    return max(off[kind] / (most[kind] or 1.0) for kind in off)


def _places(ask: Ask, run: Run) -> float:
    """How far out a body lies, over the largest displacement."""
    places = [ask.scene.spheres.position, *(block.vertices for block in ask.scene.blocks)]
    moved = [np.abs(u).max() for what, u in run.values.items() if isinstance(what, Displacement)]
    return float(max(np.abs(place).max() for place in places if len(place)) / (max(moved) or 1.0))


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("which", [0, 1, 2], ids=("length", "time", "mass"))
@pytest.mark.parametrize("name", AT_REST)
def test_the_floor_bears_what_rests_on_it_in_any_unit(name: str, which: int, unit: float) -> None:
    units = tuple(unit if k == which else 1.0 for k in range(3))
    ask = in_units(Ask(AT_REST[name], History(0.1, 0.01), (Displacement(1),), Knobs(1e-3)), units)
    program = rigid.prepare(ask)
    assert program.run(program.solve()).status is Status.RAN
    weight = sum(block.mass for block in ask.scene.blocks) * ask.scene.gravity
    borne = program.reactions[1:].sum(axis=1) + weight
    assert np.abs(borne).max() <= 1e-9 * np.linalg.norm(weight)
