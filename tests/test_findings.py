"""Claims of docs/findings.md: each names what shows it, which is there; the cheap ones are run."""

import re
import shlex

import pytest

from tests import ROOT
from tests.support.findings import PROJECT, asked, found
from vv.ask import Knobs, Status
from vv.case import Level
from vv.plan.selection import choose_schemes, named_adapters, select

PAGE = (ROOT / "docs" / "findings.md").read_text()
BULLETS = [line[2:] for line in PAGE.splitlines() if line.startswith("- ")]
QUOTED = re.compile(r"`([^`]+)`")
SHOWN_BY = re.compile(
    r"vv run .*|python -m bench\.[\w.]+|tests/[\w/]*(\.py)?|reference_solutions/[\w/]*\.py"
)


def shown_by(bullet: str) -> list[str]:
    """What a finding names that shows it: commands, tests, scripts."""
    return [text for text in QUOTED.findall(bullet) if SHOWN_BY.fullmatch(text)]


@pytest.mark.parametrize("bullet", BULLETS, ids=lambda text: " ".join(text.split()[:6]))
def test_each_finding_names_what_shows_it(bullet: str) -> None:
    assert shown_by(bullet)


@pytest.mark.parametrize("text", sorted({one for bullet in BULLETS for one in shown_by(bullet)}))
def test_what_shows_a_finding_is_there(text: str) -> None:
    if not text.startswith(("vv run", "python")):
        assert (ROOT / text).exists()
        return
    if text.startswith("python"):
        assert (ROOT / f"{text.rsplit(maxsplit=1)[-1].replace('.', '/')}.py").is_file()
        return
    words = shlex.split(text)[2:]
    options = {words[i]: words[i + 1] for i, word in enumerate(words) if word.startswith("--")}
    chosen = [w for i, w in enumerate(words) if "--" not in w and "--" not in words[max(0, i - 1)]]
    assert options.keys() <= {"--codes", "--level", "--rung", "--set"}
    codes = tuple(options.get("--codes", "*").split(","))
    assert choose_schemes(named_adapters(PROJECT, codes), codes)
    level = Level(options.get("--level", "default"))
    assert any(case.variant(name).runs_at(level) for case, name in select(PROJECT, chosen))


