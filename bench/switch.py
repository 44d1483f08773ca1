"""Tells which mutant is on; the copy of the project that holds mutants has it as vv/switch.py."""

import os

ON = int(os.environ.get("VV_MUTANT", "0"))  # none is 0


def on(number: int) -> bool:
    """Whether it is this one."""
    return number == ON
