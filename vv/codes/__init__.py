"""The interface of adapters to codes, and helpers to write one.

May import: base, scene, ask, engines.kernels.
"""

from vv.codes.adapter import (
    LEAPFROG_ON_SPRINGS,
    Adapter,
    Found,
    Scheme,
    behind_wall,
    known_beforehand,
    no_drag,
    no_sphere,
    no_steps,
    turned_spin_lock,
    unreported,
    unsupported,
)
from vv.codes.script import python_script, source
from vv.codes.timing import run_timed, timed

__all__ = [
    "LEAPFROG_ON_SPRINGS",
    "Adapter",
    "Found",
    "Scheme",
    "behind_wall",
    "known_beforehand",
    "no_drag",
    "no_sphere",
    "no_steps",
    "python_script",
    "run_timed",
    "source",
    "timed",
    "turned_spin_lock",
    "unreported",
    "unsupported",
]