SMALL = "b=0.09 h=0.31 part=0.5 duration=0.9"  # a block that rocks
# slow ones are left to their commands: blocks of bonds through failure, stacks of a hundred, maps
# a case is followed by what --set changes of it
FOUND = (
    ("incline:two-directions", "dem/default", Knobs(1e-4, 1e10), "d", 2.5e-4, 2.7e-4),  # w dt = 1
    ("incline:two-directions", "dem/default", Knobs(1e-4, 1.01e10), "d", 2.9e-5, 3.2e-5),
    ("incline:two-directions", "dem/default", Knobs(2e-4, 2.5e9), "d", 6.0e-4, 6.2e-4),  # w dt = 1
    ("incline:two-directions", "dem/default", Knobs(2e-4, 2.6e9), "d", 1.3e-4, 1.5e-4),
    ("incline:two-directions", "dem/default", Knobs(5e-5, 4e10), "d", 9.7e-5, 9.9e-5),  # w dt = 1
    ("incline:two-directions", "dem/default", Knobs(5e-5, 4.2e10), "d", 1.9e-5, 2.1e-5),
    ("laden-block:turning", "dda/lagged", Knobs(2.5e-4, 1e9), "slip", 0.027, 0.029),
    ("laden-block:turning", "dda/lagged", Knobs(2.5e-4, 1e9), "slipping", 0.022, 0.024),
    ("slow-slide:slope", "dda/published", Knobs(0.5872247793239222e-3, 1e9), "s", 0.10, 0.12),
    (f"rocking:released {SMALL}", "dda/default", Knobs(1e-3, 1e10), "x", 0.0, 0.03),
    ("masonry:rest", "dda/default", None, "borne", 4e-4, 1.1e-3),
    ("masonry:rest", "dda/default", None, "given upwards", 0.0, 2e-15),
    ("elastic-block:spun", "dda/published", None, "e_x", 0.999, 1.001),  # does not strain
    ("painleve:mu-2", "dda/default", Knobs(1e-3, 1e8), "distance", 0.058, 0.062),  # 6 to 19 %
    ("rocking:released", "dda/default", Knobs(1e-3, 1e9), "x", 0.022, 0.025),
    ("rocking:released", "dda/default", Knobs(2.5e-5, 1e9), "x", 0.26, 0.3),
    ("responding-block:1d", "dda/default", Knobs(1e-3, 1e10), "d2x", 3.6e-4, 3.8e-4),
    ("rocking:released", "dda/default", Knobs(1e-3, 1e11), "first swing", 4.8e-4, 5.0e-4),
    ("rocking:released", "dda/default", Knobs(5e-5, 1e11), "first swing", 2.4e-5, 2.5e-5),
    ("rocking:overturns-1e-1", "dda/default", Knobs(1e-3, 1e11), "time", 1.6e-3, 1.8e-3),
    ("rocking:overturns-1e-1", "dda/default", Knobs(5e-5, 1e11), "time", 7.8e-5, 8.2e-5),
    ("rocking:overturns-1e-1", "dda/published", Knobs(1e-3, 1e11), "time", 1.3e-3, 1.4e-3),
    (
        "rocking:overturns-1e-1",
        "dda/augmented-lagrangian",
        Knobs(1e-3, 1e11),
        "time",
        2.6e-5,
        2.8e-5,
    ),
    ("wedge:xi-0.1", "dda/lagged", Knobs(1e-3, 1e9), "s", 0.013, 0.015),
    ("wedge:xi-0.1", "dda/lagged", Knobs(1e-4, 1e11), "s", 1.3e-3, 1.5e-3),
    ("wedge:xi-0.1", "dda/default", Knobs(1e-3, 1e9), "s", 0.0, 1e-9),
    ("wedge:xi-0.01", "dda/generalised-alpha", Knobs(1e-3, 1e10), "s", 0.0, 1e-9),
    ("painleve:mu-2", "rigid/default", Knobs(1e-3), "distance", 8e-7, 1.2e-6),
    ("slow-slide:level", "dda/lagged", Knobs(1e-3, 1e9), "s", 0.5, 0.56),  # half of the way
    ("slow-slide:level", "dda/published", None, "s", 0.068, 0.072),
    ("laden-block:turning", "dda/lagged", Knobs(5e-5, 1e10), "slip", 0.0115, 0.0125),
    ("incline:gravity-5", "dda/published", Knobs(1e-3, 1e8), "d", 6e-4, 8e-4),
    ("incline:gravity-25", "dda/published", Knobs(1e-3, 1e8), "d", 0.065, 0.075),
    ("incline:gravity-5", "dem/published", Knobs(1e-3, 1e8), "d", 0.99e-3, 1.01e-3),
    ("standing:arch-thin", "dda/default", Knobs(2.5e-3, 1e9), "sunk", 0.9, 1.1),  # twice
    ("standing:arch-thin", "dda/default", Knobs(1.25e-3, 1e10), "sunk", 0.17, 0.2),
    ("standing:arch-thin", "dda/default", Knobs(1.25e-3, 1e11), "sunk", 0.04, 0.05),
    ("standing:arch-thin", "dda/lagged", Knobs(2.5e-3, 1e9), "sunk", 1.9, 2.2),  # three times
    ("masonry:slides", "dda/default", Knobs(1e-3, 1e10), "highest", 3.2e-3, 3.4e-3),
    ("masonry:slides", "dda/default", Knobs(5e-4, 1e10), "highest", 3.2e-3, 3.4e-3),
    ("wedge:xi-1e-06", "rigid/default", Knobs(1e-2), "s", 0.0, 7e-7),
    ("wedge:sphere", "dem/default", None, "s", 0.0, 1.1e-5),
    ("shaken-fast:20hz", "dem/default", Knobs(2.5e-4, 1e8), "d2x", 8.0, 10.0),  # nine times
    ("shaken-fast:20hz", "dem/default", Knobs(5e-6, 1e11), "d2x", 0.015, 0.017),
    ("tetrahedral-unit:turning", "dem/default", None, "E", 0.0, 1e-8),
    ("rocking-restitution:aspect-3", "rigid/default", Knobs(1e-3), "restitution", 0.0, 2e-6),
    ("rocking-restitution:aspect-5", "rigid/default", Knobs(1e-3), "restitution", 0.0, 2e-6),
    ("rocking-restitution:aspect-3", "dda/default", Knobs(1e-3, 1e10), "restitution", 3e-3, 1e-2),
    ("rocking-restitution:aspect-5", "dda/default", Knobs(1e-3, 1e10), "restitution", 3e-3, 1e-2),
)


@pytest.mark.parametrize(
    ("name", "scheme", "knobs", "quantity", "low", "high"),
    FOUND,
    ids=[f"{name} {scheme} {knobs}" for name, scheme, knobs, *_ in FOUND],
)
def test_what_is_found_is_as_it_is_told(
    name: str, scheme: str, knobs: Knobs | None, quantity: str, low: float, high: float
) -> None:
    assert low <= found(name, scheme, knobs, quantity) <= high


def test_kinetic_damping_of_3_per_cent_holds_a_falling_block_back_by_the_step() -> None:
    *_, run = asked("kinetic-damping:3-per-cent", "dda/default", Level.DEFAULT)
    assert run.status is Status.RAN
    (path,) = run.values.values()
    assert abs(path[-1]).max() == pytest.approx(0.000328, rel=2e-3)


@pytest.mark.parametrize("dt", [5e-4, 4.3e-4])
def test_a_base_that_never_lets_its_block_stick_is_followed_as_it_is_told(dt: float) -> None:
    block = {"mu": 0.482, "g": 28.6}
    at = Knobs(dt, 1e8)
    assert found("responding-block:1d", "dda/augmented-lagrangian", at, "d2x", block) <= 2e-5


@pytest.mark.parametrize("kind", [SMALL, f"{SMALL} mu=0.3", f"{SMALL} mu=1.3"])
def test_a_block_that_rocks_diverges_where_friction_lags(kind: str) -> None:
    *_, run = asked(f"rocking:released {kind}", "dda/lagged", Knobs(1e-3, 1e10))
    assert run.status is Status.DIVERGED


def test_friction_that_lags_gives_energy_on_a_knife_edge_at_large_steps_only() -> None:
    given = []
    for dt in (2e-3, 1e-3):
        *_, run = asked("knife-edge:topples", "dda/lagged", Knobs(dt, 1e8))
        assert run.ledger is not None
        given.append(-run.ledger.terms["friction dissipation"] / run.ledger.peak)
    assert 7.5e-3 <= given[0] <= 8.5e-3
    assert given[1] <= 1e-9
