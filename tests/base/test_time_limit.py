"""A calculation without end is ended."""

import contextlib
import resource
import signal
import threading
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


def test_a_limit_is_as_long_as_it_says() -> None:
    with time_limit(0.4):
        _busy(0.3)


def test_after_it_no_clock_runs_and_what_stood_before_stands_again() -> None:
    """Else a later calculation would be ended, or the process by a signal that nobody handles."""

    def own(*_: object) -> None:
        """Stands before."""

    before = signal.signal(signal.SIGVTALRM, own)
    try:
        with time_limit(10.0):
            assert signal.getitimer(signal.ITIMER_VIRTUAL)[0] > 0
        with pytest.raises(KeyError), time_limit(10.0):
            raise KeyError
        assert signal.getsignal(signal.SIGVTALRM) is own
        assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)
    finally:
        signal.signal(signal.SIGVTALRM, before)


def test_in_a_thread_there_is_no_limit() -> None:
    done: list[str] = []

    def limited() -> None:
        with time_limit(0.02):
            _busy(0.1)
        done.append("whole")

    thread = threading.Thread(target=limited)
    thread.start()
    thread.join()
    assert done == ["whole"]


def _busy(seconds: float) -> None:
    """Keep the processor busy by work of our own; the limit does not count the system's."""
    begun = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    while resource.getrusage(resource.RUSAGE_SELF).ru_utime - begun < seconds:
        sum(range(100_000))


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
