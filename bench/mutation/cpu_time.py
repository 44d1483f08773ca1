"""Ends processes that use too much CPU time, without a timer in them.

While a process has a timer or a limit of CPU time, its clock of CPU time moves in ticks of 4 ms, in
which a short solve takes no time at all: tests of costs would fail. So its parent watches it.
"""

import ctypes
import mmap
import os
import select
import signal
import time

PAUSE = 50  # ms between two looks at a clock


class Allowance:
    """The CPU time [s] until which a fork may run; the fork can change it."""

    def __init__(self, seconds: float) -> None:
        self._until = ctypes.c_double.from_buffer(mmap.mmap(-1, 8))  # shared with forks
        self._until.value = seconds

    def renew(self, seconds: float) -> None:
        """Allow the calling process so much from now on."""
        self._until.value = time.process_time() + seconds

    def waited(self, child: int) -> int:
        """Wait for a child, which SIGPROF ends after its time; returns its status."""
        handle = os.pidfd_open(child)
        ended = select.poll()
        ended.register(handle, select.POLLIN)
        while not ended.poll(PAUSE):
            if used(child) > self._until.value:
                os.kill(child, signal.SIGPROF)
        os.close(handle)
        return os.waitpid(child, 0)[1]


def used(process: int) -> float:
    """The CPU time [s] of a process, by its clock as of clock_getcpuclockid(3)."""
    try:
        return time.clock_gettime((~process << 3) | 2)
    except OSError:  # it has just ended
        return 0.0
