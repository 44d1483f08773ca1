"""Computes the motion of a slider in closed form within quarter periods, from event to event."""

from __future__ import annotations

from vv.engines.exact.guards import GUARD_ROUNDING
from vv.engines.exact.modes import BACKWARD, FORWARD, STUCK, Index
from vv.engines.exact.slide.arc import arc, first_fall
from vv.engines.kernels.compiled import compiled_to_branch, inlined
from vv.scene import Vector

FULL, CROWDED = -1, -2  # in place of the number of pieces; CROWDED minus it where events crowd
SLIPS, STARTS, PULLS, BASE, VELOCITY = 0, 2, 4, 7, 8  # rows; of two, the first is for FORWARD
NO_FRICTION = 2  # of PULLS
EVEN, ODD = 2, 3  # rows of work, after waves


@compiled_to_branch
def follow_line(
    rows: Vector,
    bounds: Vector,
    waves: Vector,
    turn: Vector,
    given: Vector,
    work: Vector,
    pieces: Vector,
    states: Index,
) -> int:
    """The number p of pieces, or a negative number for the reason of a failure.

    rows (9, 1 + k), each a constant and amplitudes of k sines: two rates at which the velocity of a
    slip changes, times its sign, and two margins before a start; these four [m/s] per cell, with
    bounds (4,) of their third and fourth derivatives. Accelerations of the body that slips forward,
    backward or without friction [m/s2]; the position of the wall [m], and its velocity [m/s] as
    amplitudes of cosines. waves (cells, 2, k): sines and cosines at the start of each cell; turn
    (k,) [rad]: the change of their phases in a cell. given (7,): cells per second; the part of the
    last cell at which the motion ends; speed [m/s], state and fastest speed [m/s] at t = 0; number
    of events allowed in a cell; whether there is friction. work (4, k). Filled: pieces (room, 5),
    the cell and part at which a piece starts, its length in cells, and place [m] and speed [m/s] at
    its start; states (room,). It is one function since each piece updates nearly all of its
    variables.
    """
    rate, last, speed, state = given[0], given[1], given[2], int(given[3])
    fastest, most, rubs = given[4], given[5], given[6] > 0.0
    place, cell, part, count, events = 0.0, 0, 0.0, 0, 0
    over = 1.0 / rate
    for i in range(len(turn)):
        work[EVEN, i], work[ODD, i] = arc(turn[i])
    while cell < len(waves):
        if count == len(pieces):
            return FULL
        end, after = (last if cell == len(waves) - 1 else 1.0) - part, state
        if part == 0.0:
            for i in range(len(turn)):
                work[0, i], work[1, i] = waves[cell, 0, i], waves[cell, 1, i]
        band = GUARD_ROUNDING * fastest
        if rubs:
            end, after = _event(rows, bounds, turn, work, state, speed, band, end)
        if end > 0.0:
            piece = pieces[count]
            piece[0], piece[1], piece[2], piece[3], piece[4] = cell, part, end, place, speed
            states[count] = state
            count += 1
            way, speed = _advance(rows, turn, work, state, rubs, over, end, speed)
            place += way
            fastest = max(fastest, abs(speed))
        if after == state:
            cell, part, events = cell + 1, 0.0, 0
        else:
            part, state, events = part + end, after, events + 1
            if events > most:
                return CROWDED - count
    return count


@inlined
def _event(
    rows: Vector,
    bounds: Vector,
    turn: Vector,
    work: Vector,
    state: int,
    speed: float,
    band: float,
    end: float,
) -> tuple[float, int]:
    """The part of a cell until the state changes, at most `end`, and the state then."""
    wave = work[:2]
    if state != STUCK:
        slip, row = speed, state - FORWARD
        for i in range(len(turn)):
            slip -= rows[VELOCITY, 1 + i] * wave[1, i]
        slip = slip if state == FORWARD else -slip
        fall = first_fall(True, slip, rows[SLIPS + row], bounds[SLIPS + row], turn, wave, band, end)
        return (fall, STUCK) if fall <= end else (end, state)
    after = STUCK
    for way in (FORWARD, BACKWARD):
        row = STARTS + way - FORWARD
        margin = rows[row, 0]
        for i in range(len(turn)):
            margin += rows[row, 1 + i] * wave[0, i]
        if margin <= -0.5 * band:
            return 0.0, way
        fall = first_fall(False, 0.0, rows[row], bounds[row], turn, wave, band, end)
        if fall <= end:
            end, after = fall, way
    return end, after


@inlined
def _advance(
    rows: Vector,
    turn: Vector,
    work: Vector,
    state: int,
    rubs: bool,
    over: float,
    x: float,
    speed: float,
) -> tuple[float, float]:
    """The way [m] of a piece of length x and the speed [m/s] at its end; waves move there."""
    sticks, pull = rubs and state == STUCK, PULLS + NO_FRICTION
    if state != STUCK:
        pull = PULLS + state - FORWARD
    gained, way = rows[pull, 0] * x, 0.5 * rows[pull, 0] * x * x
    if sticks:
        gained = way = 0.0
    for i in range(len(turn)):
        angle, sine, cosine = turn[i] * x, work[0, i], work[1, i]
        even, odd = (work[EVEN, i], work[ODD, i]) if x == 1.0 else arc(angle)
        risen, fallen = angle - angle * angle * angle * odd, angle * angle * even
        work[0, i] = sine - sine * fallen + cosine * risen
        work[1, i] = cosine - cosine * fallen - sine * risen
        if sticks:
            way += rows[BASE, 1 + i] * (cosine * risen - sine * fallen)
            gained += rows[VELOCITY, 1 + i] * work[1, i]
        else:
            size = rows[pull, 1 + i] * x
            gained += size * (sine * (1.0 - angle * angle * odd) + cosine * angle * even)
            way += size * x * (sine * even + cosine * angle * odd)
    if sticks:
        return way, gained
    return (speed * x + way * over) * over, speed + gained * over
