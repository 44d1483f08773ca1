"""Claims about the confined unit: sliding is read from the bonds that slide first."""

from pathlib import Path
from typing import cast

import pytest

from adapters.dem import ADAPTER
from cases.bonds.confined_strength import CASE
from cases.bonds.parts import _open_base
from vv.ask import Knobs, Method
from vv.case import Exact, Ladder, Level, Scalar

WEAK = {"fx": 5.0, "mu_p": 0.21, "fs0": 14.0, "eta": 4.0}


def test_weak_bonds_are_seen_to_slide_where_they_do(tmp_path: Path) -> None:
    """The extrapolation of shear over strength, which is curved, once had errors of 1.5e-5 in P."""
    trial = CASE.declare("two", {**CASE.defaults("two"), **WEAK})
    ask = cast(Ladder, trial.study).ask(Knobs(dt=4e-8))
    (run,) = ADAPTER.run([ask], "default", tmp_path, 0.0)
    judged = [one for one in trial.quantities if isinstance(one, Scalar) and one.reference]
    assert [one.observe(run) for one in judged] == pytest.approx(
        [one.reference for one in judged], rel=1e-6
    )


@pytest.mark.parametrize(
    "given", [{}, {"eta": 20.0}, {"rate": -120.0}, {"ks": 4.39e6, "mu_p": 0.554}]
)
def test_what_viscosity_leaves_is_that_of_a_load_on_the_base(
    given: dict[str, float], tmp_path: Path
) -> None:
    """Over twice the square of viscosity and rate, and on bonds that slide late."""
    trial = CASE.declare("two", {**CASE.defaults("two"), **given})
    (run,) = ADAPTER.run([cast(Ladder, trial.study).ask(Knobs(dt=4e-8))], "default", tmp_path, 0.0)
    for one in (it for it in trial.quantities if it.name.startswith("C_u")):
        assert isinstance(one, Scalar)
        assert isinstance(one.judge, Exact)
        assert isinstance(one.reference, float)
        error = abs(one.observe(run) / one.reference - 1.0)
        assert 0.35 < error / one.judge.tolerance(Method.SECOND_ORDER).value < 0.65


@pytest.mark.parametrize(
    "given", [{"eta": 300.0}, {"m": 1.9e-8}, {"eta": 80.0, "rate": -80.0}, {"ks": 8e5}], ids=str
)
def test_failures_far_from_the_usual_parameters_are_within_their_bounds(
    given: dict[str, float], tmp_path: Path
) -> None:
    """Viscosity delays them beyond the strain at rest; light elements need shorter steps."""
    trial = CASE.declare("two", {**CASE.defaults("two"), **given})
    knobs = cast(Ladder, trial.study).rungs[Level.QUICK][0]
    (run,) = ADAPTER.run([cast(Ladder, trial.study).ask(knobs)], "default", tmp_path, 0.0)
    for one in (it for it in trial.quantities if isinstance(it.judge, Exact)):
        assert isinstance(one, Scalar)
        assert isinstance(one.judge, Exact)
        error = abs(one.observe(run) / cast(float, one.reference) - 1.0)
        assert error < one.judge.tolerance(Method.SECOND_ORDER).at(knobs), one.name


def test_units_that_are_pulled_are_refused() -> None:
    with pytest.raises(ValueError, match=r"rate = 30\.0 1/s; it must be negative where they are"):
        CASE.declare("two", {**CASE.defaults("two"), "rate": 30.0})


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"fs0": 11.3, "mu_p": 0.17}, "bonds slide below the pressure that opens the base"),
        (
            {"fs0": 10.4, "mu_p": 0.36, "ks": 1.04e7, "eta": 2.0},
            "the oscillation after the base opens loads",
        ),
    ],
)
def test_bonds_that_slide_as_the_base_opens_are_refused(
    changes: dict[str, float], why: str
) -> None:
    with pytest.raises(ValueError, match=rf"fx = 8\.0 N, of which one unit bears .*{why}"):
        CASE.declare("two", {**CASE.defaults("two"), **changes})


SWINGS = {"kn": 9e7, "m": 1.9e-6}


@pytest.mark.parametrize(
    ("given", "sound"),
    [
        (SWINGS | {"eta": 2.0}, True),
        (SWINGS | {"eta": 1.5}, False),
        (SWINGS | {"fs0": 24.0, "eta": 2.0}, True),
        (SWINGS | {"fs0": 24.0, "eta": 1.5}, False),
    ],
    ids=["nearly slides", "slides", "nearly opens", "opens"],
)
def test_bonds_fail_in_the_swing_of_an_open_base_where_parameters_are_refused(
    given: dict[str, float], sound: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without the refusal dem finds another strength; a little more viscosity, and it agrees."""
    parameters = {**CASE.defaults("two"), **given}
    if not sound:
        with pytest.raises(ValueError, match="the oscillation after the base opens"):
            CASE.declare("two", parameters)
        monkeypatch.setattr(_open_base, "require_sound", lambda *_: None)
    trial = CASE.declare("two", parameters)
    (run,) = ADAPTER.run([cast(Ladder, trial.study).ask(Knobs(dt=2e-8))], "default", tmp_path, 0.0)
    bare = trial.quantities[0]
    assert isinstance(bare, Scalar)
    assert isinstance(bare.judge, Exact)
    error = abs(bare.observe(run) / cast(float, bare.reference) - 1.0)
    assert (error < bare.judge.tolerance(Method.SECOND_ORDER).value) == sound
