"""Claims about the numbers of a variant on its page: each is there, and none is rounding."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from vv.ask import Displacement, History, Knobs, Method, Run
from vv.case import (
    Case,
    EnergyAllowance,
    Exact,
    Interval,
    Ladder,
    Level,
    Parameter,
    Scalar,
    Series,
    Source,
    Tolerance,
    Trial,
    Variant,
)
from vv.output.gallery.declared_numbers import numbers
from vv.output.gallery.number_text import fields, gathered, listed
from vv.scene import Contact, Scene, Spheres


def read(run: Run) -> Any:
    raise AssertionError(run)


def falling(spheres: int = 1) -> Case:
    """Spheres that fall, with every kind of number that a variant declares."""

    def declare(variant: str, p: Mapping[str, float]) -> Trial:
        body = Spheres(
            position=np.array([[3.0 * i, 0.0, 2.0] for i in range(spheres)]),
            velocity=np.zeros((spheres, 3)),
            radius=np.full(spheres, 0.5),
            mass=np.full(spheres, 3.0),
            free=np.ones((spheres, 3), bool),
        )
        scene = Scene((body,), Contact(kn=1e6), gravity=np.array([0.0, 0.0, -p["g"]]))
        rungs = {level: (Knobs(0.1), Knobs(0.01))[: level.rank + 1] for level in Level}
        study = Ladder(
            scene, History(2.0, 0.5), (Displacement(0),), rungs, (Knobs(0.02),), cpu_limit=60.0
        )
        second = Tolerance(1e-3, "why", dt=0.1, order=2, floor=1e-9, late=0.25)
        high = Series(
            "high", "z", "m", "m", read, lambda t: 5 * t**2, Exact({Method.SECOND_ORDER: second}),
            scale=7.0,
        )  # fmt: skip
        fast = Scalar("fast", "v", "m/s", "m", read, lambda: 20.0, 4.0, Interval(1.0, 30.0, "why"))
        allowed = EnergyAllowance(8.0, {Method.SECOND_ORDER: Tolerance(1e-6, "why")})
        return Trial(study, (high, fast), allowed)

    return Case(
        "fall", "Fall", Source("", ""), (Parameter("g", 10.0, "m/s2", "gravity"),),
        (Variant("one", "one", "z"),), declare,
    )  # fmt: skip


def test_settings_bounds_answers_and_scene_of_a_variant_are_all_shown() -> None:
    case = falling()
    assert numbers(case, case.variants[0]) == {
        "parameter g": "10",
        "duration": "2 s, output every 0.5 s",
        "settings, quick": "dt 0.1",
        "settings, default": "dt 0.1; dt 0.01",
        "settings, paper": "dt 0.1; dt 0.01",
        "settings, timed": "dt 0.02",
        "limit of CPU time": "60 s",
        "unexplained energy": "scale 8",
        "unexplained energy tolerances second order in dt": "value 1e-06",
        "high, judge tolerances second order in dt": (
            "value 0.001, dt 0.1, order 2, floor 1e-09, late 0.25"
        ),
        "high, scale": "7",
        "high, exact": "0, 5, 20",
        "fast, judge": "low 1, high 30",
        "fast, scale": "4",
        "fast, exact": "20",
        "observed": "displacement of 0",
        "scene, contact kn": "1e+06",
        "scene, gravity": "0, 0, -10",
        "scene, axes": "x 1, 0, 0; y 0, 1, 0; z 0, 0, 1",
        "scene, spheres position": "0, 0, 2",
        "scene, spheres radius": "0.5",
        "scene, spheres mass": "3",
        "scene, spheres inertia": "0.3",
        "scene, spheres free": "1, 1, 1",
    }


@pytest.mark.parametrize(("spheres", "shown"), [(300, True), (301, False)])
def test_an_answer_given_as_a_function_is_worked_out_unless_the_scene_is_large(
    spheres: int, shown: bool
) -> None:
    case = falling(spheres)
    found = numbers(case, case.variants[0])
    assert ("fast, exact" in found) == shown
    assert found["high, exact"] == "0, 5, 20"


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ([1.0, 1e-12, -2.0], "1, 0, -2"),
        ([1.0] * 7, "1 in all"),
        ([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0 + 1e-12], "1 in all"),
        ([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 7.0], "0 to 7, mean 1, root mean square 2.64575"),
        ([-3.0, 3.0, -3.0, 3.0], "-3, 3, -3, 3"),
    ],
)
def test_few_numbers_are_listed_and_many_told_by_range_and_means(
    values: list[float], text: str
) -> None:
    assert listed(np.array(values)) == text


def test_a_part_that_is_small_beside_the_other_parts_of_vectors_is_zero() -> None:
    rows = [[float(i), 1e-17 * i, 2.0] for i in range(3)]
    text = "x 0, 1, 2; y 0, 0, 0; z 2, 2, 2"
    assert [*gathered({"blocks": [{"at": rows, "body": 4}]})] == [("blocks at", text)]


def test_fields_of_frozen_data_are_told_by_their_names_without_prose_and_usual_values() -> None:
    judge = Exact({Method.PENALTY: Tolerance(0.1, "why", kn=1e9, softness=0.5)})
    assert [*fields(judge, "s")] == [
        ("s tolerances penalty contact", "value 0.1, kn 1e+09, softness 0.5")
    ]
    assert [*fields({"a": ((1.0, 2.0), (3.0, 4.0)), "b": ("word",), "c": float("inf")})] == [
        ("a", "1, 2, 3, 4")
    ]
