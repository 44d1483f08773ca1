"""Claims that bounds follow the parameters: correct codes pass at unusual parameters too."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bench.chance.holdouts import Draw, judged
from vv.ask import Knobs
from vv.case import Level, Search, Series
from vv.plan.project import find
from vv.records.checking import checked
from vv.records.outcomes import Verdict
from vv.records.record import measured

PROJECT = find()
LONG = {"m": 1.06, "kn": 1.03e6, "eta": 13.0, "g": 9.94, "height": 0.00229}
STRONG = {
    "kn": 4.29e7, "ks": 9.15e6, "xb": 1.22e-7, "fs0": 25.4, "mu_p": 0.537, "d": 0.000915,
    "m": 1.96e-6, "eta": 7.26, "rate": -10.3,
}  # fmt: skip
NEAR_A_SWING = {"rho": 1700.0, "G": 3.1e8, "F": 4.3}
SHAKEN = {"D": 0.196, "f": 6.55, "mu": 0.729, "g": 9.61, "duration": 22.7}
LONG_TUMBLE = {"w": 1.38, "height": 0.75, "V": 0.194, "duration": 2.04}
WEAK = {
    "kn": 6.28e7, "ks": 5.31e6, "xb": 1.58e-7, "fs0": 14.6, "mu_p": 0.5, "d": 0.00125,
    "m": 2.44e-6, "eta": 4.42, "rate": -6.99,
}  # fmt: skip
SLOWED = {"fs0": 11.2, "mu_p": 0.554, "d": 0.00138, "eta": 8.11, "rate": -24.6}


@pytest.mark.parametrize(
    ("code", "case", "variant", "given", "knobs"),
    [
        ("rigid", "wedge", "xi-1e-06", {"dip": 55.3, "held": 1.21, "m": 1180}, Knobs(1e-2)),
        ("dem", "at-yield", "above", {"f": 3.1, "g": 6.0}, Knobs(2.5e-4, 1e9)),
        ("dda", "laden-block", "turning", {"alpha": 20.0, "v": 2.0}, Knobs(1e-4, 1e9)),
        ("dem", "laden-block", "level", {"duration": 0.02}, Knobs(5e-4, 1e8)),
        ("dda", "laden-block", "turning", {"a": 2.5, "press": 4.0}, Knobs(1e-3, 1e8)),
        ("dem", "resting", "knocked", {"mu": 0.6}, Knobs(2e-4)),
        ("dem", "resting", "knocked", {"mu": 0.0}, Knobs(2e-4)),
        ("dem", "resting", "held", {"mu": 0.1}, None),
        ("dem", "close-packed-failure", "82", {"d": 0.003}, Knobs(8e-8)),
        ("dem", "close-packed-energy", "pulled-82", {"d": 2e-5}, Knobs(8e-8)),
        ("dem", "close-packed-strength", "pulled-82", {"kn": 14038149.0}, Knobs(4e-8)),
        ("dem", "close-packed-strength", "pulled-82", {"ks": 24203706.0}, Knobs(4e-8)),
        ("dem", "bounce", "held", {"ks": 3e10}, None),
        ("dem", "bounce", "pair", {"ks": 3.2e7}, None),
        ("dem", "settling", "drop", LONG, Knobs(2.5e-5)),
        ("rigid", "tumbling", "corner", {"w": 1.21, "height": 0.781, "V": 0.186}, None),
        ("dem", "confined-strength", "two", SLOWED, None),
        ("dem", "tetrahedral-strength", "pressed", STRONG, None),
        ("dem", "tetrahedral-strength", "pressed", WEAK, None),
        ("dem", "packing", "seed-1", {"m": 0.0178, "eta": 0.12}, None),
        ("rigid", "tumbling", "corner", {"w": 1.71}, None),
        ("rigid", "tumbling", "corner", LONG_TUMBLE, None),
        ("rigid", "wedge", "xi-1e-06", {"xi": 9.21e-7, "g": 4.33}, Knobs(1e-2)),
        ("dda", "shaken-wedge", "level", {"dip": 33.2, "xi": 1.18, "A": 1.92}, Knobs(1e-3, 1e9)),
        ("dda", "shaken-wedge", "along", {"dip": 33.2, "xi": 1.18, "A": 1.92}, Knobs(1e-3, 1e9)),
        ("dda", "shaken-wedge", "along", {"phi": 0.0}, Knobs(1e-3, 1e9)),
        ("dda", "masonry", "slides", {"f": 3.18, "duration": 0.451}, Knobs(1e-3, 1e9)),
        ("rigid", "responding-block", "3d", {"mu": 3.01}, Knobs(1e-3)),
        ("rigid", "responding-block", "2d", {"mu": 8.31}, Knobs(1e-3)),
        ("dda", "elastic-block", "pressed", {"L": 0.1}, None),
        ("dda", "elastic-block", "spun", {"a": 6.0}, Knobs(1.44337567297e-6, 9e14)),
        ("dda", "elastic-block", "spun", {"spin": 50.0}, None),
        ("rigid", "shaken-fast", "5hz", {"f": 0.5}, Knobs(5e-4)),
        ("dda/generalised-alpha", "elastic-block", "coupled", {"b": 0.15}, None),
        ("dem/published", "at-yield", "above", {"phi": 2.0}, Knobs(1e-3, 1e8)),
        ("rigid", "slow-slide", "slope", {"v0": 2e-3}, None),
        ("rigid", "slow-slide", "level", {"mu": 0.003, "v0": 0.001}, None),
        ("dda", "shear-wave", "5", {"H": 2.0}, Knobs(2.5e-4, 1e12)),
        ("dda", "shear-wave", "5", {"D": 0.1}, Knobs(2.5e-4, 1e12)),
        ("dda", "shear-wave", "20", NEAR_A_SWING, Knobs(1e-4, 1e12)),
        ("rigid", "shaken-fast", "5hz", SHAKEN, Knobs(5e-4)),
        ("rigid", "rocking", "threshold", {"part": 1.02}, None),
        ("dem", "single-contact", "T1", {"r": 1e9}, Knobs(5e-4)),
        ("dem", "single-contact", "T4", {"r": 1e9}, Knobs(5e-4)),
        ("dem", "single-contact", "T4", {"mu": 1e9}, Knobs(5e-4)),
    ],
)
def test_a_code_that_is_right_is_within_its_bounds(
    code: str, case: str, variant: str, given: dict[str, float], knobs: Knobs | None, tmp_path: Path
) -> None:
    name, _, asked = code.partition("/")
    made, adapter = PROJECT.load_case(case), PROJECT.load_adapter(name)
    trial = made.declare(variant, {**made.defaults(variant), **given})
    study, scheme = trial.study, next(one for one in adapter.schemes if asked in ("", one.name))
    ask = study.ask(knobs or next(iter(study.rungs.values()))[0])
    run = checked(next(adapter.run([ask], scheme.name, tmp_path, 0.0)), ask)
    method = scheme.method_for(study.scene.terms())
    verdicts = {q.name: measured(run, q, method, ask.knobs)[0].verdict for q in trial.quantities}
    assert Verdict.PASS in verdicts.values()
    assert Verdict.FAIL not in verdicts.values(), verdicts


@pytest.mark.parametrize("eta", [3e7, 3e8, 9e8])
def test_a_search_reaches_beyond_both_limits_at_any_drag(eta: float) -> None:
    made = PROJECT.load_case("stable-step")
    p = {**made.defaults("viscous"), "eta": eta}
    study = made.declare("viscous", p).study
    assert isinstance(study, Search)
    middle = 2.0 * (p["m"] / p["ks"]) ** 0.5
    assert study.dt * study.bracket.span > 1.3 * middle


@pytest.mark.parametrize(
    "case", ["close-packed-lattice:82", "close-packed-path:in-82", "close-packed-energy:pulled-82"]
)
@pytest.mark.parametrize(("given", "shorter"), [({"kn": 9.4e7}, 2), ({"m": 4e-7}, 4), ({}, 1)])
def test_steps_are_shorter_where_bonds_swing_faster(
    case: str, given: dict[str, float], shorter: int
) -> None:
    name, _, variant = case.partition(":")
    made = PROJECT.load_case(name)
    usual = made.defaults(variant)
    changed, due = (made.declare(variant, {**usual, **p}).study for p in (given, {}))
    dt, longest = (study.rungs[Level.QUICK][0].dt or 0.0 for study in (changed, due))
    assert dt == pytest.approx(longest / shorter, rel=1e-15)


@pytest.mark.parametrize(
    "given",
    [
        {"w": 1.17, "height": 1.02, "V": 0.242, "duration": 1.96},
        {"w": 1.15, "height": 0.781, "V": 0.168, "duration": 2.11},  # by outputs on whole steps
    ],
)
def test_a_block_that_lands_as_its_run_ends_is_refused(given: dict[str, float]) -> None:
    made = PROJECT.load_case("tumbling")
    path = made.declare("corner", {**made.defaults("corner"), **given}).quantities[0]
    assert isinstance(path, Series)
    assert path.reference is not None
    with pytest.raises(ValueError, match="too near one end for two outputs"):
        path.reference(np.zeros(1))


@pytest.mark.parametrize(
    ("case", "variant", "settings", "codes"),
    [
        ("laden-block", "turning", ("mu=3", "v=66"), "dda/published,dda/lagged"),
        ("laden-block", "turning", ("mu=3.5", "v=300"), "dda/published"),  # spins and grows
        ("rocking", "threshold", ("b=0.006",), "dda/lagged"),
        ("responding-block", "3d", ("fz=0.3",), "dem/published"),
    ],
)
def test_what_is_right_or_known_at_other_parameters_is_not_red(
    case: str,
    variant: str,
    settings: tuple[str, ...],
    codes: str,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    monkeypatch.setenv("VV_DATA", str(tmp_path))
    assert judged(PROJECT, Draw(case, variant, settings), codes) == ("green", [])
