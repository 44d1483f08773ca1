"""Claims about phase diagrams, one quantity over another, and about charts of energies."""

from __future__ import annotations

import numpy as np
import pytest

from reports.drawing.collect import History
from reports.drawing.energies import energy_figures
from reports.drawing.phases import _exact, phase_figures
from reports.marks import COLOURS, Mark
from tests.support.drawn import paths, read, texts
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
    assert figure.title == "Phase picture: omega over theta"
    assert figure.caption.startswith("Grey: the exact one;")
    assert figure.caption.endswith("at its finest setting. how it leans; its rate.")


def ends_of(line: list[float]) -> np.ndarray:
    """The places along a path, which is written as its start and its steps."""
    return np.array(line).reshape(-1, 2).cumsum(axis=0)


def test_the_first_quantity_lies_across_and_the_second_up_as_drawn_and_as_exact() -> None:
    (figure,) = phase_figures(
        [history("one", T, T**2)], [history("one", 10 * T, 10 * T**3)], (FACTS[0], FACTS[1])
    )
    drawn = read(figure.svg)
    own = np.column_stack([52 + 304 * T, 248 - 238 * (10 * T + 0.4) / 10.8])
    assert ends_of(paths(drawn, "line")[0]) == pytest.approx(own, abs=0.2)
    exact = np.column_stack([52 + 304 * T**2, 248 - 238 * (10 * T**3 + 0.4) / 10.8])
    assert ends_of(paths(drawn, "exact")[0]) == pytest.approx(exact, abs=0.2)
    assert [said for said, _, _ in texts(drawn, "mid")] == ["theta"]
    assert [one.text for one in drawn.every("text", class_="up")] == ["omega"]


def test_the_exact_curve_needs_both_references() -> None:
    (figure,) = phase_figures(
        [history("one", T, T)], [history("one", T**2, None)], (FACTS[0], FACTS[1])
    )
    assert 'class="exact"' not in str(figure.svg)
    assert figure.caption.startswith("Each scheme at its finest setting.")
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


def energy(name: str, unit: str = "J") -> QuantityFacts:
    return QuantityFacts(name, name.upper(), unit, f"{name} energy", JudgeKind.SHOWN)


def test_energies_of_a_scheme_are_drawn_with_their_symbols_and_told_at_the_end() -> None:
    facts = [energy("k"), energy("p"), energy("w"), energy("way", "m")]
    over_time = {
        "way": [history("one", 9 * T, None), history("other", 9 * T, None)],
        "k": [history("one", 3 - 4 * T, None), history("other", T, None)],
        "w": [history("one", 2 + T, None)],
    }
    (figure,) = energy_figures(over_time, facts)
    assert figure.title == "Energy over time in one"
    assert figure.alt == ("Energy over time in one; at the final time: K -1.00e0 J, W 3.00e0 J")
    assert figure.caption == "At its finest setting. K: k energy; W: w energy."
    drawn = read(figure.svg)
    keys = [one for one in drawn.every("g") if "data-k" in one.named]
    assert [(one.named["data-k"], one.named["class"]) for one in keys] == [
        ("K", "key c0"), ("W", "key c1")
    ]  # fmt: skip
    first, second = (ends_of(one)[[0, -1]] for one in paths(drawn, "line"))

    def up(joule: float) -> float:
        return 248 - 238 * (joule + 1.16) / 4.32  # -1 to 3 J

    assert first == pytest.approx(np.array([(52, up(3)), (356, up(-1))]), abs=0.2)
    assert second == pytest.approx(np.array([(52, up(2)), (356, up(3))]), abs=0.2)


def test_colours_of_energies_begin_again_after_the_last() -> None:
    facts = [energy(f"e{n}") for n in range(len(COLOURS) + 1)]
    over_time = {one.name: [history("one", T, None)] for one in facts}
    (figure,) = energy_figures(over_time, facts)
    looks = [one.named["class"] for one in read(figure.svg).every("g") if "data-k" in one.named]
    assert looks == [f"key c{n}" for n in (*range(len(COLOURS)), 0)]
