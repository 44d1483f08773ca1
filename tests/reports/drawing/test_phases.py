"""Claims about phase diagrams: one quantity over another, for each scheme."""

import numpy as np

from reports.drawing.collect import History
from reports.drawing.phases import _exact, phase_figures
from reports.marks import Mark
from vv.records.case_facts import QuantityFacts
from vv.records.outcomes import JudgeKind

T = np.linspace(0.0, 1.0, 5)
FACTS = tuple(
    QuantityFacts(name, symbol, "", meaning, JudgeKind.SHOWN)
    for name, symbol, meaning in (("lean", "theta", "how it leans"), ("rate", "omega", "its rate"))
)


def history(label: str, value: np.ndarray, reference: np.ndarray | None) -> History:
    return History(Mark(label, 0, (), "", 0), 0.1, T, value, reference)


def test_a_scheme_is_drawn_where_both_quantities_put_it() -> None:
    """The exact curve is drawn behind it; a scheme with only one of both quantities is left out."""
    lean = [history("one", T, T), history("other", T, T)]
    rate = [history("one", T**2, 1.0 - T)]
    (figure,) = phase_figures(lean, rate, (FACTS[0], FACTS[1]))
    drawn = str(figure.svg)
    assert drawn.count('class="line"') == 1
    assert drawn.count('class="exact"') == 1
    assert "theta" in drawn
    assert "omega" in drawn
    assert figure.alt == "omega over theta in one"


def test_the_exact_curve_needs_both_references() -> None:
    (figure,) = phase_figures(
        [history("one", T, T)], [history("one", T**2, None)], (FACTS[0], FACTS[1])
    )
    assert 'class="exact"' not in str(figure.svg)
    assert phase_figures([], [], (FACTS[0], FACTS[1])) == []


def test_the_exact_curve_is_that_with_the_most_output_times_of_one_scheme() -> None:
    few, many = T[::2], T
    pairs = [(history("a", few, few), history("a", few, 1.0 - few)),
             (history("b", many, many), history("b", many, 2.0 - many)),
             (history("c", many, None), history("c", many, 3.0 - many))]  # fmt: skip
    for given in (pairs, pairs[::-1]):
        found = _exact(given)
        assert found is not None
        assert (found[0].tolist(), found[1].tolist()) == (many.tolist(), (2.0 - many).tolist())
