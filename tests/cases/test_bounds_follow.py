"""Claims that bounds follow the parameters: runs that are right pass where draws found them red."""

import math

import pytest

from tests.findings.figures import PROJECT, asked
from tests.support.installed import require
from vv.ask import Method, Status
from vv.case import Exact, Level
from vv.records.outcomes import Verdict
from vv.records.record import measured

ROUNDING = 1e-9
RIGHT = {
    "failure-modes:3d-40 phi=37.4 alpha=12.5": "rigid/default",
    "wedge:xi-1 dip=29.4 xi=0.649 held=0.502 g=9.93": "rigid/default",
    "wedge:xi-1e-06 xi=1.73e-6 held=0.378 g=6.11": "rigid/default",
    "resting:booked n=8 rows=6 m=0.901 kn=1.1e6 ks=9.77e5 mu=0.327 g=13.1": "dem/default",
    "resting:booked n=4 rows=6 m=1.62 kn=1.37e6 ks=5.76e5 mu=0.296 v=7e-4": "dem/published",
    "knife-edge:topples crossing=31 mu=2.19 duration=0.178": "dda/default",
    "knife-edge:topples g=19.1 duration=0.259": "dda/default",
    "painleve:mu-0.8 half=2.23 g=20.8 m=262": "dda/default",
    "painleve:mu-0.8 mu=0.842 slope=2.79 half=1.03 V=2.53 g=11": "dda/augmented-lagrangian",
    "painleve:mu-0.8 mu=0.89 slope=2.25 half=0.727 V=1.9 g=8.6 m=91.6": "dda/lagged",
    "painleve:mu-0.8 slope=1.72 g=25.5 m=104": "dda/published",
    "knife-edge:topples rho=250": "dda/lagged",
    "at-yield:above f=20": "dem/default",
    "at-yield:below g=294.3": "exact/default",
    "responding-block:1d duration=40": "exact/default",
    "incline:two-way f=8": "dem/default",
    "incline:two-way alpha=8 phi=32.35 A=31.2 f=0.53": "dda/generalised-alpha",
    "incline:two-directions Ay=8": "dda/augmented-lagrangian",
    "responding-block:1d f=16": "dem/published",
    "shaken-corner:viscous u=3e-7": "exact/default",
    "responding-block:3d D=0.01": "rigid/default",
    "responding-block:3d D=0.8": "dem/published",
    "responding-block:2d D=0.9": "dda/published",
    "responding-block:2d D=1.2": "dda/published",
    "responding-block:1d mu=0.06": "dda/generalised-alpha",
    "responding-block:1d-mu-1 Dy=8": "dem/published",
    "shaken-wedge:along f=8": "dda/augmented-lagrangian",
    "painleve:mu-0.8 m=10": "dda/published",
    "painleve:mu-0.8 slope=0.2": "dda/lagged",
    "painleve:mu-0.8 half=0.1": "rigid/default",
    "painleve:mu-0.8 half=0.03": "dda/default",
    "painleve:mu-2 slope=0.2": "dda/published",
    "painleve:mu-2 slope=0.735": "rigid/default",
    "painleve:mu-2 g=78.48": "rigid/default",
    "painleve:mu-2 mu=1.29 V=0.87": "dda/augmented-lagrangian",
    "settling:drop m=2.7 kn=1.96e6": "dem/default",
    "settling:drop m=0.9153 kn=2.977e6": "dem/published",
    "settling:drop m=1.153 kn=6.437e5 eta=12.54 g=12.52 height=2.141e-3": "dem/default",
    "shaken-corner:viscous z=0.0521 zn=0.179": "dem/published",
    "shaken-corner:viscous m=2.83 zn=0.291 g=27.5": "dem/published",
    "shaken-corner:viscous z=0.15 zn=0.3": "dem/published",
    "shaken-corner:viscous z=0.35": "dem/default",
    "shaken-corner:viscous zn=0.38": "dem/default",
    "shaken-corner:viscous z=0.6": "dem/default",
    "shaken-corner:corner z=0.8": "dem/default",
    "shaken-corner:wall z=0.8": "dem/default",
    "single-contact:T4 r=28.8": "dem/published",
    "slow-slide:held m=7030 mu=0.598 g=19.1": "dda/default",
    "slow-slide:held m=3420 mu=0.695 v0=0.0227 g=11.2": "dem/default",
    "slow-slide:slope mu=0.702 g=22.3": "dda/default",
    "incline:two-way phi=76.6": "rigid/default",
    "incline:two-directions alpha=38.49 duration=10.11": "exact/second-order",
    "incline:two-directions alpha=43.18 A=1.317": "exact/second-order",
    "bounce:held kn=1.41e10": "dem/default",
    "bounce:floor r1=90": "dem/published",
    "bounce:held kn=2e7": "dem/published",
    "bounce:held mu=300": "dem/default",
    "bounce:pair mu=300": "dem/default",
    "bounce:again load=0.026": "dem/published",
    "bounce:again rho=250": "dem/default",
    "kharaz:linear kn=516000": "dem/default",
    "kharaz:linear ks=4.44e8": "dem/published",
    "packing:seed-1 kn=3e6": "dem/default",
    "packing:seed-1 eta=0.6": "dem/default",
    "bounce:floor r1=3": "dem/published",
    "bounce:floor r1=3 mu=0.1": "dem/published",
    "passing:sheared m=1e-3": "dem/default",
    "passing:sheared ks=10": "dem/default",
    "passing:sheared duration=2.5e-4": "dem/default",
    "galperin:31 ratio=0.1": "exact/default",
    "rocking-restitution:aspect-3 b=0.588 mu=1.07 g=6.11": "rigid/default",
    "rocking-restitution:aspect-3 b=0.73 mu=2": "rigid/default",
    "galperin:31 ratio=44.3 kn=7.66e5": "dem/default",
    "galperin:31 ratio=178.6 kn=6.49e6": "dem/published",
    "grazing:T3 r=5e4": "exact/default",
    "grazing:T3 ks=5.5e12": "exact/default",
    "settling:drop m=1000": "exact/default",
    "settling:drop kn=1e9": "dem/default",
    "single-contact:T1-rotated r=0.05": "dem/default",
    "single-contact:T4-swapped ks=5.5e12": "dem/default",
    "damped-swing:unresolved v=5e-5": "dda/generalised-alpha",
    "kharaz:linear mu=92": "dem/default",
    "mfix:dem03 rho=20": "dem/default",
    "mfix:dem03 kn=1": "dem/published",
    "mfix:dem03 kn=1e6": "dem/default",
    "elastic-block:spun L=1.03 a=1.58 b=1.5 rho=3390 E=6.84e9 nu=0.202 spin=3.08": "dda/default",
    "elastic-block:spun a=4.44 E=1.6e10 spin=1.67": "dda/default",
    "laden-block:level alpha=23.1 mu=0.417 v=3.04 push=0.344 press=2.01 a=0.968 D=0.025 g=13.1 "
    "duration=0.389": "dem/default",
    "laden-block:level mu=0.267 D=0.0395": "dda/generalised-alpha",
    "laden-block:level v=1.4 g=8.16": "dda/augmented-lagrangian",
    "laden-block:turning mu=0.118 D=0.0179 v=1.91 a=2.98 press=2.42 duration=0.67": (
        "dda/augmented-lagrangian"
    ),
    "laden-block:turning mu=0.287 D=0.0167 v=1.74 a=2.42 press=1.25 duration=0.368": (
        "dda/published"
    ),
    "oblique-impact:spun-alloy young=6.71e10 poisson=0.337 rho=2530 R=0.139 mu=0.526 v=0.231 "
    "e=0.721": "dem/published",
    "oblique-impact:spun-alloy mu=1.2 e=0.9": "dem/published",
    "mfix:dem01 h=0.11": "dem/published",
    "mfix:dem03 kn=30": "dem/published",
    "mfix:dem06 R=0.0015": "dem/default",
    "mfix:dem06 R=0.005": "dem/default",
    "spin-stopped:crossed V=1e-3": "rigid/default",
    "spin-stopped:crossed V=30": "dda/default",
    "tumbling:corner w=30": "dda/published",
    "mfix:dem06 v=1.2": "dem/default",
    "mfix:dem06 R=6.76e-05 rho=1630 v=0.259 g=12.7 rho_f=1.55 viscosity=1.44e-05": "dem/default",
    "mfix:dem02-1 kn=7.52e4": "dem/default",
    "unlike-bonds:slowed kn=1.93e4 v=0.054 stretch=0.00165": "dem/published",
    "unlike-bonds:slowed eta=60": "dem/published",
    "unlike-bonds:slowed eta=600": "dem/default",
    "unlike-bonds:slowed m=0.02": "dem/default",
    "unlike-bonds:slowed duration=0.006": "dem/default",
    "unlike-bonds:spinning duration=0.03": "yade/default",
    "tetrahedral-unit:pulled strain=1e-7": "yade/half-step-mass",
    "tetrahedral-unit:pressed kn=4679383.1": "yade/half-step-mass",
    "tetrahedral-strength:pressed d=3e-4": "yade/default",
    "tetrahedral-strength:pulled m=5.6214989e-7": "yade/default",
    "unlike-bonds:hung kn=1.93e4 v=0.054 stretch=0.00165": "dem/default",
    "close-packed-energy:pulled-82 kn=1.62e7 ks=8.88e6 d=3.91e-4": "dem/default",
    "close-packed-energy:pressed-82 rate=-16": "dem/default",
    "close-packed-energy:pressed-82 kn=2.5e7 m=2.5e-6": "dem/published",
    "close-packed-lattice:82 gamma=1": "dem/default",
    "close-packed-lattice:82 gamma=1.02": "dem/default",
    "close-packed-path:in-82 gamma=1": "dem/default",
    "close-packed-path:in-82 gamma=0.8": "dem/default",
    "close-packed-failure:82 kn=6.47e7 ks=1.05e7 xb=1.85e-7 fs0=11.2 mu_p=0.508 d=0.00125 "
    "m=1.96e-6 rate=-1.37": "dem/default",
    "close-packed-failure:82 kn=6.17e7 ks=9.68e6 xb=2e-7 fs0=19 mu_p=0.424 d=8.77e-4 m=1.59e-6 "
    "rate=-1.11": "dem/default",
    "close-packed-failure:82 kn=5.84e7 ks=6.78e6 xb=1.73e-7 fs0=18.7 mu_p=0.441 d=0.00112 "
    "m=1.63e-6 rate=-0.769": "dem/default",
    "close-packed-failure:82 m=5.6214989e-7": "dem/default",
    "close-packed-failure:82 ks=5.29e6": "dem/default",
    "close-packed-failure:82 fs0=38.8 d=0.00108": "dem/default",
    "masonry:slides columns=8 courses=7 mu=0.209 D=0.0572 f=1.54 g=11 duration=0.528": (
        "dda/default"
    ),
    "masonry:slides D=0.03": "dda/default",
    "tetrahedral-path:out gamma=0.116 rate=30.8": "dem/default",
    "elastic-block:spun L=1.28 a=1.33 b=1.66 rho=2440 E=1.04e10 nu=0.311 spin=6.61": (
        "dda/default"
    ),
    "incline:two-way alpha=16.1 phi=38 A=24.1 f=1.35 g=7.89 duration=5.64": "dda/lagged",
    "close-packed-strength:pulled-82 m=6.86e-07": "dem/default",
    "confined-strength:two ks=4.39e6 mu_p=0.554 m=3.53e-6": "dem/published",
    "close-packed-strength:pulled-82 kn=6.07e7 ks=3.04e6": "dem/published",
    "close-packed-strength:pulled-82 kn=2.16e7 rate=0.588": "dem/published",
    "wedge:xi-1 dip=36.5 xi=0.71 held=0.622 g=9.68": "rigid/default",
    "packing:seed-1 m=0.0035 kn=7.86e4 g=5.17": "dem/default",
    "passing:sheared m=0.879 kn=2.49e4 ks=1.32e4 mu=1.2 overlap=7.74e-5 v=6.43e-4 duration=0.342": (
        "dem/default"
    ),
}


