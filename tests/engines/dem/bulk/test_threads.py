"""Claims about threads that share many free spheres: they change no bit of an answer."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from tests.engines.dem.bulk.test_bulk import DT, crowd
from vv.ask import Ask, Displacement, History, Knobs
from vv.engines import dem
from vv.engines.dem.bulk.model import BulkState
from vv.scene import Contact

LAWS = {
    "friction and drag": (Contact(1e5, 2e4, 0.5), 2e-3),
    "friction, dashpots and drag": (Contact(1e5, 2e4, 0.5, 0.3), 2e-3),
}
ACROSS = (10, 10, 41)  # 4100 spheres, which make four chunks


def program(law: str, threads: int) -> dem.PreparedSpheres:
    """A crowd that takes 90 steps and reports its positions three times."""
    contact, eta = LAWS[law]
    scene = crowd(contact, eta, across=ACROSS)
    seen = tuple(map(Displacement, range(len(scene.spheres))))
    return dem.prepare(Ask(scene, History(90 * DT, 30 * DT), seen, Knobs(DT)), dem.CENTRED, threads)


@pytest.mark.parametrize("law", LAWS)
def test_threads_give_the_bits_of_one_core(law: str) -> None:
    """It runs in a process of its own, since this one has one thread.

    Three threads do not divide four chunks evenly.
    """
    script = (
        "from tests.engines.dem.bulk.test_threads import program\n"
        f"told = [program({law!r}, threads) for threads in (1, 2, 3)]\n"
        "assert [one.solve() for one in told] == [4, 4, 4]\n"
        "assert told[0].arguments[1][-1, 3] > 0.0, 'nothing rubs'\n"
        "bits = {tuple(a.tobytes() for a in one.arguments[:2]) for one in told}\n"
        "assert len(bits) == 1, 'threads change the answer'\n"
    )
    env = {**os.environ, "NUMBA_NUM_THREADS": "3"}
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_one_core_is_given_no_loop_for_threads() -> None:
    """Such a loop takes long to compile, which a run on one core need not wait for."""
    place = BulkState._fields.index("threads") - len(BulkState._fields) - 2  # before the leapfrog
    told = [program("friction and drag", threads).arguments[place] for threads in (1, 2)]
    assert told == [None, 2]
