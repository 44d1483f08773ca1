"""Claims that bounds follow the parameters: a code that is right is right at unusual ones too."""

from __future__ import annotations

from pathlib import Path

import pytest

from vv.ask import Knobs
from vv.case import Search
from vv.plan.project import find
from vv.records.checking import checked
from vv.records.outcomes import Verdict
from vv.records.record import measured

PROJECT = find()


@pytest.mark.parametrize(
    ("code", "case", "variant", "given", "knobs"),
    [
        ("dem", "at-yield", "above", {"f": 3.1, "g": 6.0}, Knobs(2.5e-4, 1e9)),
        ("dda", "laden-block", "turning", {"alpha": 20.0, "v": 2.0}, Knobs(1e-4, 1e9)),
        ("dda", "laden-block", "turning", {"a": 2.5, "press": 4.0}, Knobs(1e-3, 1e8)),
        ("dem", "resting", "knocked", {"mu": 0.6}, Knobs(2e-4)),
        ("dem", "resting", "knocked", {"mu": 0.0}, Knobs(2e-4)),
        ("dem", "resting", "held", {"mu": 0.1}, None),
        ("dem", "close-packed-failure", "82", {"d": 0.003}, Knobs(8e-8)),
        ("dda", "shaken-wedge", "level", {"dip": 33.2, "xi": 1.18, "A": 1.92}, Knobs(1e-3, 1e9)),
        ("dda", "shaken-wedge", "along", {"dip": 33.2, "xi": 1.18, "A": 1.92}, Knobs(1e-3, 1e9)),
    ],
)
def test_a_code_that_is_right_is_within_its_bounds(
    code: str, case: str, variant: str, given: dict[str, float], knobs: Knobs | None, tmp_path: Path
) -> None:
    made, adapter = PROJECT.load_case(case), PROJECT.load_adapter(code)
    trial = made.declare(variant, {**made.defaults(variant), **given})
    study, scheme = trial.study, adapter.schemes[0]
    ask = study.ask(knobs or next(iter(study.rungs.values()))[0])
    run = checked(next(adapter.run([ask], scheme.name, tmp_path, 0.0)), ask)
    method = scheme.method_for(study.scene.terms())
    verdicts = {q.name: measured(run, q, method, ask.knobs)[0].verdict for q in trial.quantities}
    assert Verdict.PASS in verdicts.values()
    assert Verdict.FAIL not in verdicts.values(), verdicts


@pytest.mark.parametrize("eta", [3e7, 3e8, 9e8, 3e9])
def test_a_search_reaches_beyond_both_limits_at_any_drag(eta: float) -> None:
    made = PROJECT.load_case("stable-step")
    p = {**made.defaults("viscous"), "eta": eta}
    study = made.declare("viscous", p).study
    assert isinstance(study, Search)
    middle = 2.0 * (p["m"] / p["ks"]) ** 0.5
    assert study.dt * study.bracket.span > 1.3 * middle
