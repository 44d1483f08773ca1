"""Claims about bounds derived from the step and the parameters: an answer a bit off is outside."""

import dataclasses

import pytest

from tests.findings.figures import PROJECT, asked
from tests.support.installed import require
from vv.ask import Knobs, Method
from vv.case import Exact
from vv.records.outcomes import Verdict
from vv.records.record import measured

FINE = Knobs(1e-4, 1e10)
SEEN = [  # case, quantity, scheme, setting, and by which part all that is observed is larger
    ("shaken-wedge:along", "s", "rigid/default", FINE, 1e-7),
    ("shaken-wedge:level f=0.4 duration=2", "s", "rigid/default", FINE, 1e-7),
    ("shaken-wedge:along", "s", "dda/augmented-lagrangian", FINE, 1e-6),
    ("responding-block:3d", "d2z", "rigid/default", FINE, 3e-10),
    ("responding-block:3d fz=0.5", "d2z", "dda/augmented-lagrangian", FINE, 3e-10),
    ("responding-block:3d D=0.01", "d2y", "rigid/default", FINE, 3e-5),
    ("responding-block:1d-mu-0.1", "d2x", "dda/augmented-lagrangian", FINE, 2e-6),
    ("painleve:mu-0.8", "x", "dda/augmented-lagrangian", Knobs(1e-3, 1e8), 2e-5),
    ("painleve:mu-0.8 mu=0.6", "x", "dda/augmented-lagrangian", Knobs(1e-3, 1e8), 2e-6),
    ("painleve:mu-2", "x", "rigid/default", Knobs(1e-3, 1e8), 3e-6),
    ("slow-slide:held", "s", "rigid/default", None, 3e-11),
    ("wedge:xi-0.1", "s", "rigid/default", Knobs(1e-2, 1e9), 5e-11),
    ("laden-block:level", "slip", "dda/default", Knobs(1e-3, 1e8), 1e-4),
    ("masonry:rest", "borne", "rigid/default", Knobs(1e-3, 1e9), 3e-7),
]


@pytest.mark.parametrize(("name", "quantity", "scheme", "at", "more"), SEEN)
def test_an_answer_a_bit_off_is_seen(
    name: str, quantity: str, scheme: str, at: Knobs | None, more: float
) -> None:
    require(PROJECT.load_adapter(scheme.partition("/")[0]))
    one = asked(name, scheme, at)
    wanted = next(it for it in one.trial.quantities if it.name == quantity)
    method = one.scheme.method_for(one.ask.scene.terms())
    larger = {what: (1.0 + more) * values for what, values in one.run.values.items()}
    verdicts = [
        measured(run, wanted, method, one.ask.knobs, True)[0].verdict
        for run in (one.run, dataclasses.replace(one.run, values=larger))
    ]
    assert verdicts == [Verdict.PASS, Verdict.FAIL]


@pytest.mark.parametrize("strain", [-1e-3, -1e-4, 5e-3])
def test_moduli_on_the_path_lag_by_two_parts_in_five_hundred_of_the_strain(strain: float) -> None:
    case = PROJECT.load_case("close-packed-path")
    trial = case.declare("in-82", {**case.defaults("in-82"), "strain": strain})
    for quantity in trial.quantities[:-1]:
        assert isinstance(quantity.judge, Exact)
        bound = quantity.judge.tolerance(Method.LEAPFROG)
        assert bound.at(Knobs(1e-7)) == pytest.approx(2 / 500 * abs(strain), rel=1e-12)
