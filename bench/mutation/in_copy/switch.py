"""Tells which mutant is on; the copy of the project that holds mutants has it as vv/switch.py."""

import os

NUMBER = "VV_MUTANT"  # the name under which the environment says which mutant is on
ON = int(os.environ.get(NUMBER, "0"))  # none is 0


def on(number: int) -> bool:
    """Whether it is this one."""
    return number == ON
