"""Claims that parameters for which a case has no solution are refused with value and rule."""

from __future__ import annotations

import pytest

from vv.base.errors import UsageError
from vv.plan.planning import declare_trial
from vv.plan.project import find
from vv.plan.settings import parameters_with_settings

PROJECT = find()


@pytest.mark.parametrize(
    ("case", "variant", "given", "words"),
    [
        ("galperin", "31", {"ratio": 73.2}, "is 27.0005, so near a whole number"),
        ("galperin", "31", {"ratio": 233.0, "m": 0.418}, "is 48.0229, so near a whole number"),
        ("galperin", "31", {"m": 1.6}, "overlap the wall by 0.01 m; at most a tenth"),
        ("galperin", "31", {"m": 1.76}, "overlap the wall by 0.0105 m; at most a tenth"),
        ("hertz-impact", "glass", {"v": 200.0}, "it must be below a tenth of the radius, 0.001 m"),
        ("kharaz", "linear", {"ks": 8e8}, "springs swing 12.8 times in a contact; at most 12"),
        ("kharaz", "linear", {"v": 65.0}, "it must be below a tenth of the radius, 0.00025 m"),
        ("oblique-impact", "large-alloy", {"v": 200.0}, "it must be below a tenth of the radius"),
        ("restitution", "linear-limestone", {"v": 100.0}, "it must be below a tenth of the radius"),
        ("single-contact", "T3", {"mu": 1e12}, "an overlap so small is lost"),
        ("single-contact", "T4-free", {"mu": 0.003}, "overlap of 7.352 m must be below a tenth"),
        ("single-contact", "T1", {"v_a": -90.0}, "overlap of 5.647 m must be below a tenth"),
        ("mfix", "dem01", {"kn": 300.0}, "sinks by 0.9427 m; it must be less than the radius"),
        ("long-swing", "bonded", {"v_a": 0.0}, "v_a = 0.0 m/s; the speed must not be 0"),
        ("rocking", "topples", {"duration": 5.0}, "end before the block overturns and slips"),
        ("slow-slide", "level", {"v0": 0.0}, "the block must move, and friction must stop it"),
        ("slow-slide", "slope", {"mu": 0.01}, "the block must move, and friction must stop it"),
        ("stable-step", "undamped", {"mu": 0.0}, "mu = 0.0; it must be positive"),
        ("stable-step", "viscous", {"ks": 0.0}, "ks = 0.0 N/m; it must be positive"),
        ("standing", "arch", {"part": 0.973}, "part = 0.973; it must be above 1"),
        ("standing", "arch-thin", {"part": 1.0}, "part = 1.0; it must be below 1"),
        ("standing", "arch", {"mu": 0.398}, "mu = 0.398; whatever the thrust of an arch"),
        ("standing", "arch-thin", {"mu": 0.4}, "mu = 0.4; whatever the thrust of an arch"),
        ("tetrahedral-strength", "pressed", {"fs0": 6.88}, "of 0.001836, .* below 0.002147"),
        ("tetrahedral-strength", "pressed", {"fs0": 8.0, "m": 1e-5}, "in the wave that follows"),
        (
            "tetrahedral-strength",
            "pulled",
            {"xb": 1.36e-6},
            "inclined bonds slide before they open",
        ),
        ("tetrahedral-strength", "pulled", {"mu_p": 3.17}, "fs0 - mu_p kn xb = -6.82 N"),
        ("tetrahedral-strength", "pressed", {"kn": 3.74e8}, "level bonds slide before they open"),
        ("tetrahedral-unit", "pulled", {"kn": 1e4}, "the unit creeps to rest"),
        ("masonry", "rest", {"mu": 0.3085}, "whatever the thrust of the arch, a joint slides"),
        ("masonry", "slides", {"courses": 13, "mu": 0.481}, "the wall does not move as one block"),
        ("packing", "seed-1", {"eta": 0.0}, "eta = 0.0 N s/m; without drag nothing"),
        ("packing", "seed-1", {"eta": 1e300}, "to come to rest; at most 72 s are run"),
        ("packing", "seed-1", {"eta": 1e-9}, "takes 4.8e\\+08 s to come to rest"),
        ("bounce", "floor", {"r1": 1e-4}, "steps that resolve a contact are 2.28e\\+09; at most"),
        ("bounce", "floor", {"r1": 0.01}, "are 2.28e\\+06; at most 1e\\+06 are run"),
        ("bounce", "pair", {"gap": 3e-3}, "gap = 0.003 m, v_n = 0.04 m/s; the spheres must meet"),
        ("bounce", "floor", {"load": 1000.0}, "load = 1000.0 N; it must be 0"),
        ("bounce", "again", {"r2": 7e-5}, "the bodies overlap by 3.787e-05 m at most; it must be"),
        ("chain", "jump", {"load": 1e5}, "it must be below a tenth of the radius, 0.01 m"),
        ("damped-swing", "resolved", {"g": 9810.0}, "the tip sinks by 0.9815 m; it must be less"),
        ("damped-swing", "resolved", {"v": 1e-10}, "is lost as places are rounded"),
        ("implicit-swing", "near-four", {"v": 0.0}, "v = 0.0 m/s; it must not be 0"),
        ("packing", "seed-1", {"kn": 100.0}, "spheres on the floor overlap it by 0.00613 m"),
        ("passing", "sheared", {"overlap": 0.1}, "it must be below a tenth of the smallest radius"),
        ("passing", "sheared", {"ks": 0.0}, "ks = 0.0 N/m; it must exceed kn d/L = 2.858 N/m"),
        ("passing", "sheared", {"v": 0.0}, "v = 0.0 m/s; it must not be 0, or nothing moves"),
        ("passing", "sheared", {"duration": 250.0}, "it takes 8e\\+06 steps that are so short"),
        ("stable-step", "viscous", {"eta": 0.0}, "n/w = 0; it must be from 0.04 to 1.5"),
        ("stable-step", "viscous", {"ks": 5.5e6}, "n/w = 13.7; it must be from 0.04 to 1.5"),
        ("close-packed-energy", "pulled-82", {"d": 2e-5, "rate": 0.012}, "is 9.83e\\+09 steps of"),
        ("tetrahedral-path", "out", {"rate": 2000.0}, "rate = 2000.0 1/s; it must not exceed 250"),
    ],
)
def test_a_parameter_that_leaves_no_answer_is_refused(
    case: str, variant: str, given: dict[str, float], words: str
) -> None:
    made = PROJECT.load_case(case)
    with pytest.raises(ValueError, match=words):
        made.declare(variant, {**made.defaults(variant), **given})


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("bounce:floor kn=1", "kn = 1.0 N/m; the bodies overlap by 205.5 m at most"),
        ("bounce:floor mu=0", "mu = 0.0; it must be positive, since friction ends slip"),
        (
            "mfix:dem03 H=7.47e-4",
            "H = 0.000747 m: a contact opens; the answer holds",
        ),
        ("tumbling:corner w=1.22", "at 0.0939 m/s, slower than the centre, 0.2 m/s"),
        ("incline:gravity-5 phi=-5", "phi = -5.0 deg; a friction angle must be from 0"),
        ("incline:gravity-5 phi=95", "phi = 95.0 deg; a friction angle must be from 0"),
        ("wedge:xi-1 held=1", "held = 1.0; it must differ from 1, where rounding decides"),
        ("single-contact:T2 eta=2e12", "eta = 2000000000000.0 N s/m; .* N s/m, critical damping"),
        ("single-contact:T3 eta=2e12", r"N s/m, 0\.9239 of critical damping"),
    ],
)
def test_a_far_value_is_refused_by_its_own_name_and_a_rule_of_the_field(
    given: str, words: str
) -> None:
    name, setting = given.split()
    case, _, variant = name.partition(":")
    made = PROJECT.load_case(case)
    with pytest.raises(UsageError, match=words):
        declare_trial(made, variant, parameters_with_settings(made, variant, [setting]))


@pytest.mark.parametrize(
    "given",
    [
        "at-yield:above duration=1e300",
        "at-yield:above f=1e5",
        "incline:two-way duration=1e300",
        "masonry:rest courses=1e300",
        "shaken-wedge:along f=1e300",
        "shaken-wedge:level duration=1e300",
        "shear-wave:20 G=1e300",
        "shear-wave:20 duration=1e300",
        "standing:stack-10 n=1e300",
    ],
)
def test_endless_work_is_refused_by_its_count_before_it_begins(given: str) -> None:
    name, setting = given.split()
    case, _, variant = name.partition(":")
    made = PROJECT.load_case(case)
    with pytest.raises(UsageError, match=r"at most \d+ (are solved|blocks are stacked)"):
        declare_trial(made, variant, parameters_with_settings(made, variant, [setting]))
