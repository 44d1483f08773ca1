"""Whether rectangular stones on dry joints are in equilibrium under gravity and a thrust.

Livesley (1978), International Journal for Numerical Methods in Engineering 12, 1853-1871: joints
press at their two ends, with forces in Coulomb's cone. A linear program tells whether such forces
can balance the weight of each stone and a horizontal force at its centre, which is `thrust` times
the weight. If they cannot, stones rock, slide or fall. The converse does not hold: with friction
more than one motion may obey all laws, and stones that may stay may also move (Drucker 1954).
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BASE = -1  # the number of what carries the stones, at height 0
TOUCHES = 1e-9  # of a stone's width: stones that are closer touch
BALANCED, UNBALANCED = 0, 2  # of the program: an optimum is found, or no forces are feasible


class Stone(NamedTuple):
    """The sides of a rectangle in the plane [m]; it weighs as much as its area."""

    left: float
    right: float
    low: float
    high: float


class Contact(NamedTuple):
    """One end of a joint: the number of the stone below or to the left, and of the other one.

    level: whether the joint is a bed joint, and not upright.
    """

    before: int
    behind: int
    x: float
    z: float
    level: bool


def contacts(stones: Sequence[Stone]) -> Iterator[Contact]:
    """The ends of all joints of the stones with one another and with the base."""
    for number, stone in enumerate(stones):
        if stone.low == 0.0:
            yield from (Contact(BASE, number, x, 0.0, True) for x in stone[:2])
    left, right, low, high = np.array(stones, float).reshape(-1, 4).T
    near = TOUCHES * (right - left)[:, None]
    for i, j in _meeting(high, low, left, right, near):
        ends = max(left[i], left[j]), min(right[i], right[j])
        yield from (Contact(i, j, float(x), stones[j].low, True) for x in ends)
    for i, j in _meeting(right, left, low, high, near):
        ends = max(low[i], low[j]), min(high[i], high[j])
        yield from (Contact(i, j, stones[j].left, float(z), False) for z in ends)


def _meeting(
    side: Array, other: Array, first: Array, last: Array, near: Array
) -> Iterator[tuple[int, int]]:
    """Pairs of a stone and another, whose `other` side lies on its side, along more than a point.

    first, last: where these sides begin and end; near: the least length, for each stone (k, 1).
    """
    along = np.minimum(last[:, None], last) - np.maximum(first[:, None], first)
    meet = (np.abs(side[:, None] - other) < near) & (along > near)
    yield from ((int(i), int(j)) for i, j in np.argwhere(meet) if i != j)


def stands(stones: Sequence[Stone], mu: float, thrust: float, upright: bool = True) -> bool:
    """Whether compressive forces within Coulomb's cone balance all stones.

    thrust: the sum of the horizontal forces of the joints of a stone over its weight, to the right;
    upright: joints between stones side by side may bear forces too. Raises RuntimeError if the
    program ends without an answer.
    """
    from scipy.optimize import linprog
    from scipy.sparse import csr_array

    rows, columns, values, cones = [], [], [], 0
    for end in (one for one in contacts(stones) if upright or one.level):
        for side in (mu, -mu):  # the two edges of the cone
            force = (side, 1.0) if end.level else (1.0, side)
            for number, sign in ((end.behind, 1.0), (end.before, -1.0)):
                if number != BASE:
                    rows += [3 * number, 3 * number + 1, 3 * number + 2]
                    columns += [cones] * 3
                    values += [sign * one for one in (*force, _moment(end, stones[number], force))]
            cones += 1
    weights = np.array([(one.right - one.left) * (one.high - one.low) for one in stones])
    loads = np.outer(weights / weights.mean(), [thrust, 1.0, 0.0]).ravel()
    balance = csr_array((values, (rows, columns)), shape=(len(loads), cones))
    answer = linprog(np.zeros(cones), A_eq=balance, b_eq=loads, method="highs-ipm")
    if answer.status not in (BALANCED, UNBALANCED):
        raise RuntimeError(f"whether the stones stand is not known: {answer.message}")
    return bool(answer.status == BALANCED)


def _moment(end: Contact, stone: Stone, force: tuple[float, float]) -> float:
    """The moment of a force about the centre of a stone, over its width."""
    arm = end.x - (stone.left + stone.right) / 2, end.z - (stone.low + stone.high) / 2
    return (arm[0] * force[1] - arm[1] * force[0]) / (stone.right - stone.left)
