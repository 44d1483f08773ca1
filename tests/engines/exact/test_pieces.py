"""Claims about pieces of a slip: how long they are, where they end, the series of their drive."""

from __future__ import annotations

from math import factorial

import numpy as np
import pytest

from vv.engines.exact.slide.clock import ORDER as HIGHEST
from vv.engines.exact.slide.clock import Clock
from vv.engines.exact.turn.kernel import LAST, LONGEST, _end_of_piece, _step_of_slip
from vv.engines.exact.turn.series import ORDER
from vv.engines.exact.turn.slipping import SLIP as WAY
from vv.engines.exact.turn.slipping import SPEED

pytestmark = pytest.mark.usefixtures("in_python")


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("seed", [3, 45, 200, 210, 219])
def test_a_piece_ends_where_its_time_is_that_of_the_end(seed: int, unit: float) -> None:
    """Of polynomials that rise unevenly, where steps along the slope lead out of the piece."""
    random = np.random.default_rng(seed)
    root = np.polynomial.Polynomial(random.normal(size=5) * [1, 3, 6, 6, 6])
    elapsed = unit * (root * root + 1e-3).integ()
    end = random.uniform(0.3, 1.0)
    duration = elapsed(end) * random.uniform(0.02, 0.98)
    piece = np.zeros((ORDER + 1, 3))
    piece[: len(elapsed.coef), 2] = elapsed.coef
    for t in (0.0, 5.0 * unit):
        then, x = _end_of_piece(piece, end, t, t + duration)
        assert then == t + duration
        assert elapsed(x) == pytest.approx(duration, rel=1e-9)
        assert 0.0 <= x <= end
        late = t + 2.0 * elapsed(end)
        assert _end_of_piece(piece, end, t, late) == pytest.approx((t + elapsed(end), end))


@pytest.mark.parametrize("n", [ORDER - 2, ORDER - 1])
@pytest.mark.parametrize("parts", [{SPEED: -3.0}, {WAY: 3.0}, {WAY + 1: -3.0},
                                   {WAY: 1.8, WAY + 1: 2.4, SPEED: 2.9}])  # fmt: skip
def test_a_step_of_slip_is_so_long_that_the_last_terms_are_rounding(
    n: int, parts: dict[int, float]
) -> None:
    """The last two terms count, over the first; all before them may be as large as they like."""
    q = np.zeros((ORDER, 1 + max(SPEED, WAY + 1)))
    q[: ORDER - 2] = 1e9
    q[0, SPEED] = 7.0
    assert _step_of_slip(q) == LONGEST
    for k, value in parts.items():
        q[n, k] = 1e-60 * value
    assert _step_of_slip(q) == LONGEST
    q[n] *= 1e60
    end = _step_of_slip(q)
    assert end == pytest.approx((LAST * 7.0 / 3.0) ** (1.0 / n))
    assert 3.0 * end**n == pytest.approx(LAST * 7.0)


def test_all_terms_of_a_drive_are_those_of_its_sines() -> None:
    """The term n of sin(a + w (part + s)) is w^n/n! sin(a + w part + n pi/2), to the last one."""
    row, phase = np.random.default_rng(2).normal(size=3), np.array([0.3, -1.1])
    clock, part = Clock.of(np.array([1.0, 0.4]), phase, 5.0), 0.4
    found = clock.taylor(row) @ clock.waves((0, part))
    n = np.arange(HIGHEST + 1)
    size = clock.turn[:, None] ** n / [float(factorial(k)) for k in n]
    due = row[1:] @ (size * np.sin((phase + clock.turn * part)[:, None] + n * np.pi / 2))
    due[0] += row[0]
    assert found == pytest.approx(due, rel=1e-11, abs=0.0)  # the last ones are near 1e-29
