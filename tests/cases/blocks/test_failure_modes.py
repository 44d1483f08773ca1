"""Claims about the chart of failure modes: its points, and that a wrong friction is detected."""

import dataclasses

import pytest

from reference_solutions.blocks import first_motion
from vv.ask import Method, Run
from vv.case import Level, Trial
from vv.engines import rigid
from vv.plan.project import find
from vv.records.record import measured
from vv.scene import Contact

CASE = find().load_case("failure-modes")


def verdicts(trial: Trial, run: Run) -> dict[str, str]:
    rung = trial.study.rungs[Level.QUICK][0]
    found = (measured(run, q, Method.SECOND_ORDER, rung)[0] for q in trial.quantities)
    return {one.name: one.verdict.value for one in found}


def moved(trial: Trial, mu: float = 1.0) -> Run:
    """The run of `rigid` with `mu` times the friction."""
    ask = trial.study.ask(trial.study.rungs[Level.QUICK][0])
    law = Contact(ask.scene.contact.kn, mu=mu * ask.scene.contact.mu)
    return rigid.solve(
        dataclasses.replace(ask, scene=dataclasses.replace(ask.scene, contact=law))
    )  # fmt: skip


@pytest.mark.parametrize("variant", ["2d-30", "gravity-32"])
def test_rigid_moves_at_every_point_as_the_chart_says(variant: str) -> None:
    trial = CASE.declare(variant, CASE.defaults(variant))
    assert set(verdicts(trial, moved(trial)).values()) == {"pass"}


def test_five_per_cent_more_friction_misses_modes_beside_the_borders() -> None:
    trial = CASE.declare("2d-30", CASE.defaults("2d-30"))
    found = verdicts(trial, moved(trial, 1.05))
    assert found["worst"] == found["agree"] == "fail"
    assert 1 < [*found.values()].count("fail") < len(found)


@pytest.mark.parametrize("phi", [1.0, 3.0, 6.0, 17.3, 33.0, 47.0, 69.0, 70.0, 75.0, 80.0, 85.0])
def test_the_chart_can_be_asked_at_any_friction(phi: float) -> None:
    for variant in ("2d-20", "gravity-32"):
        trial = CASE.declare(variant, {**CASE.defaults(variant), "phi": phi})
        names = [quantity.name for quantity in trial.quantities]
        assert len(set(names)) == len(names) >= 16


def test_all_points_of_the_paper_s_charts_are_there() -> None:
    count = {"2d": 0, "3d": 0, "gravity": 0}
    for variant in CASE.variants:
        if variant.name.endswith("-short"):
            continue  # the points of another variant, at shorter steps
        trial = CASE.declare(variant.name, CASE.defaults(variant.name))
        count[variant.name.partition("-")[0]] += len(trial.quantities) - 2
    assert count == {"2d": 110, "3d": 88, "gravity": 51}


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [("phi", 0.5, "phi = 0.5 degrees; it must be between 1"),
     ("alpha", 80.0, "alpha = 80.0 degrees; it must be above 0")],
)  # fmt: skip
def test_what_the_chart_does_not_cover_is_refused(name: str, value: float, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        CASE.declare("2d-20", {**CASE.defaults("2d-20"), name: value})


@pytest.mark.parametrize("variant", ["2d-30", "3d-6"])
def test_modes_change_across_every_border_of_the_chart(variant: str) -> None:
    given = CASE.defaults(variant)
    chart = CASE.declare(variant, given).regions
    assert chart is not None
    for border in chart.borders:
        (x, y), (u, v) = border[0], border[1]
        psi, delta = (u, v) if len(border) > 2 else (0.5 * (x + u), 0.5 * (y + v))
        across = (-1e-3, 1e-3) if x == u else (0.0, 0.0)
        down = (0.0, 0.0) if x == u else (-1e-3, 1e-3)
        sides = {
            first_motion.mode(psi=psi + a, phi=given["phi"], delta=delta + b)
            for a, b in zip(across, down, strict=True)
        }
        assert len(sides) == 2
