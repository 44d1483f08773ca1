"""A calculation without end is ended."""

import contextlib
import time

import pytest

from vv.base.time_limit import TooLongError, time_limit


def test_what_takes_too_long_is_ended_and_what_does_not_is_left_alone() -> None:
    with time_limit(10.0):
        total = sum(range(100))
    assert total == 4950
    begun = time.process_time()
    with pytest.raises(TooLongError, match=r"not done after 0\.1 s"), time_limit(0.1):
        _without_end()
    assert time.process_time() - begun < 1.0


def test_an_end_that_is_ignored_comes_again() -> None:
    begun = time.process_time()
    with pytest.raises(TooLongError), time_limit(0.1):
        _ignoring_one()
    assert time.process_time() - begun < 1.0


def _without_end() -> None:
    while True:
        pass


def _ignoring_one() -> None:
    """Python does so where an object is freed."""
    with contextlib.suppress(TooLongError):
        _without_end()
    begun = time.process_time()
    while time.process_time() - begun < 5.0:
        pass
