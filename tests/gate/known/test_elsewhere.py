"""Claims that known errors of codes keep to their limits at other parameters."""

from __future__ import annotations

import fnmatch

import pytest

from tests import ROOT
from tests.findings.figures import PROJECT, asked
from tests.support.installed import require
from vv.ask import Status
from vv.case import Level
from vv.gate.disagreement import Disagreement
from vv.gate.ledger_file import read_disagreements
from vv.records.outcomes import Verdict
from vv.records.record import measured

ENTRIES = read_disagreements(ROOT / "cases" / "disagreements.toml")
TIGHT = 4.0  # a limit is about twice the worst error that was seen
KNOWN = {
    "incline:two-directions-turning f=3": ("yade/clump", "d"),
    "kharaz:linear v=31.2": ("yade/default", "worst"),
    "kharaz:hertz mu=0.736": ("liggghts/default", "worst"),
    "oblique-impact:angle-alumina mu=0.736": ("liggghts/default", "worst"),
    "oblique-impact:pair-alloy mu=3.2": ("liggghts/default", "worst"),
    "oblique-impact:spun-alloy-0.5 mu=3.2": ("liggghts/default", "worst"),
    "oblique-impact:spun-alloy mu=3.2": ("yade/default", "nearest"),
    "mfix:dem05-linear v=31.2": ("yade/default", "nearest"),
    "masonry:slides courses=40": ("rigid/default", "lowest"),
}


def limits(name: str, scheme: str, quantity: str) -> list[float]:
    """The limits that entries state for a quantity at other parameters."""
    (code, _, method), (case, _, told) = scheme.partition("/"), name.partition(":")
    variant, _, _ = told.partition(" ")

    def speaks(one: Disagreement) -> bool:
        pairs = (
            (code, one.code),
            (method, one.schemes),
            (case, one.case),
            (quantity, one.quantity),
        )
        return (
            one.elsewhere is not None
            and all(fnmatch.fnmatchcase(*pair) for pair in pairs)
            and any(fnmatch.fnmatchcase(variant, glob) for glob in one.variants)
        )

    return [one.elsewhere for one in ENTRIES if speaks(one) and one.elsewhere is not None]


@pytest.mark.parametrize(("name", "known"), KNOWN.items(), ids=KNOWN)
def test_a_known_error_keeps_to_its_limit_and_is_not_far_below_it(
    name: str, known: tuple[str, str]
) -> None:
    scheme, quantity = known
    require(PROJECT.load_adapter(scheme.partition("/")[0]))
    (limit,) = limits(name, scheme, quantity)
    case, _, variant = name.split(maxsplit=1)[0].partition(":")
    quick = PROJECT.load_case(case).variant(variant).runs_at(Level.QUICK)
    one = asked(name, scheme, Level.QUICK if quick else Level.DEFAULT)
    assert one.run.status is Status.RAN
    (it,) = (it for it in one.trial.quantities if it.name == quantity)
    method = one.scheme.method_for(one.ask.scene.terms())
    found = measured(one.run, it, method, one.ask.knobs, True)[0]
    assert found.verdict is Verdict.FAIL
    assert found.norm is not None
    error = found.errors[found.norm]
    assert error is not None
    assert limit / TIGHT < error < limit
