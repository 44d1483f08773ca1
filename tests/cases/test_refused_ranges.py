"""Claims that a parameter is accepted up to the end of its range, and refused just beyond it."""

from __future__ import annotations

import pytest

from vv.case import Scalar, Trial, evaluated
from vv.plan.project import find

PROJECT = find()
TIPS = "the plate would tip"
DRAG = "only the variant 'slowed' has drag"


def declared(case: str, variant: str, given: dict[str, float]) -> Trial:
    made = PROJECT.load_case(case)
    usual = made.defaults(variant)
    assert given.keys() <= usual.keys()
    return made.declare(variant, {**usual, **given})


@pytest.mark.parametrize(
    ("case", "variant", "within", "beyond", "words"),
    [
        # a plate tips where mu exceeds its length over its height, and on springs a third of that
        ("incline", "two-directions-turning", {"phi": 78.6}, {"phi": 78.8}, TIPS),
        ("laden-block", "turning", {"mu": 4.9, "v": 200.0}, {"mu": 5.1, "v": 200.0}, TIPS),
        ("responding-block", "3d-turning", {"mu": 1.66}, {"mu": 1.67}, TIPS),
        ("slow-slide", "level", {"mu": 2.4}, {"mu": 2.6}, TIPS),
        # amplitudes, and what a variant does not have
        ("incline", "newmark-30", {"Ay": 0.0}, {"Ay": -0.1}, "must be zero or more"),
        ("responding-block", "2d", {"Dy": 1e-3}, {"Dy": -1e-3}, "must be zero or more"),
        ("responding-block", "3d", {"Dz": 1e-3}, {"Dz": -1e-3}, "must be zero or more"),
        ("incline", "two-directions", {"v0": 0.0}, {"v0": 0.1}, "must start at rest"),
        ("unlike-bonds", "row", {"stretch": 0.0}, {"stretch": 1e-4}, "must be 0"),
        ("unlike-bonds", "hung", {"stretch": 1e-4}, {"eta": 1.0}, DRAG),
        ("unlike-bonds", "spinning", {}, {"eta": 1.0}, DRAG),
        ("unlike-bonds", "slowed", {"g": 0.0}, {"g": 1.0}, "has no gravity"),
        ("shaken-corner", "viscous", {"zn": 0.02}, {"u": 5.1e-5}, "below a tenth of the radius"),
        ("shaken-corner", "wall", {"u": 4.9e-5}, {"zn": 0.02}, "only the variant 'viscous'"),
        ("shaken-corner", "viscous", {"z": 0.6, "zn": 0.39}, {"z": 0.7, "zn": 0.3}, "below 1, so"),
        # the signs of rates and of drag
        ("tetrahedral-unit", "gamma-0", {"eta": 20.0}, {"eta": 0.0}, "must be positive: without"),
        ("close-packed-energy", "pulled-82", {}, {"rate": 0.0}, "must be positive where a block"),
        ("close-packed-energy", "pressed-82", {}, {"rate": 0.0}, "negative where it is pressed"),
        (
            "close-packed-energy", "pulled-82", {"fs0": 4.2}, {"fs0": 4.1},
            "bonds slide before the first one opens",
        ),
        ("close-packed-failure", "82", {}, {"rate": 0.0}, "it must be negative"),
        ("tetrahedral-unit", "pulled", {"kn": 2.3e5}, {"kn": 2e5}, "creeps to rest at 6.27e\\+04"),
        ("masonry", "slides", {"D": 0.12}, {"D": 0.13}, "no longer bears its last stone"),
        ("masonry", "rest", {"columns": 20, "courses": 18}, {"columns": 20, "courses": 19},
         "= 1.37e\\+05; at most"),
        ("masonry", "rest", {"columns": 6}, {"columns": 4}, "columns = 4; the number must be even"),
        ("masonry", "rest", {"columns": 6}, {"columns": 7}, "columns = 7; the number must be even"),
        ("masonry", "rest", {"courses": 5}, {"courses": 4}, "courses = 4; the openings need"),
        # the friction that holds a corner or a voussoir
        ("masonry", "rest", {"mu": 0.309}, {"mu": 0.3089}, "whatever the thrust of the arch"),
        ("rocking", "search", {"mu": 0.34}, {"mu": 0.33}, "mu = 0.33; it must exceed b/h"),
        ("rocking-restitution", "aspect-3", {"mu": 0.34}, {"mu": 0.33}, "it must exceed b/h"),
        ("rocking-restitution", "aspect-3", {"b": 0.73, "mu": 2.0}, {"b": 0.74, "mu": 2.0},
         "of its rate 0.095 remains after an impact"),
        ("failure-modes", "2d-10", {"phi": 84.0}, {"phi": 86.0}, "it must be between 1 and 85"),
        ("failure-modes", "2d-10", {"phi": 1.2}, {"phi": 0.9}, "it must be between 1 and 85"),
        ("wedge", "xi-1", {"dip": 89.0}, {"dip": 90.0}, "or more and below 90"),
        ("wedge", "sphere", {"dip": 0.0}, {"dip": -0.1}, "or more and below 90"),
        # how far bodies sink into one another, and how stiff contacts are
        ("crowd", "pairs", {"v": 7.0}, {"v": 7.15}, "overlap by 0.00505581 m"),
        ("galperin", "31", {"x": 0.1, "kn": 1.05e7}, {"x": 0.1, "kn": 9.7e6}, "last 0.00101 s"),
        ("resting", "booked", {"v": 1.8e-3}, {"v": 2e-3}, "contacts open, by about"),
        ("passing", "sheared", {"v": 8e-3}, {"v": 8.3e-3}, "large that the contacts nearly slip"),
        ("damped-swing", "resolved", {"v": 0.0979}, {"v": 0.0983}, "on, the tip lifts off"),
        ("implicit-swing", "near-four", {"v": -0.0979}, {"v": -0.0983}, "on, the tip lifts off"),
        ("chain", "jump", {"load": 950.0}, {"load": 960.0}, "would overlap by 0.01008 m"),
        ("chain", "mode-3", {"part": 0.19}, {"part": 0.21}, "it must be between 0 and 0.2"),
        ("chain", "mode-3", {"part": 0.01}, {"part": -0.01}, "it must be between 0 and 0.2"),
        ("kinetic-damping", "3-per-cent", {"a": 0.1}, {"a": 0.0}, "both must be positive"),
        ("kinetic-damping", "3-per-cent", {"t": 0.1}, {"t": 0.0}, "both must be positive"),
        ("skid", "wall", {"vn": 9.9}, {"vn": 10.1}, "would sink by 0.0101 m; it must be"),
        ("unlike-bonds", "slowed", {"eta": 990.0}, {"eta": 1010.0}, "it must be below 1000 N s/m"),
        ("mfix", "dem03", {"h": 4.76e-4, "h2": 1.428e-3, "H": 1.904e-3},
         {"h": 4.7e-4, "h2": 1.41e-3, "H": 1.88e-3}, "an overlap of 6e-05 m at most"),
        # shapes, materials and strains
        ("hertz-impact", "glass", {"poisson": 0.5}, {"poisson": 0.51}, "must lie in \\[0, 0.5\\]"),
        ("hertz-impact", "glass", {"poisson": 0.0}, {"poisson": -0.01}, "must lie in \\[0, 0.5\\]"),
        ("spin-stopped", "crossed", {"a1": 0.59}, {"a1": -0.61}, "ends 0.75 m from its middle"),
        ("spin-stopped", "crossed", {"a2": -0.47}, {"a2": 0.49}, "ends 0.6 m from its middle"),
        ("spin-stopped", "crossed", {"crossing": 31.0}, {"crossing": 29.0}, "from 30.0 to 150.0"),
        ("spin-stopped", "crossed", {"crossing": 149.0}, {"crossing": 151.0}, "from 30.0 to 150.0"),
        ("knife-edge", "topples", {"crossing": 31.0}, {"crossing": 29.0}, "from 30.0 to 150.0"),
        ("knife-edge", "topples", {"crossing": 149.0}, {"crossing": 151.0}, "from 30.0 to 150.0"),
        ("knife-edge", "topples", {"mu": 5.0, "duration": 0.77}, {"mu": 5.0, "duration": 0.79},
         "below 0.75 rad"),
        ("single-contact", "T3", {"mu": 1.9e10}, {"mu": 2.1e10}, "an overlap so small is lost"),
        ("wedge", "xi-1", {"xi": 1.57}, {"xi": 1.58}, "it must be below pi/2"),
        ("hopper", "low-1", {"opening": 4.4}, {"opening": 4.3}, "wide as 5 mean grains"),
        ("hopper", "low-1", {"opening": 6.1}, {"opening": 6.2}, "it must be at most 6.15"),
        ("packing", "seed-1", {"g": 0.64}, {"g": 0.62}, "to come to rest; at most 72 s are run"),
        ("shear-wave", "5", {"F": 7.0}, {"F": 7.2}, "from the wave by 0.084, more than 0.08"),
        ("close-packed-path", "in-82", {"strain": 1.1e-6}, {"strain": 9e-7}, "from 1e-6 to 5e-3"),
        ("close-packed-path", "in-82", {"strain": -4.9e-3}, {"strain": -5.1e-3}, "to 5e-3"),
        ("confined-strength", "two", {"kn": 9e7, "eta": 2.0}, {"kn": 9e7, "eta": 1.5},
         "oscillation after the base opens loads inclined bonds to 1.06 of what they bear"),
        ("confined-strength", "two", {"kn": 9e7, "fs0": 24.0, "eta": 2.0},
         {"kn": 9e7, "fs0": 24.0, "eta": 1.5}, "stretches inclined bonds to 1.06 xb"),
        ("confined-strength", "two", {"xb": 3e-7}, {"xb": 6e-7}, "slide below the pressure that"),
    ],
)  # fmt: skip
def test_a_range_ends_where_the_refusal_says(
    case: str, variant: str, within: dict[str, float], beyond: dict[str, float], words: str
) -> None:
    assert declared(case, variant, within).quantities
    with pytest.raises(ValueError, match=words):
        declared(case, variant, beyond)


def test_a_block_that_lands_twice_is_refused_where_it_is_measured() -> None:
    def landing(height: float) -> float:
        lands = declared("tumbling", "corner", {"height": height}).quantities[1]
        assert isinstance(lands, Scalar)
        assert lands.reference is not None
        return evaluated(lands.reference)

    assert 0.0 < landing(0.8) < 1.6
    with pytest.raises(ValueError, match="a corner meets the plane a second time"):
        landing(0.7)