@pytest.mark.parametrize(("name", "scheme"), RIGHT.items(), ids=RIGHT)
def test_what_is_right_passes_at_other_parameters_too(name: str, scheme: str) -> None:
    require(PROJECT.load_adapter(scheme.partition("/")[0]))
    for at in (None, Level.QUICK):  # the first and the last setting
        one = asked(name, scheme, at)
        assert one.run.status is Status.RAN
        method = one.scheme.method_for(one.ask.scene.terms())
        found = [
            measured(one.run, it, method, one.ask.knobs, True)[0] for it in one.trial.quantities
        ]
        assert {it.name for it in found if it.verdict is Verdict.FAIL} == set()


@pytest.mark.parametrize("given", [{"rho": 5100.0}, {"H": 63.3, "G": 6.26e7}, {"duration": 5.0}])
def test_a_column_whose_free_oscillation_remains_is_refused(given: dict[str, float]) -> None:
    case = PROJECT.load_case("site-response")
    usual = case.defaults("five-layers")
    case.declare("five-layers", {**usual, "duration": 12.0})
    with pytest.raises(ValueError, match="free oscillation dies out in"):
        case.declare("five-layers", {**usual, **given})


@pytest.mark.parametrize("given", [{"v": 0.02}, {"squeeze": 8e-5}, {"g": 20.5, "kn": 5e5}])
def test_a_sheet_whose_contacts_open_is_refused(given: dict[str, float]) -> None:
    case = PROJECT.load_case("resting")
    with pytest.raises(ValueError, match=r"contacts open, by about v/sqrt\(kn/m\)"):
        case.declare("booked", {**case.defaults("booked"), **given})


