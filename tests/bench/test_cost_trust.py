"""What the bench of costs looks for: figures that differ, and rankings that turn."""

from __future__ import annotations

from bench.waits.cost_trust import Place, gaps, rankings

A: Place = ("case", "variant", "a/a", 1e-3, None)
B: Place = ("case", "variant", "b/b", 1e-4, None)
C: Place = ("case", "other", "b/b", 1e-4, None)


def test_figures_of_a_millisecond_are_compared_whichever_is_larger() -> None:
    found = gaps({A: (1e-2, 1e-2), B: (9e-4, 1e-3)}, {A: (1.3e-2, 2e-2), B: (1e-4, 1e-3)})
    assert found.keys() == {A}
    assert round(found[A], 9) == 0.3
    assert gaps({A: (1.3e-2, 1.0)}, {A: (1e-2, 1.0)}) == found


def test_a_ranking_turns_only_where_intervals_lie_apart_in_both_sessions_of_one_variant() -> None:
    first = {A: (1.0, 2.0), B: (3.0, 4.0), C: (0.1, 0.2)}
    assert rankings(first, first) == (1, [])
    turned = {A: (5.0, 6.0), B: (3.0, 4.0), C: (0.1, 0.2)}
    assert rankings(first, turned) == (1, [f"{A} and {B[2:]}"])
    assert rankings(first, {**turned, A: (3.5, 6.0)}) == (0, [])
