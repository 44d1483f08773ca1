"""Claims about a wedge under a sine: two routes agree, also where it slides upwards."""

import math
from types import ModuleType

import pytest

from reference_solutions.checks.hard import shaken_wedge as stepped
from reference_solutions.hard import shaken_wedge
from tests.support.turned_signs import caught, signs, turned
from vv.plan.project import find

MU = math.tan(math.radians(20.0))
LAWS = [
    {"dip": 30.0, "xi": math.pi / 2, "mu": MU, "A": 2.0, "f": 1.0, "g": 9.81},
    {"dip": 30.0, "xi": 1.5, "mu": 0.45, "A": 6.0, "f": 1.0, "g": 9.81},
    {"dip": 20.0, "xi": 2.0, "mu": 0.2, "A": 12.0, "f": 1.3, "g": 5.0},
    {"dip": 10.0, "xi": 2.0, "mu": 0.3, "A": 8.0, "f": 1.0, "g": 9.81},
]


def apart(
    route: ModuleType, second: ModuleType = stepped, steps: int = 20_000, laws: slice = slice(4)
) -> float:
    """The largest difference [m] of the two routes after 2 s, in which the wedge slides metres."""
    off = []
    for law in LAWS[laws]:
        for level, way in ((False, route.along), (True, route.level)):
            s = float(way([2.0], **law)[0])
            off.append(second.slid(2.0, level=level, steps=steps, **law) - s)
    return float(max(map(abs, off)))


def test_the_two_routes_agree() -> None:
    assert apart(shaken_wedge, laws=slice(3)) < 1e-5
    assert apart(shaken_wedge, laws=slice(3, 4)) < 1e-4  # reversals are of first order


def test_a_right_angle_gives_what_was_seen() -> None:
    (s,) = shaken_wedge.along([3.0], **LAWS[0])
    assert s == pytest.approx(3.3488831, abs=1e-7)


@pytest.mark.parametrize("sign", signs(shaken_wedge))
def test_any_wrong_sign_is_caught(sign: int) -> None:
    assert caught(lambda: apart(turned(shaken_wedge, sign), steps=2000) < 1e-3)


@pytest.mark.parametrize("sign", signs(stepped, without=("n + 1",)))
def test_any_wrong_sign_in_the_second_route_is_caught(sign: int) -> None:
    assert caught(lambda: apart(shaken_wedge, turned(stepped, sign), steps=2000) < 1e-3)


def test_a_wedge_that_friction_holds_is_refused_in_words() -> None:
    case = find().load_case("shaken-wedge")
    with pytest.raises(
        ValueError, match=r"phi = 35.0 degrees; friction in the groove, 1.027, hold"
    ):
        case.declare("along", {**case.defaults("along"), "phi": 35.0})