@pytest.mark.parametrize(
    ("ks", "kn", "judged"), [(1.0, 1.0, True), (0.99, 1.0, True), (1.0, 1.4, False)]
)
def test_a_slope_is_judged_where_no_wave_lets_bonds_slide(
    ks: float, kn: float, judged: bool
) -> None:
    case = PROJECT.load_case("close-packed-failure")
    usual = case.defaults("82")
    trial = case.declare("82", {**usual, "ks": ks * usual["ks"], "kn": kn * usual["kn"]})
    (after,) = (one for one in trial.quantities if one.name == "E after")
    assert isinstance(after.judge, Exact) == judged


@pytest.mark.parametrize("given", [{"v": 4.89, "m": 2.2}, {"kn": 1e5, "v": 2.3}])
def test_pairs_of_spheres_that_overlap_by_a_tenth_of_their_radius_are_refused(
    given: dict[str, float],
) -> None:
    case = PROJECT.load_case("crowd")
    with pytest.raises(ValueError, match=r"would overlap by .*less than a tenth of the radius"):
        case.declare("pairs", {**case.defaults("pairs"), **given})


@pytest.mark.parametrize(("ratio", "allowed"), [(44.3, 1.0), (45.5, 0.0), (100.0, 0.0)])
def test_a_collision_may_be_missing_where_errors_of_steps_turn_the_motion_past_it(
    ratio: float, allowed: float
) -> None:
    case = PROJECT.load_case("galperin")
    trial = case.declare("31", {**case.defaults("31"), "ratio": ratio})
    (number,) = trial.quantities
    assert isinstance(number.judge, Exact)
    assert isinstance(number.reference, int)
    tolerance, due = number.judge.tolerances[Method.SECOND_ORDER], number.reference
    coarse, _, fine, _ = trial.study.rungs[Level.DEFAULT]
    for knobs, most in ((coarse, allowed), (fine, 0.0)):
        assert math.floor(tolerance.uncut(knobs) * due + ROUNDING) == most
