"""Claims about impacts with partial slip: two routes agree, limits and conservation laws hold."""

import math

import pytest

from reference_solutions.checks.impact import micro_slip as second
from reference_solutions.checks.impact.rebound import Strike
from reference_solutions.impact import hertz, micro_slip, rebound
from reference_solutions.impact.micro_slip import rebound as in_part
from reference_solutions.impact.rebound import WALL, After, Law, Sphere

RADIUS, SPEED, MU = 0.0025, 3.9, 0.092
BALL = Sphere(RADIUS, 4000 * 4.0 / 3.0 * math.pi * RADIUS**3)
LAW = Law(
    hertz.normal_factor(modulus=6.18e10, radius=RADIUS),
    hertz.shear_factor(modulus=1.33e10, radius=RADIUS),
    MU,
)
ANGLE = math.degrees(math.atan(1.5 * MU * LAW.K / LAW.S))  # impacts stick at first up to it


def _start(degrees: float) -> dict[str, float]:
    angle = math.radians(degrees)
    return {"vn": SPEED * math.cos(angle), "vt": SPEED * math.sin(angle)}


def _agree(one: Sphere, two: Sphere, start: dict[str, float], law: Law = LAW) -> None:
    strike = Strike(
        law.K, law.S, law.mu, 1.5, 0.0, one.radius, one.mass, two.radius, two.mass
    )  # fmt: skip
    first, other = in_part(law, one, partner=two, **start), second.after(strike, **start)
    speed = math.hypot(start["vn"], start.get("vt", 0.0))
    turn = speed / one.radius
    sizes = (speed, speed, turn, turn, first.lasting, first.lasting)
    for a, b, size in zip(first, other, sizes, strict=True):
        assert a == pytest.approx(b, abs=1e-10 * size)


def _after(degrees: float) -> After:
    return in_part(LAW, BALL, **_start(degrees))


@pytest.mark.parametrize("degrees", [3.0, 15.0, 22.0])
def test_two_routes_agree_on_a_wall(degrees: float) -> None:
    _agree(BALL, WALL, _start(degrees))


def test_two_routes_agree_on_two_spheres_that_spin() -> None:
    start = {"vn": 0.4, "vt": 0.03, "spin": 4.0, "partner_spin": -1.0}
    _agree(Sphere(0.1, 11.3), Sphere(0.2, 90.0), start, Law(2.343e10, 2.8e10, 0.4))


@pytest.mark.parametrize("degrees", [40.0, 60.0, 85.0])
def test_what_slips_throughout_knows_nothing_of_micro_slip(degrees: float) -> None:
    without = rebound.rebound(LAW, BALL, **_start(degrees))
    assert _after(degrees).tangential == pytest.approx(without.tangential, rel=1e-11)


@pytest.mark.parametrize("degrees", [0.01, 0.1])
def test_with_hardly_any_slip_it_is_mindlins_stiffness_by_increments(degrees: float) -> None:
    """At any angle the edge of the contact slips, in a share that decreases with the angle."""
    with_it, without = _after(degrees), rebound.rebound(LAW, BALL, **_start(degrees))
    start = _start(degrees)["vt"]
    assert abs(with_it.tangential - without.tangential) / start < 0.25
    assert abs(_after(degrees).tangential / start - _after(0.5 * degrees).tangential / (
        0.5 * start)) < 0.02 * degrees / 0.1  # fmt: skip


@pytest.mark.parametrize("degrees", [2.0, ANGLE - 0.01, ANGLE + 0.01, 20.0])
def test_angular_momentum_about_the_contact_is_kept_but_for_the_arm(degrees: float) -> None:
    start, end = _start(degrees), _after(degrees)
    lost = BALL.mass * RADIUS * (start["vt"] - end.tangential)
    gained = 0.4 * BALL.mass * RADIUS**2 * end.spin
    assert lost == pytest.approx(gained, rel=0.01)


def test_impacts_that_begin_stuck_join_those_that_begin_to_slip() -> None:
    below, above = (_after(ANGLE + more) for more in (-1e-7, 1e-7))
    assert below.tangential == pytest.approx(above.tangential, rel=1e-7)


def test_a_contact_that_changes_too_often_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(micro_slip, "MOST", 0)
    with pytest.raises(RuntimeError, match="changed more than 0 times"):
        in_part(LAW, BALL, vn=1.25)


def test_a_law_without_hertz_or_with_losses_is_refused() -> None:
    with pytest.raises(ValueError, match="micro-slip is known for Hertz"):
        in_part(Law(1e6, 1e6, 0.1, 1.0), BALL, vn=1.0)
    with pytest.raises(ValueError, match="z = h = 0"):
        in_part(Law(1e6, 1e6, 0.1, z=0.1), BALL, vn=1.0)
