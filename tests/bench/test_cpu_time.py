"""Claims about limits of CPU time for the tests of mutants."""

from __future__ import annotations

import os
import signal
import time

from bench.mutation.collected_tests import forked
from bench.mutation.cpu_time import Allowance, used

SPIN = 0.3  # s


def spin(seconds: float) -> None:
    """Use so much CPU time."""
    until = time.process_time() + seconds
    while time.process_time() < until:
        pass


def test_a_fork_that_uses_too_much_cpu_time_is_ended() -> None:
    assert forked(lambda: spin(1e9), SPIN) == signal.SIGPROF
    assert forked(lambda: spin(SPIN), 100 * SPIN) == 0


def test_a_fork_may_wait_longer_than_it_may_compute() -> None:
    assert forked(lambda: time.sleep(2 * SPIN), SPIN) == 0


def test_the_clock_of_a_fork_with_a_limit_is_as_fine_as_without() -> None:
    """With a timer of CPU time it would move in ticks of 1 ms or more."""

    def look() -> None:
        seen = {time.process_time()}
        while len(seen) < 10:
            seen.add(time.process_time())
        assert max(seen) - min(seen) < 1e-3

    assert forked(look, 100.0) == 0


def test_a_fork_can_renew_what_it_may_use() -> None:
    for most, status in ((100 * SPIN, 0), (SPIN, signal.SIGPROF)):
        allowed = Allowance(2 * SPIN)
        child = os.fork()
        if child == 0:
            spin(SPIN)
            allowed.renew(most)
            spin(3 * SPIN)
            os._exit(0)
        assert allowed.waited(child) == status


def test_the_time_of_a_process_that_has_ended_is_none() -> None:
    child = os.fork()
    if child == 0:
        os._exit(0)
    os.waitpid(child, 0)
    assert used(child) == 0.0
    assert used(os.getpid()) > 0.0
